"""A base that is declared fixed but moves on the ground: sway and rocking."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from edesign.calibration.form import Values, size
from edesign.calibration.structures.building import Building
from edesign.calibration.structures.effect import ChangedBuilding, StructureForm
from edesign.calibration.structures.sizes import StructureSizes


def _sways(p: Values, building: Building) -> Building:
    return replace(building, sway=building.sway + p["f"])


def _rocks(p: Values, building: Building) -> Building:
    return replace(building, rocking=building.rocking + p["f"])


def _of_storey(s: StructureSizes) -> float:
    return 1.0 / float(s.building.stiffness[0])


def _of_frame(s: StructureSizes) -> float:
    """Return the flexibility, rad/(N m), that rotates as the building sways: of the frame over its height squared."""
    heights = s.building.heights if s.building.heights is not None else np.ones(1)
    return float(np.sum(1.0 / s.building.stiffness) / heights[-1] ** 2)


_SWAY = StructureForm(
    "flexible_base",
    "sway",
    "structure",
    "horizontal flexibility of the ground",
    "the first frequency is lower than declared, higher ones hardly; the lowest floor moves more than the frame lets "
    "it (sway), or all floors in proportion to their height (rocking)",
    "Veletsos & Meek (1974), Earthquake Engng Struct. Dyn. 3, 121-138; Wolf (1985), chapter 3",
    (ChangedBuilding(_sways),),
    # as flexible as the lowest storey is much; none is negative
    lambda s: (size("f", "m/N", 0.5 * _of_storey(s), 0.0, 50.0 * _of_storey(s)),),
    lambda s: ((0.1 * _of_storey(s),),),
    shown=lambda s: not s.building.isolated,
    meanings={"f": "flexibility of the ground"},
)
_ROCKING = replace(
    _SWAY,
    form="rocking",
    title="rotational flexibility of the ground",
    mechanisms=(ChangedBuilding(_rocks),),
    parameters=lambda s: (size("f", "rad/(N*m)", 0.5 * _of_frame(s), 0.0, 50.0 * _of_frame(s)),),
    starts=lambda s: ((0.1 * _of_frame(s),),),
    shown=lambda s: not s.building.isolated and s.building.heights is not None,
)

FORMS = (_SWAY, _ROCKING)
