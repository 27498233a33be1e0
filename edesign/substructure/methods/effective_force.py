"""Effective force tests: actuators in force control push a structure on fixed ground, and feel it (thesis 6.1.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.damper import CoreDamper
from edesign.errors import InputError
from edesign.substructure.indicators.response_error import response_error
from edesign.substructure.methods.comparison import MethodRecord, checked_ground, positive
from edesign.substructure.methods.rate import motion_frequency, steady_stiffness
from edesign.substructure.methods.state_space import LinearSystem, fixed_base, respond
from edesign.substructure.structure.numerical import LinearPart


@dataclass(frozen=True)
class Forcing:
    """An actuator in force control, alike at each degree: F' = oil_stiffness (gain (F_c - F) - (1 - share) x').

    Attributes:
        gain: velocity of the piston by an error of force, m/s/N.
        oil_stiffness: of the oil column, N/m; infinite: rigid, then F = F_c - (1 - share) x' / gain.
        velocity_feedback: share of the piston's velocity that is fed forward to the valve: 0 none, 1 all of it.

    Raises:
        InputError: gain or stiffness is not greater than zero, or the share is not 0 to 1.

    Source: Dyke, Spencer, Quast & Sain, J. Engineering Mechanics 121 (1995), for the interaction; Dimig, Shield,
    French, Bailey & Clark, J. Structural Engineering 125 (1999), for the feedback.
    """

    gain: float
    oil_stiffness: float = math.inf
    velocity_feedback: float = 0.0

    def __post_init__(self) -> None:
        positive("gain", self.gain)
        if not self.oil_stiffness > 0.0:
            raise InputError(f"oil_stiffness: must be greater than zero, not {self.oil_stiffness:g} [E-VALUE-02]")
        if not 0.0 <= self.velocity_feedback <= 1.0:
            raise InputError(f"velocity_feedback: must be 0 to 1, not {self.velocity_feedback:g} [E-VALUE-02]")

    @property
    def drag(self) -> float:
        """Damping coefficient of the actuator in a slow motion, N s/m: (1 - share) / gain."""
        return (1.0 - self.velocity_feedback) / self.gain


@dataclass(frozen=True, eq=False, kw_only=True)
class EffectiveForceRecord(MethodRecord):
    """An effective force test beside the response to the forces as commanded; n samples, d degrees.

    Attributes:
        command: (n, d) effective forces -m influence a_g, N.
        force: (n, d) of the actuators, N.
        damper_stiffness: of the damper at the largest deformation and mean frequency of the direct response, N/m.
        frequency: (d,) natural frequencies with the real part of it, Hz.
        force_ratio: (d,) share of the commanded modal force that arrives at these frequencies, complex.
        added_damping: (d,) damping ratio that the actuators as dashpots add to each mode.
        force_error: rms of force less command over that of the command, dimensionless.
    """

    command: np.ndarray
    force: np.ndarray
    damper_stiffness: complex
    frequency: np.ndarray
    force_ratio: np.ndarray
    added_damping: np.ndarray
    force_error: float


def effective_force_test(
    part: LinearPart, damper: CoreDamper | None, step: float, ground: ArrayLike, forcing: Forcing
) -> EffectiveForceRecord:
    """Run an effective force test of a whole structure, an actuator at each degree, from rest.

    Args:
        part: the structure; its mass must be in the laboratory too.
        damper: in the place of the specimen; None: there is none.
        step: s.
        ground: (n,) acceleration of the ground that the forces stand for, m/s2.

    Raises:
        InputError: an impossible number, or the damper's force does not come into balance.
        CoreError: the law of the damper failed.
    """
    values = checked_ground(step, ground)
    n = len(part.names)
    states, damper_force = respond(_laboratory(part, forcing), values, step, damper)
    direct, direct_force = respond(fixed_base(part), values, step, damper)
    command = -np.outer(values, part.mass @ part.influence)
    force = states[:, 2 * n :] if math.isfinite(forcing.oil_stiffness) else command - forcing.drag * states[:, n:]
    direct_deformation = direct[:, :n] @ part.interface
    stiffness = 0j
    if damper is not None:
        amplitude = float(np.abs(direct_deformation).max())
        stiffness = steady_stiffness(damper, amplitude, motion_frequency(direct_deformation, step))
    return EffectiveForceRecord(
        time=step * np.arange(values.size),
        command=command,
        force=force,
        displacement=states[:, :n],
        deformation=states[:, :n] @ part.interface,
        damper_force=damper_force,
        direct_displacement=direct[:, :n],
        direct_deformation=direct_deformation,
        direct_force=direct_force,
        damper_stiffness=stiffness,
        frequency=part.frequencies(stiffness.real),
        force_ratio=force_ratios(part, forcing, stiffness),
        added_damping=added_damping(part, forcing, stiffness.real),
        force_error=response_error(force, command),
    )


def force_transfer(
    part: LinearPart, forcing: Forcing, frequency: ArrayLike, damper_stiffness: complex = 0j
) -> tuple[np.ndarray, np.ndarray]:
    """Return the transfer matrices of force and displacement by commanded force.

    With the dynamic stiffness D = K - omega^2 M + i omega C and what the damper adds: F = D x, and
    (i omega / oil + gain) D x + (1 - share) i omega x = gain F_c. Zeros of F / F_c lie at the poles of the structure.

    Args:
        part: the structure of d degrees.
        frequency: (m,) Hz.
        damper_stiffness: K' + i K'' of the damper at all of these frequencies, N/m.

    Returns:
        Force (m, d, d), dimensionless, and displacement (m, d, d), m/N.
    """
    s = 2j * math.pi * np.atleast_1d(np.asarray(frequency, dtype=float))[:, None, None]
    damper = damper_stiffness * np.outer(part.interface, part.interface)
    dynamic = part.mass * s**2 + part.damping * s + part.stiffness + damper
    unit = np.eye(len(part.names))
    loop = (s / forcing.oil_stiffness + forcing.gain) * dynamic + (1.0 - forcing.velocity_feedback) * s * unit
    displacement = np.linalg.solve(loop, np.broadcast_to(forcing.gain * unit, loop.shape))
    return dynamic @ displacement, displacement


def force_ratios(part: LinearPart, forcing: Forcing, damper_stiffness: complex = 0j) -> np.ndarray:
    """Return the share (d,), complex, of a commanded modal force M phi that arrives at each natural frequency.

    Of one degree gain c / (1 + gain c) with the damping c (N s/m), for an oil column that is stiff against omega c;
    none without damping, and all with velocity feedback.

    Args:
        part: the structure of d degrees.
        damper_stiffness: K' + i K'' of the damper, N/m; its real part counts for the frequencies.
    """
    omega, shapes = part.modes(damper_stiffness.real)
    force, _ = force_transfer(part, forcing, omega / (2.0 * math.pi), damper_stiffness)
    load = part.mass @ shapes
    return np.array([shapes[:, j] @ force[j] @ load[:, j] for j in range(omega.size)])


def added_damping(part: LinearPart, forcing: Forcing, damper_stiffness: float = 0.0) -> np.ndarray:
    """Return the damping ratio (d,) that actuators add to each mode as dashpots of (1 - share) / gain.

    Of one degree 1 / (2 m omega gain), m in kg; infinite for a mode of zero frequency.

    Args:
        part: the structure of d degrees.
        damper_stiffness: in the place of the damper, N/m.
    """
    omega, shapes = part.modes(damper_stiffness)
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(forcing.drag * np.sum(shapes**2, axis=0) / (2.0 * omega))


def _laboratory(part: LinearPart, forcing: Forcing) -> LinearSystem:
    """The structure on fixed ground with its actuators, by the acceleration (m/s2) that the command stands for.

    The state is displacement, velocity, and force unless the oil is rigid.
    """
    fixed, n = fixed_base(part), len(part.names)
    inverse, inertia = np.linalg.inv(part.mass), part.mass @ part.influence
    if not math.isfinite(forcing.oil_stiffness):
        A = fixed.A.copy()
        A[n:, n:] -= forcing.drag * inverse
        return LinearSystem(A, fixed.b, fixed.f, fixed.deformation, fixed.velocity)
    A, none = np.zeros((3 * n, 3 * n)), np.zeros(n)
    A[: 2 * n, : 2 * n] = fixed.A
    A[n : 2 * n, 2 * n :] = inverse
    A[2 * n :, n : 2 * n] = -forcing.oil_stiffness * (1.0 - forcing.velocity_feedback) * np.eye(n)
    A[2 * n :, 2 * n :] = -forcing.oil_stiffness * forcing.gain * np.eye(n)
    b = np.concatenate([none, none, -forcing.oil_stiffness * forcing.gain * inertia])
    f, deformation, velocity = (np.concatenate([row, none]) for row in (fixed.f, fixed.deformation, fixed.velocity))
    return LinearSystem(A, b, f, deformation, velocity)
