"""ASCE/SEI 7: two-period spectra and sets of ground motions of 7-16 and 7-22; damping systems of 7-16."""

from edesign.codes.asce7.damping_devices import largest_property_factor, smallest_property_factor
from edesign.codes.asce7.ground_motions import set_rules
from edesign.codes.asce7.spectrum import EARTHQUAKES, AsceDesignSpectrum, AsceSpectrum, damping_coefficient

__all__ = [
    "EARTHQUAKES",
    "AsceDesignSpectrum",
    "AsceSpectrum",
    "damping_coefficient",
    "largest_property_factor",
    "set_rules",
    "smallest_property_factor",
]
