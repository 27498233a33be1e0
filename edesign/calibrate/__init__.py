"""What a model lacks, found in measured data: the loop from a residual to an effect that is added.

What dampers, property tables and structures share stands here, the rest in the rooms `dampers`, `properties` and
`structure`. `edesign calibrate` calls `run.py`, and `report.calibration` shows what it found.
"""
