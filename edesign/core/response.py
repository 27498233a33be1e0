"""What is recorded of an analysis, and what it returns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from edesign.core._edcore import lib

Watch = Callable[[np.ndarray, np.ndarray], None]
"""What sees every step of a run while it goes on: the abscissas, (n,), and the values of the watched channels in their
order, (n, watched); it must copy what it keeps."""

KINDS = {
    "displacement": lib.ED_DISPLACEMENT,
    "velocity": lib.ED_VELOCITY,
    "acceleration": lib.ED_ACCELERATION,
    "total_acceleration": lib.ED_TOTAL_ACCELERATION,
    "reaction": lib.ED_REACTION,
    "ground_acceleration": lib.ED_GROUND_ACCELERATION,
    "load_factor": lib.ED_LOAD_FACTOR,
    "end_force": lib.ED_END_FORCE,
    "global_force": lib.ED_GLOBAL_FORCE,
    "axial_force": lib.ED_AXIAL_FORCE,
    "deformation": lib.ED_DEFORMATION,
    "plastic_rotation": lib.ED_PLASTIC_ROTATION,
    "section_force": lib.ED_SECTION_FORCE,
    "section_deformation": lib.ED_SECTION_DEFORMATION,
    "fibre_stress": lib.ED_FIBRE_STRESS,
    "fibre_strain": lib.ED_FIBRE_STRAIN,
    "damper_force": lib.ED_DAMPER_FORCE,
    "damper_deformation": lib.ED_DAMPER_DEFORMATION,
    "damper_work": lib.ED_DAMPER_WORK,
    "given_force": lib.ED_GIVEN_FORCE,
    "given_deformation": lib.ED_GIVEN_DEFORMATION,
    "given_work": lib.ED_GIVEN_WORK,
    "deflection": lib.ED_DEFLECTION,
    "damage": lib.ED_DAMAGE,
    "broken_share": lib.ED_BROKEN_SHARE,
    "strength_left": lib.ED_STRENGTH_LEFT,
}

ENERGIES = ("input", "kinetic", "damping", "elastic", "hysteretic", "p_delta", "dampers", "residual")

FALLBACK_NAMES = {
    lib.ED_FALLBACK_FULL_NEWTON: "full Newton",
    lib.ED_FALLBACK_LINE_SEARCH: "line search",
    lib.ED_FALLBACK_FROZEN_DAMPING: "damping stiffness of the step's start",
    lib.ED_FALLBACK_HALVE: "step halved",
}


@dataclass(frozen=True)
class Channel:
    """A recorded quantity: the weighted sum of terms, or the resultant of two other channels.

    Attributes:
        name: key of the results.
        terms: (coefficient, kind, id of the node or element, component); edanalysis.h lists kinds and components,
            `KINDS` the names.
        beside: names of two channels before this one, at right angles to each other: without terms, this one is their
            resultant, sqrt(x^2 + y^2).
        history: keep the samples, not only the extremes.
        tail: keep the samples of the last steps.
        start: keep the value at the start of the run.
        watched: show the value of every step to the `Watch` of the run.
    """

    name: str
    terms: tuple[tuple[float, str, int, int], ...] = ()
    history: bool = True
    tail: bool = False
    start: bool = False
    watched: bool = False
    beside: tuple[str, str] | None = None

    @property
    def written(self) -> bool:
        """True if its value in every step is asked for, not the extremes alone."""
        return self.history or self.tail or self.start or self.watched


@dataclass(frozen=True)
class Passed:
    """Passing of a limit that ended a run: the channel, its value, and the time (s)."""

    channel: str
    value: float
    time: float


@dataclass
class Response:
    """Result of a run.

    Attributes:
        status: "completed", "failed", "interrupted" or "limit".
        reason: why it did not complete, "" otherwise.
        time: (nt,) s, of the steps that were kept; load factor in load control, controlled displacement (m) in
            displacement control.
        values: (nt,) of every channel with history.
        maximum, minimum, final, time_of_maximum, time_of_minimum: of every channel, every step counted.
        angle: of every resultant the direction of its maximum, rad from the first channel beside towards the second,
            -pi to pi.
        energy: (nt,) J of each of ENERGIES; (0,) if they were not kept.
        events: fallbacks where a step did not converge: time, step, fallback, halvings, success, iterations.
        statistics: counts, worst relative unbalance, `energy_error` (see the function), CPU seconds.
        passed: the limit that ended the run, if the status is "limit".
        end: `time` of the last step.
        tail: of every channel with a tail, the last steps.
        energy_final: J of each of ENERGIES in the last step.
        start: of every channel that keeps it, at the start of the run.
        energy_start: J of each of ENERGIES at the start of the run: what runs before it have put in and left.
    """

    status: str
    reason: str
    time: np.ndarray
    values: dict[str, np.ndarray]
    maximum: dict[str, float]
    minimum: dict[str, float]
    final: dict[str, float]
    time_of_maximum: dict[str, float]
    time_of_minimum: dict[str, float]
    energy: dict[str, np.ndarray]
    events: list[dict[str, object]] = field(default_factory=list)
    statistics: dict[str, float] = field(default_factory=dict)
    passed: Passed | None = None
    end: float = float("nan")
    tail: dict[str, np.ndarray] = field(default_factory=dict)
    energy_final: dict[str, float] = field(default_factory=dict)
    start: dict[str, float] = field(default_factory=dict)
    energy_start: dict[str, float] = field(default_factory=dict)
    angle: dict[str, float] = field(default_factory=dict)

    def peak(self, name: str) -> float:
        """Return the largest magnitude of a channel.

        Returns:
            In the unit of the channel.
        """
        return max(abs(self.maximum[name]), abs(self.minimum[name]))

    @property
    def finite(self) -> bool:
        """True if every extreme and every energy is a finite number."""
        extremes = [*self.maximum.values(), *self.minimum.values(), *self.final.values(), *self.energy_final.values()]
        return bool(np.all(np.isfinite(extremes)) and all(np.all(np.isfinite(e)) for e in self.energy.values()))

    @property
    def load_factor(self) -> np.ndarray:
        """Load factor: the abscissa of a run in load control."""
        return self.time


class EnergyBalance:
    """The largest error of the energy balance in a run over the largest energy that was put in, counted on the way.

    Both count from the start of the run: what gravity has put in before would hide the error of a small motion.
    """

    def __init__(self) -> None:
        self._start: tuple[float, float] | None = None
        self._error = self._put_in = self._ever = 0.0
        self._finite = True

    def count(self, given: np.ndarray, missing: np.ndarray) -> None:
        """Count further steps.

        Args:
            given: (nt,) input energy, J.
            missing: (nt,) residual of the energies, J.
        """
        self._finite = self._finite and bool(np.all(np.isfinite(given)) and np.all(np.isfinite(missing)))
        if not given.size or not self._finite:
            return
        if self._start is None:
            self._start = float(given[0]), float(missing[0])
        self._error = max(self._error, float(np.max(np.abs(missing - self._start[1]))))
        self._put_in = max(self._put_in, float(np.max(np.abs(given - self._start[0]))))
        self._ever = max(self._ever, float(np.max(np.abs(given))))

    def error(self, tolerance: float) -> float:
        """Return the error as a ratio; infinite if an energy is not finite, 0 without any.

        Args:
            tolerance: dimensionless, of equilibrium. The input is taken as at least that times all that was ever put
                in: equilibrium is not solved more closely.
        """
        if not self._finite:
            return float("inf")
        put_in = max(self._put_in, tolerance * self._ever)
        return self._error / put_in if put_in > 0.0 else 0.0
