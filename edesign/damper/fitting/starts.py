"""How tests start away from rest, as a fitted law says; what went before is left out of a fit, or found."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.fitting.loading import Loading, Predict
from edesign.damper.history import Extremes
from edesign.damper.law import Law
from edesign.damper.testing.local_fit import noise
from edesign.damper.testing.start import SOFTENED, Recorded, Start, extremes_before, find_start
from edesign.errors import AnalysisError, InputError

if TYPE_CHECKING:
    from edesign.damper.testing.measured_histories import DamperTest

_LEAST = 5e-4  # of a test's rms force: no load cell is better
_SOON = 0.01  # of a test's samples: so many more or less that are judged change nothing
_ALIKE = 0.1  # of that noise

ValuesAt = Callable[[float], Mapping[str, float]]
"""Parameters of a law, SI, at a temperature, degC."""


def with_starts(
    loadings: Sequence[Loading], tests: Sequence[DamperTest], law: Law, values_at: ValuesAt, predict: Predict
) -> tuple[Loading, ...]:
    """Return tests with their state at the first sample, as a law with its parameters gives it.

    A test keeps the start that it has where the law has no force for another beginning.

    Args:
        tests: the records, as many.
        values_at: gives its parameters at a temperature.
        predict: gives the force of a loading.

    Returns:
        The loadings with their starts.
    """

    def started(loading: Loading, test: DamperTest) -> Loading:
        try:
            return loading.starting(_start(loading.starting(None), test, law, values_at, predict))
        except (AnalysisError, InputError):
            return loading

    return tuple(started(loading, test) for loading, test in zip(loadings, tests, strict=True))


def same_starts(some: Sequence[Loading], others: Sequence[Loading], values_at: ValuesAt, predict: Predict) -> bool:
    """Say whether tests start alike: the force of a law is the same but for a tenth of the least noise.

    Args:
        values_at: gives the parameters of the law at a temperature.
        predict: gives the force of a loading.
    """
    for one, other in zip(some, others, strict=True):
        if (one.start is None) != (other.start is None) or abs(one.first - other.first) > _SOON * one.time.size:
            return False
        if one.prior_extremes != other.prior_extremes:
            forces = (np.asarray(predict(values_at(one.temperature_C), each)) for each in (one, other))
            change = np.subtract(*forces)[max(one.first, other.first) :]
            if np.sqrt(np.mean(change**2)) > _ALIKE * _LEAST * one.rms:
                return False
    return True


def start_warnings(loadings: Sequence[Loading]) -> list[str]:
    """List what the user should know of tests that start away from rest.

    Returns:
        One sentence a test.
    """
    return [
        f"test {loading.name} starts away from rest: {loading.start.words}"
        for loading in loadings
        if loading.start is not None
    ]


def _start(loading: Loading, test: DamperTest, law: Law, values_at: ValuesAt, predict: Predict) -> Start | None:
    values = values_at(loading.temperature_C)
    record = Recorded(
        loading.time,
        loading.displacement,
        loading.velocity,
        loading.force,
        noise(loading.displacement),
        max(noise(loading.force), _LEAST * loading.rms),
    )

    def force_of(time: np.ndarray, displacement: np.ndarray, velocity: np.ndarray, prior: Extremes) -> np.ndarray:
        other = replace(loading, time=time, displacement=displacement, velocity=velocity, prior_extremes=prior)
        return np.asarray(predict(values, other))

    start = find_start(record, test.start, test.ramp, force_of)
    if start is None or start.known or law.name not in SOFTENED:
        return start
    prior = extremes_before(
        record,
        loading.starting(start).first,
        np.ones(loading.time.size),
        lambda prior: np.asarray(predict(values, replace(loading, prior_extremes=prior))),
    )
    return replace(start, prior_extremes=prior)
