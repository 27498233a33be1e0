"""The loop on records of a building: a shear building on a fixed, flexible or isolated base, and its effects.

`run.py` is called by `edesign calibrate` where a campaign is of a structure.
"""
