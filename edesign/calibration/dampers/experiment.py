"""A test of a campaign as a fit sees it: motion freed of noise, force, temperature, noise, place among the tests."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from edesign.calibration.dampers.motion import Motion
from edesign.damper.history import NONE, Extremes
from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.start import Start

_RATE = 40.0  # samples per second that a fit needs at least, if there are as many
_PER_CYCLE = 25  # and in a cycle of the fastest motion
_ROUNDED = 0.1  # parts of a step
_OF_CORNERS = 2.0  # steps over those that a fit needs where the motion turns at its samples: cubics without overshoot


@dataclass(frozen=True, eq=False)
class Experiment:
    """A test at one sampling.

    Attributes:
        name: of the test.
        use: whether it is fitted to, or compared with only.
        order: number of tests made before.
        elapsed: duration of all tests made before, s.
        motion: measured, freed of noise.
        force: measured (n,) N.
        temperature: mean, degC.
        displacement_noise: standard deviation of white noise as strong next to the motion as that of the channel, m.
        channel_noise: standard deviation of the noise of the force channel, N.
        motion_noise: standard deviation of the force that noise of the displacement makes through the law, N.
        interpolation_noise: that of the force that the law makes of what is not known of the motion between samples, N.
        noise_measured: whether the noise of the force channel was, in this or in another test; it is assumed otherwise.
        local_noise: (n,) standard deviation of that noise at each sample, N; None: it is as strong at all times.
        discrepancy: standard deviation of what a model leaves beside it, N.
        start: how its record starts away from rest; None: at rest.
        full: the test at full rate, if this is not.
        conditions: that the test declares, by name, in units of the campaign.
        clipped: (n,) whether the force stands at the end of the load cell's range; None: it does nowhere.
        spikes: (n,) whether the force has a spike, over which it is interpolated; None: it has none.
        motion_spikes: (n,) the same of the displacement.
        way: which mirror image of the test the specimen made before it (`Motion.after`); 0.0: it was held for long.
        continued: whether it goes on where the test before it ends: one record that was cut.
    """

    name: str
    use: Use
    order: int
    elapsed: float
    motion: Motion
    force: np.ndarray
    temperature: float
    displacement_noise: float = 0.0
    channel_noise: float = 0.0
    motion_noise: float = 0.0
    interpolation_noise: float = 0.0
    noise_measured: bool = True
    local_noise: np.ndarray | None = None
    discrepancy: float = 0.0
    start: Start | None = None
    full: Experiment | None = None
    conditions: Mapping[str, float] = field(default_factory=dict)
    clipped: np.ndarray | None = None
    spikes: np.ndarray | None = None
    motion_spikes: np.ndarray | None = None
    way: float = 0.0
    continued: bool = False
    _finer: dict[int, Motion] = field(default_factory=dict, init=False, repr=False)

    @property
    def noise(self) -> float:
        """Standard deviation of what cannot be predicted, N: noise of the force, and by the law that of the motion."""
        return math.hypot(self.channel_noise, self.motion_noise, self.interpolation_noise)

    @property
    def from_rest(self) -> bool:
        """Whether the specimen was at rest before the record."""
        return self.start is None and not self.continued

    @property
    def prior_extremes(self) -> Extremes:
        """Extremes that the specimen went through before the test, of which its record shows nothing."""
        return NONE if self.start is None else self.start.prior_extremes

    @property
    def prior_extremes_unknown(self) -> bool:
        """Whether nothing but its force shows what the specimen went through before the test."""
        return self.start is not None and not self.start.known

    @cached_property
    def judged_from(self) -> int:
        """First sample that is judged: what is before depends on how the test started."""
        return self.start.first(self.motion.time) if self.start else 0

    @cached_property
    def ends(self) -> np.ndarray:
        """Samples (n,) at an end of the record in motion, where velocity and acceleration are not known."""
        whole = self.motion if self.full is None else self.full.motion
        return whole.ends[np.searchsorted(whole.time, self.motion.time)]

    @cached_property
    def judged(self) -> np.ndarray:
        """Samples (n,) that are judged: none before the first one, none that is clipped or a spike, none at `ends`."""
        found = ~self.ends
        for lost in (self.clipped, self.spikes, self.motion_spikes):
            found &= True if lost is None else ~lost
        found[: self.judged_from] = False
        return found

    @cached_property
    def weights(self) -> np.ndarray:
        """Factors (n,) of the residuals, of mean square 1: 0 where they are not judged, for which the others stand.

        They make noise, with what a model leaves beside it, as strong at all times.
        """
        both = 1.0 if self.local_noise is None else np.hypot(self.local_noise, self.discrepancy)
        found = np.where(self.judged, 1.0 / both, 0.0)
        return found / max(float(np.sqrt(np.mean(found**2))), 1e-300)

    @cached_property
    def rms_force(self) -> float:
        """Root mean square of the force that is judged, N."""
        return float(np.sqrt(np.mean(self.force[self.judged] ** 2))) if np.any(self.judged) else 0.0

    @cached_property
    def weighted_noise(self) -> float:
        """Standard deviation of the noise of weighted residuals, N."""
        if self.local_noise is None:
            return self.noise
        return float(np.sqrt(np.mean((self.weights * self.local_noise) ** 2)))

    def weighed(self, discrepancy: float) -> Experiment:
        """Return the test with residuals weighted by its noise and by what a model leaves beside it, N."""
        full = None if self.full is None else self.full.weighed(discrepancy)
        return replace(self, discrepancy=discrepancy, full=full)

    @cached_property
    def work(self) -> float:
        """Work done on the specimen, J."""
        return float(np.sum(0.5 * (self.force[1:] + self.force[:-1]) * self.motion.increments))

    @cached_property
    def _coarseness(self) -> float:
        """Steps over those that a fit needs."""
        if self.motion.cornered:
            return _OF_CORNERS
        step = float(np.median(self.motion.steps))
        return max(min(_RATE * step, 1.0), _PER_CYCLE * self.motion.frequency * step)

    def thinned(self) -> Experiment:
        """Return the test with no more samples than a fit needs."""
        stride = max(1, int(1.0 / self._coarseness))
        return replace(
            self,
            motion=self.motion.thinned(stride),
            force=np.ascontiguousarray(self.force[::stride]),
            local_noise=None if self.local_noise is None else np.ascontiguousarray(self.local_noise[::stride]),
            clipped=None if self.clipped is None else self.clipped[::stride],
            spikes=None if self.spikes is None else self.spikes[::stride],
            motion_spikes=None if self.motion_spikes is None else self.motion_spikes[::stride],
            full=self,
        )

    def parts(self, refined: float) -> int:
        """Return into how many parts each step is cut, for so many times the samples that a fit needs."""
        return max(1, math.ceil(refined * self._coarseness - _ROUNDED))

    def finer(self, parts: int) -> Motion:
        """Return the motion with every step cut into parts; it is kept, as models ask for it again and again."""
        if parts not in self._finer:
            known = self.motion if self.full is None else self.full.motion
            self._finer[parts] = self.motion.finer(parts, known)
        return self._finer[parts]
