"""Estimates of a calibration in the units of a laboratory, as text with their uncertainty."""

from __future__ import annotations

import math

from edesign.calibration.residual.series import Series
from edesign.calibration.results.result import Estimate
from edesign.report.tables.cell import Rounded, Value
from edesign.report.tables.number import significant
from edesign.report.tables.unit import PERCENT

UNKNOWN = "not determined"
_LARGEST = 1e7
_MOST_PLACES = 9


_SHOWN = {"N": (1e3, "kN"), "m": (1e-3, "mm"), "m/s^2": (1.0, "m/s²")}


def scale_of(series: Series) -> tuple[float, str]:
    """The unit in which what a series measures is shown, SI, and its name."""
    return _SHOWN[series.unit]


def percent(ratio: float, digits: int = 3) -> str:
    """A ratio in per cent, "-" if there is none."""
    return significant(ratio / PERCENT.si, digits) if math.isfinite(ratio) else "-"


def value_text(estimate: Estimate) -> str:
    """The value with the digits that its standard error leaves."""
    return _with_places(estimate.value, estimate.standard_error)


def value_cell(estimate: Estimate) -> Value:
    """The same for a table, which keeps all digits of the number."""
    shown = value_text(estimate)
    return Rounded(shown, estimate.value) if math.isfinite(estimate.value) else shown


def error_text(estimate: Estimate) -> str:
    """The standard error; "fixed" of a value that was not searched."""
    error = estimate.standard_error
    if not math.isfinite(error):
        return UNKNOWN
    return _with_places(error, error) if error > 0.0 else "fixed"


def interval_text(estimate: Estimate) -> str:
    """The 95 % interval, or why there is none."""
    error = estimate.standard_error
    if estimate.not_determined:
        return f"{UNKNOWN}: {estimate.not_determined}"
    if not math.isfinite(error):
        return UNKNOWN
    if error == 0.0:
        return "fixed"
    return " to ".join(_with_places(end, error) for end in estimate.interval)


def plus_minus(estimate: Estimate) -> str:
    """Value, standard error and unit: 4.00 ± 0.10 ms."""
    unit = f" {estimate.unit}" if estimate.unit else ""
    error = error_text(estimate)
    if error == "fixed":
        return f"{value_text(estimate)}{unit}"
    if error == UNKNOWN:
        why = f"{UNKNOWN}: {estimate.not_determined}" if estimate.not_determined else f"uncertainty {UNKNOWN}"
        return f"{value_text(estimate)}{unit} ({why})"
    return f"{value_text(estimate)} ± {error}{unit}"


def _with_places(value: float, error: float) -> str:
    """A number to two digits of its error; of an error that says nothing, four digits."""
    if not math.isfinite(value):
        return UNKNOWN
    if not math.isfinite(error) or error <= 0.0 or abs(value) >= _LARGEST:
        return f"{value:.4g}"
    places = 1 - math.floor(math.log10(error))
    if places > _MOST_PLACES:
        size = math.floor(math.log10(abs(value))) if value else 0
        return f"{value:.{max(size + places + 1, 1)}g}"
    found = f"{round(value, places):.{max(places, 0)}f}"
    return found.removeprefix("-") if float(found) == 0.0 else found
