"""Target displacement of the nonlinear static (pushover) analysis: the N2 method, EN 1998-1:2004, Annex B."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.codes.capacity_curve import CapacityCurve, fitting
from edesign.codes.spectrum import Spectrum
from edesign.errors import InputError

RANGE = 1.5
"""The capacity curve reaches to this multiple of the target displacement. Source: EN 1998-1:2004, 4.3.3.4.2.3(1)."""

LEAST_ROOF_FORCE = 1e-6
"""Of the force of the roof over the largest one. With less the control node does not stand for the frame: Gamma, by
which its displacement is divided, tends to zero with it. Forces are in equilibrium to 1e-7 of the largest, and so
are displacements about; at 1e-6 one digit of that of the roof is left."""

LARGEST_RATIO = 3.0
"""d_t* need not exceed this multiple of d_et*. Source: EN 1998-1:2004, Annex B.5(2), Note to Eq. B.12."""


@dataclass(frozen=True)
class Oscillator:
    """The equivalent oscillator of a frame under forces of one pattern.

    Attributes:
        mass: m*, kg.
        Gamma: transformation factor.
    """

    mass: float
    Gamma: float


@dataclass(frozen=True)
class Idealisation:
    """The elastic - perfectly plastic relation that stands for the curve of the oscillator.

    Attributes:
        d_m: displacement up to which the areas below both are equal, d_m*, m.
        F_y: yield force, F_y*, N.
        d_y: yield displacement, d_y*, m.
        T: period of the oscillator, T*, s.
    """

    d_m: float
    F_y: float
    d_y: float
    T: float


@dataclass(frozen=True)
class TargetDisplacement:
    """Target displacement by the N2 method, with the steps that lead to it.

    Attributes:
        S_e: ordinate of the elastic spectrum at T*, m/s2.
        d_et: target displacement of the oscillator if it stayed elastic, d_et*, m.
        q_u: acceleration of the elastic oscillator over that of the oscillator as it is.
        d_t_oscillator: target displacement of the oscillator, d_t*, m.
        d_t: target displacement of the control node, m.
    """

    oscillator: Oscillator
    idealisation: Idealisation
    S_e: float
    d_et: float
    q_u: float
    d_t_oscillator: float
    d_t: float

    @property
    def ductility(self) -> float:
        """Ductility d_t* / d_y*."""
        return self.d_t_oscillator / self.idealisation.d_y


def equivalent_oscillator(forces: np.ndarray, masses: np.ndarray) -> Oscillator:
    """Return m* and Gamma of lateral forces F_i = m_i Phi_i, with Phi = 1 at the control node.

    Args:
        forces: F_i of the floors in any scale, from the lowest; the control node is on the last.
        masses: m_i of the floors, kg; 0 only where there is no force.

    Raises:
        InputError: the floor of the control node has no mass or hardly a force, or forces have no resultant.

    Source: EN 1998-1:2004, Annex B, Eqs. B.1 to B.3.
    """
    if not (masses[-1] > 0.0 and forces[-1] != 0.0):
        raise InputError(
            "the roof needs a mass and a lateral force, to which those of the other floors are related [E-EC8-06]"
        )
    share = abs(forces[-1]) / np.abs(forces).max()
    if share < LEAST_ROOF_FORCE:
        raise InputError(
            f"the lateral force of the roof is {share:.3g} of the largest one; those of the other floors are related "
            f"to it, which takes {LEAST_ROOF_FORCE:g} at least [E-EC8-06]"
        )
    there = masses > 0.0
    m, normalised = masses[there], forces[there] * masses[-1] / forces[-1]
    total = float(normalised.sum())
    if not total > 0.0:
        raise InputError("the lateral forces act against the displacement of the roof [E-EC8-06]")
    return Oscillator(total, total / float(np.sum(normalised**2 / m)))


def idealised(curve: CapacityCurve, mass: float, d_m: float) -> Idealisation:
    """Return the elastic - perfectly plastic relation of equal energy.

    Args:
        curve: F* against d*, of the oscillator.
        mass: m*, kg.
        d_m: d_m*, at most the displacement at the largest force.

    Source: EN 1998-1:2004, Annex B.3 and B.4, Eqs. B.6 and B.7.
    """
    F_y = curve.largest_up_to(d_m)
    d_y = 2.0 * (d_m - curve.energy(d_m) / F_y)
    return Idealisation(d_m, F_y, d_y, 2.0 * math.pi * math.sqrt(mass * d_y / F_y))


def oscillator_target(S_e: float, T: float, T_C: float, q_u: float) -> float:
    """Return d_t* of an oscillator, m.

    Args:
        S_e: ordinate of the elastic spectrum at its period, m/s2.
        T: T*, s.
        T_C: corner period of the spectrum, s.
        q_u: S_e m* / F_y*.

    Source: EN 1998-1:2004, Annex B.5, Eqs. B.8 to B.12.
    """
    d_et = S_e * (T / (2.0 * math.pi)) ** 2
    if T >= T_C or q_u <= 1.0:
        return d_et
    return min(max(d_et / q_u * (1.0 + (q_u - 1.0) * T_C / T), d_et), LARGEST_RATIO * d_et)


def target_displacement(
    curve: CapacityCurve, oscillator: Oscillator, spectrum: Spectrum, T_C: float
) -> TargetDisplacement:
    """Return the target displacement of the control node.

    The plastic mechanism, up to which the curve is idealised, forms at the target displacement itself, as B.5(3) has
    it, or at the largest base shear if that comes earlier. The target that fits itself is found by halving, so that
    it depends on no first guess.

    Args:
        curve: base shear against displacement of the control node.
        oscillator: m* and Gamma of the lateral forces.
        spectrum: elastic, of the hazard level.
        T_C: its corner period, s.

    Source: EN 1998-1:2004, 4.3.3.4.2.6 and Annex B; Fajfar (2000), Earthquake Spectra 16(3), 573-592.
    """
    own = curve.scaled(1.0 / oscillator.Gamma)

    def found(d_m: float) -> TargetDisplacement:
        relation = idealised(own, oscillator.mass, d_m)
        S_e = float(spectrum.acceleration(relation.T))
        q_u = S_e * oscillator.mass / relation.F_y
        d_t = oscillator_target(S_e, relation.T, T_C, q_u)
        d_et = S_e * (relation.T / (2.0 * math.pi)) ** 2
        return TargetDisplacement(oscillator, relation, S_e, d_et, q_u, d_t, oscillator.Gamma * d_t)

    return found(fitting(lambda d_m: found(d_m).d_t_oscillator, own.peak))
