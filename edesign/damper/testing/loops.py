"""Loops of force and deformation, cycle by cycle: extremes, forces at zero deformation, work."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from edesign.damper.history import spline_velocity
from edesign.damper.testing.cycles import Block
from edesign.damper.testing.local_fit import noise, peak, value_at, value_at_reversal
from edesign.errors import InputError

LEAST_SAMPLES = 12  # a cycle


@dataclass(frozen=True)
class LoopValues:
    """Values of each cycle of a block, (n,) each; force over deformation, or stress over strain.

    Attributes:
        start, period: s.
        highest, lowest: extremes of the deformation.
        at_highest, at_lowest: force at these: half way where it jumps.
        largest, smallest: extremes of the force.
        at_zero_rising, at_zero_falling: force at zero deformation, while that grows and while it falls.
        work: dissipated.
    """

    start: np.ndarray
    period: np.ndarray
    highest: np.ndarray
    lowest: np.ndarray
    at_highest: np.ndarray
    at_lowest: np.ndarray
    largest: np.ndarray
    smallest: np.ndarray
    at_zero_rising: np.ndarray
    at_zero_falling: np.ndarray
    work: np.ndarray

    @property
    def amplitude(self) -> np.ndarray:
        """Half the distance between the extremes of the deformation."""
        return 0.5 * (self.highest - self.lowest)

    @property
    def storage(self) -> np.ndarray:
        """Difference of the forces at the extremes of the deformation over that of these (thesis Eq. 3.1)."""
        return (self.at_highest - self.at_lowest) / (self.highest - self.lowest)

    @property
    def equivalent(self) -> np.ndarray:
        """Difference of the extremes of the force over that of the extremes of the deformation (thesis Eq. 3.2)."""
        return (self.largest - self.smallest) / (self.highest - self.lowest)

    @property
    def loss(self) -> np.ndarray:
        """Loss stiffness or modulus: work / (pi amplitude^2) (thesis Eqs. 3.3 and 3.4)."""
        return self.work / (np.pi * self.amplitude**2)


class Loops:
    """Loops of one test.

    Args:
        time: (n,) s.
        deformation: (n,) in any unit.
        force: (n,) in any unit.
        where: the file or the test, for messages.
    """

    def __init__(self, time: np.ndarray, deformation: np.ndarray, force: np.ndarray, where: str) -> None:
        self.time, self.deformation, self.force, self.where = time, deformation, force, where
        self._noise = noise(deformation), noise(force)
        # area of a loop: of the spline through force times velocity, so that cycles may begin between samples
        rate = spline_velocity(time, deformation)
        self._work = scipy.interpolate.CubicSpline(time, force * rate).antiderivative()

    def of(self, block: Block) -> LoopValues:
        """Return the values of each cycle of a block.

        Args:
            block: cycles of one frequency and amplitude.

        Raises:
            InputError: a cycle has too few samples.
        """
        rows = [self._cycle(block, i) for i in range(block.cycles)]
        return LoopValues(**{name: np.array([row[name] for row in rows]) for name in rows[0]})

    def _cycle(self, block: Block, i: int) -> dict[str, float]:
        start, end = (float(bound) for bound in block.bounds[i : i + 2])
        inside = slice(int(np.searchsorted(self.time, start)), int(np.searchsorted(self.time, end)))
        if inside.stop - inside.start < LEAST_SAMPLES:
            raise InputError(
                f"{self.where}: the cycle at {start:g} s has {inside.stop - inside.start} samples; "
                f"at least {LEAST_SAMPLES} are needed [E-TEST-04]"
            )
        omega, bounds = 2.0 * np.pi / (end - start), (start, end)
        u, force, (u_noise, force_noise) = self.deformation, self.force, self._noise
        high, low = (self._extreme(sign * u, inside, omega, bounds, u_noise) for sign in (1.0, -1.0))
        at_high, at_low = (
            value_at_reversal(self.time, force, found[0], omega, force_noise).value for found in (high, low)
        )
        largest, smallest = (self._extreme(sign * force, inside, omega, None, force_noise)[1] for sign in (1.0, -1.0))
        # a record may begin with the first cycle, at rest: then the zero at its end is one in motion
        zeros = (float(block.bounds[i] if i else end), float(block.middles[i]))
        rising, falling = (
            value_at(self.time, force, zero, omega, force_noise).value for zero in zeros[:: 1 if block.rising else -1]
        )
        return {
            "start": start,
            "period": end - start,
            "highest": high[1],
            "lowest": -low[1],  # the low one is that of -u
            "at_highest": at_high,
            "at_lowest": at_low,
            "largest": largest,
            "smallest": -smallest,
            "at_zero_rising": rising,
            "at_zero_falling": falling,
            "work": float(self._work(end) - self._work(start)),
        }

    def _extreme(
        self, values: np.ndarray, inside: slice, omega: float, within: tuple[float, float] | None, spread: float
    ) -> tuple[float, float]:
        at = float(self.time[inside.start + int(np.argmax(values[inside]))])
        found = peak(self.time, values, at, omega, within or (-np.inf, np.inf), spread)
        return found.time, found.value
