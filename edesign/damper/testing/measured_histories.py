"""One test of a damper: what was imposed, what was measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from edesign.damper.testing.start import StartKind
from edesign.errors import InputError

Use = Literal["fit", "validate"]
USES: tuple[Use, ...] = ("fit", "validate")
FEWEST = 3  # samples
LARGEST = 1e15  # of any number in SI units: beyond it squares overflow in sums, and no test has been made
SMALLEST = 1e-12  # m, of a motion
_CONSTANT = 1e-9  # relative

_GAP = 3.5
"""Steps on either side: a longer one lacks three samples or more. Where two are dropped the spline through the others
follows to 1e-4 of the amplitude at 50 samples a cycle."""
_STILL = 0.02
"""Of the range of the displacement: a specimen that moves by less around a gap rests in it. This is a judgement: noise
and drift of displacement transducers stay below, and the force of a spring is off by 2 % of its range at most."""
_DEAD_BAND = 0.1
"""Of the range on either side of the middle: the dead band in which no half cycle ends. This is a judgement too: noise
must not count as half cycles. Those of a sine are counted alike with any band below half of the range."""


def gaps(time: np.ndarray) -> np.ndarray:
    """Return the samples (k,) after which others are missing; a rate of sampling that changes and stays so is no gap.

    Args:
        time: (n,) s, ascending.
    """
    steps = np.diff(time)
    around = np.pad(steps, 1, mode="edge")
    return np.flatnonzero(steps >= _GAP * np.maximum(around[:-2], around[2:]))


def lost_motion(time: np.ndarray, displacement: np.ndarray) -> tuple[float, float] | None:
    """Return the first gap, s, in which a motion went on for half a cycle or longer; None: there is none.

    No interpolation follows what went on there. A gap in which the specimen rested is none.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
    """
    missing, size = gaps(time), float(np.ptp(displacement))
    if not missing.size or not size:
        return None
    steps = np.diff(time)
    middle = 0.5 * (float(np.max(displacement)) + float(np.min(displacement)))
    sides = np.sign(displacement - middle)[np.abs(displacement - middle) > _DEAD_BAND * size]
    half_cycles = max(int(np.count_nonzero(np.diff(sides))), 1)
    half = (float(np.sum(steps)) - float(np.sum(steps[missing]))) / half_cycles
    for i in missing:
        near = (time >= time[i] - 0.5 * half) & (time <= time[i + 1] + 0.5 * half)
        if steps[i] >= half and np.ptp(displacement[near]) > _STILL * size:
            return float(time[i]), float(time[i + 1])
    return None


@dataclass(frozen=True)
class DamperTest:
    """Histories of a test at one ambient temperature.

    Attributes:
        name: of the test, unique in its campaign.
        time: (n,) s, ascending.
        displacement: (n,) m.
        force: (n,) N; None if it was not measured.
        temperature_C: ambient.
        temperature_history: (n,) degC; None if it was not measured.
        title: for people.
        use: whether laws are fitted to the test, or only compared with it.
        source: the file it comes from.
        unread: headers of the file's columns that are no part of the test.
        start: what is said of how it starts.
        start_ramp: duration of the way from rest to the first sample of a test that starts at rest, s; None: one
            sampling interval.
        reading: how its table was read, as far as it is not plain, and where its displacement begins; for people.
        conditions: other quantities under which it was made, by name, in units of the campaign.
    """

    name: str
    time: np.ndarray
    displacement: np.ndarray
    force: np.ndarray | None = None
    temperature_C: float = 20.0
    temperature_history: np.ndarray | None = None
    title: str = ""
    use: Use = "fit"
    source: str = ""
    unread: tuple[str, ...] = ()
    start: StartKind = "unknown"
    start_ramp: float | None = None
    reading: str = ""
    conditions: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for name in ("time", "displacement", "force", "temperature_history"):
            values = getattr(self, name)
            if values is not None:
                object.__setattr__(self, name, self._checked(name.replace("_", " "), values))
        size = self.time.size
        if size < FEWEST:
            raise InputError(f"{self.where}: a test needs at least {FEWEST} samples, not {size} [E-TEST-04]")
        for name in ("displacement", "force", "temperature_history"):
            values = getattr(self, name)
            if values is not None and values.size != size:
                raise InputError(
                    f"{self.where}: {values.size} samples of {name.replace('_', ' ')}, {size} of time [E-TEST-04]"
                )
        back = np.flatnonzero(np.diff(self.time) <= 0.0)
        if back.size:
            at = int(back[0]) + 1
            raise InputError(
                f"{self.where}: sample {at + 1}: the time {self.time[at]:g} s is not after {self.time[at - 1]:g} s"
                " [E-TEST-05]"
            )
        span = float(np.ptp(self.displacement))
        if span == 0.0:
            raise InputError(
                f"{self.where}: the displacement is {self.displacement[0]:g} m throughout; nothing moved [E-TEST-06]"
            )
        if span < SMALLEST:
            raise InputError(
                f"{self.where}: the displacement changes by {span:g} m only; is its unit right? [E-TEST-07]"
            )

    def _checked(self, name: str, values: np.ndarray) -> np.ndarray:
        array = np.array(values, dtype=float)
        if array.ndim != 1:
            raise InputError(
                f"{self.where}: {name}: one row of samples is needed, not an array of shape {array.shape} [E-TEST-04]"
            )
        finite = np.isfinite(array)
        if not finite.all():
            at = int(np.argmin(finite))
            raise InputError(f"{self.where}: {name}: sample {at + 1} is {array[at]:g}, not a finite number [E-TEST-07]")
        if np.max(np.abs(array), initial=0.0) > LARGEST:
            at = int(np.argmax(np.abs(array)))
            raise InputError(
                f"{self.where}: {name}: sample {at + 1} is {array[at]:g} in SI units; is its unit right? [E-TEST-07]"
            )
        array.setflags(write=False)
        return array

    @property
    def where(self) -> str:
        """File of the test, or the name of a test that comes from none."""
        return self.source or f"test {self.name}"

    @property
    def label(self) -> str:
        """Title, or the name of a test without one."""
        return self.title or self.name

    @property
    def ramp(self) -> float:
        """Duration of the way from rest to the first sample, s."""
        return self.start_ramp or float(self.time[1] - self.time[0])

    def measured_force(self) -> np.ndarray:
        """Return the measured force (n,) N.

        Raises:
            InputError: it was not measured.
        """
        if self.force is None:
            raise InputError(f"{self.where}: the test has no force; a column such as `force_kN` is needed [E-TEST-06]")
        return self.force

    def varying_force(self) -> np.ndarray:
        """Return the measured force (n,) N, which must not be the same throughout.

        Raises:
            InputError: it was not measured, or does not change.
        """
        force = self.measured_force()
        if np.ptp(force) <= _CONSTANT * np.max(np.abs(force)):
            raise InputError(
                f"{self.where}: the force is {force[0]:g} N throughout; was the load cell connected? [E-TEST-06]"
            )
        return force

    def with_force(self, force: np.ndarray) -> DamperTest:
        """Return the test with another force.

        Args:
            force: (n,) N.
        """
        return replace(self, force=force)
