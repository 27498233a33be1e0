"""Estimates of a calibration in the units of a laboratory."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import cache

from edesign.calibration.results.result import Estimate
from edesign.damper.law import Parameter
from edesign.damper.parameters import practical_unit
from edesign.project.notation.quantities import Kind
from edesign.project.notation.units import parse_quantity

_AS_THEY_ARE = ("", "degC", "K", "1/K")
_SHORT = 0.1  # s: shorter times are in ms
_SMALL = 1e-3  # kN, kN/mm...: smaller forces are in N
_PER_WORK = "1/J"  # a damper of a building does kJ of it
_EXPONENT = re.compile(r"\^([A-Za-z_]\w*)")  # a parameter as exponent in the unit of another


def practical(estimate: Estimate, siblings: Mapping[str, Estimate], size: float | None = None) -> Estimate:
    """Return an estimate in kN, mm, kJ, ms or s in place of SI; forces of a model specimen in N.

    Args:
        estimate: SI.
        siblings: those of the same law or effect, among which are exponents in its unit.
        size: value, SI, by which the unit is chosen, so that several stand in one; None: its own.
    """
    unit, size = estimate.unit, abs(estimate.value if size is None else size)
    if unit in _AS_THEY_ARE:
        return estimate
    if unit == "s":
        scale, shown = (1e-3, "ms") if size < _SHORT else (1.0, "s")
    elif unit == _PER_WORK:
        scale, shown = 1e-3, "1/kJ"
    else:
        exponents = {name: siblings[name].value for name in _EXPONENT.findall(unit) if name in siblings}
        shown = practical_unit(Parameter("", "", unit))
        scale = _scale(_with_numbers(shown, exponents), _with_numbers(unit, exponents))
        if shown.startswith("kN") and 0.0 < size < _SMALL * scale:
            scale, shown = 1e-3 * scale, shown.removeprefix("k")
    return estimate.scaled(scale, shown)


@cache
def _scale(shown: str, unit: str) -> float:
    """One of the unit shown, in SI."""
    return parse_quantity(f"1 {shown}", Kind("value", unit, f"1 {shown}")) if shown != unit else 1.0


def _with_numbers(unit: str, exponents: Mapping[str, float]) -> str:
    return _EXPONENT.sub(lambda match: f"^{exponents.get(match[1], match[1])!r}", unit)
