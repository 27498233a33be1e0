"""Damping of the superstructure: its level, its kind, and friction in the storeys."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.damping import KINDS, DampingKind
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.structure.links import Link, Slider
from edesign.calibrate.unknown import Unknown


class _Damping(StructuralEffect):
    name: ClassVar[str] = "damping"
    source: ClassVar[str] = "Chopra, Dynamics of Structures, 3.8, 11.3-11.4"


class Spread(_Damping):
    """Damping of one kind with a ratio, in the place of the declared one."""

    signature: ClassVar[str] = (
        "the height of resonances is wrong, of all modes alike (level) or of high modes the other way (kind)"
    )

    def __init__(self, kind: DampingKind) -> None:
        self.spread = kind
        self.form = kind
        self.title = f"damping ratio, {kind} damping"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        return (Unknown("ratio", "", 1e-3, 0.5, 0.03, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        building = setting.building
        return () if building.isolated and building.floors == 1 else ((max(building.damping.ratio, 1e-3),),)

    def building(self, p: Values, building: Building) -> Building:
        return replace(building, damping=replace(building.damping, kind=self.spread, ratio=p["ratio"]))


class Friction(_Damping):
    """Coulomb friction in every storey, in proportion to the mass above it; F is that of the lowest."""

    form = "friction"
    title = "friction in the storeys"
    signature: ClassVar[str] = (
        "small motions are damped more, and stiffer, than large ones; free vibration ends at once"
    )

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        shear = _shear(setting)
        return (Unknown("F", "N", 1e-5 * shear, 2.0 * shear, 0.05 * shear, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        building = setting.building
        if building.isolated and building.floors == 1:
            return ()
        return tuple((share * _shear(setting),) for share in (0.005, 0.05))

    def links(self, p: Values, building: Building) -> Sequence[Link]:
        first = 1 if building.isolated else 0
        above = np.cumsum(building.masses[::-1])[::-1]
        # stuck storeys are twice as stiff
        return [
            Slider(i, p["F"] * float(above[i] / above[first]), float(building.stiffness[i]))
            for i in range(first, building.floors)
        ]


def _shear(setting: Setting) -> float:
    first = 1 if setting.building.isolated else 0
    return float(setting.building.stiffness[first] * setting.drift[first])


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building; the declared kind is there too, as its ratio is not always free."""
    return (*(Spread(kind) for kind in KINDS), Friction())
