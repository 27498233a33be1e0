"""Viscous dampers as dashpots with a power of the velocity, and the linear dashpot of the same energy a cycle."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.core import LawValues
from edesign.damper.laws import law as law_of
from edesign.errors import InputError
from edesign.project.dampers.designs import VISCOUS_LAWS

_POWER_LAWS = ("viscous_power", "asymmetric_viscous", "maxwell_power")
LEAST_EXPONENT, LARGEST_EXPONENT = 0.15, 1.0
"""Of fluid dampers for buildings. Below, the force hardly depends on the velocity, as of a friction damper."""


@dataclass(frozen=True)
class Dashpot:
    """F = c |v|^alpha sgn v, with a spring in series.

    Attributes:
        c: damping coefficient, N (s/m)^alpha.
        alpha: exponent of the velocity.
        spring: stiffness in series that belongs to the device, N/m; infinite: it has none.
    """

    c: float
    alpha: float
    spring: float = math.inf


def dashpot(law: LawValues) -> Dashpot:
    """Return the dashpot and spring that a viscous law is.

    Raises:
        InputError: the law is no viscous dashpot, has effects beside, or its exponent is out of range.

    Source: thesis Eqs. 2.24 and 2.25.
    """
    if law.law not in VISCOUS_LAWS:
        raise InputError(f"the law {law.law} is no viscous dashpot; {', '.join(VISCOUS_LAWS)} are [E-DESIGN-03]")
    if law.effects:
        raise InputError(
            f"this law {law.law} has `effects`; the sizing of viscous dampers counts a dashpot alone [E-DESIGN-03]"
        )
    if law.law == "viscous":
        found = Dashpot(law.values[0], 1.0)
    elif law.law == "maxwell":
        c, relaxation = law.values
        found = Dashpot(c, 1.0, c / relaxation)
    else:
        found = Dashpot(*law.values)
    if not LEAST_EXPONENT <= found.alpha <= LARGEST_EXPONENT:
        raise InputError(
            f"alpha = {found.alpha:g} of the law {law.law} is out of range: viscous dampers are sized for "
            f"{LEAST_EXPONENT:g} to {LARGEST_EXPONENT:g} [E-LAW-03]"
        )
    return found


def locks_when_small(law: LawValues) -> bool:
    """Say whether the force of a dashpot over its amplitude grows without bound in ever smaller vibrations: alpha < 1.

    Its stiffness in series with a spring then is that of the spring in small vibrations and nothing in large ones.

    Args:
        law: law and parameters of the dashpot.
    """
    if law.law not in _POWER_LAWS:
        return False
    exponent = [parameter.name for parameter in law_of(law.law).parameters].index("alpha")
    return law.values[exponent] < 1.0


def energy_factor(alpha: float) -> float:
    """Return lambda: energy of a power-law dashpot in a harmonic cycle over the largest force times the amplitude.

    pi for alpha = 1, towards 4 for alpha = 0.

    Args:
        alpha: exponent of the velocity.

    Source: lambda = 4 2^alpha Gamma(1 + alpha/2)^2 / Gamma(2 + alpha), Constantinou and Symans (1993), Structural
        Design of Tall Buildings 2; FEMA 356, Table 9-4, has rounded values.
    """
    return 4.0 * 2.0**alpha * math.gamma(1.0 + 0.5 * alpha) ** 2 / math.gamma(2.0 + alpha)


def linear_dashpot(c: float | np.ndarray, alpha: float, amplitude: float | np.ndarray, omega: float) -> np.ndarray:
    """Return the linear dashpot, N s/m, that dissipates as much as a power-law dashpot in a harmonic cycle.

    Args:
        c: damping coefficient, N (s/m)^alpha.
        alpha: exponent of the velocity.
        amplitude: of the dashpot's deformation, m.
        omega: rad/s.

    Returns:
        N s/m, in the shape of the arguments.

    Source: lambda c (omega u)^alpha u = pi c_eq omega u^2; Constantinou and Symans (1993).
    """
    return np.asarray(energy_factor(alpha) / math.pi * c * (omega * amplitude) ** (alpha - 1.0))


def added_damping(
    c: np.ndarray, alpha: float, deformation: np.ndarray, roof: float, period: float, modal_mass: float
) -> float:
    """Return the damping ratio that power-law dashpots add to a mode, with rigid braces.

    Args:
        c: damping coefficient of each device, (d,) N (s/m)^alpha.
        alpha: exponent of the velocity.
        deformation: of each device along itself in the mode whose roof displacement is 1, (d,): f_j phi_rj, which
            contains its slope.
        roof: amplitude of the roof displacement, m.
        period: s.
        modal_mass: sum of m phi^2 of the mode whose roof displacement is 1, kg.

    Source: FEMA 356, Eq. 9-32; the work of the devices over 4 pi times the strain energy, ASCE/SEI 7-16, 18.7.3.2.2.
    """
    work = float(energy_factor(alpha) * np.sum(c * np.abs(deformation) ** (1.0 + alpha)))
    return period ** (2.0 - alpha) * work / ((2.0 * math.pi) ** (3.0 - alpha) * roof ** (1.0 - alpha) * modal_mass)
