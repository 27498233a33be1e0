"""What spectrum matching returns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from edesign.ground_motion.intensity import Measures
from edesign.ground_motion.matching.options import MatchOptions, Method
from edesign.ground_motion.matching.shape import Shape
from edesign.ground_motion.record import Record

GOOD = 0.05  # misfit (rms) up to which there is nothing to say
LARGEST_END_VELOCITY = 1e-3  # m/s


@dataclass(frozen=True)
class Misfit:
    """Misfit of a response spectrum, psa/target - 1 over the periods given.

    Attributes:
        rms: root mean square.
        largest: largest absolute value.
        at_period: where the largest is, s.
    """

    rms: float
    largest: float
    at_period: float


def misfit(psa: np.ndarray, target: np.ndarray, periods: np.ndarray) -> Misfit:
    """Return the misfit of a spectrum.

    Args:
        psa: ordinates of the record, shape (n,), m/s2.
        target: ordinates wanted, greater than zero, shape (n,), m/s2.
        periods: where they stand, shape (n,), s; log-spaced periods give each octave the same weight.
    """
    error = np.asarray(psa) / np.asarray(target) - 1.0
    worst = int(np.argmax(np.abs(error)))
    return Misfit(float(np.sqrt(np.mean(error**2))), float(np.abs(error[worst])), float(periods[worst]))


@dataclass(frozen=True)
class Adjusted:
    """Result of a matching method.

    Attributes:
        acceleration: as many samples as were given, end velocity and displacement corrected, m/s2; those given if no
            iteration came closer to the target.
        iterations: how many were done.
        history: misfit (rms over the matching periods, period zero among them if it is matched) before the first
            and after each iteration.
        notes: what the user should know; empty if all went well.
    """

    acceleration: np.ndarray
    iterations: int
    history: tuple[float, ...]
    notes: tuple[str, ...] = ()


class Adjust(Protocol):
    """A matching method, a function of plain arrays."""

    def __call__(
        self,
        acceleration: np.ndarray,
        time_step: float,
        target: Callable[[np.ndarray], np.ndarray],
        periods: np.ndarray,
        options: MatchOptions,
        zero_period: float | None = None,
    ) -> Adjusted:
        """Change the shape of a motion until its pseudo-acceleration spectrum is the target.

        Args:
            acceleration: the scaled motion, with zeros before and after where they are needed, shape (n,), m/s2.
            time_step: s.
            target: ordinates wanted at periods (s), greater than zero, m/s2; may be asked between the matching ones.
            periods: matching periods, increasing, greater than zero, shape (n_p,), s.
            options: damping, iterations and tolerance are read here.
            zero_period: the target's ordinate at period zero (peak ground acceleration), m/s2; None: not matched.
        """


@dataclass(frozen=True)
class Match:
    """A matched record beside its original.

    Spectra and misfits stand on a dense grid of periods that is not the one that was matched.

    Attributes:
        original: as given.
        scale: constant factor on the original before its shape was changed.
        scaled: the original times `scale`, with zeros before and after it where they were needed.
        matched: the result, on the time axis of `scaled`.
        lead: zeros before the original in `scaled` and `matched`, s.
        method: how it was matched.
        damping: of the spectra, ratio to critical.
        periods: shape (n,), s.
        target: shape (n,), m/s2.
        psa_before: of the scaled original, shape (n,), m/s2.
        psa_after: of the matched record, shape (n,), m/s2.
        misfit_before: of the scaled original.
        misfit_after: of the matched record.
        zero_period: the target's ordinate at period zero, m/s2.
        before: intensity measures of the scaled original.
        after: intensity measures of the matched record.
        shape: how far the motion's character changed, against the scaled original.
        iterations: how many were done.
        history: misfit (rms over the matching periods) before the first and after each iteration.
        messages: what scaling and method had to say.
        suite_factor: on the result, the same for a whole suite so that its mean satisfies the code; 1 as matched.
    """

    original: Record
    scale: float
    scaled: Record
    matched: Record
    lead: float
    method: Method
    damping: float
    periods: np.ndarray
    target: np.ndarray
    psa_before: np.ndarray
    psa_after: np.ndarray
    misfit_before: Misfit
    misfit_after: Misfit
    zero_period: float
    before: Measures
    after: Measures
    shape: Shape
    iterations: int
    history: tuple[float, ...]
    messages: tuple[str, ...]
    suite_factor: float = 1.0

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes that the user should read; empty if all went well."""
        found = list(self.messages)
        off, end_velocity = self.misfit_after, self.after.end_velocity
        if self.method != "scale" and off.rms > GOOD:
            found.append(
                f"the spectrum is off by {100 * off.rms:.2g} % (rms), at most {100 * off.largest:.2g} % "
                f"at {off.at_period:.3g} s"
            )
        if abs(end_velocity) > LARGEST_END_VELOCITY:
            found.append(f"the ground still moves at {1e3 * end_velocity:.3g} mm/s at the end of the record")
        return (*found, *self.shape.notes())

    @property
    def pga_ratio(self) -> float:
        """Peak ground acceleration of the matched record over the target's ordinate at period zero."""
        return self.after.pga / self.zero_period
