"""Target displacement by the coefficient method, FEMA 356, 3.3.3.3.2."""

from __future__ import annotations

import math
from dataclasses import dataclass

from edesign.codes.capacity_curve import CapacityCurve, fitting
from edesign.codes.fema356.idealisation import Bilinear, bilinear
from edesign.codes.spectrum import Spectrum

FEW_STOREYS, MANY_STOREYS = 1.0, 0.9
LONG_PERIOD = 1.0  # s
SHORTEST, LARGEST_C_1 = 0.1, 1.5  # period in s, and C_1 up to it; 3.3.1.3.1


@dataclass(frozen=True)
class CoefficientTarget:
    """Target displacement of the control node, and what it is the product of.

    Attributes:
        idealisation: of the capacity curve.
        T_e: effective fundamental period, s.
        S_a: ordinate of the spectrum at T_e, m/s2.
        C_0: displacement of the control node over that of the oscillator.
        C_1: inelastic over elastic displacement.
        C_2: effect of pinched and degrading loops.
        C_3: effect of a negative slope after yielding; 1 in ASCE/SEI 41, which has none.
        C_m: share of the mass that takes part.
        ratio: of elastic demand to yield strength, R of FEMA 356, mu_strength of ASCE/SEI 41.
        d_t: target displacement, m.
    """

    idealisation: Bilinear
    T_e: float
    S_a: float
    C_0: float
    C_1: float
    C_2: float
    C_3: float
    C_m: float
    ratio: float
    d_t: float


def effective_mass_factor(storeys: int, period: float) -> float:
    """Return C_m of steel frames: 0.9 from three storeys on, 1.0 of lower ones and where the period is above 1 s.

    Args:
        storeys: of the building.
        period: fundamental, s.

    Source: FEMA 356, Table 3-1; ASCE/SEI 41-17, Table 7-4: moment frames and braced frames of steel.
    """
    return FEW_STOREYS if storeys < 3 or period > LONG_PERIOD else MANY_STOREYS


def inelastic_factor(R: float, T_e: float, T_S: float) -> float:
    """Return C_1.

    Args:
        R: ratio of elastic demand to yield strength.
        T_e: effective fundamental period, s.
        T_S: corner period of the spectrum, s.

    Source: FEMA 356, 3.3.3.3.2, Eq. 3-15: between 1 and the values of 3.3.1.3.1.
    """
    if T_e >= T_S or R <= 1.0:
        return 1.0
    share = min(max((T_S - T_e) / (T_S - SHORTEST), 0.0), 1.0) if T_S > SHORTEST else 1.0
    most = 1.0 + (LARGEST_C_1 - 1.0) * share
    return min(unlimited_inelastic_factor(R, T_e, T_S), most)


def unlimited_inelastic_factor(R: float, T_e: float, T_S: float) -> float:
    """Return C_1 of Eq. 3-15 without the limit of 3.3.1.3.1, from 1.

    Args:
        R: ratio of elastic demand to yield strength.
        T_e: effective period, s.
        T_S: end of the branch of constant acceleration, s.

    Source: FEMA 440, chapter 5, which advises against the limit.
    """
    return 1.0 if T_e >= T_S or R <= 1.0 else (1.0 + (R - 1.0) * T_S / T_e) / R


def second_order_factor(R: float, T_e: float, alpha: float) -> float:
    """Return C_3 = 1 + |alpha| (R - 1)^1.5 / T_e of a negative slope after yielding, else 1.

    Args:
        R: ratio of elastic demand to yield strength.
        T_e: effective fundamental period, s.
        alpha: slope after yielding over the effective stiffness.

    Source: FEMA 356, Eq. 3-17.
    """
    return 1.0 + abs(alpha) * max(R - 1.0, 0.0) ** 1.5 / T_e if alpha < 0.0 else 1.0


def strength_ratio(S_a: float, V_y: float, mass: float, C_m: float) -> float:
    """Return R = S_a C_m W / (V_y g).

    Args:
        S_a: ordinate of the spectrum at T_e, m/s2.
        V_y: effective yield strength, N.
        mass: effective seismic weight / g, kg.
        C_m: effective mass factor.

    Source: FEMA 356, Eq. 3-16; ASCE/SEI 41-17, Eq. 7-31.
    """
    return S_a * mass * C_m / V_y


@dataclass(frozen=True)
class Demand:
    """Demand that the coefficients of a target displacement are taken from; attributes as of `CoefficientTarget`."""

    idealisation: Bilinear
    T_e: float
    S_a: float
    C_m: float
    ratio: float

    def target(self, C_0: float, C_1: float, C_2: float, C_3: float = 1.0) -> CoefficientTarget:
        """Return d_t = C_0 C_1 C_2 C_3 S_a (T_e / 2 pi)^2.

        Args:
            C_0: factor from spectral to control-node displacement.
            C_1: factor for inelastic displacements.
            C_2: factor for degradation.
            C_3: factor for P-Delta.

        Returns:
            The target displacement with its coefficients, m.

        Source: FEMA 356, Eq. 3-15; ASCE/SEI 41-17, Eq. 7-28.
        """
        d_t = C_0 * C_1 * C_2 * C_3 * self.S_a * (self.T_e / (2.0 * math.pi)) ** 2
        return CoefficientTarget(self.idealisation, self.T_e, self.S_a, C_0, C_1, C_2, C_3, self.C_m, self.ratio, d_t)


def demand(curve: CapacityCurve, D_d: float, period: float, mass: float, storeys: int, spectrum: Spectrum) -> Demand:
    """Return the demand on a frame whose curve is idealised up to a displacement.

    Args:
        curve: base shear against displacement of the control node.
        D_d: displacement of the idealisation, m.
        period: elastic fundamental period T_i, s.
        mass: of the frame, kg.
        spectrum: of the hazard level.
    """
    lines = bilinear(curve, D_d)
    T_e = lines.effective_period(period)
    S_a = float(spectrum.acceleration(T_e))
    C_m = effective_mass_factor(storeys, period)
    return Demand(lines, T_e, S_a, C_m, strength_ratio(S_a, lines.V_y, mass, C_m))


def target_displacement(
    curve: CapacityCurve, period: float, C_0: float, mass: float, storeys: int, spectrum: Spectrum, T_S: float
) -> CoefficientTarget:
    """Return the target displacement; the curve is idealised up to the target itself.

    C_2 is 1, which 3.3.3.3.2 permits for nonlinear procedures.

    Args:
        curve: base shear against displacement of the control node.
        period: elastic fundamental period T_i, s.
        C_0: first participation factor, with the shape 1 at the control node.
        mass: of the frame, kg.
        storeys: of the frame.
        spectrum: of the hazard level.
        T_S: its corner period between constant acceleration and velocity, s.

    Source: FEMA 356, 3.3.3.3.2, Eq. 3-15.
    """

    def found(D_d: float) -> CoefficientTarget:
        at = demand(curve, D_d, period, mass, storeys, spectrum)
        C_1 = inelastic_factor(at.ratio, at.T_e, T_S)
        return at.target(C_0, C_1, 1.0, second_order_factor(at.ratio, at.T_e, at.idealisation.alpha))

    return found(fitting(lambda D_d: found(D_d).d_t, curve.end))
