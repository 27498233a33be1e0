"""Delay compensators as the core and its exported header run them (core_c/include/edcompensator.h)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name

Signal = Literal["target", "velocity", "acceleration", "measured", "command"]
MOST_TERMS = int(lib.ED_COMPENSATOR_TERMS)
MEMORY = int(lib.ED_COMPENSATOR_MEMORY)
"""Main steps that a compensator looks back."""
LONGEST_WINDOW = int(lib.ED_COMPENSATOR_WINDOW)
"""Main steps in the window of ATS."""
_SIGNAL: dict[Signal, int] = {
    "target": lib.ED_OF_TARGET,
    "velocity": lib.ED_OF_VELOCITY,
    "acceleration": lib.ED_OF_ACCELERATION,
    "measured": lib.ED_OF_MEASURED,
    "command": lib.ED_OF_COMMAND,
}
Triple = tuple[float, float, float]


@dataclass(frozen=True)
class Term:
    """A term of a difference equation: coefficient times a signal some main steps ago; 0 is the present call."""

    of: Signal
    lag: int
    coefficient: float


@dataclass(frozen=True)
class DifferenceEquation:
    """A compensator with constant coefficients.

    Attributes:
        terms: whose sum is the command.
        force_terms: whose sum is added to the measured force.
    """

    terms: tuple[Term, ...]
    force_terms: tuple[Term, ...] = ()

    def fill(self, parameters: Any) -> None:
        """Write the compensator into the core's struct.

        Raises:
            ValueError: it has more terms than the core takes.
        """
        if max(len(self.terms), len(self.force_terms)) > MOST_TERMS:
            raise ValueError(f"{max(len(self.terms), len(self.force_terms))} terms, of {MOST_TERMS} at most")
        parameters.kind = lib.ED_COMPENSATE_LINEAR
        for count, field, terms in (("n_terms", "term", self.terms), ("n_force_terms", "force_term", self.force_terms)):
            setattr(parameters, count, len(terms))
            for place, term in zip(getattr(parameters, field), terms, strict=False):
                place.of, place.lag, place.coefficient = _SIGNAL[term.of], term.lag, term.coefficient


@dataclass(frozen=True)
class LiveDelay:
    """A polynomial through targets a delay apart; the delay follows from zero crossings.

    Attributes:
        order: of the polynomial, 0 to 4.
        delay: first estimate, s.
        least, largest: limits of the delay, s.
        share: of each error of the delay that is found, how much is taken over.
        threshold: amplitude, m, below which crossings do not count.
    """

    order: int
    delay: float
    least: float
    largest: float
    share: float
    threshold: float

    def fill(self, parameters: Any) -> None:
        """Write the compensator into the core's struct."""
        parameters.kind = lib.ED_COMPENSATE_LIVE_DELAY
        parameters.order, parameters.share, parameters.threshold = self.order, self.share, self.threshold
        parameters.delay, parameters.least_delay, parameters.largest_delay = self.delay, self.least, self.largest


@dataclass(frozen=True)
class AdaptiveTimeSeries:
    """u = alpha_0 x + alpha_1 v + alpha_2 a, the alphas by least squares over what was measured.

    Attributes:
        initial, least, largest: alpha_0, alpha_1 (s), alpha_2 (s2).
        rate: their largest change a second.
        threshold: of the measured displacement, m, from which they change.
        sections: (n, 5) b0, b1, b2, a1, a2 of the filter's sections of second order.
        differences: whether velocity and acceleration of the target are backward differences (thesis Eq. 6.17).
        window, every: main steps of the window with equal weights, and of these each how manieth is taken.
        forgetting: weight that a sample keeps after a step; in place of a window.
    """

    initial: Triple
    least: Triple
    largest: Triple
    rate: Triple
    threshold: float
    sections: np.ndarray
    differences: bool
    window: int = 0
    every: int = 1
    forgetting: float | None = None

    def fill(self, parameters: Any) -> None:
        """Write the compensator into the core's struct.

        Raises:
            ValueError: its filter has more sections than the core takes.
        """
        parameters.kind = lib.ED_COMPENSATE_ATS if self.forgetting is None else lib.ED_COMPENSATE_MODIFIED_ATS
        for name in ("initial", "least", "largest", "rate"):
            setattr(parameters, name, list(getattr(self, name)))
        parameters.threshold, parameters.differences = self.threshold, int(self.differences)
        sections = np.asarray(self.sections, dtype=float).reshape(-1, 5)
        if len(sections) > lib.ED_COMPENSATOR_SECTIONS:
            raise ValueError(f"a filter of {len(sections)} sections, of {lib.ED_COMPENSATOR_SECTIONS} at most")
        parameters.n_sections = len(sections)
        for place, section in zip(parameters.section, sections, strict=False):
            for i, value in enumerate(section):
                place[i] = value
        parameters.window, parameters.every = self.window, self.every
        parameters.forgetting = 0.0 if self.forgetting is None else self.forgetting


Compensator = DifferenceEquation | LiveDelay | AdaptiveTimeSeries


def compensator_parameters(compensator: Compensator, step: float) -> Any:
    """Return the core's struct of a compensator.

    Args:
        compensator: of the test.
        step: main step, s.
    """
    parameters = ffi.new("ed_compensator_parameters *")
    parameters.step = step
    compensator.fill(parameters)
    return parameters


def run_compensator(compensator: Compensator, step: float, target: ArrayLike, measured: ArrayLike) -> np.ndarray:
    """Return the commands (n,) m of a compensator on its own.

    Args:
        step: main step, s.
        target: (n, 3) displacement, velocity, acceleration at the ends of n steps, SI.
        measured: (n,) displacement at the beginnings of these steps, m.

    Raises:
        CoreError: a parameter is out of range.
    """
    wanted, seen = np.ascontiguousarray(target, dtype=float), np.ascontiguousarray(measured, dtype=float)
    if wanted.shape != (seen.size, 3):
        raise ValueError(f"target has the shape {wanted.shape}, measured {seen.shape}")
    command = np.empty(seen.size)
    buffers = (ffi.from_buffer("double[]", array) for array in (wanted, seen, command))
    status = lib.ed_compensator_run(compensator_parameters(compensator, step), seen.size, *buffers)
    if status < 0:
        raise CoreError(status_name(status), "a parameter of the compensator is out of range")
    return command
