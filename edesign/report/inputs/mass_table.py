"""Masses and weights of the floors."""

from __future__ import annotations

import numpy as np

from edesign.frame.frame_model import FrameModel
from edesign.frame.isolation import base_loads
from edesign.frame.loads import floor_loads
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import KN, M, T

SAME = 0.01
"""Share by which weight and mass times g may differ before it is said."""
ROUNDING = 1e-9
"""Share by which sums differ that are made in another order, as those of beams with a node in the middle."""

FLOORS = TableSpec[Row](
    "floor_masses",
    "Masses and weights of the floors{of}",
    (text("floor"), col("level", M, form="g", missing=""), col("mass", T), col("weight", KN)),
)


def mass_tables(frames: VariantFrames) -> list[Table]:
    """Return the masses and weights of the floors, a table for variants that have the same; none without masses.

    Raises:
        InputError: a frame cannot be built.
    """
    alike: dict[tuple[tuple[float, float], ...], list[str]] = {}
    for variant in frames.variants:
        project = frames.project(variant)
        if not isinstance(project, Project):
            return []  # a building has a table of its own
        mass, weight = _floors_of(project, frames.frame(variant))
        if mass.any():
            own = tuple(zip(mass.tolist(), weight.tolist(), strict=True))
            same = next((of for of in alike if np.allclose(of, own, rtol=ROUNDING, atol=0.0)), own)
            alike.setdefault(same, []).append(variant)
    tables = []
    for floors, variants in alike.items():
        of = f", {', '.join(variants)}" if len(alike) > 1 else ""
        project = frames.project(variants[0])
        assert isinstance(project, Project)
        tables.append(_table(floors, project, of))
    return tables


def _floors_of(project: Project, frame: FrameModel) -> tuple[np.ndarray, np.ndarray]:
    """Return mass (kg) and weight (N) of the base and of each floor, (storeys + 1,), from the lowest.

    The masses resist horizontal motion; tuned masses are none of them. The weights are the loads of the gravity
    combination on beams, nodes and the leaning column, and on an isolated base.
    """
    levels = np.asarray(project.frame.levels)
    mass = np.zeros(levels.size)
    for node, value in frame.masses.items():
        if node in project.frame.nodes:
            mass[int(np.abs(levels - project.frame.nodes[node][1]).argmin())] += value
    weight = floor_loads(project)
    if project.isolation is not None:
        weight[0] += sum(base_loads(project.frame, project.isolation, project.loads.gravity).values())
    return mass, weight


def _table(floors: tuple[tuple[float, float], ...], project: Project, of: str) -> Table:
    found = [(i, *floors[i]) for i in reversed(range(len(floors)))]
    rows = [(i or "base", project.frame.levels[i], mass, weight) for i, mass, weight in found if i or mass or weight]
    total = np.sum(floors, axis=0)
    factors = project.loads.gravity
    notes = [f"Mass: that resists horizontal motion. Weight: loads of {factors.G:g} G + {factors.Q:g} Q."]
    share = float(total[1]) / (STANDARD_GRAVITY * float(total[0]))
    if abs(share - 1.0) > SAME:
        notes.append(f"The weight is {100.0 * share:.0f} % of the mass times g.")
    if project.frame.leaning_column is not None:
        notes.append("Both contain what leans on the frame.")
    if project.dampers is not None and project.dampers.attachments:
        notes.append("Tuned masses are not in it.")
    return FLOORS.of([*rows, ("total", None, *total)], notes=notes, of=of)
