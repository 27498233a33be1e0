"""EN 1998-1:2004, Eurocode 8: the seismic action, what accelerograms must satisfy, analysis and steel frames."""

from edesign.codes.ec8.action.accelerograms import SET_RULES
from edesign.codes.ec8.action.design import DesignSpectrum, vertical_design_spectrum
from edesign.codes.ec8.action.displacement import LongPeriodSpectrum
from edesign.codes.ec8.action.elastic import ElasticSpectrum, damping_correction
from edesign.codes.ec8.action.parameters import HorizontalParameters, VerticalParameters
from edesign.codes.ec8.action.vertical import VerticalSpectrum
from edesign.codes.ec8.national import NationalParameters, countries, national_parameters
from edesign.codes.rule_check import RuleCheck

__all__ = [
    "RuleCheck",
    "DesignSpectrum",
    "ElasticSpectrum",
    "HorizontalParameters",
    "LongPeriodSpectrum",
    "NationalParameters",
    "SET_RULES",
    "VerticalParameters",
    "VerticalSpectrum",
    "countries",
    "damping_correction",
    "national_parameters",
    "vertical_design_spectrum",
]
