"""The minimum as a Fit: values, errors, doubts."""

from __future__ import annotations

from typing import Literal

import numpy as np

from edesign.damper.fitting.doubts import doubts_of, start_doubts
from edesign.damper.fitting.fit import Fit, Tested
from edesign.damper.fitting.identifiable import LIMITED_BY
from edesign.damper.fitting.setup import Setup
from edesign.damper.fitting.solve import Outcome
from edesign.damper.fitting.uncertainty import uncertainty


def assemble(
    setup: Setup,
    outcome: Outcome,
    groups: tuple[np.ndarray, np.ndarray],
    errors: dict[str, float],
    overall: float,
    rms_error: dict[str, float],
    peak_error: dict[str, float],
    determined: dict[str, float],
    tested: Tested,
    independent: float,
    against: Literal["forces", "properties"] = "forces",
) -> Fit:
    """Gather what a fit found.

    Args:
        setup: unknowns of the fit.
        outcome: of the search.
        groups: test and block of every residual.
        errors: NRMS by test.
        overall: see `Fit`.
        rms_error: see `Fit`.
        peak_error: see `Fit`.
        determined: see `Fit`.
        tested: range of the tests.
        independent: number of independent errors.
        against: "forces" or "properties" that were fitted.
    """
    coordinates, law = setup.coordinates, setup.law
    values, x, free = coordinates.values(outcome.x), outcome.x, outcome.free
    names = [coordinates.names[i] for i in free]
    index = list(free)
    # parameters at a bound count as known: the others' errors do not answer for them
    slopes = coordinates.slopes(x)[np.ix_(index, index)]
    found = uncertainty(outcome.jacobian, outcome.residual, *groups, slopes, outcome.loss_weight)
    white = dict(zip(names, found.white.tolist(), strict=True))
    robust = dict(zip(names, found.robust.tolist(), strict=True))
    enough = bool(np.all(np.isfinite(found.robust)))
    fewer = float(np.sqrt(max(outcome.residual.size / max(independent, 1.0), 1.0)))
    printed = robust if enough else {name: error * fewer for name, error in white.items()}
    at_bound = {name: values[name] for i, name in enumerate(coordinates.names) if i not in free}
    doubts = [
        f"{name} ended at its bound {value:g}"
        if coordinates.is_bound(name, value)
        else f"{name} ran off to {value:g}, the end of the search: what lies beyond fits as well"
        for name, value in at_bound.items()
    ]
    doubts += [
        f"{name} is left with nothing beside {other}, which is held above zero: start from {other} = 0"
        for name, other in LIMITED_BY.get(law.name, {}).items()
        if name in at_bound and other in setup.held and values[other] > 0.0
    ]
    doubts += doubts_of(names, values, printed, found)
    if setup.thermal.kind is None and len(setup.thermal.temperatures) > 1:
        low, high = setup.thermal.temperatures[0], setup.thermal.temperatures[-1]
        doubts.append(f"tests at {low:g} to {high:g} degC were fitted with one set of parameters")
    doubts += start_doubts(outcome.costs, outcome.same, outcome.converged)
    own = {parameter.name for parameter in setup.thermal.parameters}
    return Fit(
        law=law,
        values={name: value for name, value in values.items() if name not in own},
        thermal_values={name: value for name, value in values.items() if name in own},
        thermal=setup.thermal,
        free=tuple(names),
        held=setup.held,
        at_bound=at_bound,
        standard_error=printed,
        standard_error_white=white,
        standard_error_robust=robust,
        error_kind="robust" if enough else "correlation time",
        correlation=found.correlation,
        nrms=errors,
        nrms_overall=overall,
        rms_error=rms_error,
        peak_error=peak_error,
        determination=determined,
        condition=found.condition,
        doubts=tuple(doubts),
        cost=outcome.cost,
        starts=outcome.costs,
        same_minimum=outcome.same,
        iterations=outcome.iterations,
        evaluations=outcome.evaluations,
        converged=outcome.converged,
        samples=int(outcome.residual.size),
        tested=tested,
        independent=independent,
        against=against,
    )
