"""A ground acceleration history."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, field, replace

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.band_limited import band_limited_at
from edesign.notebook import facts_html, pictures_html

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
        band_limited: whether it runs between its samples as the motion through them that has no content above their
            Nyquist frequency, the one whose response spectrum is reported; if not, in straight lines.
        remarks: warnings about the file that it was read from, sentences.
    """

    name: str
    acceleration: np.ndarray
    time_step: float
    source: str
    checksum: str = field(default="")
    band_limited: bool = False
    remarks: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        samples = np.array(self.acceleration, dtype=float)
        step = float(self.time_step)
        if samples.ndim != 1 or samples.size < 2:
            raise InputError(f"{self.source}: a record needs at least two samples, not {samples.size} [E-REC-21]")
        if not np.all(np.isfinite(samples)):
            at = int(np.flatnonzero(~np.isfinite(samples))[0])
            raise InputError(f"{self.source}: sample {at + 1} is not a finite number [E-REC-08]")
        if not (np.isfinite(step) and step > 0.0):
            raise InputError(f"{self.source}: the time step must be greater than zero, not {step:g} s [E-REC-20]")
        samples.setflags(write=False)
        object.__setattr__(self, "acceleration", samples)
        object.__setattr__(self, "time_step", step)
        if not self.checksum:
            digest = hashlib.sha256(np.array(step, "<f8").tobytes())
            digest.update(samples.astype("<f8", copy=False).data)
            object.__setattr__(self, "checksum", digest.hexdigest())

    def _repr_html_(self) -> str:
        rows = {"source": self.source, "PGA": f"{self.pga:.4g} m/s2", "duration": f"{self.duration:.4g} s"}
        rows |= {"time step": f"{self.time_step:.4g} s", "remarks": "; ".join(self.remarks)}
        return facts_html(self.name, rows.items()) + pictures_html(self)

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
        """Return the record times a factor.

        Args:
            factor: dimensionless.
        """
        return replace(self, acceleration=factor * self.acceleration, source=f"{self.source}; times {factor:.9g}")

    def last_sample(self, time_step: float) -> int:
        """Return the number of the last sample, from 0, with another time step.

        Args:
            time_step: s.

        Raises:
            InputError: the step is not greater than zero, or longer than the record.
        """
        if not (np.isfinite(time_step) and time_step > 0.0):
            raise InputError(f"{self.name}: the time step must be greater than zero, not {time_step:g} s [E-REC-20]")
        last = int(np.floor(self.duration / time_step + _TOLERANCE))
        if last < 1:
            raise InputError(
                f"{self.name}: the time step of {time_step:g} s is longer than the record ({self.duration:g} s)"
                " [E-MOTION-03]"
            )
        return last

    def resampled(self, time_step: float) -> Record:
        """Return the record at another step, as time integration reads it.

        The samples are those of the polygon through the given ones, or of the band-limited motion where the step gets
        shorter: nothing is filtered. Straight lines weaken the content at a frequency f by (pi f dt)^2 / 3, by 3.7 % at
        5.3 Hz and a step dt of 0.02 s. If the old step is no multiple of the new one, given samples between new ones
        are passed over, the peak may be one of them, and what is left at the end, less than one new step, is dropped.

        Args:
            time_step: the new step, s.

        Raises:
            InputError: the step is not greater than zero, or longer than the record.
        """
        last = self.last_sample(time_step)
        if time_step == self.time_step:
            return self
        finer = self.band_limited and time_step < self.time_step
        samples, given = np.empty(last + 1), np.arange(self.acceleration.size)
        for first in range(0, last + 1, _BLOCK):
            position = np.arange(first, min(first + _BLOCK, last + 1)) * (time_step / self.time_step)
            nearest = np.round(position)  # a sample that both grids share is taken over exactly
            position = np.where(np.abs(position - nearest) < _TOLERANCE * np.maximum(1.0, nearest), nearest, position)
            samples[first : first + _BLOCK] = position if finer else np.interp(position, given, self.acceleration)
        if finer:
            samples = band_limited_at(self.acceleration, samples)
        how = "as a band-limited signal" if finer else "by linear interpolation"
        source = f"{self.source}; resampled to {time_step:.9g} s {how}"
        return replace(self, acceleration=samples, time_step=time_step, source=source)

    def with_zeros(self, seconds: float) -> Record:
        """Return the record with zeros appended, as many whole steps as last long enough.

        Args:
            seconds: least duration of the zeros, s.
        """
        count = int(np.ceil(seconds / self.time_step - _TOLERANCE))
        if count <= 0:
            return self
        samples = np.concatenate((self.acceleration, np.zeros(count)))
        return replace(
            self, acceleration=samples, source=f"{self.source}; {count * self.time_step:.9g} s of zeros appended"
        )
