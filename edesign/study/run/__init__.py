"""Carrying out a plan: order, calls, back ends, progress, interruption, and going on where a run stopped.

`run.py` is behind `edesign run`.
"""
