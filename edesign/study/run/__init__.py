"""Carrying out a plan: order, tasks, back ends, progress, interruption, and going on where a run stopped.

`run.py` is behind `edesign run`.
"""
