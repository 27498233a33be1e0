"""The leaning column in the model: its loads, its masses, its struts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from edesign.project.actions.loads import Combination
from edesign.project.frame.leaning_column import of_floors
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.core import Model

SHORTENING = 1e-5
"""Strain of the struts under all that stands on them: columns of steel under gravity have some fifty times as much. The
forces of second order depend on the loads and drifts alone, whatever it is."""


@dataclass(frozen=True)
class LeaningStruts:
    """The leaning column of a model.

    Attributes:
        base: its node on the ground.
        elements: the strut of each storey from the lowest.
    """

    base: int
    elements: tuple[int, ...]


def leaning_loads(project: Project, factors: Combination) -> tuple[float, ...]:
    """Return the load on the leaning column at each floor from the lowest, N downwards; empty without one.

    Args:
        factors: on the permanent and the variable part.
    """
    column, floors = project.frame.leaning_column, project.frame.n_storeys
    if column is None:
        return ()
    both = zip(of_floors(column.G, floors), of_floors(column.Q, floors), strict=True)
    return tuple(factors.G * G + factors.Q * Q for G, Q in both)


def leaning_masses(project: Project) -> dict[str, float]:
    """Return the mass that leans on the frame, kg, by the leading node of each floor; it resists horizontal motion."""
    column, masses, floors = project.frame.leaning_column, project.masses, project.frame.n_storeys
    if column is None or masses is None:
        return {}
    if column.mass is not None:
        found = of_floors(column.mass, floors)
    elif masses.from_loads is not None:
        found = tuple(load / STANDARD_GRAVITY for load in leaning_loads(project, masses.from_loads))
    else:
        return {}
    leading = (project.frame.leading_node(floor) for floor in range(1, floors + 1))
    return {node: mass for node, mass in zip(leading, found, strict=True) if mass > 0.0}


def add_leaning_column(project: Project, model: Model, nodes: Mapping[str, int], gravity: int) -> LeaningStruts | None:
    """Add the leaning column beside the frame, and its loads to the pattern of the gravity combination.

    Args:
        nodes: of the frame, by name.

    Returns:
        Its struts; None if the frame has none.
    """
    frame = project.frame
    if frame.leaning_column is None:
        return None
    total = sum(leaning_loads(project, Combination(G=1.0, Q=1.0)))
    stiffness = total / SHORTENING
    # hinges at both ends: the bending stiffness does not matter
    section = model.elastic_section(stiffness, stiffness * frame.storey_heights[0] ** 2)
    x = frame.x[-1] + frame.bay_widths[-1]
    base = below = model.node("leaning column at the base", x, 0.0)
    model.fix(base, ux=True, uy=True, rz=True)
    elements = []
    for floor, load in enumerate(leaning_loads(project, project.loads.gravity), start=1):
        above = model.node(f"leaning column at floor {floor}", x, frame.levels[floor])
        model.fix(above, rz=True)
        model.tie(above, nodes[frame.leading_node(floor)], ux=True)
        name = f"leaning column in storey {floor}"
        geometry = project.elements.geometry.columns
        elements.append(model.beam_column(name, below, above, section, geometry=geometry, release=(True, True)))
        if load != 0.0:
            model.nodal_load(gravity, above, 0.0, -load, 0.0)
        below = above
    return LeaningStruts(base, tuple(elements))
