"""Blind tests of calibration: a generator of campaigns with hidden effects, and a scorer. The generator knows nothing
of edesign; it stands for a laboratory that is not ours."""
