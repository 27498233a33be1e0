"""The elastic design of a building as tables and drawings: spectra, checks with numbers, plans, elevations.

Called by `edesign run` and `edesign show` of a building, and by its sections of the page.
"""
