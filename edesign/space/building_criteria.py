"""The rules for a whole building, gathered from what its elastic design found."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from edesign.codes.ntc2018.behaviour_factor import limit_of_q, limit_of_q_for_damage
from edesign.codes.ntc2018.drift import limit_state_of_drift
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.project.building.design import RESTRAINED
from edesign.space.analysis.combinations import BuildingCombinations
from edesign.space.analysis.deflections import deflection_criteria
from edesign.space.analysis.design_spectra import DesignSpectra
from edesign.space.analysis.lateral import sway_limits
from edesign.space.analysis.sway import sway_criteria
from edesign.space.checks.column_bases import base_criteria
from edesign.space.checks.links import link_criteria
from edesign.space.checks.restrained_braces import restrained_criteria
from edesign.space.checks.rules import (
    allowed_class,
    behaviour_criteria,
    bracing_criteria,
    connection_criteria,
    joint_criteria,
    modal_criteria,
    storey_criteria,
)
from edesign.space.checks.secondary_beams import secondary_criteria
from edesign.space.checks.web_panels import panel_criteria
from edesign.space.designed import ElasticDesign
from edesign.space.structure.design_block import ECCENTRIC, MOMENT_FRAME, Regular, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis
from edesign.space.structure.restrained import laws_of_groups, restrained_braces


def building_criteria(
    found: ElasticDesign,
    of_regularity: Sequence[RuleCheck],
    spectra: DesignSpectra,
    combinations: BuildingCombinations,
    class_of_use: str,
    q_limit: Mapping[Axis, float],
    dissipative: Mapping[Axis, np.ndarray],
    bases: Mapping[Axis, np.ndarray],
) -> list[RuleCheck]:
    """Return the rules for the whole building.

    Args:
        of_regularity: whether the building is regular.
        combinations: of actions.
        class_of_use: of NTC 2018; empty by other codes.
        q_limit: upper limits of q.
        dissipative: numbers of the dissipative members of either direction.
        bases: numbers of the columns on supports that restrain rotation, by direction.
    """
    building, frame, q, steel = found.building, found.frame, found.q, found.building.materials
    design = design_of(building)
    rules, gamma_M0 = rules_of(design), design.partial_factors.M0
    limited = f"q d_r / h under {limit_state_of_drift(class_of_use)}, q = 1" if class_of_use else "nu d_r / h"
    criteria = [*modal_criteria(found.modes, rules), *of_regularity]
    criteria += sway_criteria(found.sway, design.imperfections == "sway")
    for axis in AXES:
        criteria += behaviour_criteria(building, frame, q, q_limit, axis, dissipative[axis], found.regular)
        criteria += storey_criteria(found.storeys[axis], limited)
        criteria += _strength_under_damage(found, spectra, class_of_use, axis)
        if design.ductility_class == "low":
            continue  # no capacity design (EN 1998-1, 6.1.2(4))
        if system_of(design, axis).type == MOMENT_FRAME:
            highest = allowed_class(design, q[axis], q_limit[axis], found.regular)
            own = [joint for joint in found.joints if joint.axis == axis]
            panels = [panel for panel in found.panels if panel.axis == axis]
            criteria += connection_criteria(design, axis, q[axis])
            criteria += joint_criteria(own, axis)
            criteria += base_criteria(
                frame,
                steel,
                found.effects,
                found.members.amplified,
                bases[axis],
                axis,
                highest,
                gamma_M0,
                rules.base_axial,
            )
            criteria += panel_criteria(panels, len(own), axis, design.members.doubler_plates)
        elif system_of(design, axis).type == RESTRAINED:
            restrained = restrained_braces(frame, laws_of_groups(building))
            criteria += restrained_criteria(frame, restrained, found.overstrength[axis], found.storeys[axis])
        elif system_of(design, axis).type == ECCENTRIC:
            criteria += link_criteria([link for link in found.links if link.axis == axis], design.overstrength)
        else:
            criteria += bracing_criteria(building, frame, found.overstrength[axis])
    names = [member.name for member in frame.members]
    criteria += deflection_criteria(found.deflections, design.serviceability.beams, names)
    criteria += secondary_criteria(building, combinations.fundamental, combinations.characteristic)
    criteria += sway_limits(found.lateral, design.serviceability.sway, combinations.characteristic)
    return criteria


def q_without_dissipation(system: str, regular: Regular) -> float:
    """Return q of NTC 2018, Eq. 7.3.2, if the building did not dissipate energy.

    Args:
        system: type of the structural system of a direction.
        regular: whether the building is.
    """
    return limit_of_q(system, "low", 1.0, regular.elevation)


def _strength_under_damage(
    found: ElasticDesign, spectra: DesignSpectra, class_of_use: str, axis: Axis
) -> list[RuleCheck]:
    """Return whether members that resist SLV resist SLD as well, which classes of use III and IV ask for.

    Source: NTC 2018, Table 7.3.III and 7.3.1, Table 7.3.I; Circolare 7/2019, C7.3.1.
    """
    if spectra.damage is None:
        return []
    response = found.response[axis]
    T_1 = response.T_1
    q_ND = q_without_dissipation(system_of(design_of(found.building), axis).type, found.regular)
    SLV, SLD = (float(of.acceleration(T_1)) for of in (spectra.elastic, spectra.damage))
    text = f"q up to which strength under SLV is strength under SLD, direction {axis}"
    rule = at_most("NTC 2018, C7.3.1", text, limit_of_q_for_damage(q_ND, SLV, SLD), response.spectrum.q)
    detail = f"q_ND = {q_ND:.3g}, T_1 = {T_1:.3g} s"
    if class_of_use in ("III", "IV"):
        return [replace(rule, detail=detail)]
    return [replace(rule, passed=None, detail=f"{detail}; informs")]
