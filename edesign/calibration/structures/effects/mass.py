"""Masses other than declared: of all floors, or of one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibration.dampers.effect import size
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.effect import ChangedBuilding, StructureForm, Values
from edesign.calibration.structures.sizes import StructureSizes
from edesign.estimation.parameters import Parameter

_KNOWN = 0.2
"""Standard deviation of a mass: twice that of permanent loads with their part of imposed ones (JCSS Probabilistic Model
Code, 2.1 and 2.2)."""


def _heavier(floors: Sequence[int]) -> ChangedBuilding:
    def change(p: Values, building: Building) -> Building:
        factors = np.ones(building.floors)
        factors[list(floors)] += p["m"]
        return replace(building, masses=building.masses * factors)

    return ChangedBuilding(change)


def _share(_: StructureSizes) -> tuple[Parameter, ...]:
    return (size("m", "", _KNOWN, -0.8, 4.0),)


def of(sizes: StructureSizes) -> tuple[StructureForm, ...]:
    """Return the forms for a building.

    Base motion shows stiffness over mass: where the stiffness of all that carries a building is a parameter, the mass
    of all floors adds nothing.
    """
    n = sizes.building.floors

    def form(name: str, title: str, floors: Sequence[int]) -> StructureForm:
        return StructureForm(
            "mass_error",
            name,
            "structure",
            title,
            "all frequencies are wrong by one factor: base motion cannot tell it from the stiffness, only a known "
            "force can; the mass of one floor changes the modes in the share of its movement, and their shapes",
            "Friswell & Mottershead (1995), Finite Element Model Updating in Structural Dynamics",
            _heavier(floors),
            _share,
            lambda _: ((0.1,),),
        )

    total = replace(form("total", "mass of the building", range(n)), shown=lambda s: not s.refit or s.building.isolated)
    return total, *(form(f"floor_{i + 1}", f"mass of floor {i + 1}", (i,)) for i in range(n) if n > 1)
