"""Simplified linear analysis of isolated buildings, EN 1998-1:2004, 10.3 and 10.9."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError

GAMMA_X = 1.2
"""On displacements of isolators in buildings, so that they are more reliable than the rest: 10.3(2)P, recommended."""
LEAST_STIFFNESS_RATIO = 0.5
MOST_DAMPING = 0.3
LEAST_RESTORING = 0.025
LEAST_PERIOD_RATIO = 3.0
LONGEST_PERIOD = 3.0  # s

_SEARCH = np.geomspace(5.0, 1e-4, 24)  # m: no building moves by more, and no isolator slips or yields by less
_AGREEMENT = 1e-6  # of frequencies that follow each other
_MOST_ROUNDS = 50

Loop = Callable[[float, float, float], tuple[float, float]]
"""Effective stiffness (N/m) and energy of a cycle (J) of the isolation system by amplitude (m), frequency (Hz) and the
speed at which friction counts (m/s)."""


@dataclass(frozen=True)
class EquivalentLinear:
    """The isolated building as a rigid body on a linear isolation system.

    Attributes:
        displacement: d_dc, m.
        stiffness: K_eff at it, N/m.
        damping: xi_eff, ratio of critical.
        mass: M above the isolators, kg.
        acceleration: S_e(T_eff, xi_eff), m/s2.
        stiffness_ratio: K_eff / K_eff at 0.2 d_dc.
        restoring: growth of the force from 0.5 d_dc to d_dc over the weight M g, with the friction at d_dc on both.
    """

    displacement: float
    stiffness: float
    damping: float
    mass: float
    acceleration: float
    stiffness_ratio: float
    restoring: float

    @property
    def period(self) -> float:
        """Effective period T_eff = 2 pi sqrt(M / K_eff), s; Eq. 10.1."""
        return 2.0 * math.pi * math.sqrt(self.mass / self.stiffness)

    @property
    def shear(self) -> float:
        """Force through the isolation system, K_eff d_dc = M S_e, N."""
        return self.stiffness * self.displacement

    def not_met(self, fixed_period: float) -> Iterator[str]:
        """Yield the conditions that the equivalent linear and the simplified analysis ask for and this misses.

        Args:
            fixed_period: T_f, fundamental period on a fixed base, s.

        Source: EN 1998-1:2004, 10.9.2(5)a, b, d and 10.9.3(3)e. The other conditions are not of these quantities.
        """
        if self.stiffness_ratio < LEAST_STIFFNESS_RATIO:
            yield f"EN 1998-1, 10.9.2(5)a: K_eff is {self.stiffness_ratio:.2f} of that at 0.2 d_dc, less than 0.5"
        if self.damping > MOST_DAMPING:
            yield f"EN 1998-1, 10.9.2(5)b: xi_eff is {100.0 * self.damping:.1f} %, more than 30 %"
        if self.restoring < LEAST_RESTORING:
            grown = f"{100.0 * self.restoring:.2f} % of the weight"
            yield f"EN 1998-1, 10.9.2(5)d: the force grows by {grown} from d_dc/2 to d_dc, less than 2.5 %"
        if self.period < LEAST_PERIOD_RATIO * fixed_period:
            yield f"EN 1998-1, 10.9.3(3)e: T_eff is {self.period / fixed_period:.2f} T_f, less than 3"
        if self.period > LONGEST_PERIOD:
            yield f"EN 1998-1, 10.9.3(3)e: T_eff is {self.period:.2f} s, more than 3 s"


def equivalent_linear(loop: Loop, mass: float, spectrum: Spectrum, gravity: float) -> EquivalentLinear:
    """Find the displacement of an isolated building from an elastic spectrum, with the stiffness and damping at it.

    Of several solutions the largest is taken.

    Args:
        loop: of the isolation system.
        mass: above it, kg.
        spectrum: elastic, of any code; its own correction for damping counts.
        gravity: m/s2.

    Raises:
        InputError: no displacement of 0.1 mm to 5 m solves it, or the spectrum does not know such a damping or period.

    Source: EN 1998-1:2004, 10.9.2(2)-(4) and 10.9.3(1), (5), Eqs. 10.1 and 10.5. ASCE/SEI 7-16, Eqs. 17.5-1 and 17.5-2
        are the same on the branch of constant velocity of its spectrum.
    """
    from scipy.optimize import brentq

    def state(displacement: float) -> tuple[float, float, float]:
        stiffness, energy = _steady(loop, displacement, mass)
        damping = energy / (2.0 * math.pi * stiffness * displacement**2)
        period = 2.0 * math.pi * math.sqrt(mass / stiffness)
        return stiffness, damping, float(spectrum.with_damping(damping).acceleration(period))

    def excess(displacement: float) -> float:
        stiffness, _, acceleration = state(displacement)
        return acceleration - stiffness * displacement / mass

    above = None
    for displacement in map(float, _SEARCH):
        try:
            found = excess(displacement)
        except InputError:  # beyond what the spectrum knows; there may be a solution within
            above = None
            continue
        if found >= 0.0:
            break
        above = displacement
    else:
        raise InputError("no displacement from 0.1 mm on solves it with a damping that the spectrum knows [E-EC8-04]")
    if above is None:
        raise InputError(f"no displacement solves it with a damping and period that {spectrum.label} knows [E-EC8-04]")
    d = float(brentq(excess, displacement, above, xtol=1e-9))
    stiffness, damping, acceleration = state(d)
    small, _ = _steady(loop, 0.2 * d, mass)
    half, _ = _steady(loop, 0.5 * d, mass, d * math.sqrt(stiffness / mass))
    restoring = (stiffness * d - half * 0.5 * d) / (mass * gravity)
    return EquivalentLinear(d, stiffness, damping, mass, acceleration, stiffness / small, restoring)


def _steady(loop: Loop, displacement: float, mass: float, speed: float | None = None) -> tuple[float, float]:
    """Effective stiffness and energy of a cycle at an amplitude, at the frequency that the mass has on this stiffness.

    Friction counts at a speed, m/s; None: the largest of this motion.

    Raises:
        InputError: there is no stiffness.
    """
    frequency = 0.5
    for _ in range(_MOST_ROUNDS):
        own = 2.0 * math.pi * frequency * displacement
        stiffness, energy = loop(displacement, frequency, own if speed is None else speed)
        if not stiffness > 0.0:
            raise InputError(f"the isolation system has no stiffness at {1e3 * displacement:g} mm [E-EC8-04]")
        before, frequency = frequency, math.sqrt(stiffness / mass) / (2.0 * math.pi)
        if abs(frequency - before) <= _AGREEMENT * frequency:
            break
    return stiffness, energy
