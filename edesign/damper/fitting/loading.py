"""Tests as a fit sees them: motion, measured force, and how much each counts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.damper.fitting.scales import Scales
from edesign.damper.history import NONE, Extremes, spline_velocity
from edesign.damper.testing.start import Start
from edesign.errors import InputError

if TYPE_CHECKING:
    from edesign.damper.testing.measured_histories import DamperTest

_LEAST_SAMPLES = 8
_PER_CYCLE = 30  # samples of a cycle that a search needs: a cubic through them is exact to 1e-5


@dataclass(frozen=True)
class Loading:
    """A test prepared for fitting.

    Attributes:
        name: of the test.
        time: (n,) s.
        displacement: (n,) m.
        velocity: (n,) m/s.
        force: measured (n,) N.
        temperature_C: degC.
        frequency: mean frequency of the cycles, Hz: rms velocity / rms displacement / 2 pi.
        weight: factor of its squared errors.
        prior_extremes: what the specimen went through before.
        start: how the test starts away from rest; None: at rest.
    """

    name: str
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    force: np.ndarray
    temperature_C: float
    frequency: float
    weight: float = 1.0
    prior_extremes: Extremes = NONE
    start: Start | None = None

    def starting(self, start: Start | None) -> Loading:
        """Return the loading with another start.

        Args:
            start: None: at rest.
        """
        return replace(self, start=start, prior_extremes=NONE if start is None else start.prior_extremes)

    @property
    def first(self) -> int:
        """First sample that is judged: what is before depends on how the test started."""
        return self.start.first(self.time) if self.start else 0

    @property
    def judged_force(self) -> np.ndarray:
        """Force of the samples that are judged, N."""
        return self.force[self.first :]

    @property
    def rms(self) -> float:
        """Root mean square of the measured force, N."""
        return float(np.sqrt(np.mean(self.force**2)))

    def thinned(self, stride: int) -> Loading:
        """Return every so many samples of the loading; velocities stay those of all.

        Args:
            stride: one sample of so many is kept.
        """
        cut = slice(None, None, stride)
        return replace(
            self,
            time=self.time[cut],
            displacement=self.displacement[cut],
            velocity=self.velocity[cut],
            force=self.force[cut],
        )

    def for_search(self) -> Loading:
        """Return the loading with no more samples than a search needs."""
        step = float(np.median(np.diff(self.time)))
        fastest = self.frequency * max(1.0, _fast_share(self))
        return self.thinned(max(1, int(1.0 / (fastest * _PER_CYCLE * step))))


Predict = Callable[[Mapping[str, float], Loading], np.ndarray]
"""Force (n,) N of parameters (SI, by name) under a loading."""


def prepare(tests: Sequence[DamperTest], weights: Mapping[str, float] | None = None) -> tuple[Loading, ...]:
    """Prepare tests for a fit.

    Args:
        tests: with force.
        weights: factor of a test's squared errors by its name, 1 where not said.

    Raises:
        InputError: a test has no force, a constant force, or too few samples; there are none, or two of one name; a
            weight is of no test or not positive.
    """
    if not tests:
        raise InputError("there is no test to fit to: a test of the campaign needs `use: fit` [E-FIT-01]")
    names = [test.name for test in tests]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"two tests are called `{name}`; a fit distinguishes tests by their names [E-NAME-02]")
    given = dict(weights or {})
    for name, weight in given.items():
        if name not in names:
            raise InputError(f"weights: there is no test `{name}` (there are: {', '.join(names)}) [E-FIT-04]")
        if not weight > 0.0 or not np.isfinite(weight):
            raise InputError(f"weights: {name} has {weight:g}; a weight is greater than 0 [E-FIT-04]")
    return tuple(_loading(test, given.get(test.name, 1.0)) for test in tests)


def scales_of(loadings: Sequence[Loading]) -> Scales:
    """Return the sizes of force, deformation and velocity in tests.

    They are means of the tests' root mean squares, times sqrt 2 as of a sine.
    """
    force = np.mean([loading.rms for loading in loadings])
    deformation = np.mean([np.sqrt(np.mean(loading.displacement**2)) for loading in loadings])
    velocity = np.mean([np.sqrt(np.mean(loading.velocity**2)) for loading in loadings])
    return Scales(*(float(np.sqrt(2.0) * value) for value in (force, deformation, velocity)))


def _loading(test: DamperTest, weight: float) -> Loading:
    force = test.varying_force()
    if test.time.size < _LEAST_SAMPLES:
        raise InputError(
            f"{test.where}: {test.time.size} samples are too few; at least {_LEAST_SAMPLES} are needed [E-FIT-01]"
        )
    u, velocity = test.displacement, spline_velocity(test.time, test.displacement)
    frequency = float(np.sqrt(np.mean(velocity**2) / np.mean(u**2)) / (2.0 * np.pi))
    return Loading(test.name, test.time, u, velocity, force, float(test.temperature_C), frequency, weight)


def _fast_share(loading: Loading) -> float:
    """How much faster than its mean frequency the motion also moves: by accelerations instead of velocities."""
    acceleration = np.gradient(loading.velocity, loading.time)
    faster = float(np.sqrt(np.mean(acceleration**2) / np.mean(loading.velocity**2)) / (2.0 * np.pi))
    return faster / loading.frequency
