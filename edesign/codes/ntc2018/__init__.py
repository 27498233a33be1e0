"""NTC 2018, the Italian technical rules for construction (D.M. 17 January 2018): the seismic action of chapter 3.2."""

from edesign.codes.ntc2018.accelerograms import SERVICEABILITY, ULTIMATE
from edesign.codes.ntc2018.design import NtcDesignSpectrum
from edesign.codes.ntc2018.elastic import NtcSpectrum, NtcVerticalSpectrum
from edesign.codes.ntc2018.return_period import LIMIT_STATES, reference_life, return_period
from edesign.codes.ntc2018.site import Site

__all__ = [
    "LIMIT_STATES",
    "SERVICEABILITY",
    "ULTIMATE",
    "NtcDesignSpectrum",
    "NtcSpectrum",
    "NtcVerticalSpectrum",
    "Site",
    "reference_life",
    "return_period",
]
