"""FEMA 356 (November 2000), Prestandard and Commentary for the Seismic Rehabilitation of Buildings: steel frames."""

from edesign.codes.fema356.drift import PERFORMANCE_LEVELS

__all__ = ["PERFORMANCE_LEVELS"]
