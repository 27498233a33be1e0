"""Processing of records; each function returns a record whose source says what was done."""

from edesign.ground_motion.processing.band_pass import band_pass
from edesign.ground_motion.processing.baseline import correct_baseline, remove_drift
from edesign.ground_motion.processing.length import pad, taper, trim, trim_to_significant
from edesign.ground_motion.processing.resampling import resample_band_limited

__all__ = [
    "band_pass",
    "correct_baseline",
    "pad",
    "remove_drift",
    "resample_band_limited",
    "taper",
    "trim",
    "trim_to_significant",
]
