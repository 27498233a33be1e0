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


Steel = Elastic | Bilinear | MenegottoPinto
