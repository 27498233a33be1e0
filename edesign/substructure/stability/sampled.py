"""The loop of a substructure test as the linear system in main steps that it is, and the count of its unstable roots.

All of it is evaluated at z = exp(s T), T being the main step: the recursion of the numerical part, the difference
equation of the compensator, and what rig and specimen do between two commands, taken at main steps. So the frequencies
up to half the rate of the loop count as they are in a run.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg

from edesign.core.compensator import DifferenceEquation, Term
from edesign.core.substructure import Recursion
from edesign.errors import InputError
from edesign.project.substructure.checks_tests import MOST_STEPS
from edesign.substructure.stability.sweep import LARGEST_CHANGE, first_grid, refined

SLOWEST = math.log(2.0) / MOST_STEPS
"""Growth in a main step that counts as none, 1.4e-7: it doubles a motion in the longest test that may run. Undamped
roots of a numerical part lie on the unit circle, and rounding moves a double root at z = 1 by the root of a double's
1e-16, which is less."""
LEANS = (0.0, 0.01, 0.1, 0.5)
"""Growth over half the rate of the loop of the starts from which roots are sought."""
STARTS = 40
ROUNDS = 50
SETTLED = 1e-10
"""Last change of a root over half the rate of the loop."""
DIFFERENCE = 1e-7
"""Of s, over half the rate of the loop, for a derivative; about the root of the rounding errors."""
_ORDER = ("target", "velocity", "acceleration")

RigSteps = Callable[[np.ndarray], np.ndarray]
"""(3, m) at s of shape (m,), 1/s: measured displacement and piston (m), and force as read (N), all at main steps, over
commands at main steps that are reached in ramps (m)."""


class Resolvent:
    """Transfer function C (z - A)^-1 B of matrices.

    Args:
        A: (n, n).
        B: (n, k).
        C: (l, n).

    Source: Laub 1981, Efficient multivariable frequency response computations (with Schur's form for Hessenberg's).
    """

    def __init__(self, A: np.ndarray, B: np.ndarray, C: np.ndarray) -> None:
        balanced, (scale, _) = scipy.linalg.matrix_balance(A, permute=False, separate=True)
        self._triangle, unitary = scipy.linalg.schur(balanced, output="complex")
        self._inputs = unitary.conj().T @ (B / scale[:, None])
        self._outputs = (C * scale) @ unitary

    @property
    def poles(self) -> np.ndarray:
        """Eigenvalues of A, (n,)."""
        return np.diagonal(self._triangle)

    def __call__(self, z: np.ndarray) -> np.ndarray:
        """Return the values at z of shape (m,), none of which is a pole; (l, k, m)."""
        n, k = self._inputs.shape
        solved = np.empty((n, k * z.size), dtype=complex)
        for i in reversed(range(n)):
            known = (self._triangle[i, i + 1 :] @ solved[i + 1 :]).reshape(k, z.size) + self._inputs[i][:, None]
            solved[i] = (known / (z - self._triangle[i, i])).ravel()
        return np.asarray((self._outputs @ solved).reshape(-1, k, z.size))


class SampledPlant:
    """Numerical part, rig and specimen in main steps: all but the compensator, which they have in common.

    Args:
        rig: with the specimen, stable by itself.
        step: main step, s.
        resonances: (k,) roots of structure and numerical part, 1/s, about which the loop is looked at closely.
    """

    def __init__(self, numerical: Recursion, rig: RigSteps, step: float, resonances: np.ndarray) -> None:
        self.step, self._rig, self._resonances = step, rig, resonances
        self._numerical = Resolvent(numerical.A, numerical.B[:, :2], numerical.C[:3])
        self._direct = numerical.D[:3, :2]

    @property
    def half_rate(self) -> float:
        """Half the rate of the loop, rad/s."""
        return np.pi / self.step

    @property
    def growth_of_none(self) -> float:
        """Growth that counts as none, 1/s."""
        return SLOWEST / self.step

    @property
    def unstable_poles(self) -> int:
        """Roots of the numerical part alone that grow."""
        return int(np.sum(np.abs(self._numerical.poles) > np.exp(SLOWEST)))

    def values(self, s: np.ndarray) -> np.ndarray:
        """Return target displacement, velocity and acceleration over force, then what `RigSteps` says; (6, m).

        Args:
            s: (m,) complex frequencies, 1/s.
        """
        z = np.exp(s * self.step)
        over = self._numerical(z) + self._direct[:, :, None]
        return np.vstack([(over[:, 0] + over[:, 1] / z) / z, self._rig(s)])

    @cached_property
    def grid(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies (m,), rad/s, from 0 to half the rate, and the values there (6, m), the same for every loop."""
        poles = self._numerical.poles
        own = np.log(poles[np.abs(poles) > np.exp(-1.0)]) / self.step  # those that decay faster are no resonances
        resonances = np.concatenate([self._resonances, own[own.imag >= 0.0]])
        omega = first_grid(resonances, self.half_rate)
        return omega, self.values(self.growth_of_none + 1j * omega)


@dataclass(frozen=True)
class SampledStability:
    """Verdict on the loop in main steps.

    Attributes:
        unstable_roots: outside the unit circle, a pair counted twice.
        growth: rate at which the motion grows that grows most, 1/s; 0: none grows; NaN: its root was not found.
        frequency: of that motion, Hz; NaN: as above.
    """

    unstable_roots: int
    growth: float
    frequency: float

    @property
    def stable(self) -> bool:
        """True if no motion grows."""
        return self.unstable_roots == 0


