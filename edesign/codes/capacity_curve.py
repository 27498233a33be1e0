"""The capacity curve that nonlinear static procedures idealise: base shear against a displacement of the roof."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.errors import InputError

SETTLED = 1e-9  # relative: to which displacements that depend on themselves are found

DESCENT = 1e-6
"""Least fall of a base shear over its largest value that counts as one: ten times the tolerance of equilibrium, below
which a plateau wavers."""


@dataclass(frozen=True)
class CapacityCurve:
    """Points of a capacity curve, joined by straight lines.

    Attributes:
        displacement: of the control node, m, from 0 and ascending.
        force: base shear, N, from 0.
    """

    displacement: np.ndarray
    force: np.ndarray

    def __post_init__(self) -> None:
        d, f = self.displacement, self.force
        if d.ndim != 1 or d.shape != f.shape or d.size < 2:
            raise InputError(
                "a capacity curve needs two points or more, each of a displacement and a base shear [E-CURVE-05]"
            )
        if not (d[0] == 0.0 and np.all(np.diff(d) > 0.0) and np.all(np.isfinite(f))):
            raise InputError("the displacements of a capacity curve begin with 0 and ascend [E-CURVE-05]")
        if not f[1] > f[0]:
            raise InputError(
                "the base shear does not rise with the displacement from the start of the capacity curve [E-CURVE-05]"
            )

    @property
    def end(self) -> float:
        """Last displacement of the curve, m."""
        return float(self.displacement[-1])

    @cached_property
    def peak(self) -> float:
        """Displacement at the largest base shear, m; the first of several."""
        return float(self.displacement[int(np.argmax(self.force))])

    @cached_property
    def _energies(self) -> np.ndarray:
        parts = 0.5 * (self.force[1:] + self.force[:-1]) * np.diff(self.displacement)
        return np.append(0.0, np.cumsum(parts))

    @cached_property
    def _largest(self) -> np.ndarray:
        return np.maximum.accumulate(self.force)

    @property
    def stiffness(self) -> float:
        """Slope of the first part of the curve, N/m."""
        return float((self.force[1] - self.force[0]) / (self.displacement[1] - self.displacement[0]))

    def force_at(self, displacement: float) -> float:
        """Return the base shear at a displacement up to the end, N.

        Args:
            displacement: m.
        """
        return float(np.interp(displacement, self.displacement, self.force))

    def largest_up_to(self, displacement: float) -> float:
        """Return the largest base shear up to a displacement, N.

        Args:
            displacement: m.
        """
        return max(float(self._largest[self._before(displacement)]), self.force_at(displacement))

    def energy(self, displacement: float) -> float:
        """Return the work of the base shear up to a displacement, J: the area below the curve.

        Args:
            displacement: m.
        """
        at = self._before(displacement)
        rest = displacement - float(self.displacement[at])
        return float(self._energies[at]) + 0.5 * (float(self.force[at]) + self.force_at(displacement)) * rest

    def first_at(self, force: float) -> float:
        """Return the first displacement at which the base shear reaches a force, m.

        Args:
            force: N, above 0 and at most the largest base shear.
        """
        at = int(np.searchsorted(self._largest, force))
        d, f = self.displacement[at - 1 : at + 1], self.force[at - 1 : at + 1]
        return float(d[0] + (force - f[0]) * (d[1] - d[0]) / (f[1] - f[0]))

    def _before(self, displacement: float) -> int:
        """The last point at a smaller displacement, 0 if there is none."""
        return max(int(np.searchsorted(self.displacement, displacement)) - 1, 0)

    def scaled(self, factor: float) -> CapacityCurve:
        """Return the curve with displacements and forces times a factor.

        Args:
            factor: dimensionless.
        """
        return CapacityCurve(factor * self.displacement, factor * self.force)


def fitting(target: Callable[[float], float], most: float) -> float:
    """Return the displacement that is the target of its own idealisation, or `most` if the target lies beyond.

    Args:
        target: the target displacement, m, from the displacement of the idealisation, m; above 0 at small ones.
        most: the largest displacement of the idealisation, m.

    Returns:
        m.

    Raises:
        InputError: the target is too small for a displacement of its own on the curve.
    """
    if target(most) >= most:
        return most
    least = SETTLED * most
    if not (found := target(least)) > least:
        raise InputError(
            f"the target displacement, {found:.3g} m, is below {SETTLED:g} of the {most:.3g} m up to which the "
            "capacity curve is idealised: the spectrum of this level hardly moves the frame [E-EC8-06]"
        )
    return zero(lambda displacement: displacement - target(displacement), least, most)


def zero(function: Callable[[float], float], low: float, high: float) -> float:
    """Find where a function passes from below zero to above, to 1e-9 of `high`.

    Returns:
        The place, between `low` and `high`.
    """
    from scipy.optimize import brentq  # which takes a tenth of a second to load

    return float(brentq(function, low, high, xtol=SETTLED * high))
