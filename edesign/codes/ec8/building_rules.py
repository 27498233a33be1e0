"""The rules of EN 1998-1:2004 for the elastic design of a steel building."""

from __future__ import annotations

from edesign.codes.building_rules import BuildingRules
from edesign.codes.ec8.analysis.directions import vertical_component_counts
from edesign.codes.ec8.analysis.modal_combination import LEAST_MASS
from edesign.codes.ec8.analysis.regularity import setbacks
from edesign.codes.ec8.steel.behaviour_factor import behaviour_factor, largest_section_class

RULES = BuildingRules(
    code="ec8-2004",
    title="EN 1998-1",
    ductility={"low": "DCL", "medium": "DCM", "high": "DCH"},
    largest_q=behaviour_factor,
    section_class=largest_section_class,
    modal_mass=LEAST_MASS,
    setbacks=setbacks,
    vertical=vertical_component_counts,
)
