"""Dampers by themselves: laws and their parameters, tests with their loops, fits.

Called by `edesign laws`, `edesign test`, `edesign characterise` and `edesign fit`.
"""
