"""What a motion does between its samples: which spline goes through them, and what of the velocity none can know."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from edesign.calibration.signals.noise import smooth
from edesign.calibration.signals.noise_level import transforms
from edesign.calibration.signals.sampling import evenly, step
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.spikes import without_spikes

CUBIC, SMOOTH = 3, 7
"""Degrees of splines: the cubic one rings least beside corners. At 0.6 of the Nyquist frequency it errs by a tenth of
the velocity, that of degree 7 by 0.4 %; of a higher degree records that end in motion grow worse at their ends."""

NOTHING = 1e-6  # of the power of the velocity: the reproducibility of a force transducer, squared (ISO 376, class 0.5)
_LONGEST, _FEWEST = 1024, 32  # samples of a segment of a spectrum, and of a record of which there is one
_END = 0.9  # of the Nyquist frequency: what stands above it, and as far below, shows how a motion goes on
_JUMPS = 2.0  # power of the frequency by which the power of a velocity falls that jumps
_FASTEST = 0.99  # of the power of the velocity, up to the frequency of the fastest motion
_FINEST = 64.0  # times the sampling, up to which that is looked for which is enough
_ENDS = 8  # samples beside the ends of a record, which a spline has on one side only: there either may be right


@dataclass(frozen=True, eq=False)
class Interpolation:
    """A motion between its samples, by the spectrum of its velocity.

    A spline through samples that are evenly spaced takes a velocity of the frequency w for D(w) i w times it: of a
    motion that ends below the Nyquist frequency that is its error. A motion that does not end there folds. Its power
    falls by a power of the frequency, as it does in the last tenths below it, and at least by that of a velocity that
    jumps. The integral of that is what folds.

    Attributes:
        power: (m,) of the velocity, at frequencies in shares of the Nyquist frequency from 0 to 1.
        rate: samples a second, Hz.

    Source: Unser (1999), IEEE Signal Processing Magazine 16(6), 22-38 (cardinal splines); Bendat & Piersol, Random
    Data, 10.3 (folding).
    """

    power: np.ndarray
    rate: float

    @staticmethod
    def of(time: np.ndarray, displacement: np.ndarray) -> Interpolation | None:
        """Return that of a motion; None: it has too few samples, or uneven ones, or stands still.

        Args:
            time: (n,) s, ascending.
            displacement: (n,) m, freed of noise as far as that is known.
        """
        if time.size < _FEWEST + 2 or np.ptp(displacement) == 0.0 or not evenly(time):
            return None
        differences = np.diff(displacement, 2)
        length = min(_LONGEST, differences.size)
        segments = np.lib.stride_tricks.sliding_window_view(differences, length)[:: length // 4]
        power = np.mean(np.abs(transforms(segments)) ** 2, axis=0)
        return Interpolation(power * np.linspace(0.0, 1.0, power.size) ** 2, 1.0 / step(time))

    @cached_property
    def degree(self) -> int:
        """Degree of the spline that errs less."""
        smooth = self._of_spline(SMOOTH) + self._folded
        return CUBIC if self._of_spline(CUBIC) <= max(NOTHING, smooth) else SMOOTH

    @cached_property
    def lost(self) -> float:
        """Share of the power of the velocity that the spline of this degree errs by."""
        return min(self._of_spline(self.degree) + self._folded, 1.0)

    @property
    def matters(self) -> bool:
        """Whether that may be more than nothing, at the ends of the record if not within it."""
        return self.degree == SMOOTH or self.lost > NOTHING

    def of_difference(self, samples: int) -> np.ndarray:
        """Return the power (n,) of that error over the power of the difference of both splines.

        Args:
            samples: n, of the record.
        """
        both = np.abs(_gain(CUBIC, self.power.size) - _gain(SMOOTH, self.power.size)) ** 2
        found = np.full(samples, self.lost / max(self._share(both), 1e-300))
        found[:_ENDS] = found[-_ENDS:] = max(1.0, found[0])
        return found

    @cached_property
    def fastest(self) -> float:
        """Frequency of the fastest motion, up to which the velocity has 99 % of its power, Hz."""
        total = np.cumsum(self.power)
        return 0.5 * self.rate * float(np.searchsorted(total, _FASTEST * total[-1])) / (self.power.size - 1)

    @property
    def samples_a_period(self) -> float:
        """Samples in a period of the fastest motion."""
        return self.rate / max(self.fastest, 1e-300)

    @cached_property
    def enough(self) -> float:
        """Samples a second with which the error would be nothing, if the motion ends where its samples say; nan: none.

        What folds falls with the sampling: to so little of a motion that turns sharply no sampling brings it.
        """
        factor = max(1.0, self._folded / NOTHING)
        while factor <= _FINEST:
            if self._share(np.abs(_gain(SMOOTH, self.power.size, factor) - 1.0) ** 2) <= NOTHING:
                return self.rate * factor
            factor *= 1.1
        return math.nan

    @cached_property
    def _folded(self) -> float:
        """Share of the power of the velocity above the Nyquist frequency, if it goes on as it ends."""
        first, second = (int(share * self.power.size) for share in (2.0 * _END - 1.0, _END))
        before, end = float(np.mean(self.power[first:second])), float(np.mean(self.power[second:]))
        falls = math.log(max(before / max(end, 1e-300), 1.0)) / math.log((1.0 + _END) / (3.0 * _END - 1.0))
        return end * self.power.size / (max(falls, _JUMPS) - 1.0) / float(np.sum(self.power))

    def _of_spline(self, degree: int) -> float:
        """Share of the power that a spline errs by, if nothing folds."""
        return self._share(np.abs(_gain(degree, self.power.size) - 1.0) ** 2)

    def _share(self, of: np.ndarray) -> float:
        return float(of @ self.power) / float(np.sum(self.power))


def through(time: np.ndarray, displacement: np.ndarray, degree: int) -> BSpline:
    """Return the spline of a degree through samples; its derivatives are `spline(time, 1)` and so on.

    Args:
        time: (n,) s, ascending; n above the degree.
        displacement: (n,) m.
        degree: odd.
    """
    return make_interp_spline(time, displacement, k=degree)


def sampling_notes(tests: Iterable[DamperTest]) -> tuple[str, ...]:
    """Return what is to be said of tests whose samples are too few for their motions, one line each.

    Args:
        tests: of a campaign.
    """
    found = []
    for test in map(without_spikes, tests):
        beside = () if test.force is None else (test.measured_force(),)
        one = Interpolation.of(test.time, smooth(test.time, test.displacement, beside=beside)[0])
        if one is not None and one.lost > NOTHING:
            enough = "" if math.isnan(one.enough) else f"; {_rounded(one.enough)} samples a second would be enough"
            found.append(
                f"{test.name}: {one.samples_a_period:.3g} samples in a period of the fastest motion "
                f"({one.fastest:.3g} Hz): what it does between them is not known, which is an NRMS of "
                f"{100.0 * one.lost:.2g} % of its velocity{enough}"
            )
    return tuple(found)


def _rounded(value: float) -> str:
    """Two digits, upwards."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / unit) * unit:.0f}"


@lru_cache(maxsize=64)
def _gain(degree: int, size: int, finer: float = 1.0) -> np.ndarray:
    """Return by what a spline multiplies velocities (size,) of frequencies up to a part of the Nyquist frequency."""
    omega = np.linspace(0.0, np.pi, size)[1:] / finer
    basis = BSpline.basis_element(np.arange(degree + 2) - 0.5 * (degree + 1))
    at = np.arange(1, degree // 2 + 1)
    phase = np.outer(omega, at)
    values = basis(0.0) + 2.0 * np.cos(phase) @ basis(at)
    return np.append(1.0, -2.0 * np.sin(phase) @ basis(at, 1) / (omega * values))
