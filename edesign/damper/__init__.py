"""Dampers as devices: laws with parameters and temperature, effects, sizing, tuned masses.

`laws.py` is the registry; the forces themselves are computed by the core. Frames (`frame`), tests (`testing`), fits
(`fitting`), the calibration and substructure tests take dampers from here.
"""
