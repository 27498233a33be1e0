"""A linear laboratory in state space with a damper in it: exact steps, in which the damper's force is balanced."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from edesign.core.damper import CoreDamper
from edesign.errors import InputError
from edesign.one_thread import one_thread
from edesign.stopping import stop_if_requested
from edesign.substructure.structure.numerical import LinearPart

BALANCE = 1e-10
"""Error of the damper's force over the largest force so far, at which the iteration for balance ends."""
NEWTON_STEPS = 4
"""Smooth laws take 2 or 3; what takes more has a kink or a vertical slope, and is bracketed."""
MOST_ITERATIONS = 200
"""Of the bracketing; Brent's method needs at most the square of the 34 bisections to BALANCE, and in practice 10."""


@dataclass(frozen=True, eq=False)
class LinearSystem:
    """z' = A z + b u + f F, with one input u and the force F of a damper.

    Attributes:
        A: (s, s).
        b: (s,) of the input.
        f: (s,) of the damper's force in N.
        deformation: (s,) row that gives the deformation of the damper, m.
        velocity: (s,) row that gives its rate, m/s.
    """

    A: np.ndarray
    b: np.ndarray
    f: np.ndarray
    deformation: np.ndarray
    velocity: np.ndarray

    def poles(self) -> np.ndarray:
        """Return the eigenvalues (s,) without the damper, rad/s."""
        return np.asarray(np.linalg.eigvals(self.A))


def fixed_base(part: LinearPart) -> LinearSystem:
    """Return a structure under the acceleration of its base (m/s2): the state is displacement and velocity, (2 n,)."""
    n = len(part.names)
    zero = np.zeros(n)
    inverse = np.linalg.inv(part.mass)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-inverse @ part.stiffness, -inverse @ part.damping]])
    return LinearSystem(
        A,
        np.concatenate([zero, -part.influence]),
        np.concatenate([zero, -inverse @ part.interface]),
        np.concatenate([part.interface, zero]),
        np.concatenate([zero, part.interface]),
    )


def respond(
    system: LinearSystem, given: np.ndarray, step: float, damper: CoreDamper | None
) -> tuple[np.ndarray, np.ndarray]:
    """Return the states (n, s) and the force of the damper (n,) in N from rest.

    Input and force are linear over a step; the motion is exact for that, and the damper moves along the cubic through
    deformation and velocity.

    Args:
        system: the laboratory.
        given: (n,) input.
        step: s.
        damper: None: there is none.

    Raises:
        InputError: the force of the damper does not come into balance.
        CoreError: its law failed.
        Stopped: by a request of `edesign.stopping.stoppable`.
    """
    with one_thread():
        A, b0, b1, f0, f1 = _exact(system, step)
    states, forces = np.zeros((given.size, len(A))), np.zeros(given.size)
    balance = None if damper is None else _Balance(damper, system, f1, step)
    z, force = states[0], 0.0
    for i in range(given.size - 1):
        stop_if_requested()
        z = A @ z + b0 * given[i] + b1 * given[i + 1] + f0 * force
        if balance is not None:
            force = balance.step(z, force, i)
            z = z + f1 * force
        states[i + 1], forces[i + 1] = z, force
    return states, forces


class _Balance:
    """The damper at the end of each step.

    Args:
        system: with the rows of its motion.
        end: (s,) state by a force of 1 N at the end of a step.
        step: s.
    """

    def __init__(self, damper: CoreDamper, system: LinearSystem, end: np.ndarray, step: float) -> None:
        self._damper, self._step, self._state = damper, step, damper.start()
        self._rows = np.array([system.deformation, system.velocity])
        self._by_force = self._rows @ end
        self._motion, self._largest = (0.0, 0.0), 0.0

    def step(self, free: np.ndarray, force: float, number: int) -> float:
        """Return the force at the end of a step, N.

        Args:
            free: (s,) state there without it.
            force: first guess, N.
            number: of the step, from 0.
        """
        e, v = (self._rows @ free).tolist()
        by_e, by_v = self._by_force.tolist()

        def moved(by: float) -> tuple[tuple[float, float], np.ndarray, float, tuple[float, float]]:
            motion = (e + by_e * by, v + by_v * by)
            return motion, *self._damper.step(self._state, self._step, self._motion, motion)

        first = force
        for _ in range(NEWTON_STEPS):
            motion, state, found, (k, c) = moved(force)
            if abs(found - force) <= BALANCE * max(self._largest, abs(found)):
                break
            force -= (found - force) / (k * by_e + c * by_v - 1.0)
        else:
            force = self._bracketed(lambda by: moved(by)[2] - by, first, number)
            motion, state, _, _ = moved(force)
        self._state, self._motion, self._largest = state, motion, max(self._largest, abs(force))
        return force

    def _bracketed(self, imbalance: Callable[[float], float], guess: float, number: int) -> float:
        """Return the force of balance, N, which is between a guess and what the damper gives for it.

        So it is as a damper that is pulled back gives less force.
        """
        other = guess + imbalance(guess)
        tolerance = BALANCE * max(self._largest, abs(other))
        if imbalance(other) * (other - guess) > 0.0:
            raise InputError(
                f"the force of the damper did not come into balance after {number + 1} steps of "
                f"{1e3 * self._step:g} ms; take a shorter step [E-RTS-03]"
            )
        return float(scipy.optimize.brentq(imbalance, guess, other, xtol=tolerance, maxiter=MOST_ITERATIONS))


def _exact(system: LinearSystem, step: float) -> tuple[np.ndarray, ...]:
    """A of the step, and what input and force at its two ends do: (s, s), 4 times (s,)."""
    s = len(system.A)
    block = np.zeros((s + 4, s + 4))
    block[:s, :s], block[:s, s], block[:s, s + 1] = step * system.A, step * system.b, step * system.f
    block[s, s + 2] = block[s + 1, s + 3] = 1.0
    exact = scipy.linalg.expm(block)[:s]
    ends = [exact[:, s] - exact[:, s + 2], exact[:, s + 2], exact[:, s + 1] - exact[:, s + 3], exact[:, s + 3]]
    return exact[:, :s], *ends
