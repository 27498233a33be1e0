"""Masses other than declared: of all floors, or of one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import ClassVar

import numpy as np

from edesign.calibrate.structure.building import Building
from edesign.calibrate.structure.effect import Setting, StructuralEffect, Values
from edesign.calibrate.unknown import Unknown


class _MassError(StructuralEffect):
    name: ClassVar[str] = "mass_error"
    signature: ClassVar[str] = (
        "all frequencies are wrong by one factor: base motion cannot tell it from the stiffness, only a known force "
        "can; the mass of one floor changes the modes in the share of its movement, and their shapes"
    )
    source: ClassVar[str] = "Friswell & Mottershead (1995), Finite Element Model Updating in Structural Dynamics"

    def unknowns(self, setting: Setting) -> tuple[Unknown, ...]:
        return (Unknown("factor", "", 0.2, 5.0, 1.0, logarithmic=True),)

    def starts(self, setting: Setting) -> tuple[tuple[float, ...], ...]:
        return ((1.05,), (0.8,), (1.25,))


class Total(_MassError):
    """All masses times a factor; the damping ratio stays."""

    form = "total"
    title = "mass of the building"

    def building(self, p: Values, building: Building) -> Building:
        return replace(building, masses=building.masses * p["factor"])


class Floor(_MassError):
    """The mass of one floor times a factor."""

    def __init__(self, floor: int) -> None:
        self.floor = floor
        self.form = f"floor_{floor + 1}"
        self.title = f"mass of floor {floor + 1}"

    def building(self, p: Values, building: Building) -> Building:
        factors = np.ones(building.floors)
        factors[self.floor] = p["factor"]
        return replace(building, masses=building.masses * factors)


def forms(setting: Setting) -> Sequence[StructuralEffect]:
    """Forms for a building."""
    n = setting.building.floors
    return (Total(), *(Floor(i) for i in range(n) if n > 1))
