"""The block `design` of a building file, with what it leaves to the country."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from edesign.errors import InputError
from edesign.ground_motion.hazard import national_of
from edesign.project.building.building import Building
from edesign.project.building.design import Design, System
from edesign.project.reading.base import Model
from edesign.space.structure.frame import Axis

M = TypeVar("M", bound=Model)
MOMENT_FRAME = "moment_frame"


@dataclass(frozen=True)
class Regular:
    """Regularity of a building, as the file says, or as it is found where the file leaves it open.

    Attributes:
        plan, elevation: EN 1998-1:2004, 4.2.3.2 and 4.2.3.3.
    """

    plan: bool
    elevation: bool


def design_of(building: Building) -> Design:
    """Return the block `design` of a building; what it leaves to the country has that value.

    These are the partial factors, gamma_ov, and nu of the importance class of its level, II where it is of none.

    Raises:
        InputError: the file has none.
    """
    design, hazard = building.design, building.design_hazard
    if design is None:
        raise InputError(
            f"{building.where('design')}: design: this block is missing; docs/reference/building_file.md explains it"
            " [E-KEY-02]"
        )
    if hazard is None:
        return design
    national = national_of(hazard)
    level = hazard.levels.get(design.level or next(iter(hazard.levels), ""))
    actions, of_class = national.action_factors, (level.importance_class if level is not None else None) or "II"
    factors = {**national.gamma_M, "G": actions.G_sup, "Q": actions.Q}
    return design.model_copy(
        update={
            "partial_factors": _completed(design.partial_factors, factors),
            "overstrength": _completed(design, {"overstrength": national.gamma_ov}).overstrength,
            "drift": _completed(design.drift, {"nu": national.nu(of_class)}),
        }
    )


def _completed(block: M, values: Mapping[str, float]) -> M:
    """A block with values in the place of defaults."""
    fields = type(block).model_fields.keys() - block.model_fields_set
    return block.model_copy(update={name: value for name, value in values.items() if name in fields})


def system_of(design: Design, axis: Axis) -> System:
    """Return the structural system of one direction."""
    return design.systems.x if axis == "x" else design.systems.y
