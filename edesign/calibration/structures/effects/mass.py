"""Masses other than declared: of all floors, or of one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibration.form import Values, size
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.effect import ChangedBuilding, StructureForm
from edesign.calibration.structures.sizes import StructureSizes
from edesign.estimation.parameters import Parameter

_KNOWN = 0.2
"""Standard deviation of a mass: a quarter of the range that follows."""
_LIGHTEST, _HEAVIEST = -0.3, 0.5
"""Beyond these a mass is declared wrongly, and no measured motion makes it likely. A floor of 5 kN/m2 is declared with
a part of 0.3 of an imposed load of 3 kN/m2 (EN 1990, table A1.1; EN 1991-1-1, table 6.2: offices). It may have all of
that or none, and a weight of its own that is three standard deviations of 5 % off: of density 4 %, of a thickness of
180 mm 3 % (JCSS Probabilistic Model Code, 2.1.4 and 2.1.5). So it is 0.72 to 1.48 times what is declared.
"""


def _heavier(floors: Sequence[int]) -> tuple[ChangedBuilding]:
    def change(p: Values, building: Building) -> Building:
        factors = np.ones(building.floors)
        factors[list(floors)] += p["m"]
        return replace(building, masses=building.masses * factors)

    return (ChangedBuilding(change),)


def _share(_: StructureSizes) -> tuple[Parameter, ...]:
    return (size("m", "", _KNOWN, _LIGHTEST, _HEAVIEST),)


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
            "all frequencies are wrong by one factor: base motion cannot separate it from the stiffness, only a known "
            "force can; the mass of one floor changes the modes in the share of its movement, and their shapes",
            "Friswell & Mottershead (1995), Finite Element Model Updating in Structural Dynamics",
            _heavier(floors),
            _share,
            lambda _: ((0.1,),),
            meanings={"m": "share by which the mass is more than declared; negative: less"},
        )

    total = replace(form("total", "mass of the building", range(n)), shown=lambda s: not s.refit or s.building.isolated)
    return total, *(form(f"floor_{i + 1}", f"mass of floor {i + 1}", (i,)) for i in range(n) if n > 1)
