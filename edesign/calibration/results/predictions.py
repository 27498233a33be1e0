"""What a model predicts of all tests at full rate, and how large its errors are."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.nuisance import joined
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.residual.series import Errors
from edesign.calibration.search.problem import Effect
from edesign.damper.testing.measured_histories import USES, Use
from edesign.estimation.model import PredictionError


def predicted(problem: DamperProblem, effects: Sequence[Effect], values: np.ndarray) -> list[np.ndarray]:
    """Return the force (n_i,) N of every test, with nuisance amplitudes estimated from its residual.

    Args:
        values: (p,) SI, of the law and the effects.

    Raises:
        PredictionError: there is none.
    """
    model = problem.model(effects, USES)
    (forces,) = model.forces(values)
    if isinstance(forces, PredictionError):
        raise forces
    found = []
    for one, force, nuisances in zip(problem.experiments, forces, model.nuisances(values), strict=True):
        columns = joined(nuisances, True)
        if columns is not None:
            weights, prior = one.weights / one.weighted_noise, np.eye(columns.shape[1])
            rows = np.vstack((weights[:, np.newaxis] * columns, prior))
            left = np.concatenate((weights * (one.force - force), np.zeros(len(prior))))
            force = force + columns @ np.linalg.lstsq(rows, left, rcond=None)[0]
        found.append(force)
    return found


def judged(one: Experiment, values: np.ndarray) -> np.ndarray:
    """Return a history (n,) from the first sample that is judged: what is before depends on how the test started.

    Args:
        values: (n,).
    """
    return values[one.judged_from :]


def errors_of(problem: DamperProblem, forces: Sequence[np.ndarray]) -> Errors:
    """Return NRMS over the tests of each use, and of each test.

    Args:
        forces: (n_i,) N, predicted of every test.
    """
    squared, power = {}, {}
    for one, force in zip(problem.experiments, forces, strict=True):
        squared[one.name] = float(np.sum((one.force - force)[one.judged] ** 2))
        power[one.name] = max(float(np.sum(one.force[one.judged] ** 2)), 1e-300)
    each = {name: squared[name] / power[name] for name in power}
    return Errors(_over(problem, "fit", squared, power), _over(problem, "validate", squared, power), each)


def validation_error(problem: DamperProblem, effects: Sequence[Effect], values: np.ndarray) -> float:
    """Return the NRMS of the validation tests; infinite: they cannot be predicted.

    Args:
        values: (p,) SI, of the law and the effects.
    """
    try:
        return errors_of(problem, predicted(problem, effects, values)).validate
    except PredictionError:
        return math.inf


def validation_noise(problem: DamperProblem) -> float:
    """Return the NRMS of the noise of the validation tests."""
    every = [one for one in problem.experiments if one.use == "validate"]
    noise = sum(one.noise**2 * int(np.count_nonzero(one.judged)) for one in every)
    return noise / max(sum(float(np.sum(one.force[one.judged] ** 2)) for one in every), 1e-300)


def _over(problem: DamperProblem, use: Use, squared: Mapping[str, float], power: Mapping[str, float]) -> float:
    names = [one.name for one in problem.experiments if one.use == use]
    return sum(squared[name] for name in names) / sum(power[name] for name in names)
