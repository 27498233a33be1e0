"""The effects that properties of steady cycles may show."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.effects import (
    friction,
    gain,
    hardening,
    inertia,
    lag,
    payne,
    play,
    relaxation_branch,
    series_flexibility,
    temperature_law,
    velocity_exponent,
)
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.problem import Candidate
from edesign.calibrate.properties import arrangement, reading
from edesign.calibrate.properties.gamma import FreeGamma

# what fades, wears or drifts is gone in the mean of cycles 5 to 15 of tests of which nobody tells the order
_MODULES = (
    payne,
    hardening,
    relaxation_branch,
    velocity_exponent,
    friction,
    play,
    series_flexibility,
    lag,
    gain,
    inertia,
)


def candidates_of(problem: DamperProblem) -> tuple[Candidate, ...]:
    """All forms of effects for a table whose rows are the trials of a problem."""
    fitted = [trial for trial in problem.trials if trial.use == "fit"]
    left = Left(fitted, [np.zeros(trial.force.size) for trial in fitted])
    temperatures = sorted({float(np.mean(trial.temperature)) for trial in fitted})
    relaxes = problem.law.name == "mgmm"
    found = [candidate_of(form, problem.sizes, left) for form in _forms(relaxes, temperatures)]
    return tuple(candidate for candidate in found if candidate is not None and candidate.starts)


def _forms(relaxes: bool, temperatures: list[float]) -> Iterator[Form]:
    for module in _MODULES:
        for kind in module.FORMS:
            form = kind()
            yield form
            if relaxes and form.may_be_inside:
                yield form.within()
    yield from (kind() for kind in reading.FORMS)
    if relaxes:
        yield from (kind() for kind in arrangement.FORMS)
        yield FreeGamma(temperatures)
    else:
        # laws with a table of gamma_T change with temperature by it: a law file takes one or the other
        yield from (kind() for kind in temperature_law.FORMS)
