"""What the design of a building rests on as tables: steels, loads and masses of floors, overstrength, joints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from edesign.codes.ec8.verification.strong_column import LEAST_RATIO
from edesign.codes.rule_check import ROUNDING
from edesign.report.building.results import MET, NOT_MET, UNITS, BuildingResults, Row, part
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import Column, bounded, col, count, formula, text, verdict
from edesign.report.tables.number import finite, significant
from edesign.report.tables.table import MORE, Table, TableSpec
from edesign.report.tables.unit import GPA, KN, MPA, ONE, M, T, Unit
from edesign.space.archived import SELECTION
from edesign.space.structure.frame import AXES, Axis


def _floor(joint: Row) -> int:
    _, dot, floor = str(joint["node"]).rpartition(".")
    return int(floor) if dot else 0


def _strong_enough(joint: Row) -> Value:
    if joint["exempt"]:
        return "exempt"
    return MET if joint["ratio"] >= LEAST_RATIO * (1.0 - ROUNDING) else NOT_MET


def _least_and_largest(axis: Axis) -> tuple[Column[dict[str, Value]], ...]:
    return (
        col(f"least {axis}", ONE, digits=3),
        text("of", f"member {axis}"),
        col(f"largest {axis}", ONE, digits=3),
    )


STEEL = TableSpec[Row](
    "steel",
    "Steel",
    (
        text("name", "material"),
        col("f_y", MPA, "fy"),
        col("E", GPA),
        col("nu", ONE, digits=2),
        col("density", Unit("kg/m³")),
    ),
    formulas=True,
)
FLOORS = TableSpec[dict[str, Any]](
    "floor_loads",
    "Loads and masses of the floors",
    (
        count("floor"),
        col("level", M, form=".2f"),
        MORE,  # the load of each case
        col("mass", T, negligible=0.5),
        col("x", M, bounded("x")),
        col("y", M, bounded("y")),
        col("radius", M, bounded("gyration")),
    ),
    notes=(
        "loads downwards, G with the self weight; x, y: centre of mass; radius: of gyration about it. The base carries "
        "the lower half of the first storey, which has no mass in the model.",
    ),
)
OVERSTRENGTH = TableSpec[dict[str, Value]](
    "overstrength",
    "Overstrength of the dissipative members: resistance over effect in the seismic design situation",
    (
        count("storey"),
        *_least_and_largest("x"),
        *_least_and_largest("y"),
    ),
    notes=("the least ratio of a direction is its Omega (EN 1998-1, 6.6.3(1)P, 6.7.4(1))",),
    formulas=True,
    named_by_title=True,
)
CHOSEN = TableSpec[Row](
    "sections_chosen",
    "Sections chosen",
    (
        text("group"),
        text("before"),
        text("chosen", "after"),
        col("mass", T),
        formula("its next lighter section would break", "held_by", broken=1),
    ),
    keys=3,
)
JOINTS = TableSpec[Row](
    "building_joints",
    "Joints: the weakest of each floor",
    (
        count("floor", _floor),
        text("direction", "axis"),
        text("node"),
        col("sum M_Rc", UNITS["N*m"], "M_Rc"),
        col("sum M_Rb", UNITS["N*m"], "M_Rb"),
        col("ratio", ONE, digits=3),
        verdict("", _strong_enough),
    ),
    notes=(f"at least {LEAST_RATIO} (EN 1998-1, 4.4.2.3(4)); joints at the roof are exempt",),
    keys=3,
    formulas=True,
    named_as="joints",
)


def materials_table(results: BuildingResults) -> Table:
    """Return the steels."""
    return STEEL.of(results.rows("materials", "material"))


def floors_table(results: BuildingResults) -> Table:
    """Return load and mass of each floor, from the roof down, and of the building."""
    cases = results.values("floors", "case")
    lifted = np.abs(results.values("floors", "load")).sum(axis=1) > 0.5  # wind on facades brings nothing down
    shown = [(k, str(case)) for k, case in enumerate(cases) if lifted[k] and not str(case).startswith("-")]
    more = [col(case, KN, part("load", k), negligible=0.5) for k, case in shown]
    floors: list[dict[str, Any]] = [*reversed(results.rows("floors", "floor"))]
    loads, mass = results.values("floors", "load"), results.values("floors", "mass")
    for floor in floors:
        floor["floor"] = floor["floor"] or "base"
    whole: dict[str, Any] = dict.fromkeys(("level", "x", "y", "gyration"), "")
    whole["floor"] = "all"
    whole["load"] = np.array([Quantity(float(of.sum()), KN, 5, beside=True) for of in loads])
    whole["mass"] = Quantity(float(mass.sum()), T, 5, beside=True)
    return FLOORS.of([*floors, whole], more=more)


def overstrength_table(results: BuildingResults) -> Table:
    """Return the least and the largest overstrength of the dissipative members of each storey, from the roof down."""
    members = {axis: results.rows(f"overstrength_{axis}", "member") for axis in AXES}
    rows = []
    for storey in sorted({int(member["storey"]) for of in members.values() for member in of}, reverse=True):
        row: dict[str, Value] = {"storey": storey}
        for axis, of in members.items():
            here = sorted((member for member in of if member["storey"] == storey), key=lambda member: member["ratio"])
            row[f"least {axis}"] = finite(here[0]["ratio"]) if here else None
            row[f"member {axis}"] = here[0]["member"] if here else None
            row[f"largest {axis}"] = finite(here[-1]["ratio"]) if here else None
        rows.append(row)
    return OVERSTRENGTH.of(rows)


def selection_table(results: BuildingResults) -> Table:
    """Return the section that `edesign design` chose for each group of members, and the check that governs it."""
    if not results.has(SELECTION):
        return CHOSEN.of(())
    before, after = (significant(results.number(name, SELECTION) / 1e3) for name in ("mass_before_kg", "mass_kg"))
    certified = "no single and no double exchange of sections is lighter and meets all checks"
    notes = (
        f"steel: {after} t, with the sections before {before} t",
        certified if results.number("certified", SELECTION) else "the search was cut short",
    )
    return CHOSEN.of(results.rows(SELECTION, "group"), notes=notes)


def joints_table(results: BuildingResults) -> Table:
    """Return the weakest joint of each floor in each direction of a moment frame, from the roof down."""
    weakest: dict[tuple[int, str], Row] = {}
    joints = results.rows("joints", "joint") if results.has("joints") else []
    for joint in sorted(joints, key=lambda joint: math.inf if joint["exempt"] else joint["ratio"]):
        weakest.setdefault((-_floor(joint), joint["axis"]), joint)
    return JOINTS.of(weakest[place] for place in sorted(weakest))
