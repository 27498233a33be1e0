"""Partitions and cladding: stiffness that the declared frame does not have, until they break."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.calibration.form import Values, shape, size
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.effect import ChangedBuilding, Links, StructureForm
from edesign.calibration.structures.response import Link
from edesign.calibration.structures.sizes import StructureSizes, has_storeys


def _stiffer(storeys: Sequence[int]) -> tuple[ChangedBuilding]:
    def change(p: Values, building: Building) -> Building:
        factor = np.ones(building.floors)
        factor[list(storeys)] += p["r"]
        return replace(building, stiffness=building.stiffness * factor)

    return (ChangedBuilding(change),)


def _breaking(p: Values, building: Building) -> list[Link]:
    return [Link.breaking(i, p["r"] * float(building.stiffness[i]), p["d"]) for i in building.storeys]


_UNIFORM = StructureForm(
    "partitions",
    "uniform",
    "structure",
    "added stiffness in all storeys",
    "the measured frequencies are higher than those of the frame; where partitions break they fall after the largest "
    "drift and stay low in later tests",
    "Chopra, Dynamics of Structures, 11.1; FEMA P-58-1, 3.8 (drift fragilities of partitions)",
    _stiffer(()),
    lambda s: (size("r", "", 0.5, 0.0, 10.0),),
    lambda s: ((0.1,),),
    shown=lambda s: has_storeys(s) and not s.refit,
    meanings={"r": "added stiffness, in that of a storey", "d": "drift over which it is lost"},
)
_LOST = replace(
    _UNIFORM,
    form="lost",
    title="added stiffness that is lost with the largest drift",
    mechanisms=(Links(_breaking),),
    parameters=lambda s: (
        size("r", "", 0.5, 0.0, 10.0),
        shape("d", "m", s.storey_drift, 0.02 * s.storey_drift, 20.0 * s.storey_drift),
    ),
    starts=lambda s: tuple((0.2, part * s.storey_drift) for part in (0.15, 0.5, 1.5)),
    shown=has_storeys,
)


def of(sizes: StructureSizes) -> tuple[StructureForm, ...]:
    """Return the forms for a building; where the stiffness of all storeys is a parameter, one of all adds nothing."""
    storeys = sizes.building.storeys

    def single(i: int) -> StructureForm:
        title = f"added stiffness in storey {i + 1}"
        return replace(_UNIFORM, form=f"storey_{i + 1}", title=title, mechanisms=_stiffer((i,)), shown=has_storeys)

    return replace(_UNIFORM, mechanisms=_stiffer(storeys)), _LOST, *(single(i) for i in storeys if len(storeys) > 1)
