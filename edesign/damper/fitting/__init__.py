"""Fits of damper laws to measured forces or properties."""

from __future__ import annotations

from edesign.damper.fitting.compare import Comparison, compare_laws
from edesign.damper.fitting.cross_validation import CrossValidation, cross_validate, prediction_errors
from edesign.damper.fitting.fit import Fit, Tested
from edesign.damper.fitting.forces import fit_forces
from edesign.damper.fitting.law_fit import fit_law
from edesign.damper.fitting.property_fit import fit_properties

__all__ = [
    "Comparison",
    "CrossValidation",
    "Fit",
    "Tested",
    "compare_laws",
    "cross_validate",
    "fit_forces",
    "fit_law",
    "fit_properties",
    "prediction_errors",
]
