"""An isolation layer that softens with amplitude: hysteresis, friction, or stiffness that is taken away."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.links import BreakingSpring, FadingSpring, Hysteresis, Link, Slider
from edesign.calibrate.unknown import Unknown


class _Softening(StructuralEffect):
    name: ClassVar[str] = "isolation_softening"
    signature: ClassVar[str] = (
        "the isolated period is longer in larger motions; the phase of the residual drifts with the amplitude"
    )


class BoucWen(_Softening):
    """A Bouc-Wen force of strength F and yield drift Y beside the declared law, without stiffness after yielding."""

    form = "bouc_wen"
    title = "smooth hysteresis in the isolation layer"
    source: ClassVar[str] = "Wen (1976), J. Engng Mech. 102, 249-263; Nagarajaiah, Reinhorn & Constantinou (1991)"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        force, drift = setting.shear, float(setting.drift[0])
        return (
            Unknown("F", "N", 1e-4 * force, 3.0 * force, 0.1 * force, logarithmic=True),
            Unknown("Y", "m", 1e-3 * drift, 3.0 * drift, 0.05 * drift, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        if not setting.building.isolated:
            return ()
        return tuple((0.05 * setting.shear, share * float(setting.drift[0])) for share in (0.03, 0.15))

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (Hysteresis(0, p["F"], p["Y"]),)


class Friction(_Softening):
    """Coulomb friction F behind a spring that slips at the drift Y, beside the declared law."""

    form = "friction"
    title = "friction in the isolation layer"
    source: ClassVar[str] = "Constantinou, Mokha & Reinhorn (1990), J. Struct. Engng 116, 455-474"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        force, drift = setting.shear, float(setting.drift[0])
        return (
            Unknown("F", "N", 1e-4 * force, 3.0 * force, 0.1 * force, logarithmic=True),
            Unknown("Y", "m", 1e-3 * drift, drift, 0.01 * drift, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((0.05 * setting.shear, 0.01 * float(setting.drift[0])),) if setting.building.isolated else ()

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (Slider(0, p["F"], p["F"] / p["Y"]),)


class Envelope(_Softening):
    """Stiffness taken away: -k g(a) u, g = (a/a0)^m / (1 + (a/a0)^m), a the fading envelope of the drift."""

    form = "envelope"
    amendment: ClassVar[str] = "payne.elastic"
    title = "stiffness of the isolation layer that falls with amplitude"
    source: ClassVar[str] = "Kraus (1984), J. Appl. Polym. Sci. Symp. 39, 75-92"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k, drift, period = float(setting.building.stiffness[0]), float(setting.drift[0]), setting.period
        return (
            Unknown("k", "N/m", -2.0 * k, 3.0 * k, k),
            Unknown("a0", "m", 0.01 * drift, 10.0 * drift, 0.3 * drift, logarithmic=True),
            Unknown("m", "", 0.3, 4.0, 1.0, logarithmic=True),
            Unknown("tau_a", "s", 0.1 * period, 1e4 * period, 3.0 * period, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        if not setting.building.isolated:
            return ()
        k, drift = float(setting.building.stiffness[0]), float(setting.drift[0])
        return tuple((0.1 * k, share * drift, 1.0, 3.0 * setting.period) for share in (0.1, 0.4, 1.2))

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (FadingSpring(0, p["k"], p["a0"], p["m"], p["tau_a"]),)


class Scragging(_Softening):
    """A spring k exp(-(M/d)^2) u beside the declared law, with M the largest drift ever, also in earlier tests."""

    form = "scragging"
    title = "stiffness of the isolation layer that is lost with the largest drift"
    source: ClassVar[str] = "Mullins (1969), Rubber Chem. Technol. 42, 339-362; EN 15129, 8.2 (scragging)"
    remembers: ClassVar[bool] = True

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k, drift = float(setting.building.stiffness[0]), float(setting.drift[0])
        return (
            Unknown("k", "N/m", 1e-3 * k, 10.0 * k, 0.3 * k, logarithmic=True),
            Unknown("d", "m", 0.02 * drift, 20.0 * drift, drift, logarithmic=True),
        )

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        k, drift = float(setting.building.stiffness[0]), float(setting.drift[0])
        return tuple((0.2 * k, share * drift) for share in (0.3, 1.0)) if setting.building.isolated else ()

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        return (BreakingSpring(0, p["k"], p["d"]),)


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    return (BoucWen(), Friction(), Envelope(), Scragging())
