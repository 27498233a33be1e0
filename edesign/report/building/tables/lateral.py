"""Load cases that act sideways, as wind: forces on floors, drifts of storeys, from the archive of a building."""

from __future__ import annotations

from typing import Any

import numpy as np

from edesign.report.building.results import BuildingResults
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, ONE
from edesign.space.structure.frame import AXES

GROUP = "lateral"

CASES = TableSpec[dict[str, Any]](
    "lateral_cases",
    "Load cases that act sideways: forces on floors and drifts of storeys",
    (
        text("case"),
        count("storey"),
        *(col(f"F_{axis}", KN, negligible=0.05) for axis in AXES),
        *(col(f"d_{axis}/h", ONE, f"storey_drift_{axis}", 3, negligible=1e-7) for axis in AXES),
    ),
    notes=(
        "F: on the floor above the storey; d/h: largest drift of its columns over its height, of first order; a case "
        "that acts the other way has the same",
    ),
    formulas=True,
)
DRIFTS = TableSpec[dict[str, Any]](
    "characteristic_drifts",
    "Drifts of storeys, characteristic combinations",
    (
        count("storey"),
        col("d_x/h", ONE, "storey_drift_x", 3, negligible=1e-7),
        text("combination", "name_x"),
        col("d_y/h", ONE, "storey_drift_y", 3, negligible=1e-7),
        text("combination ", "name_y"),
    ),
    formulas=True,
)


def lateral_cases_table(results: BuildingResults) -> Table:
    """Return forces and drifts of each load case that acts sideways, storeys from the roof down; empty without any."""
    if not results.has(GROUP):
        return CASES.of(())
    names = [str(case) for case in results.values(GROUP, "case")]
    force, drift = results.values(GROUP, "force"), results.values(GROUP, "drift") / results.values(GROUP, "height")
    rows = []
    for number, name in enumerate(names):
        if name.startswith("-"):
            continue
        for storey in reversed(range(force.shape[2])):
            row: dict[str, Any] = {"case": name, "storey": storey + 1}
            for k, axis in enumerate(AXES):
                row |= {f"F_{axis}": force[number, k, storey], f"storey_drift_{axis}": drift[number, k, storey]}
            rows.append(row)
    return CASES.of(rows)


def drifts_table(results: BuildingResults) -> Table:
    """Return the largest drifts in characteristic combinations, storeys from the roof down; empty without own cases."""
    if not results.has(GROUP):
        return DRIFTS.of(())
    combined = results.values(GROUP, "combined") / results.values(GROUP, "height")
    numbers = results.values(GROUP, "combination")
    names = results.values("combinations", "name")
    rows = []
    for storey in reversed(range(combined.shape[1])):
        row: dict[str, Any] = {"storey": storey + 1}
        for k, axis in enumerate(AXES):
            name = str(names[int(numbers[k, storey]) - 1])
            row |= {f"storey_drift_{axis}": combined[k, storey], f"name_{axis}": name}
        rows.append(row)
    limits = results.group(GROUP).attributes
    notes = [
        f"limit: {float(str(limits[key])):.3g} {of} (EN 1993-1-1, 7.2.2)"
        for key, of in (("limit_storey", "of the height of a storey"), ("limit_building", "of that of the building"))
        if key in limits
    ]
    top = np.asarray(results.values(GROUP, "top")) / float(str(limits["total_height_m"]))
    notes.append(f"roof over its height: {top[0]:.3g} along x, {top[1]:.3g} along y")
    return DRIFTS.of(rows, notes=notes)


def lateral_summary(results: BuildingResults) -> list[dict[str, object]]:
    """Return force on the floor and drift of each storey under each case that acts sideways, for JSON in SI."""
    if not results.has(GROUP):
        return []
    force, drift = results.values(GROUP, "force"), results.values(GROUP, "drift")
    return [
        {
            "case": str(case),
            "storey": storey + 1,
            **{f"force_{axis}": float(force[number, k, storey]) for k, axis in enumerate(AXES)},
            **{f"storey_drift_{axis}": float(drift[number, k, storey]) for k, axis in enumerate(AXES)},
        }
        for number, case in enumerate(results.values(GROUP, "case"))
        for storey in range(force.shape[2])
    ]
