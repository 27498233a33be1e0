"""What a calibration found, as tables and figures: errors, effects, residuals, properties, structures.

Called by `edesign calibrate` and by `report.page.calibration`.
"""
