"""The forms of effects that damper tests may show, one table a subject."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import (
    alignment,
    amplitude,
    condition,
    friction,
    gain,
    gas_spring,
    hardening,
    hysteresis,
    lag,
    limit,
    load_cell,
    mullins,
    one_sided,
    pinching,
    places,
    rig,
    temperature_law,
    viscous,
    wear,
    zero,
)
from edesign.calibration.dampers.sizes import Sizes

TABLES = (
    *(amplitude, mullins, hardening, one_sided, limit, viscous, hysteresis, pinching, gas_spring, temperature_law),
    *(wear, friction, rig, alignment, lag, gain, zero, load_cell),
)
"""Modules, each with its FORMS."""


def forms(sizes: Sizes, parameters: Sequence[str] = ("parameter",)) -> tuple[EffectForm, ...]:
    """Return all forms that a campaign can show, of whatever law.

    Args:
        parameters: names of those of the law that may depend on a condition of the tests; any one stands for all.
    """
    listed = (form for table in TABLES for form in table.FORMS)
    every = (*listed, *condition.of_conditions(sizes, parameters), *places.one_test(sizes), *places.from_test(sizes))
    return tuple(form for form in every if form.shown(sizes))
