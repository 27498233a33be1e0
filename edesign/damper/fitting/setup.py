"""What is fitted and what is fixed: shared by fits to forces and to properties."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import get_args

import numpy as np

from edesign.damper.fitting.coordinates import ABOVE, Bounds, Coordinates
from edesign.damper.fitting.identifiable import FIXED, as_held, beside, fixed_by_default, held, is_bouc_wen, why_fixed
from edesign.damper.fitting.observed import Observed
from edesign.damper.fitting.solve import Loss
from edesign.damper.fitting.start import branches_of, start_values
from edesign.damper.fitting.thermal import Thermal, ThermalKind, thermal
from edesign.damper.law import Law, Parameter
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean

_SAME = 1e-9  # relative difference of rounding
_FRACTION = 0.1  # of a parameter that must exceed another, where the other one starts


@dataclass(frozen=True)
class Setup:
    """A fit before it is run.

    Attributes:
        law: the law.
        parameters: all of it, and the unknowns of the temperature.
        coordinates: of what is fitted.
        fixed: what is not, with the reason.
        thermal: how temperature enters.
    """

    law: Law
    parameters: tuple[Parameter, ...]
    coordinates: Coordinates
    fixed: dict[str, str]
    thermal: Thermal

    def canonical(self, x: np.ndarray) -> np.ndarray:
        """Return coordinates with the branches of a law in the order of their relaxation times, the longest first.

        Args:
            x: (n,) coordinates.

        Returns:
            (n,) coordinates.
        """
        kinds = [parameter.name for parameter in self.law.branch]
        values = self.coordinates.values(x)
        count = branches_of(self.law, values, 1)
        free = all(f"{kind}{i}" in self.coordinates.names for kind in kinds for i in range(1, count + 1))
        if count < 2 or not free or self.coordinates.bounded:
            return x
        order = sorted(range(1, count + 1), key=lambda i: -values[f"c{i}"] / values[f"k{i}"])
        moved = {f"{kind}{new}": values[f"{kind}{old}"] for new, old in enumerate(order, 1) for kind in kinds}
        return self.coordinates.at({**values, **moved})


def set_up(
    law: Law,
    observed: Observed,
    start: Mapping[str, float] | None,
    bounds: Bounds | None,
    fixed: Mapping[str, float] | Sequence[str],
    fit_also: Sequence[str],
    temperatures: Sequence[float],
    kind: ThermalKind | None,
    reference_C: float | None,
    branches: int,
    starts: int,
    loss: Loss,
) -> Setup:
    """Decide what is fitted, from where, and within which bounds.

    Args:
        start: see `fit_forces`.
        bounds: see `fit_forces`.
        fixed: see `fit_forces`.
        fit_also: see `fit_forces`.
        temperatures: of the tests, degC.
        kind: what the temperature changes.
        reference_C: degC at which the parameters hold.
        branches: of a law with branches.
        starts: number of descents.
        loss: see `fit_forces`.

    Raises:
        InputError: an option names what there is not, or nothing is left to fit.
    """
    if loss not in get_args(Loss):
        raise InputError(
            f"loss: `{loss}` is unknown{did_you_mean(str(loss), get_args(Loss))} ({', '.join(get_args(Loss))})"
            " [E-FIT-04]"
        )
    if starts < 1:
        raise InputError(f"starts: {starts}; at least 1 is needed [E-FIT-04]")
    heat = thermal(law, kind, temperatures, reference_C)
    begin = {**(start or {}), **(fixed if isinstance(fixed, Mapping) else {})}
    parameters = (*law.with_branches(branches_of(law, begin, branches)), *heat.parameters)
    known = {parameter.name: parameter for parameter in parameters}
    for what, names in (("start", begin), ("fixed", fixed), ("fit", fit_also), ("bounds", bounds or {})):
        for name in names:
            if name not in known:
                raise InputError(
                    f"{what}: law {law.name} has no parameter `{name}`{did_you_mean(name, known)} "
                    f"(there are: {', '.join(known)}) [E-FIT-04]"
                )
    for name, value in begin.items():
        if not known[name].allows(value):
            raise InputError(
                f"start of `{name}`: {known[name].written(value)} is out of range: {known[name].allowed} is allowed"
                " [E-FIT-03]"
            )
    constants = fixed_by_default(law, begin, observed.scales, observed.largest_force)
    for name in fit_also:
        if name not in FIXED.get(law.name, {}) and name in constants:
            raise InputError(
                f"fit: `{name}` of law {law.name} is a choice, not a number that data can determine [E-FIT-02]"
            )
        constants.pop(name, None)
    own = {name: value for name, value in begin.items() if name not in {p.name for p in heat.parameters}}
    values = start_values(law, observed, {**own, **constants}, branches)
    holds = is_bouc_wen(law) and "gamma" in constants and "gamma" not in fixed
    if holds:
        scaled = as_held(law, values)
        # what the user fixed is not scaled
        holds = all(math.isclose(scaled[name], values[name], rel_tol=_SAME) for name in fixed if name in values)
        values = scaled if holds else values
    values |= {p.name: begin.get(p.name, p.default or 1.0) for p in heat.parameters}
    reasons = {name: why_fixed(law, name) or "a choice" for name in constants}
    reasons |= {name: "fixed by the user" for name in fixed}
    values = _within(values, bounds, begin, known)
    values = _apart(values, ABOVE.get(law.name, {}), begin)
    free = [name for name in values if name not in reasons]
    if not free:
        raise InputError(f"all parameters of law {law.name} are fixed; nothing is left to fit [E-FIT-04]")
    if is_bouc_wen(law) and not holds and "gamma" in reasons:
        reasons["gamma"] = "fixed by the user" if "gamma" in fixed else "you fix others, and z has the unit of these"
    parameters = tuple(beside(law, one, values if holds else constants, holds) for one in parameters)
    above = ABOVE.get(law.name)
    coordinates = Coordinates(
        parameters, free, values, observed.scales, bounds, above, partial(held, law) if holds else dict
    )
    return Setup(law, parameters, coordinates, reasons, heat)


def _apart(values: dict[str, float], above: Mapping[str, str], begin: Mapping[str, float]) -> dict[str, float]:
    """Starts from the data moved where one parameter must exceed another; those the user gave are refused."""
    found = dict(values)
    for name, other in above.items():
        if found[name] > found[other]:
            continue
        if name in begin and other in begin:
            raise InputError(f"start of `{name}`: {found[name]:g} is not above {other} = {found[other]:g} [E-FIT-03]")
        if name in begin:
            found[other] = _FRACTION * found[name]
        else:
            found[name] = found[other] / _FRACTION
    return found


def _within(
    values: dict[str, float], bounds: Bounds | None, begin: Mapping[str, float], known: Mapping[str, Parameter]
) -> dict[str, float]:
    """Starts that came from the data moved inside the user's bounds; those the user gave are left to be refused."""
    found = dict(values)
    for name, (low, high) in (bounds or {}).items():
        if name in found and name not in begin and not low <= found[name] <= high and low < high:
            positive = low > 0.0 and math.isfinite(high)
            middle = math.sqrt(low * high) if positive else 0.5 * (low + high)
            found[name] = middle if math.isfinite(middle) else low if math.isfinite(low) else high
            if not known[name].allows(found[name]):
                found[name] = high if math.isfinite(high) else low
    return found
