"""Motions made ready for histories: fitted to the spectrum, applied as a history asks for, archived.

A run makes them before its first history; `edesign match` makes them alone.
"""
