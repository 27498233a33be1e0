"""Uniaxial steel laws of the core."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Elastic:
    """Linear elastic law; E in Pa."""

    E: float


@dataclass(frozen=True)
class Bilinear:
    """Elastic-plastic law with kinematic hardening; E and fy in Pa, b = E_t / E in [0, 1)."""

    E: float
    fy: float
    b: float = 0.0


@dataclass(frozen=True)
class MenegottoPinto:
    """Menegotto & Pinto (1973) with the curvature rule of Filippou et al. (1983); E and fy in Pa.

    R = R0 (1 - cR1 xi / (cR2 + xi)). Small unloadings are remembered: reloading never rises above the curve that was
    left.
    """

    E: float
    fy: float
    b: float
    R0: float = 20.0
    cR1: float = 0.925
    cR2: float = 0.15


@dataclass(frozen=True)
class Fatigue:
    """Low-cycle fatigue of fibres, cycles counted by rainflow and summed by Miner's rule.

    Attributes:
        strain: range of a cycle that breaks a fibre at once.
        exponent: m of Coffin and Manson: range = strain * cycles^m; below 0.

    Source: Uriz & Mahin (2008), PEER report 2008/08, chapter 5: 0.095 and -0.5 for braces of fibres.
    """

    strain: float = 0.095
    exponent: float = -0.5


Steel = Elastic | Bilinear | MenegottoPinto
