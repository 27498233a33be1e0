"""Regularity of a building as its file claims it, and as it is found, EN 1998-1:2004, 4.2.3.

Centre of stiffness and torsional radius of each floor come from three static cases: forces along x, along y, and
moments about a vertical axis that follow the same forces, by masses and heights of the floors (4.3.3.2.3, Eq. 4.11).
For one storey they are exact; of several storeys they are those of this distribution (4.2.3.2(8)).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes.building_rules import BuildingRules
from edesign.codes.ec8.analysis.lateral_force import lateral_forces
from edesign.codes.ec8.analysis.regularity import (
    ChangeLimits,
    eccentricity_and_radius,
    gradual_mass,
    gradual_stiffness,
    recess,
    slenderness,
    torsional_radius,
)
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.core.space import SpaceModel
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.project.building.places import parts_of
from edesign.space.structure.design_block import MOMENT_FRAME, Regular, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, NO_DIAPHRAGM, SpaceFrame
from edesign.space.structure.plan_outline import recess_areas

ROUNDING = 1e-9
"""Eccentricities below this share of the plan are rounding of the solution."""


@dataclass(frozen=True)
class FloorStiffness:
    """Floors under lateral forces, values (2, n_floors) for forces along x and along y, without held ones.

    Attributes:
        e_0: distance of the centre of stiffness from the centre of mass at right angles to the forces, m.
        r: torsional radius, m.
        l_s: (n_floors,) radius of gyration of the mass, m.
        storey: stiffness of the storeys, shear over drift of the centres of mass, N/m.
    """

    e_0: np.ndarray
    r: np.ndarray
    l_s: np.ndarray
    storey: np.ndarray


@dataclass(frozen=True)
class Shape:
    """The rules for the shape of a building, in plan and in elevation; sections do not change them."""

    plan: tuple[RuleCheck, ...]
    elevation: tuple[RuleCheck, ...]


def shape(building: Building, frame: SpaceFrame) -> Shape:
    """Return the rules for the shape of a building."""
    rules = rules_of(design_of(building))
    return Shape(tuple(_shape_of_plan(building, frame)), tuple(_shape_of_elevation(frame, rules)))


def regularity(
    building: Building, frame: SpaceFrame, model: SpaceModel, of_shape: Shape
) -> tuple[Regular, list[RuleCheck]]:
    """Return whether a building counts as regular, and the rules that say so.

    It is what its file says, or else what is found. A rule that does not hold fails where the file claims that it
    does; otherwise it informs. Where a centre of stiffness cannot be found, as not every floor is one diaphragm, the
    building is not found to be regular in plan.

    Args:
        building: with its block `design`.
        frame: with its sections.
        model: for the seismic action.
        of_shape: by `shape`.

    Returns:
        The regularity; the criteria.
    """
    design = design_of(building)
    of, limits = _floor_stiffness(frame, model), rules_of(design).changes
    plan, elevation = [*of_shape.plan, *_counted(frame, _torsion(of))], list(of_shape.elevation)
    gradual = _counted(frame, _gradual(frame, of, limits, design))
    if limits is not None:  # the code has figures, and the storeys count
        elevation, gradual = [*elevation, *gradual], []
    asked = design.regular_in_plan, design.regular_in_elevation
    holds = all(rule.passed for rule in plan), all(rule.passed is not False for rule in elevation)
    regular = Regular(*(found if claim == "auto" else claim for claim, found in zip(asked, holds, strict=True)))
    claimed = [*_as_claimed(plan, asked[0] is True), *_as_claimed(elevation, asked[1] is True)]
    return regular, [*claimed, *gradual]


def _counted(frame: SpaceFrame, rules: Iterable[RuleCheck]) -> list[RuleCheck]:
    """Return rules that number the floors and storeys above those that the ground holds, and say so."""
    above = f", counted above floor {frame.held}" if frame.held else ""
    return [replace(rule, detail=rule.detail and rule.detail + above) for rule in rules]


def _as_claimed(rules: Iterable[RuleCheck], claimed: bool) -> list[RuleCheck]:
    """Return rules as they are where the file claims that they hold; otherwise none of them fails."""
    if claimed:
        return list(rules)
    return [
        rule
        if rule.passed is not False
        else replace(rule, passed=None, detail=f"{rule.detail}; counts as irregular".lstrip("; "))
        for rule in rules
    ]


def _gradual(
    frame: SpaceFrame, of: FloorStiffness | None, limits: ChangeLimits | None, design: Design
) -> list[RuleCheck]:
    """Return the changes of mass and stiffness from storey to storey, for information where the code has no figures.

    Braced steel frames that take half of the base shear are regular in stiffness by NTC 2018, 7.2.1 e: their changes
    inform.
    """
    mass = _floor_masses(frame)
    found = [gradual_mass(mass, limits)] if (mass > 0.0).all() else []
    if of is not None:
        for number, axis in enumerate(AXES):
            braced = system_of(design, axis).type != MOMENT_FRAME
            rules = gradual_stiffness(of.storey[number], None if braced else limits)
            found += [replace(rule, text=f"{rule.text}, direction {axis}") for rule in rules]
    return found


def _shape_of_plan(building: Building, frame: SpaceFrame) -> list[RuleCheck]:
    lowest = (frame.level_of_nodes >= frame.held) & (frame.level_of_nodes <= frame.held + 1)
    extent = [np.ptp(frame.coordinates[lowest, axis]) for axis in (0, 1)]
    lines = [np.concatenate([[0.0], np.cumsum(building.widths(axis))]).tolist() for axis in AXES]
    each = []
    for floor in range(frame.held + 1, frame.n_floors + 1):
        for part in parts_of(building.layout.floors[floor]):
            areas, whole = recess_areas(part, *lines)
            each.append(replace(recess(max(areas, default=0.0), whole), detail=f"floor {floor}"))
    return [slenderness(*extent), max(each, key=lambda rule: rule.value or 0.0)]


def _shape_of_elevation(frame: SpaceFrame, code: BuildingRules) -> list[RuleCheck]:
    found = []
    for number, axis in enumerate(AXES):
        floors = range(frame.held + 1, frame.n_floors + 1)
        places = [frame.coordinates[frame.level_of_nodes == floor, number] for floor in floors]
        rules = code.setbacks([of.min() for of in places], [of.max() for of in places], frame.heights[frame.held + 1 :])
        found += [replace(rule, text=f"{rule.text}, direction {axis}") for rule in rules]
    return [*_counted(frame, found), *_interrupted(frame)]


def _torsion(of: FloorStiffness | None) -> list[RuleCheck]:
    """Return the rules for eccentricity and torsional radius, or that they cannot be found."""
    if of is None:
        text = "centre of stiffness and torsional radius: not every floor is one diaphragm with mass"
        return [RuleCheck("4.2.3.2(4)", text, None, None, "", None)]
    each = [eccentricity_and_radius(of.e_0[n], of.r[n], of.l_s, axis) for n, axis in enumerate(AXES)]
    return [rule for pair in each for rule in pair]


def _floor_masses(frame: SpaceFrame) -> np.ndarray:
    """Return the masses of the floors above the base, or above those that the ground holds, (n_floors - held,) kg."""
    return np.bincount(frame.level_of_nodes, frame.node_mass, minlength=frame.n_floors + 1)[frame.held + 1 :]


def _floor_stiffness(frame: SpaceFrame, model: SpaceModel) -> FloorStiffness | None:
    """Return the floors under lateral forces; None unless each is one diaphragm and has mass."""
    rigid = frame.node_diaphragm[frame.level_of_nodes > frame.held] != NO_DIAPHRAGM
    whole = rigid.all() and sum(at.floor > frame.held for at in frame.diaphragms) == frame.n_floors - frame.held
    return floor_stiffness(frame, model) if whole and (_floor_masses(frame) > 0.0).all() else None


def floor_stiffness(frame: SpaceFrame, model: SpaceModel) -> FloorStiffness:
    """Return centres of stiffness, torsional radii and stiffness of the storeys of a building with rigid floors.

    With u_x and theta_x under forces along x through the centres of mass, and theta_M and u_M under moments of these
    forces times 1 m, the floor does not turn under forces at e = theta_x / theta_M; it then moves by u_x - e u_M.

    Args:
        frame: with masses on all floors.
        model: for the seismic action.
    """
    level, n = np.maximum(frame.level_of_nodes - frame.held, 0), frame.n_floors - frame.held
    mass = _floor_masses(frame)
    share = np.where(level > 0, frame.node_mass / np.concatenate([[1.0], mass])[level], 0.0)
    force = lateral_forces(1.0, mass, frame.heights[frame.held + 1 :])
    nodal = np.zeros((3, len(level), 6))
    nodal[0, :, 0] = nodal[1, :, 1] = nodal[2, :, 5] = share * np.concatenate([[0.0], force])[level]
    moved = model.static(nodal).displacements
    centre = np.array(
        [[np.bincount(level, share * case[:, part], minlength=n + 1)[1:] for part in (0, 1, 5)] for case in moved]
    )  # case, component, floor
    at = np.array([np.bincount(level, share * frame.coordinates[:, axis], minlength=n + 1) for axis in (0, 1)])
    distance = ((frame.coordinates[:, :2].T - at[:, level]) ** 2).sum(axis=0)
    theta_M = centre[2, 2]
    e = np.array([centre[0, 2], -centre[1, 2]]) / theta_M
    e = np.where(np.abs(e) > ROUNDING * np.ptp(frame.coordinates[:, :2]), e, 0.0)
    without_turning = np.array([centre[0, 0] - e[0] * centre[2, 0], centre[1, 1] + e[1] * centre[2, 1]])
    shear = np.cumsum(force[::-1])[::-1]
    drift = np.diff(np.array([centre[0, 0], centre[1, 1]]), axis=1, prepend=0.0)
    return FloorStiffness(
        e_0=np.abs(e),
        r=torsional_radius(1.0 / theta_M, 1.0 / without_turning),
        l_s=np.sqrt(np.bincount(level, share * distance, minlength=n + 1)[1:]),
        storey=shear / drift,
    )


def _interrupted(frame: SpaceFrame) -> list[RuleCheck]:
    """Return whether bracings and columns go down to the foundation without interruption (4.2.3.3(2))."""
    storeys: dict[str, set[int]] = {}
    for member in frame.members:
        if member.kind == "brace":
            storeys.setdefault(member.frame[0], set()).add(member.storey)
    heads = {member.end for member in frame.members if member.kind == "column"}
    hanging = [
        member.name
        for member in frame.members
        if member.kind == "column" and member.storey > 1 and member.start not in heads
    ]
    gaps = {name: set(range(frame.held + 1, max(of))) - of for name, of in sorted(storeys.items())}
    broken = [f"frame {name} has none in storey {min(gap)}" for name, gap in gaps.items() if gap]
    broken += [f"{name} stands on no column" for name in hanging]
    text = "bracings and columns that do not run down to the foundation"
    return [at_most("4.2.3.3(2)", text, 0.0, len(broken), "; ".join(broken))]
