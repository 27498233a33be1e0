"""Pseudo-dynamic tests, of a whole structure or of its damper alone: slow, and with errors of the actuators (6.1.2)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np
import scipy
from numpy.typing import ArrayLike

from edesign.core.damper import CoreDamper
from edesign.errors import InputError
from edesign.stopping import stop_if_requested
from edesign.substructure.laboratory import SMALL
from edesign.substructure.methods.comparison import MethodRecord, checked_ground, positive
from edesign.substructure.methods.rate import RateEffect, motion_frequency, rate_effect
from edesign.substructure.methods.state_space import fixed_base, respond
from edesign.substructure.structure.numerical import LinearPart
from edesign.substructure.structure.recursion import largest_step

Feedback = Literal["measured", "computed"]
Physical = Literal["specimen", "structure"]

_SLACK = 1e-9  # of the largest step: a step at the limit itself is allowed
_ROUNDING = 1e-6  # of a growth: a double eigenvalue is known to the root of the precision, 1.5e-8, times a few


@dataclass(frozen=True)
class ControlError:
    """Errors of the actuators in each step of the integration; the parts add up.

    Attributes:
        undershoot: they stop short by this share of the increment that the integration asks for.
        lag: they stay behind by this displacement, against the direction of the increment, m.
        noise: standard deviation of where they stop, independent from step to step, m.
        seed: of the noise.

    Raises:
        InputError: a share that is not below 1 in size, or a number that is negative or not finite.
    """

    undershoot: float = 0.0
    lag: float = 0.0
    noise: float = 0.0
    seed: int = 1

    def __post_init__(self) -> None:
        if not -1.0 < self.undershoot < 1.0:
            raise InputError(f"error: undershoot must be between -1 and 1, not {self.undershoot:g} [E-VALUE-02]")
        for name in ("lag", "noise"):
            if not 0.0 <= getattr(self, name) < math.inf:
                raise InputError(f"error: {name} must not be negative, not {getattr(self, name):g} [E-VALUE-02]")


NO_ERROR = ControlError()


@dataclass(frozen=True, eq=False, kw_only=True)
class PseudoDynamicRecord(MethodRecord):
    """A pseudo-dynamic test in the time of the earthquake, beside the direct response; n samples of N of the record.

    The test takes `time_scale` times as long; its `displacement` is what the integration asks for. The direct response
    has real speed and no errors.

    Attributes:
        target: (n,) deformation of the specimen that is asked for, m.
        time_scale: by which the test is slower.
        feedback: `measured` or `computed` displacement is what the integration goes on from.
        rate: the damper at the largest deformation and the mean frequency of the direct response, and slowed down.
        frequency: (m,) of the oscillating modes of the test, Hz, rising, of the linearised loop.
        damping: (m,) their damping ratios, which the undershoot changes; negative: the motion grows.
        amplification: largest growth of a motion in a step of the linearised loop; above 1: it grows for ever.
        aborted: the test ended because the specimen came to the abort displacement, or a number was not finite.
    """

    target: np.ndarray
    time_scale: float
    feedback: Feedback
    rate: RateEffect
    frequency: np.ndarray
    damping: np.ndarray
    amplification: float
    aborted: bool


def pseudo_dynamic_test(
    part: LinearPart,
    damper: CoreDamper,
    step: float,
    ground: ArrayLike,
    *,
    time_scale: float = 100.0,
    error: ControlError = NO_ERROR,
    feedback: Feedback = "measured",
    physical: Physical = "specimen",
    abort: float = math.inf,
) -> PseudoDynamicRecord:
    """Run a pseudo-dynamic test from rest with explicit Newmark, the central difference method of thesis 6.1.2.

    Displacements of a step are computed, then imposed `time_scale` times slower; forces that depend on the rate are
    those of that slow motion. The motion does not stop between the steps, so nothing relaxes there. Inertia and
    viscous damping are numerical. With `feedback` measured the integration goes on from where the actuators stopped,
    with computed from where they should have; the force is in both cases that of where they stopped. The direct
    response is exact between the samples, with the damper's force in balance at each.

    Args:
        part: the structure.
        damper: the specimen.
        step: of the integration in the time of the earthquake, s.
        ground: (n,) acceleration of the ground at the steps, m/s2.
        time_scale: by which the test is slower; 1: real time.
        feedback: `measured` or `computed`.
        physical: `specimen`: the damper alone is tested (6.1.4), the error is one of its deformation, and of the
            displacements that give it the smallest; `structure`: all springs too, with an actuator a degree (6.1.2).
        abort: deformation of the specimen that ends the test, m.

    Raises:
        InputError: an impossible number, or a step beyond the limit of the method: 2 / omega of the highest mode,
            less with a damper that resists velocity (m / c of a mass on a dashpot).
        CoreError: the law of the damper failed.
        Stopped: by a request of `edesign.stopping.stoppable`.

    Source: thesis Eqs. 6.1-6.4; Shing & Mahin, UCB/EERC-83/12 (1983), for errors and feedback.
    """
    values = checked_ground(step, ground)
    positive("time_scale", time_scale)
    if not abort > 0.0:
        raise InputError(f"abort: must be greater than zero, not {abort:g} [E-VALUE-02]")
    _check_step(part, damper, step, time_scale)
    states, direct_force = respond(fixed_base(part), values, step, damper)
    direct = states[:, : len(part.names)]
    integration = _Integration(part, step, error, feedback, physical)
    test = _run(integration, _Laboratory(damper, step, time_scale), values, abort)
    deformation = direct @ part.interface
    rate = rate_effect(damper, float(np.abs(deformation).max()), motion_frequency(deformation, step), time_scale)
    omega = 2.0 * math.pi * rate.frequency
    poles = step_poles(
        part, step, rate.slow_stiffness.real, rate.slow_stiffness.imag / omega, error.undershoot, feedback, physical
    )
    frequency, damping = modes_of(poles, step)
    return PseudoDynamicRecord(
        time=step * np.arange(values.size),
        displacement=test.displacement,
        target=test.target,
        deformation=test.measured,
        damper_force=test.force,
        direct_displacement=direct,
        direct_deformation=deformation,
        direct_force=direct_force,
        time_scale=time_scale,
        feedback=feedback,
        rate=rate,
        frequency=frequency,
        damping=damping,
        amplification=float(np.abs(poles).max()),
        aborted=len(test.measured) < values.size,
    )


def step_poles(
    part: LinearPart,
    step: float,
    specimen_stiffness: float,
    specimen_damping: float = 0.0,
    undershoot: float = 0.0,
    feedback: Feedback = "computed",
    physical: Physical = "specimen",
) -> np.ndarray:
    """Return the eigenvalues (2 d,) of a step of the test with a spring and a dashpot as specimen, the largest first.

    The method keeps displacement, velocity and acceleration; the d smallest eigenvalues, none without a dashpot, are
    what it forgets from step to step, and are left out.

    Of one degree without damping, with computed feedback and the whole stiffness in the laboratory, the pair has the
    size sqrt(1 + undershoot (omega step)^2) exactly. With measured feedback it has the size 1, and the frequency falls.

    Args:
        part: the structure of d degrees.
        step: s.
        specimen_stiffness: N/m.
        specimen_damping: N s/m in the time of the earthquake: the loss stiffness that the test sees over omega.
        undershoot: share of each increment.
        feedback: see `pseudo_dynamic_test`.
        physical: see `pseudo_dynamic_test`.

    Returns:
        (2 d,), complex, by falling magnitude.
    """
    integration = _Integration(part, step, ControlError(undershoot=undershoot), feedback, physical)
    d = len(part.names)

    def force(deformation: float, velocity: float) -> float:
        return specimen_stiffness * deformation + specimen_damping * velocity

    columns = []
    for unit in np.eye(3 * d):
        ahead = integration.advance(_Motion(*np.split(unit, 3)), 0.0, force).motion
        columns.append(np.concatenate([ahead.displacement, ahead.velocity, ahead.acceleration]))
    poles = np.linalg.eigvals(np.array(columns).T)
    return np.asarray(poles[np.argsort(-np.abs(poles), kind="stable")][: 2 * d])


def modes_of(poles: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Return frequencies (Hz, rising) and damping ratios (m,) each of the eigenvalues of a step that oscillate.

    Args:
        poles: (s,) eigenvalues.
        step: s.
    """
    rates = np.log(poles[poles.imag > 0.0]) / step
    rates = rates[np.argsort(np.abs(rates))]
    return np.abs(rates) / (2.0 * math.pi), -rates.real / np.abs(rates)


