"""Dampers as devices: laws with parameters and temperature, tests and their files, properties, tuned masses.

`laws.py` is the registry; the forces themselves are computed by the core. Frames (`building`), fits (`fitting`),
the calibration and substructure tests take dampers from here.
"""