@dataclass(frozen=True, eq=False)
class SampledLoop:
    """Loop of plant and compensator in main steps.

    Attributes:
        plant: all but the compensator.
        compensator: its difference equation; an adaptive one with what it has found.
        unseen_delay: main steps between the target and the compensator.
        corrected: whether the command gets the difference of piston and specimen that was last measured.
    """

    plant: SampledPlant
    compensator: DifferenceEquation
    unseen_delay: int = 0
    corrected: bool = False

    def determinant(self, s: np.ndarray, values: np.ndarray) -> np.ndarray:
        """Return the determinant of the loop's equations in its commands, and in the force, (m,).

        The unknowns are the command of the compensator, the command with the correction of the rig, and the force that
        the numerical part gets. The determinant is 0 at roots of the loop, 1 at z = infinity, and its only poles are
        those of numerical part and rig.

        Args:
            s: (m,), 1/s.
            values: of the plant there, (6, m).
        """
        back = np.exp(-s * self.plant.step)
        targets, (measured, piston, force) = values[:3], values[3:]

        def sums(terms: Iterable[Term]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
            """Of targets over force, of the measured displacement over the sent command, and of commands."""
            found = np.zeros((3, s.size), dtype=complex)
            for term in terms:
                share = term.coefficient * back**term.lag
                if term.of == "command":
                    found[2] += share
                elif term.of == "measured":
                    found[1] += share * back * measured
                else:
                    found[0] += share * back**self.unseen_delay * targets[_ORDER.index(term.of)]
            return found[0], found[1], found[2]

        wanted, fed_back, past = sums(self.compensator.terms)
        of_target, of_measured, of_command = sums(self.compensator.force_terms)
        sent = 1.0 - (back * (piston - measured) if self.corrected else 0.0)
        got = force + of_measured
        return np.asarray(((1.0 - past) * sent - fed_back) * (1.0 - of_target) - wanted * (got + sent * of_command))

    @cached_property
    def _swept(self) -> tuple[np.ndarray, np.ndarray]:
        """Frequencies, rad/s, and the determinant there, both (m,)."""
        plant, (omega, values) = self.plant, self.plant.grid

        def at(some: np.ndarray) -> np.ndarray:
            s = plant.growth_of_none + 1j * some
            return self.determinant(s, plant.values(s))[None]

        first = self.determinant(plant.growth_of_none + 1j * omega, values)[None]
        with np.errstate(invalid="ignore"):
            omega, found = refined(omega, first, at, _too_far)
        if not np.all(np.isfinite(found)):
            where = omega[~np.isfinite(found[0])][0] / (2.0 * np.pi)
            raise InputError(f"the loop in main steps has no finite value at {where:.4g} Hz [E-RIG-04]")
        return omega, found[0]

    @property
    def unstable_roots(self) -> int:
        """Roots outside the unit circle, a pair counted twice.

        As the determinant is 1 at infinity, it goes round 0 on the circle, clockwise, once for each root outside less
        each pole there (principle of the argument; Jury 1964, Theory and Application of the z-Transform Method). The
        upper half is half of it: it begins and ends on the real axis, which a complex spring misses somewhat.
        """
        found = self._swept[1]
        angle = float(np.sum(np.angle(found[1:] / found[:-1]))) + _off_axis(found[0]) - _off_axis(found[-1])
        return self.plant.unstable_poles + round(-angle / np.pi)

    def stability(self) -> SampledStability:
        """Return the verdict.

        Raises:
            InputError: a part of the loop is not finite at a frequency, which is named.
        """
        count = self.unstable_roots
        if count <= 0:
            return SampledStability(0, 0.0, np.nan)
        roots = self._unstable()
        if not roots.size:
            return SampledStability(count, np.nan, np.nan)
        fastest = complex(roots[np.argmax(roots.real)])
        return SampledStability(count, fastest.real, abs(fastest.imag) / (2.0 * np.pi))

    def _unstable(self) -> np.ndarray:
        """Roots that grow, as far as Newton's method finds them: from the dips of the determinant, and from a net."""
        plant, (omega, found) = self.plant, self._swept
        size, end = np.abs(found), plant.half_rate
        inner = np.flatnonzero((size[1:-1] <= size[:-2]) & (size[1:-1] <= size[2:])) + 1
        omega = np.concatenate([omega[[0, -1]], omega[inner], np.linspace(0.0, end, STARTS)])
        s = np.add.outer(end * np.array(LEANS) + plant.growth_of_none, 1j * omega).ravel()
        step = DIFFERENCE * end
        change = np.full(s.size, np.inf, dtype=complex)
        with np.errstate(all="ignore"):
            for _ in range(ROUNDS):
                here, beside = np.split(self._at(np.concatenate([s, s + step])), 2)
                change = step * here / (beside - here)
                s = s - change
                kept = np.isfinite(s) & (s.real > -end) & (s.real < 2.0 * end) & (np.abs(s.imag) < 1.5 * end)
                s, change = s[kept], change[kept]
                if np.all(np.abs(change) <= SETTLED * end):
                    break
        grows = (np.abs(change) <= SETTLED * end) & (s.real > plant.growth_of_none)
        return np.asarray(s[grows & (np.abs(s.imag) <= end * (1.0 + 1e-6))])

    def _at(self, s: np.ndarray) -> np.ndarray:
        return self.determinant(s, self.plant.values(s))


def _too_far(values: np.ndarray) -> np.ndarray:
    """Say whether the determinant changes too much from each frequency to the next, (m - 1,)."""
    size = np.abs(values[0])
    return np.asarray(np.abs(np.diff(values[0])) > LARGEST_CHANGE * np.minimum(size[1:], size[:-1]))


def _off_axis(value: complex) -> float:
    """Angle of a value from the real axis, whichever side of 0 it is on."""
    return float(np.angle(value if value.real > 0.0 else -value))