@dataclass(frozen=True)
class _Motion:
    """What the integration goes on from: (d,) each, m, m/s, m/s2."""

    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


@dataclass(frozen=True)
class _Step:
    """The end of a step.

    Attributes:
        motion: the integration goes on from.
        asked: displacements (d,) of the integration, m.
        measured: deformation of the specimen, m.
        force: of the specimen, N.
    """

    motion: _Motion
    asked: np.ndarray
    measured: float
    force: float


@dataclass(frozen=True)
class _History:
    """Displacement (n, d) m, target and measured deformation (n,) m, force (n,) N."""

    displacement: np.ndarray
    target: np.ndarray
    measured: np.ndarray
    force: np.ndarray


Specimen = Callable[[float, float], float]
"""(deformation in m, velocity in m/s in the time of the earthquake) at the end of a step -> force in N."""


class _Integration:
    """Explicit Newmark with actuators that err; arguments as of `pseudo_dynamic_test`."""

    def __init__(
        self, part: LinearPart, step: float, error: ControlError, feedback: Feedback, physical: Physical
    ) -> None:
        self.part, self._step, self._error, self._measured = part, step, error, feedback == "measured"
        self._restores = physical == "structure"
        # what the actuators move by displacements, and back
        self._moves = np.eye(len(part.names)) if self._restores else part.interface[None, :]
        self._back = np.linalg.pinv(self._moves)
        self._effective = np.linalg.inv(part.mass + 0.5 * step * part.damping)
        self._inertia = part.mass @ part.influence
        self._random = np.random.default_rng(error.seed)

    def start(self, ground: float) -> _Motion:
        """Return the motion at rest under the first acceleration of the ground, m/s2."""
        zero = np.zeros(len(self.part.names))
        return _Motion(zero, zero, -self.part.influence * ground)

    def advance(self, now: _Motion, ground: float, specimen: Specimen) -> _Step:
        """Take a step; ground: acceleration at its end, m/s2."""
        part, h = self.part, self._step
        increment = h * now.velocity + 0.5 * h**2 * now.acceleration
        asked = now.displacement + increment
        astray = self._back @ self._deviation(self._moves @ increment)
        measured = float(part.interface @ (asked + astray))
        force = specimen(measured, float(part.interface @ (now.velocity + h * now.acceleration)))
        restoring = part.stiffness @ (asked + astray if self._restores else asked)
        halfway = now.velocity + 0.5 * h * now.acceleration
        load = -self._inertia * ground - restoring - part.damping @ halfway - part.interface * force
        acceleration = self._effective @ load
        base = asked + astray if self._measured else asked
        return _Step(_Motion(base, halfway + 0.5 * h * acceleration, acceleration), asked, measured, force)

    def _deviation(self, increment: np.ndarray) -> np.ndarray:
        """Where the actuators stop less where they should, m, by the increment of each, m."""
        error = self._error
        deviation = -error.undershoot * increment - error.lag * np.sign(increment)
        if error.noise > 0.0:
            deviation = deviation + error.noise * self._random.standard_normal(increment.size)
        return np.asarray(deviation)


