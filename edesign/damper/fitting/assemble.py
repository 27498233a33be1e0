"""The minimum as a Fit: values, errors, warnings."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from edesign.damper.fitting.fit import Fit, Tested
from edesign.damper.fitting.identifiable import LIMITED_BY
from edesign.damper.fitting.setup import Setup
from edesign.damper.fitting.solve import Outcome
from edesign.damper.fitting.warnings import LOOSE, identifiability_warnings, search_warnings
from edesign.estimation.uncertainty import uncertainty


def assemble(
    setup: Setup,
    outcome: Outcome,
    blocks: Sequence[int] | None,
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
        blocks: of each test, whose errors hang together; None: tests are the blocks.
        errors: NRMS by test.
        overall: see `Fit`.
        rms_error: see `Fit`.
        peak_error: see `Fit`.
        determined: see `Fit`.
        tested: range of the tests.
        independent: number of independent errors.
        against: "forces" or "properties" that were fitted.
    """
    coordinates, law, fitted = setup.coordinates, setup.law, outcome.fitted
    values, free = coordinates.values(outcome.x), np.flatnonzero(fitted.free)
    names, samples = [coordinates.names[i] for i in free], sum(error.size for error in outcome.errors)
    # parameters at a bound count as known: the others' errors do not answer for them
    found = uncertainty(fitted, blocks=blocks)
    slopes = coordinates.slopes(outcome.x)[free]
    count = len(found.pulls)
    few = (count - 1.0) / max(count - len(names), 1)  # parameters bend to the errors of blocks
    scatter = [slopes @ covariance @ slopes.T for covariance in (found.within, few * found.between)]
    white, robust = (dict(zip(names, np.sqrt(np.diag(one)).tolist(), strict=True)) for one in scatter)
    enough = count > 2 * len(names)
    chosen = scatter[1] if enough else scatter[0]
    errors_of = np.sqrt(np.maximum(np.diag(chosen), 1e-300))
    correlation = np.clip(chosen / np.outer(errors_of, errors_of), -1.0, 1.0)
    np.fill_diagonal(correlation, 1.0)
    if not enough:
        robust = dict.fromkeys(names, float("nan"))
    fewer = float(np.sqrt(max(samples / max(independent, 1.0), 1.0)))
    loose = [coordinates.names[i] for i in free if found.loose[i] > LOOSE]  # what no block determines does not scatter
    robust |= {name: max(robust[name], white[name]) for name in loose if enough}
    printed = robust if enough else {name: error * fewer for name, error in white.items()}
    at_bound = {name: values[name] for name in coordinates.names if name not in names}
    warnings = [
        f"{name} ended at its bound {value:g}"
        if coordinates.is_bound(name, value)
        else f"{name} ran off to {value:g}, the end of the search: what lies beyond fits as well"
        for name, value in at_bound.items()
    ]
    warnings += [
        f"{name} is left with nothing beside {other}, which is fixed above zero: start from {other} = 0"
        for name, other in LIMITED_BY.get(law.name, {}).items()
        if name in at_bound and other in setup.fixed and values[other] > 0.0
    ]
    warnings += identifiability_warnings(names, values, printed, correlation, loose, found.condition)
    if setup.thermal.kind is None and len(setup.thermal.temperatures) > 1:
        low, high = setup.thermal.temperatures[0], setup.thermal.temperatures[-1]
        warnings.append(f"tests at {low:g} to {high:g} degC were fitted with one set of parameters")
    warnings += search_warnings(outcome.costs, outcome.same, fitted.converged)
    own = {parameter.name for parameter in setup.thermal.parameters}
    return Fit(
        law=law,
        values={name: value for name, value in values.items() if name not in own},
        thermal_values={name: value for name, value in values.items() if name in own},
        thermal=setup.thermal,
        free=tuple(names),
        fixed=setup.fixed,
        at_bound=at_bound,
        standard_error=printed,
        standard_error_white=white,
        standard_error_robust=robust,
        error_kind="robust" if enough else "correlation time",
        correlation=correlation,
        nrms=errors,
        nrms_overall=overall,
        rms_error=rms_error,
        peak_error=peak_error,
        determination=determined,
        condition=found.condition,
        warnings=tuple(warnings),
        cost=outcome.cost,
        starts=outcome.costs,
        same_minimum=outcome.same,
        iterations=outcome.iterations,
        evaluations=outcome.evaluations,
        converged=fitted.converged,
        samples=samples,
        tested=tested,
        independent=independent,
        against=against,
    )
