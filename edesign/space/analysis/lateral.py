"""Load cases with horizontal forces, such as wind: their effects, and the displacements of storeys.

What acts downwards is carried without braces, as gravity is (EN 1998-1, 6.7.2(1)P); what acts sideways with them. Of
braces that count in tension only the one in tension acts. Displacements are of first order.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck, at_most, first_of_largest
from edesign.core.space import SpaceModel
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.response import StaticResponse, static_cases
from edesign.space.structure.frame import AXES, SpaceFrame

if TYPE_CHECKING:
    from edesign.project.building.design import HorizontalLimits
    from edesign.space.checks.foundations import Supports

SWAY_LIMITED = "EN 1993-1-1, 7.2.2"
"""Clause of the criteria on horizontal displacements."""
_SIDEWAYS = [0, 1, 5]
"""Forces along x and y and the moment about z, of those on a node."""


@dataclass(frozen=True)
class LateralCases:
    """The load cases that act sideways, and what they do to the storeys; storeys are from below.

    Attributes:
        cases: (c,) names.
        force: (c, 2, n_storeys) whole force at the floor of each storey along x and y, N.
        drift: (c, 2, n_storeys) largest drift of the storey's columns along x and y, m.
        height: (n_storeys,) m.
        combined: (2, n_storeys) largest drift in characteristic combinations along x and y, m.
        combination: (2, n_storeys) which of the characteristic combinations gives it, from 0.
        top: (2,) largest displacement of the roof in characteristic combinations along x and y, m.
        top_combination: (2,) which of them gives it, from 0.
        total_height: of the roof above the level that the building stands on, m.
    """

    cases: tuple[str, ...]
    force: np.ndarray
    drift: np.ndarray
    height: np.ndarray
    combined: np.ndarray
    combination: np.ndarray
    top: np.ndarray
    top_combination: np.ndarray
    total_height: float


def static_effects(
    gravity_model: SpaceModel, model: SpaceModel, frame: SpaceFrame, bracing: Bracing, supports: Supports
) -> StaticResponse:
    """Return the effects of all load cases: of vertical loads without braces, of horizontal ones with them.

    Args:
        gravity_model: in which braces carry nothing.
        model: that resists horizontal forces.
    """
    cases = tuple(frame.cases.values())
    sideways = [number for number, case in enumerate(cases) if case.sideways]
    if not sideways:
        return _collected(static_cases(gravity_model, cases), frame, bracing)
    upright = [replace(case, nodal=_only(case.nodal, False)) for case in cases]
    found = _collected(static_cases(gravity_model, tuple(upright)), frame, bracing)
    none = np.zeros(0)
    lateral = static_cases(
        model,
        tuple(
            replace(
                cases[number],
                nodal=_only(cases[number].nodal, True),
                uniform=np.zeros_like(cases[number].uniform),
                point_member=none.astype(int),
                point_position=none,
                point_force=none.reshape(0, 3),
            )
            for number in sideways
        ),
    )
    internal, beyond = bracing.under_static(lateral.internal)
    reactions = lateral.reactions
    reactions[:, supports.nodes] += (beyond @ supports.to_reactions.T).reshape(len(sideways), -1, 6)
    found.displacements[sideways] += lateral.displacements
    found.internal[sideways] += internal
    found.reactions[sideways] += reactions
    return found


def _collected(found: StaticResponse, frame: SpaceFrame, bracing: Bracing) -> StaticResponse:
    """Return the effects with what braces beside links bring to their beams, as they carry vertical loads as well."""
    if any(frame.members[number].eccentric for number in bracing.braces):
        found.internal[...] = bracing.under_static(found.internal)[0]
    return found


def _only(nodal: np.ndarray, sideways: bool) -> np.ndarray:
    """The loads on nodes that act sideways, or the others."""
    found = np.zeros_like(nodal) if sideways else nodal.copy()
    found[:, _SIDEWAYS] = nodal[:, _SIDEWAYS] if sideways else 0.0
    return found


def lateral_cases(frame: SpaceFrame, static: StaticResponse, combinations: Sequence[Combination]) -> LateralCases:
    """Return the load cases that act sideways, with drifts of storeys under them and in characteristic combinations.

    Args:
        static: effects of the load cases.
    """
    start, end = (nodes[frame.columns] for nodes in frame.ends)
    moved = static.displacements[:, end, :2] - static.displacements[:, start, :2]
    storey, floors = frame.storey[frame.columns], frame.level_of_nodes
    factors = np.array([[row.static.get(case, 0.0) for case in static.names] for row in combinations])
    sideways = [number for number, name in enumerate(static.names) if frame.cases[name].sideways]

    def drifts(of: np.ndarray) -> np.ndarray:
        found = np.zeros((len(of), 2, frame.n_floors))
        for number in range(frame.n_floors):
            found[:, :, number] = np.abs(of[:, storey == number]).max(axis=1, initial=0.0)
        return found

    each = drifts(np.tensordot(factors, moved, 1))
    roof = static.displacements[:, floors == frame.n_floors, :2]
    tops = np.abs(np.tensordot(factors, roof, 1)).max(axis=1)
    force = np.zeros((len(sideways), 2, frame.n_floors))
    for row, number in enumerate(sideways):
        nodal = frame.cases[static.names[number]].nodal
        for axis in range(2):
            force[row, axis] = np.bincount(floors, nodal[:, axis], minlength=frame.n_floors + 1)[1:]
    return LateralCases(
        cases=tuple(static.names[number] for number in sideways),
        force=force,
        drift=drifts(moved[sideways]),
        height=np.diff(frame.levels),
        combined=each.max(axis=0),
        combination=each.argmax(axis=0),
        top=tops.max(axis=0),
        top_combination=tops.argmax(axis=0),
        total_height=float(frame.heights[-1]),
    )


def sway_limits(of: LateralCases, limits: HorizontalLimits, combinations: Sequence[Combination]) -> list[RuleCheck]:
    """Return whether storeys and the roof move sideways no more than the file allows; nothing where it sets no limit.

    Args:
        of: drifts of the storeys.
        limits: shares of the height of a storey, and of the building.
        combinations: characteristic ones.

    Source: EN 1993-1-1:2005, 7.2.2(1)B: limits are those of the project, by EN 1990, A1.4.3, Figure A1.2.
    """
    found = []
    for number, axis in enumerate(AXES):
        if limits.storey is not None:
            share = of.combined[number] / of.height
            worst = first_of_largest(share)
            detail = f"storey {worst + 1}: {combinations[of.combination[number, worst]].name}"
            text = f"drift over storey height, characteristic, direction {axis}"
            found.append(at_most(SWAY_LIMITED, text, limits.storey, float(share[worst]), detail))
        if limits.building is not None:
            text = f"displacement of the roof over its height, characteristic, direction {axis}"
            detail = combinations[of.top_combination[number]].name
            found.append(at_most(SWAY_LIMITED, text, limits.building, float(of.top[number]) / of.total_height, detail))
    return found
