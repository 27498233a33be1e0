"""Tables of pushovers: events, what target displacements follow from, and the response at them."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.assess.measures import response_measures
from edesign.assess.members import VariantMembers
from edesign.assess.performance import SetPerformance, set_performance
from edesign.assess.sets import TARGET, HistorySet, target_sets
from edesign.project.analysis.pushover import METHODS, Method
from edesign.project.project import Project
from edesign.project.study.study import Study
from edesign.report.assessment.measure_columns import FRAME_COLUMNS, ROUNDING, Measures
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.spec import TableSpec
from edesign.report.tables.table import AnyTable, Table, number

_OF_COEFFICIENTS = (
    ("T_i [s]", "T_i", 1.0),
    ("T_e [s]", "T_e", 1.0),
    ("V_y [kN]", "V_y", 1e3),
    ("D_y [mm]", "D_y", 1e-3),
    ("alpha", "alpha", 1.0),
    ("S_a [m/s2]", "S_a", 1.0),
    ("C_m", "C_m", 1.0),
)
COLUMNS: Mapping[Method, tuple[tuple[str, str, float], ...]] = {
    "n2": (
        ("Gamma", "Gamma", 1.0),
        ("m* [t]", "m", 1e3),
        ("F_y* [kN]", "F_y", 1e3),
        ("d_y* [mm]", "d_y", 1e-3),
        ("T* [s]", "T", 1.0),
        ("S_e [m/s2]", "S_e", 1.0),
        ("q_u", "q_u", 1.0),
        ("d_et* [mm]", "d_et", 1e-3),
        ("d_t* [mm]", "d_t_oscillator", 1e-3),
        ("d_t [mm]", "d_t", 1e-3),
    ),
    "fema356": (
        *_OF_COEFFICIENTS,
        ("R", "R", 1.0),
        *((name, name, 1.0) for name in ("C_0", "C_1", "C_2", "C_3")),
        ("d_t [mm]", "d_t", 1e-3),
    ),
    "asce41": (
        *_OF_COEFFICIENTS,
        ("mu_strength", "mu_strength", 1.0),
        ("alpha_e", "alpha_e", 1.0),
        ("mu_max", "mu_max", 1.0),
        *((name, name, 1.0) for name in ("C_0", "C_1", "C_2")),
        ("d_t [mm]", "d_t", 1e-3),
    ),
}
"""Of each method: header with its unit, name in the archive, unit in SI."""

STATE = ("roof_drift", "interstorey_drift", "base_shear_N", "beam_plastic_rotation_rad", "column_plastic_rotation_rad")


def events_table(groups: Mapping[str, Group]) -> Table:
    """Return the events of pushovers, each with the displacement of the control node since gravity."""
    columns = ("pushover", "event", "where", "displacement [mm]", "of the height [%]", "base shear [kN]")
    table = Table("Events along the capacity curves", columns, left=3, name="capacity_events")
    for name, group in groups.items():
        if "capacity_event_what" not in group.variables:
            continue
        height = float(group.attributes["height"])
        keys = ("what", "place", "displacement", "base_shear")
        found = [group.variables[f"capacity_event_{key}"].values.tolist() for key in keys]
        for what, place, displacement, shear in zip(*found, strict=True):
            cells = [number(displacement, scale=1e-3), number(displacement / height, 3, 0.01), number(shear, scale=1e3)]
            table.rows.append([name, str(what), str(place), *cells])
    return table


def target_tables(project: Project | None, groups: Mapping[str, Group], study: Study | None = None) -> list[AnyTable]:
    """Return the values behind the target displacements of each method, and the response at them.

    Args:
        project: of the frame; None: performance levels are left out.
        groups: results of analyses by name.
        study: whose variants may have other values of the project; None: there is none.
    """
    targets = {name: group for name, group in groups.items() if group.attributes.get("kind") == TARGET}
    tables: list[AnyTable] = []
    for method, columns in COLUMNS.items():
        headers = ("pushover", "level", *(header for header, _, _ in columns))
        table = Table(f"Target displacements, {METHODS[method]}", headers, name=f"target_displacements_{method}")
        table.left, table.formulas = 2, ()
        for name, group in targets.items():
            if group.attributes.get("method") != method or f"{method}_d_t" not in group.variables:
                continue
            values = [float(group.variables[f"{method}_{key}"].values) for _, key, _ in columns]
            cells = [_shown(value, unit) for value, (_, _, unit) in zip(values, columns, strict=True)]
            table.rows.append([_pushover(name, group), str(group.attributes.get("level")), *cells])
        tables.append(table)
    without = () if project is not None else ("level by drift", "level by members")
    states = target_states(project, groups, study)
    tables.append(TARGET_RESPONSE.of(states, without=without, notes=failed_notes(groups)))
    return [table for table in tables if table.rows]


class State(NamedTuple):
    """The frame at a target displacement: response measures, and the performance levels that it meets."""

    target: str
    measures: Mapping[str, float | None]
    performance: SetPerformance | None


def _measure(column: Column[Measures]) -> Column[State]:
    name = str(column.value)
    return col(column.header, column.unit, lambda state: state.measures.get(name), negligible=ROUNDING)


def level_column(header: str, by: str) -> Column[State]:
    """Return a column of the performance level that each state meets, by `by_drift` or `by_members`."""
    return text(header, lambda state: getattr(state.performance, by, None))


TARGET_RESPONSE = TableSpec[State](
    "target_response",
    "Response at the target displacements",
    (
        text("target"),
        *(_measure(column) for column in FRAME_COLUMNS if column.value in STATE),
        level_column("level by drift", "by_drift"),
        level_column("level by members", "by_members"),
    ),
)


def failed_notes(groups: Mapping[str, Group]) -> list[str]:
    """Return why states at target displacements were not reached."""
    return [
        f"{name}: {group.attributes.get('reason')}"
        for name, group in groups.items()
        if group.attributes.get("kind") == TARGET and group.attributes.get("status") != "completed"
    ]


def target_states(project: Project | None, groups: Mapping[str, Group], study: Study | None = None) -> list[State]:
    """Return the response at target displacements; arguments as of `target_tables`."""
    targets = {name: group for name, group in groups.items() if group.attributes.get("kind") == TARGET}
    members = VariantMembers(project, study) if project is not None else None
    of = {name: found for found in target_sets(targets) for name in found.histories}
    states = []
    for name, group in targets.items():
        if group.attributes.get("status") != "completed":
            states.append(State(name, {}, None))
            continue
        performance = None
        if members is not None:
            alone = HistorySet(of[name].variant, of[name].level, {name: group}, of[name].method)
            performance = set_performance(alone, members(alone.variant), "maximum")
        states.append(State(name, response_measures(group), performance))
    return states


def _pushover(name: str, group: Group) -> str:
    """Name of the pushover of a target."""
    return name.removesuffix(f".{group.attributes.get('method')}.{group.attributes.get('level')}")


def _shown(value: float, unit: float) -> str:
    return number(value, scale=unit, negligible=ROUNDING) if isfinite(value) else "none"
