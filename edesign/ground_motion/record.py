"""A ground acceleration history."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace

import numpy as np

from edesign.errors import InputError

_TOLERANCE = 1e-9  # of a step: durations and steps are decimal numbers that floats hold to about 1e-13
_BLOCK = 1 << 16  # samples that are interpolated at a time, for memory


@dataclass(frozen=True)
class Record:
    """A uniformly sampled ground acceleration; the first sample is at time 0, where the motion begins.

    Attributes:
        name: for people and for the archive.
        acceleration: samples, shape (n,), m/s2; read-only.
        time_step: s.
        source: where the samples come from, and what was done to them.
        checksum: SHA-256 of time step and samples as read (little-endian doubles), hexadecimal; kept by all methods.
    """

    name: str
    acceleration: np.ndarray
    time_step: float
    source: str
    checksum: str = field(default="")

    def __post_init__(self) -> None:
        samples = np.array(self.acceleration, dtype=float)
        step = float(self.time_step)
        if samples.ndim != 1 or samples.size < 2:
            raise InputError(f"{self.source}: a record needs at least two samples, not {samples.size}")
        if not np.all(np.isfinite(samples)):
            at = int(np.flatnonzero(~np.isfinite(samples))[0])
            raise InputError(f"{self.source}: sample {at + 1} is not a finite number")
        if not (np.isfinite(step) and step > 0.0):
            raise InputError(f"{self.source}: the time step must be greater than zero, not {step:g} s")
        samples.setflags(write=False)
        object.__setattr__(self, "acceleration", samples)
        object.__setattr__(self, "time_step", step)
        if not self.checksum:
            digest = hashlib.sha256(np.array(step, "<f8").tobytes())
            digest.update(samples.astype("<f8", copy=False).data)
            object.__setattr__(self, "checksum", digest.hexdigest())

    @property
    def pga(self) -> float:
        """Peak ground acceleration: the largest absolute sample, m/s2."""
        return float(max(np.max(self.acceleration), -np.min(self.acceleration)))

    @property
    def duration(self) -> float:
        """Time from the first to the last sample, s."""
        return (self.acceleration.size - 1) * self.time_step

    @property
    def time(self) -> np.ndarray:
        """Time of each sample, shape (n,), s."""
        return np.arange(self.acceleration.size) * self.time_step

    def scaled(self, factor: float) -> Record:
        """Return the record times `factor` (dimensionless)."""
        return replace(self, acceleration=factor * self.acceleration, source=f"{self.source}; times {factor:.9g}")

    def last_sample(self, time_step: float) -> int:
        """Return the number of the last sample, from 0, with another time step (s).

        Raises:
            InputError: the step is not greater than zero, or longer than the record.
        """
        if not (np.isfinite(time_step) and time_step > 0.0):
            raise InputError(f"{self.name}: the time step must be greater than zero, not {time_step:g} s")
        last = int(np.floor(self.duration / time_step + _TOLERANCE))
        if last < 1:
            raise InputError(
                f"{self.name}: the time step of {time_step:g} s is longer than the record ({self.duration:g} s)"
            )
        return last

    def resampled(self, time_step: float) -> Record:
        """Return the record at another step by linear interpolation, which is how time integration reads a record.

        The samples are those of the polygon through the given ones: nothing is filtered. If the old step is no multiple
        of the new one, given samples between new ones are passed over, the peak may be one of them, and what is left at
        the end, less than one new step, is dropped.

        Args:
            time_step: the new step, s.

        Raises:
            InputError: the step is not greater than zero, or longer than the record.
        """
        last = self.last_sample(time_step)
        if time_step == self.time_step:
            return self
        samples, given = np.empty(last + 1), np.arange(self.acceleration.size)
        for first in range(0, last + 1, _BLOCK):
            position = np.arange(first, min(first + _BLOCK, last + 1)) * (time_step / self.time_step)
            nearest = np.round(position)  # a sample that both grids share is taken over exactly
            position = np.where(np.abs(position - nearest) < _TOLERANCE * np.maximum(1.0, nearest), nearest, position)
            samples[first : first + _BLOCK] = np.interp(position, given, self.acceleration)
        source = f"{self.source}; resampled to {time_step:.9g} s by linear interpolation"
        return replace(self, acceleration=samples, time_step=time_step, source=source)

    def with_zeros(self, seconds: float) -> Record:
        """Return the record with zeros appended: as many whole steps as last at least `seconds`."""
        count = int(np.ceil(seconds / self.time_step - _TOLERANCE))
        if count <= 0:
            return self
        samples = np.concatenate((self.acceleration, np.zeros(count)))
        return replace(
            self, acceleration=samples, source=f"{self.source}; {count * self.time_step:.9g} s of zeros appended"
        )
