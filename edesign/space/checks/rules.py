"""Rules of EN 1998-1 for the whole building: modes, ductility, storeys, overstrength, joints, bracing."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache

import numpy as np

from edesign.codes.building_rules import BuildingRules
from edesign.codes.ec3.buckling import critical_force
from edesign.codes.ec3.buckling import slenderness as flexural_slenderness
from edesign.codes.ec8.analysis.modal_combination import check_modes
from edesign.codes.ec8.analysis.regularity import IRREGULAR_Q
from edesign.codes.ec8.steel.behaviour_factor import alpha_ratio
from edesign.codes.ec8.steel.concentric_braces import FEW_STOREYS, asymmetry, homogeneity, slenderness
from edesign.codes.ec8.steel.moment_frames import rotation_capacity
from edesign.codes.ec8.verification.capacity import OVERSTRENGTH
from edesign.codes.ec8.verification.second_order import AMPLIFIED
from edesign.codes.ec8.verification.strong_column import LEAST_RATIO
from edesign.codes.rule_check import RuleCheck, at_least, at_most
from edesign.core.space_modes import SpaceModes
from edesign.frame.sections.section_class import SectionClass, section_class
from edesign.frame.sections.steel_section import SteelSection
from edesign.project.building.building import Building, Steel
from edesign.project.building.design import RESTRAINED, Design, System
from edesign.space.analysis.storeys import Storeys
from edesign.space.checks.capacity import Joint, Overstrength, by_section
from edesign.space.structure.design_block import ECCENTRIC, MOMENT_FRAME, Regular, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis, Member, SpaceFrame

_PATTERNS = {"cross": "x", "chevron": "v", "v": "v"}  # words of EN 1998-1, 6.7.3, for those of the file


def largest_q(building: Building, system: System, axis: Axis, low_ductility_q: float, regular: Regular) -> float:
    """Return the upper limit of q in one direction.

    Args:
        building: with its block `design`.
        system: of this direction; q of buckling-restrained braces is what the file gives.
        low_ductility_q: of the country.
        regular: whether the building is.

    Source: EN 1998-1:2004, 6.3.2, Table 6.2; NTC 2018, 7.3.1, Table 7.3.II.
    """
    design = design_of(building)
    if system.type == RESTRAINED:
        return float(system.q)  # no code has one; the file gives it with its source
    default = alpha_ratio(system.type, building.n_storeys, building.n_bays(axis), regular.plan)
    return rules_of(design).largest_q(
        system.type,
        design.ductility_class,
        system.alpha_u_over_alpha_1 or default,
        regular.elevation,
        low_ductility_q,
    )


def modal_criteria(modes: SpaceModes, rules: BuildingRules) -> list[RuleCheck]:
    """Return whether the modes taken have enough mass in both directions."""
    asked = rules.modal_mass, rules.every_large_mode
    return [
        check_modes(modes.effective_mass_ratio[:, number], modes.period.size, axis, *asked)
        for number, axis in enumerate(AXES)
    ]


def behaviour_criteria(
    building: Building,
    frame: SpaceFrame,
    q: Mapping[Axis, float],
    limit: Mapping[Axis, float],
    axis: Axis,
    dissipative: np.ndarray,
    regular: Regular,
) -> list[RuleCheck]:
    """Return whether q, and the class of the dissipative sections in one direction, are allowed.

    Args:
        building: with the design block of the file.
        q: behaviour factor of each direction.
        limit: upper limit of q in each direction.
        dissipative: numbers of the dissipative members.
        regular: whether the building is.

    Returns:
        The criterion of q, and those of the sections.

    Source: EN 1998-1:2004, 6.3.2(1), 6.5.3(2).
    """
    design = design_of(building)
    system = system_of(design, axis)
    if system.type == RESTRAINED:
        text = f"behaviour factor q of buckling-restrained braces, direction {axis}, which the code does not have"
        regularly = "" if regular.elevation else "; the building is irregular in elevation: 0.8 of it (4.2.3.1(7))"
        return [RuleCheck("6.3.2(1)", text, None, q[axis], "", None, f"as given, of {system.q_source}{regularly}")]
    found = [at_most("6.3.2(1)", f"behaviour factor q, direction {axis}", limit[axis], q[axis])]
    bent = system.type in (MOMENT_FRAME, ECCENTRIC)
    pairs, of_members = frame.sections
    worst, where = 0, ""
    for name, material in sorted(pairs[k] for k in np.unique(of_members[dissipative])):
        of = dissipative_class(frame.section(name), building.materials[material].fy, bent)
        if of.number > worst:
            worst, where = of.number, name
    if worst:
        text = f"class of dissipative sections, direction {axis}"
        found.append(at_most("6.5.3(2)", text, allowed_class(design, q[axis], limit[axis], regular), worst, where))
    return found


def allowed_class(design: Design, q: float, limit: float, regular: Regular) -> int:
    """Return the highest class that dissipative sections may have (EN 1998-1, 6.5.3(2), Table 6.3).

    Args:
        q: behaviour factor of a direction.
        limit: its upper limit.
        regular: whether the building is.

    Returns:
        The class, 1 to 4.
    """
    reference = limit if regular.elevation else limit / IRREGULAR_Q
    return rules_of(design).section_class(design.ductility_class, min(q, reference))


@cache
def dissipative_class(section: SteelSection, fy: float, bent: bool) -> SectionClass:
    """Return the class of a dissipative section.

    Args:
        section: its properties.
        fy: yield strength, Pa.
        bent: it bends without axial force (beams, links); otherwise it is compressed (diagonals).
    """
    return section_class(section, fy, 0.0 if bent else -1.0, about_y=bent)


def storey_criteria(storeys: Storeys, drift: str = "nu d_r / h") -> Iterator[RuleCheck]:
    """Yield whether second-order effects and drifts of one direction are within limits; the worst storey counts.

    Args:
        drift: what the code calls the drift that is limited.
    """
    worst = int(storeys.theta.argmax())
    yield at_most(
        "4.4.2.2(3)",
        f"theta, direction {storeys.axis}; up to 0.2 by amplification, above 0.3 never",
        AMPLIFIED,
        float(storeys.theta[worst]),
        f"storey {worst + 1}",
    )
    if storeys.limit is not None:
        worst = int(storeys.reduced.argmax())
        yield at_most(
            "4.4.3.2(1)",
            f"{drift}, direction {storeys.axis}",
            storeys.limit,
            float(storeys.reduced[worst]),
            f"storey {worst + 1}",
        )


def joint_criteria(joints: Sequence[Joint], axis: Axis) -> list[RuleCheck]:
    """Return whether columns are stronger than beams at the joints of one direction; the worst joint counts."""
    asked = [joint for joint in joints if not joint.exempt]
    if not asked:
        return []
    worst = min(asked, key=lambda joint: joint.ratio)
    text = f"sum M_Rc / sum M_Rb, direction {axis}"
    return [at_least("4.4.2.3(4)", text, LEAST_RATIO, worst.ratio, worst.node)]


def connection_criteria(design: Design, axis: Axis, q: float) -> list[RuleCheck]:
    """Return the rotation that beam to column connections of a moment frame must reach, for information.

    Args:
        axis: direction.
        q: its behaviour factor.

    Returns:
        One criterion, or none where the class of ductility asks for no rotation.

    Source: EN 1998-1:2004, 6.6.4(3); NTC 2018, 7.5.4.3 and 7.5.4.5: 1.1 gamma_ov.
    """
    if rules_of(design).clauses:
        text = f"least M_Rd / M_pl,Rd of connections of beams, and of columns to foundations, direction {axis}"
        return [RuleCheck("6.6.4(3)", text, None, OVERSTRENGTH * design.overstrength, "", None, "to be shown for each")]
    rotation = rotation_capacity(design.ductility_class, q)
    text = f"rotation capacity of beam to column connections, direction {axis}, rad"
    return [RuleCheck("6.6.4(3)", text, None, rotation, "rad", None, "to be shown by tests")] if rotation else []


def brace_slenderness(building: Building, frame: SpaceFrame, members: np.ndarray) -> np.ndarray:
    """Return the non-dimensional slenderness of diagonals, (n,), the larger one of both axes.

    Args:
        building: with buckling lengths and steels.
        members: (n,) numbers of the diagonals.

    Returns:
        lambda, (n,), dimensionless.
    """
    lengths = design_of(building).members.buckling_length
    factors = [lengths.of(of.kind, of.group, of.storey) for of in (frame.members[number] for number in members)]
    of_one_metre = by_section(frame, building.materials, slenderness_of_one_metre)
    return of_one_metre[members] * frame.length[members] * np.array([max(factor.y, factor.z) for factor in factors])


def slenderness_of_one_metre(section: SteelSection, steel: Steel) -> float:
    """Return the non-dimensional slenderness of a bar of one metre, about the axis with the smaller inertia."""
    N_cr = critical_force(steel.E, min(section.I_y, section.I_z), 1.0)
    return flexural_slenderness(section.A, steel.fy, N_cr)


def pattern_of(member: Member) -> str:
    """Return what EN 1998-1, 6.7.3 calls the bracing of a diagonal: `x`, `diagonal` or `v`."""
    return _PATTERNS.get(member.bracing, "diagonal")


def bracing_criteria(building: Building, frame: SpaceFrame, overstrength: Overstrength) -> list[RuleCheck]:
    """Return the rules for diagonals of one direction: slenderness, homogeneous overstrength, symmetry.

    Args:
        building: with the design block of the file.
        overstrength: of this direction.

    Returns:
        The criteria; none where the direction has no diagonals.
    """
    axis, number = overstrength.axis, AXES.index(overstrength.axis)
    if not overstrength.members.size:
        return []
    members = [frame.members[n] for n in overstrength.members]
    slender = brace_slenderness(building, frame, overstrength.members)
    of_braces = [
        slenderness(float(value), pattern_of(member), frame.n_floors, member.name)
        for value, member in zip(slender, members, strict=True)
    ]
    found = [max(of_braces, key=lambda rule: (rule.passed is False, rule.value or 0.0))]
    rules = rules_of(design_of(building))
    if frame.n_floors > FEW_STOREYS or rules.clauses:
        found.append(homogeneity(overstrength.ratios, f", direction {axis}", [of.name for of in members]))
    numbers = overstrength.members
    start, end = (nodes[numbers] for nodes in frame.ends)
    rise = frame.coordinates[end, number] - frame.coordinates[start, number]
    area = by_section(frame, building.materials, lambda of, steel: of.A)[numbers]
    level = area * np.abs(rise) / frame.length[numbers]
    in_storeys = [np.bincount(frame.storey[numbers], np.where(way, level, 0.0)) for way in (rise > 0.0, rise <= 0.0)]
    each = [
        asymmetry(float(one), float(other), storey)
        for storey, (one, other) in enumerate(zip(*in_storeys, strict=True), 1)
        if one + other > 0.0
    ]
    found.append(max(each, key=lambda rule: rule.value or 0.0))
    return [*found, *_hollow_walls(frame, overstrength.members, rules.hollow_braces, axis)]


def _hollow_walls(
    frame: SpaceFrame, members: np.ndarray, limits: tuple[float, float] | None, axis: Axis
) -> list[RuleCheck]:
    """Return whether the walls of hollow diagonals are thick enough; none where the code has no limits."""
    if limits is None:
        return []
    found = []
    for name in dict.fromkeys(frame.members[number].section for number in members):
        if (wall := wall_ratio(frame.section(name), limits)) is not None:
            text = f"{wall[0]} of diagonals, direction {axis}"
            found.append(at_most("NTC 2018, 7.5.5", text, wall[2], wall[1], name))
    return [max(found, key=lambda rule: rule.utilisation)] if found else []


def wall_ratio(section: SteelSection, limits: tuple[float, float]) -> tuple[str, float, float] | None:
    """Return what a code limits of a hollow section: its name, the ratio, and the limit; None of other sections.

    The width of a flat wall is that of its class, without the corners of radius 1.5 t (EN 1993-1-1, Table 5.2).

    Args:
        limits: of width and of diameter over thickness.
    """
    if section.kind == "CHS":
        return "d / t", section.h / section.tw, limits[1]
    if section.kind not in ("I", "other"):
        return "width over thickness", max(section.h / section.tw, section.b / section.tf) - 3.0, limits[0]
    return None