class _Laboratory:
    """The damper, moved `time_scale` times slower than the integration goes (step in s of the earthquake)."""

    def __init__(self, damper: CoreDamper, step: float, time_scale: float) -> None:
        self._damper, self._duration, self._time_scale = damper, step * time_scale, time_scale
        self._state, self._motion = damper.start(), (0.0, 0.0)

    def __call__(self, deformation: float, velocity: float) -> float:
        """Move to a deformation (m) and return the force there, N; velocity in the time of the earthquake, m/s."""
        ahead = (deformation, velocity / self._time_scale)
        self._state, force, _ = self._damper.step(self._state, self._duration, self._motion, ahead)
        self._motion = ahead
        return force


class _Ended(Exception):
    """The specimen went further than the test allows."""


def _run(integration: _Integration, laboratory: _Laboratory, ground: np.ndarray, abort: float) -> _History:
    """Run from rest until the end of the record or the abort displacement (m)."""

    def within(deformation: float, velocity: float) -> float:
        if not (math.isfinite(deformation) and math.isfinite(velocity) and abs(deformation) <= abort):
            raise _Ended
        return laboratory(deformation, velocity)

    motion = integration.start(float(ground[0]))
    displacement, rows = [motion.displacement], [(0.0, 0.0)]
    try:
        with np.errstate(over="ignore", invalid="ignore"):  # a motion that grows without end is ended by `within`
            for acceleration in ground[1:].tolist():
                stop_if_requested()
                end = integration.advance(motion, acceleration, within)
                motion = end.motion
                displacement.append(end.asked)
                rows.append((end.measured, end.force))
    except _Ended:
        pass
    x, (measured, force) = np.array(displacement), np.array(rows).T
    return _History(x, x @ integration.part.interface, measured, force)


def _check_step(part: LinearPart, damper: CoreDamper, step: float, time_scale: float) -> None:
    """Refuse a step beyond the limit with the damper as the spring and dashpot that a slow test sees in small motions.

    Not at rest itself, where a power of the velocity has an infinite slope.
    """
    speed = SMALL[0] / SMALL[1]
    slow = speed / time_scale
    _, _, (stiffness, damping) = damper.step(damper.start(), step * time_scale, (0.0, slow), (speed * step, slow))
    specimen = max(stiffness, 0.0)
    largest, mode = largest_step(part, "newmark_explicit", specimen)
    if step > largest * (1.0 + _SLACK):
        raise InputError(
            f"the pseudo-dynamic test is unstable with steps of {1e3 * step:g} ms: mode {mode} with the damper "
            f"({part.frequencies(specimen)[mode - 1]:.4g} Hz) allows at most {1e3 * largest:.4g} ms [E-RTS-03]"
        )
    dashpot = max(damping, 0.0) / time_scale
    if not 0.0 < dashpot < math.inf:
        return

    def growth(h: float) -> float:
        return float(np.abs(step_poles(part, h, specimen, dashpot)).max()) - 1.0 - _ROUNDING

    if growth(step) <= 0.0:
        return
    shortest = 1e-3 * step
    allowed = "at most" if growth(shortest) <= 0.0 else "less than"
    limit = scipy.optimize.brentq(growth, shortest, step) if allowed == "at most" else shortest
    raise InputError(
        f"the pseudo-dynamic test is unstable with steps of {1e3 * step:g} ms: the method takes the damper's "
        f"{1e-3 * dashpot:.4g} kN s/m explicitly, and allows {allowed} {1e3 * limit:.4g} ms [E-RTS-03]"
    )
