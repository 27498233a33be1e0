"""A base that is declared fixed but moves on the ground: sway and rocking."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.unknown import Unknown


class _FlexibleBase(StructuralEffect):
    name: ClassVar[str] = "flexible_base"
    signature: ClassVar[str] = (
        "the first frequency is lower than declared, higher ones hardly; the lowest floor moves more than the frame "
        "lets it (sway), or all floors in proportion to their height (rocking)"
    )
    source: ClassVar[str] = "Veletsos & Meek (1974), Earthquake Engng Struct. Dyn. 3, 121-138; Wolf (1985), chapter 3"


class Sway(_FlexibleBase):
    """A horizontal spring k under the building."""

    form = "sway"
    title = "horizontal flexibility of the ground"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k = float(setting.building.stiffness[0])
        return (Unknown("k", "N/m", 0.02 * k, 1e3 * k, k, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return () if setting.building.isolated else ((10.0 * float(setting.building.stiffness[0]),),)

    def building(self, p: Values, building: Building) -> Building:
        return replace(building, sway=building.sway + 1.0 / p["k"])


class Rocking(_FlexibleBase):
    """A rotational spring k under the building."""

    form = "rocking"
    title = "rotational flexibility of the ground"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        k = _rotational(setting.building)
        return (Unknown("k", "N*m/rad", 0.02 * k, 1e3 * k, k, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        building = setting.building
        return () if building.isolated or building.heights is None else ((10.0 * _rotational(building),),)

    def building(self, p: Values, building: Building) -> Building:
        return replace(building, rocking=building.rocking + 1.0 / p["k"])


def _rotational(building: Building) -> float:
    """Stiffness (N m) that rotates as the building sways: of the whole frame times the square of its height."""
    heights = building.heights if building.heights is not None else np.ones(building.floors)
    return float(heights[-1] ** 2 / np.sum(1.0 / building.stiffness))


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    return (Sway(), Rocking())
