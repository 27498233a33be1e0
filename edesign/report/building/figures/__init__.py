"""The building as figures: plans, elevations, loads, spectra, diagrams of forces."""
