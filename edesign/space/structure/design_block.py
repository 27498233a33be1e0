"""The block `design` of a building file, with what it leaves to the country."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from edesign.codes.building_rules import BuildingRules
from edesign.codes.ec8.building_rules import RULES as EC8_RULES
from edesign.codes.ntc2018.building_rules import RULES as NTC_RULES
from edesign.codes.ntc2018.capacity import material_overstrength
from edesign.errors import InputError
from edesign.ground_motion.hazard import national_of
from edesign.project.actions.hazard import EC8Hazard, NtcHazard
from edesign.project.building.building import Building
from edesign.project.building.design import Design, System
from edesign.project.frame.member_design import FrameDesign
from edesign.project.project import Project
from edesign.project.reading.base import Model
from edesign.space.structure.frame import Axis

M = TypeVar("M", bound=Model)
MOMENT_FRAME, ECCENTRIC = "moment_frame", "eccentric"
_RULES = {rules.code: rules for rules in (EC8_RULES, NTC_RULES)}


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

    These are the partial factors, gamma_ov, and nu of the importance class of its level, II where it is of none. By NTC
    2018 gamma_ov follows from the steels of the file, and there is no nu.

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
    actions = national.action_factors
    factors = {**national.gamma_M, "G": actions.G_sup, "Q": actions.Q}
    gamma_ov, nu = national.gamma_ov, 1.0
    if isinstance(hazard, NtcHazard):
        gamma_ov = material_overstrength(steel.fy for steel in building.materials.values())
    else:
        level = hazard.levels.get(building.design_level)
        nu = national.nu((level.importance_class if level is not None else None) or "II")
    return design.model_copy(
        update={
            "partial_factors": _completed(design.partial_factors, factors),
            "overstrength": _completed(design, {"overstrength": gamma_ov}).overstrength,
            "drift": _completed(design.drift, {"nu": nu}),
        }
    )


def rules_of(design: Design) -> BuildingRules:
    """Return the rules of the seismic code of a design."""
    return rules_by_name(design.code.seismic)


def rules_by_name(code: str) -> BuildingRules:
    """Return the rules of a seismic code by its name in a building file."""
    return _RULES[code]


def left_out(design: Design) -> frozenset[str]:
    """Return the clauses of EN 1998-1 by which the rules are known that sections need not meet."""
    asked, rules = set(design.select.leave_out), rules_of(design)
    known = {clause for clause, own in rules.clauses.items() if own in asked}
    return frozenset(asked | known | {f"{rules.title}, {own}" for own in asked})


def frame_design_of(project: Project) -> FrameDesign | None:
    """Return the block `design` of a plane frame with the partial factors of the country; None without the block."""
    design = project.design
    if design is None or not isinstance(project.hazard, EC8Hazard):
        return design
    factors = _completed(design.partial_factors, national_of(project.hazard).gamma_M)
    return design.model_copy(update={"partial_factors": factors})


def _completed(block: M, values: Mapping[str, float]) -> M:
    """A block with values in the place of defaults."""
    fields = type(block).model_fields.keys() - block.model_fields_set
    return block.model_copy(update={name: value for name, value in values.items() if name in fields})


def system_of(design: Design, axis: Axis) -> System:
    """Return the structural system of one direction."""
    return design.systems.x if axis == "x" else design.systems.y
