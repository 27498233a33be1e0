"""Motions made ready for histories: found, chosen, processed, fitted to the spectrum.

Called by `study.run` before the first history, and by `edesign match`.
"""
