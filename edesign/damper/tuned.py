"""Sizing of tuned mass and tuned liquid dampers."""

from __future__ import annotations

import math
from dataclasses import dataclass

from edesign.errors import InputError
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import did_you_mean


@dataclass(frozen=True)
class TunedMass:
    """A mass on spring and dashpot (thesis Eqs. 2.26-2.28).

    Attributes:
        mass: kg.
        stiffness: N/m.
        damping: N s/m.
        frequency_ratio: its frequency over that of the structure.
        damping_ratio: of its own critical damping.
    """

    mass: float
    stiffness: float
    damping: float
    frequency_ratio: float
    damping_ratio: float


def _harmonic_force(mu: float) -> tuple[float, float]:
    return 1.0 / (1.0 + mu), math.sqrt(3.0 * mu / (8.0 * (1.0 + mu)))


def _harmonic_base(mu: float) -> tuple[float, float]:
    return math.sqrt(1.0 - mu / 2.0) / (1.0 + mu), math.sqrt(3.0 * mu / (8.0 * (1.0 + mu) * (1.0 - mu / 2.0)))


def _white_force(mu: float) -> tuple[float, float]:
    zeta = math.sqrt(mu * (1.0 + 0.75 * mu) / (4.0 * (1.0 + mu) * (1.0 + mu / 2.0)))
    return math.sqrt(1.0 + mu / 2.0) / (1.0 + mu), zeta


def _white_base(mu: float) -> tuple[float, float]:
    zeta = math.sqrt(mu * (1.0 - 0.25 * mu) / (4.0 * (1.0 + mu) * (1.0 - mu / 2.0)))
    return math.sqrt(1.0 - mu / 2.0) / (1.0 + mu), zeta


OPTIMA = {
    "harmonic_force": _harmonic_force,
    "harmonic_base": _harmonic_base,
    "white_noise_force": _white_force,
    "white_noise_base": _white_base,
}
"""What is made small, always the displacement of the structure: its largest amplitude under a harmonic, its variance
under white noise; of a force on the structure or an acceleration of its base."""


def tuned_mass(mass_ratio: float, mass: float, frequency: float, optimum: str = "white_noise_base") -> TunedMass:
    """Size a tuned mass damper for a structure without damping.

    Args:
        mass_ratio: of the damper to the structure's (modal) mass, 0 to 1.
        mass: of the structure in its mode, kg, for a shape that is 1 where the damper stands.
        frequency: of the structure, Hz.
        optimum: key of OPTIMA.

    Raises:
        InputError: a value out of range, or no such optimum.

    Source: Den Hartog (1956), Mechanical Vibrations, 3.3 (harmonic force; fixed points); Warburton (1982), Optimum
    absorber parameters for various combinations of response and excitation parameters, EESD 10, Table 1 (the others).
    """
    if optimum not in OPTIMA:
        raise InputError(
            f"there is no optimum `{optimum}`{did_you_mean(optimum, OPTIMA)} (there are: {', '.join(OPTIMA)})"
            " [E-NAME-01]"
        )
    _positive(mass_ratio=mass_ratio, mass=mass, frequency=frequency)
    if mass_ratio > 1.0:
        raise InputError(f"mass_ratio = {mass_ratio:g} is out of range: at most 1 is allowed [E-LAW-03]")
    f, zeta = OPTIMA[optimum](mass_ratio)
    m, omega = mass_ratio * mass, 2.0 * math.pi * frequency * f
    return TunedMass(m, m * omega**2, 2.0 * zeta * m * omega, f, zeta)


def sloshing_frequency(length: float, depth: float, mode: int = 1) -> float:
    """Return the circular frequency (rad/s) of sloshing in a rectangular tank, exact for small waves.

    Args:
        length: of the tank along the motion, m.
        depth: of the liquid, m.
        mode: 1, 2 ...; the antisymmetric ones, which a horizontal motion excites.

    Source: linear wave theory, omega^2 = g kappa tanh(kappa h), kappa = (2 mode - 1) pi / L; Lamb (1932), article 228.
    """
    kappa = _wave_number(length, depth, mode)
    return math.sqrt(STANDARD_GRAVITY * kappa * math.tanh(kappa * depth))


def sloshing_mass_ratio(length: float, depth: float, mode: int = 1) -> float:
    """Return the mass of liquid that takes part in a mode of sloshing over all of it.

    The tank is rectangular and the waves are small. The rest of all modes moves with the tank.

    Args:
        length: of the tank along the motion, m.
        depth: of the liquid, m.

    Returns:
        Dimensionless, 0 to 1.

    Source: Graham & Rodriguez (1952), J. Applied Mechanics 19; Housner (1957) has 0.264 for 8 / pi^3 = 0.258 in mode 1.
    """
    n = 2 * mode - 1
    x = _wave_number(length, depth, mode) * depth
    return 8.0 * math.tanh(x) / (n**2 * math.pi**2 * x)


def _wave_number(length: float, depth: float, mode: int) -> float:
    _positive(length=length, depth=depth)
    if mode < 1:
        raise InputError(f"mode = {mode} is out of range: at least 1 is allowed [E-LAW-03]")
    return (2 * mode - 1) * math.pi / length


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{name} = {value:g} is out of range: greater than 0 is allowed [E-LAW-03]")
