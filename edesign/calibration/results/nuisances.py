"""What belongs to single tests, as their zeros, hum or what they began with: estimates with standard errors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.dampers.nuisance import Nuisance, Told, joined
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.results.result import Estimate, OfTest, OfTests
from edesign.calibration.search.models import FittedModel
from edesign.damper.testing.measured_histories import USES
from edesign.estimation.least_squares import SETTINGS
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import ranges_of, values_of
from edesign.estimation.uncertainty import uncertainty

_TWO_SIDED = 1.959964  # standard deviations of a normal number within which 95 % lie
_SHOWN = 0.1  # of the noise, in all samples together: a test that shows less leaves 99 % of the prior's variance


@dataclass(frozen=True, eq=False)
class _Amplitudes:
    """Amplitudes of all nuisances of a test, in units of its noise.

    Attributes:
        every: nuisances.
        columns: (n, k) of them.
        gain: (k, n) mean amplitudes of a residual.
        mean, covariance: (k,) and (k, k), given the noise; the covariance has the uncertainty of the parameters.
        left: (n,) residual freed of them.
        wave: (n,) factors that a wave in N is multiplied by.
        since: (n,) s.
    """

    every: Sequence[Nuisance]
    columns: np.ndarray
    gain: np.ndarray
    mean: np.ndarray
    covariance: np.ndarray
    left: np.ndarray
    wave: np.ndarray
    since: np.ndarray

    @staticmethod
    def of(
        every: Sequence[Nuisance],
        weight: np.ndarray,
        residual: np.ndarray,
        slopes: np.ndarray,
        known: np.ndarray,
        since: np.ndarray,
    ) -> _Amplitudes:
        """Return the posterior of the amplitudes, whose prior is N(0, 1).

        Args:
            weight: (n,) factors that turn N into units of the noise.
            residual: (n,) N.
            slopes: (n, p) N, d predicted / d z.
            known: (p, p) covariance of the coordinates z.
            since: (n,) s.
        """
        columns = weight[:, np.newaxis] * joined(list(every))
        u, s, v = np.linalg.svd(columns, full_matrices=False)
        gain = v.T @ ((s / (1.0 + s**2))[:, np.newaxis] * u.T)
        moved = gain @ (weight[:, np.newaxis] * slopes)
        # the directions that no sample shows keep the variance of the prior
        own = np.eye(len(v)) - v.T @ np.diag(s**2 / (1.0 + s**2)) @ v
        mean = gain @ (weight * residual)
        left = weight * residual - columns @ mean
        return _Amplitudes(every, columns, gain, mean, own + moved @ known @ moved.T, left, weight, since)

    def slope(self, told: Told, at: int) -> np.ndarray:
        """Return d wave / d frequency (n,), in units of the noise, of the nuisance whose columns begin at an index."""
        sine, cosine = told.weights @ self.mean[at : at + told.weights.shape[1]]
        angle = 2.0 * np.pi * told.frequency * self.since
        return np.asarray(self.wave * 2.0 * np.pi * self.since * (sine * np.cos(angle) - cosine * np.sin(angle)))

    def number(self, told: Told, at: int, frequency: tuple[float, float] | None) -> OfTest:
        """Return what is told.

        Args:
            at: index of the first column of its nuisance.
            frequency: correction of that of a wave and its standard error, Hz.
        """
        index = slice(at, at + told.weights.shape[-1])
        mean, covariance = self.mean[index], self.covariance[index, index]
        if frequency is None:
            return OfTest(float(told.weights @ mean), math.sqrt(float(told.weights @ covariance @ told.weights)))
        moved = (self.gain @ self.slope(told, at))[index]
        sine, cosine = told.weights @ (mean - frequency[0] * moved)
        of_both = told.weights @ (covariance + frequency[1] ** 2 * np.outer(moved, moved)) @ told.weights.T
        size = max(math.hypot(sine, cosine), 1e-300)
        along, across = np.array((sine, cosine)) / size, np.array((-cosine, sine)) / size
        errors = (math.sqrt(float(one @ of_both @ one)) for one in (along, across))
        return OfTest(size, next(errors), math.atan2(cosine, sine), min(next(errors) / size, math.pi))


def nuisances_of(whole: DamperProblem, model: FittedModel, forces: Sequence[np.ndarray]) -> tuple[OfTests, ...]:
    """Return what belongs to single tests, by what it is of.

    The parameters of the model are as uncertain as residuals within tests leave them.

    Args:
        whole: the problem, at full rate.
        forces: (n_i,) N, predicted of every test, with what belongs to it.

    Raises:
        PredictionError: the model cannot predict near its parameters.
    """
    of_tests = whole.model(model.effects, USES)
    every = of_tests.nuisances(model.fit.values)
    if not any(every):
        return ()
    predicted, slopes = _slopes(whole, model)
    freed = [w * (one.force - f) for w, one, f in zip(of_tests.weights, whole.experiments, forces, strict=True)]
    sizes = [float(np.sqrt(np.mean(y**2))) for y in of_tests.measured]
    noise = Noise.left_by(freed, [one.weighted_noise for one in whole.experiments], sizes)
    known = uncertainty(model.fit, model.noise).within
    found = {
        one.name: _Amplitudes.of(
            every[i],
            noise.weight(i) * of_tests.weights[i],
            one.force - predicted[i],
            slopes[i],
            known,
            one.motion.since,
        )
        for i, one in enumerate(whole.experiments)
        if every[i]
    }
    places: dict[tuple[str, str, str, float], dict[str, tuple[Told, int]]] = {}
    for name, amplitudes in found.items():
        at = 0
        for nuisance in amplitudes.every:
            shown = float(np.linalg.norm(amplitudes.columns[:, at : at + nuisance.columns.shape[1]])) > _SHOWN
            for told in nuisance.told if shown else ():
                key = (nuisance.of, told.name, told.unit, told.frequency)
                places.setdefault(key, {})[name] = told, at
            at += nuisance.columns.shape[1]
    return tuple(
        _of_tests(key, {name: (found[name], *place) for name, place in of.items()}) for key, of in places.items()
    )


def _of_tests(key: tuple[str, str, str, float], tests: dict[str, tuple[_Amplitudes, Told, int]]) -> OfTests:
    of, name, unit, frequency = key
    if not frequency:
        return OfTests(of, name, unit, {test: each[0].number(*each[1:], None) for test, each in tests.items()})
    pull = power = 0.0
    for amplitudes, told_there, at in tests.values():
        slope = amplitudes.slope(told_there, at)
        pull += float(slope @ amplitudes.left)
        power += float(slope @ (slope - amplitudes.columns @ (amplitudes.gain @ slope)))
    change, error = pull / max(power, 1e-300), 1.0 / math.sqrt(max(power, 1e-300))
    value, half = frequency + change, _TWO_SIDED * error
    told = Estimate(value, error, "Hz", (value - half, value + half))
    numbers = {test: each[0].number(*each[1:], (change, error)) for test, each in tests.items()}
    return OfTests(of, name, unit, numbers, told)


def _slopes(whole: DamperProblem, model: FittedModel) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the force (n_i,) N of every test without nuisances, and its slopes (n_i, p) by the coordinates."""
    of_tests, z = whole.model(model.effects, USES), model.fit.z
    steps = np.where(z + SETTINGS.difference <= ranges_of(of_tests.parameters)[1], 1.0, -1.0) * SETTINGS.difference
    there = [values_of(of_tests.parameters, one) for one in (z, *(z + np.diag(steps)))]
    here, *moved = of_tests.forces(np.array(there))
    if isinstance(here, PredictionError):
        raise here
    slopes = [np.zeros((f.size, z.size)) for f in here]
    for k, of in enumerate(moved):
        if not isinstance(of, PredictionError):
            for slope, one, other in zip(slopes, of, here, strict=True):
                slope[:, k] = (one - other) / steps[k]
    return here, slopes
