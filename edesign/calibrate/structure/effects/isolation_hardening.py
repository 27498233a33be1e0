"""An isolation layer that stiffens at large drifts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.links import Link, PowerSpring, ThresholdSpring
from edesign.calibrate.unknown import Unknown


class _Hardening(StructuralEffect):
    name: ClassVar[str] = "isolation_hardening"
    signature: ClassVar[str] = "peaks of acceleration at the largest drifts are too low, and come too late"
    source: ClassVar[str] = "Kelly (1997), Earthquake-Resistant Design with Rubber, 5.4; Yamamoto et al. (2009)"


class Power(_Hardening):
    """k u (|u| / r)^(p - 1), r the largest drift."""

    form = "power"
    amendment: ClassVar[str] = "hardening.power"
    title = "stiffness of the isolation layer that grows as a power of the drift"

    def __init__(self, reference: float) -> None:
        self.reference = reference

    @property
    def fixed(self) -> Values:
        """The largest drift."""
        return {"r": self.reference}

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k = float(setting.building.stiffness[0])
        return (Unknown("k", "N/m", 0.0, 3.0 * k, 0.3 * k), Unknown("p", "", 1.5, 9.0, 3.0, logarithmic=True))

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        k = float(setting.building.stiffness[0])
        return tuple((0.05 * k, p) for p in (3.0, 6.0)) if setting.building.isolated else ()

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (PowerSpring(0, p["k"], p["p"], self.reference),)


class Threshold(_Hardening):
    """k (|u| - u0) sgn u beyond u0."""

    form = "threshold"
    amendment: ClassVar[str] = "hardening.threshold"
    title = "a stop in the isolation layer"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k, drift = float(setting.building.stiffness[0]), float(setting.drift[0])
        return (
            Unknown("k", "N/m", 0.0, 100.0 * k, k),
            Unknown("u0", "m", 0.1 * drift, 1.5 * drift, 0.7 * drift, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        k, drift = float(setting.building.stiffness[0]), float(setting.drift[0])
        return ((0.1 * k, 0.5 * drift),) if setting.building.isolated else ()

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (ThresholdSpring(0, p["k"], p["u0"]),)


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    return (Power(float(setting.drift[0])), Threshold())
