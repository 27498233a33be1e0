"""Tables of pushovers: events, what target displacements follow from, and the response at them."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Mapping
from math import isfinite
from typing import Any

from edesign.archive.dataset import Group
from edesign.assess.measures import response_measures
from edesign.assess.members import VariantMembers
from edesign.assess.performance import set_performance
from edesign.assess.sets import TARGET, HistorySet, target_sets
from edesign.project.analysis.pushover import METHODS, Method
from edesign.project.analysis_file import AnalysisFile
from edesign.project.study.study import Study
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.items import Analysis, Place, at, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, M_S2, MM, MRAD, ONE, PERCENT, S, T, Unit


def _pushover(target: Analysis) -> str:
    """Name of the pushover of a target."""
    about = target.group.attributes
    return target.name.removesuffix(f".{about.get('method')}.{about.get('level')}")


def _of(method: Method, header: str, unit: Unit, name: str = "") -> Column[Analysis]:
    """A value that a method makes a target displacement of; it may have none."""

    def value(target: Analysis) -> float | str:
        found = float(target.group.variables[f"{method}_{name or header}"].values)
        return found if isfinite(found) else "none"

    return col(header, unit, value, negligible=ROUNDING)


def _of_coefficients(method: Method, *own: str) -> tuple[Column[Analysis], ...]:
    """Columns of a method of coefficients, with those that it has alone."""
    return (
        *_NAMED,
        _of(method, "T_i", S),
        _of(method, "T_e", S),
        _of(method, "V_y", KN),
        _of(method, "D_y", MM),
        _of(method, "alpha", ONE),
        _of(method, "S_a", M_S2),
        _of(method, "C_m", ONE),
        *(_of(method, name, ONE) for name in own),
        _of(method, "d_t", MM),
    )


def _height(event: Place) -> float:
    return float(event.group.attributes["height"])


def _worst_line(target: Analysis) -> int:
    return int(target.group.variables["torsional_amplification"].values.argmax())


def _amplified(name: str) -> Callable[[Analysis], float]:
    """A value on the column line with the largest amplification."""
    return lambda target: float(target.group.variables[name].values[_worst_line(target)])


def _where_drift(target: Analysis) -> str:
    return str(target.group.coords["drift_line"].values[target.group.variables["amplified_line_drift"].values.argmax()])


EVENTS = TableSpec[Place](
    "capacity_events",
    "Events along the capacity curves",
    (
        text("pushover", "analysis"),
        text("event", lambda event: event.word("capacity_event_what")),
        text("where", lambda event: event.word("capacity_event_place")),
        col("displacement", MM, at("capacity_event_displacement")),
        col("of the height", PERCENT, lambda event: event.known("capacity_event_displacement") / _height(event), 3),
        col("base shear", KN, at("capacity_event_base_shear")),
    ),
    keys=3,
)
_NAMED: tuple[Column[Analysis], ...] = (
    text("pushover", _pushover),
    text("level", lambda target: target.group.attributes.get("level")),
)
N2 = TableSpec[Analysis](
    "target_displacements_n2",
    f"Target displacements, {METHODS['n2']}",
    (
        *_NAMED,
        _of("n2", "Gamma", ONE),
        _of("n2", "m*", T, "m"),
        _of("n2", "F_y*", KN, "F_y"),
        _of("n2", "d_y*", MM, "d_y"),
        _of("n2", "T*", S, "T"),
        _of("n2", "S_e", M_S2),
        _of("n2", "q_u", ONE),
        _of("n2", "d_et*", MM, "d_et"),
        _of("n2", "d_t*", MM, "d_t_oscillator"),
        _of("n2", "d_t", MM),
    ),
    keys=2,
    formulas=True,
)
FEMA356 = TableSpec[Analysis](
    "target_displacements_fema356",
    f"Target displacements, {METHODS['fema356']}",
    _of_coefficients("fema356", "R", "C_0", "C_1", "C_2", "C_3"),
    keys=2,
    formulas=True,
)
ASCE41 = TableSpec[Analysis](
    "target_displacements_asce41",
    f"Target displacements, {METHODS['asce41']}",
    _of_coefficients("asce41", "mu_strength", "alpha_e", "mu_max", "C_0", "C_1", "C_2"),
    keys=2,
    formulas=True,
)
TORSION = TableSpec[Analysis](
    "target_torsion",
    f"Torsion at the target displacements, {METHODS['n2']}",
    (
        *_NAMED,
        col("elastic", ONE, _amplified("line_ratio_elastic")),
        col("push", ONE, _amplified("line_ratio_push")),
        col("factor", ONE, _amplified("torsional_amplification")),
        text("column line", lambda target: target.group.coords["amplified_line"].values[_worst_line(target)]),
        col("drift", PERCENT, lambda target: target.group.variables["amplified_line_drift"].values.max()),
        text("at", _where_drift),
    ),
    keys=2,
)
TARGETS: Mapping[Method, TableSpec[Analysis]] = {"n2": N2, "fema356": FEMA356, "asce41": ASCE41}
STATES = TableSpec[dict[str, Any]](
    "target_response",
    "Response at the target displacements",
    (
        text("target"),
        col("roof drift", PERCENT, "roof_drift", negligible=ROUNDING),
        col("storey drift", PERCENT, "interstorey_drift", negligible=ROUNDING),
        col("base shear", KN, "base_shear_N", negligible=ROUNDING),
        col("beam rot.", MRAD, "beam_plastic_rotation_rad", negligible=ROUNDING),
        col("col. rot.", MRAD, "column_plastic_rotation_rad", negligible=ROUNDING),
        text("level by drift"),
        text("level by members"),
    ),
)
STATES_IN_SHORT = TableSpec[dict[str, Any]](
    "target_response_in_short",
    "Response at the target displacements",
    (
        text("target"),
        col("roof drift", PERCENT, "roof_drift", negligible=ROUNDING, bare=True),
        col("storey", PERCENT, "interstorey_drift", negligible=ROUNDING, bare=True),
        col("V", KN, "base_shear_N", negligible=ROUNDING, bare=True),
        text("by drift", "level by drift"),
        text("by members", "level by members"),
    ),
    named_by_title=True,
)
_LEVELS = ("level by drift", "level by members", "by drift", "by members")


def events_table(groups: Mapping[str, Group]) -> Table:
    """Return the events of pushovers, each with the displacement of the control node since gravity."""
    return EVENTS.of(places(groups, "capacity_event", "capacity_event_what"))


def target_tables(project: AnalysisFile | None, groups: Mapping[str, Group], study: Study | None = None) -> list[Table]:
    """Return the values behind the target displacements of each method, and the response at them.

    Args:
        project: of the frame; None: performance levels are left out.
        groups: results of analyses by name.
        study: whose variants may have other values of the project; None: there is none.
    """
    found = [Analysis(name, group) for name, group in groups.items() if group.attributes.get("kind") == TARGET]
    tables = []
    for method, spec in TARGETS.items():
        reached = (one for one in found if f"{method}_d_t" in one.group.variables)
        tables.append(spec.of(one for one in reached if one.group.attributes.get("method") == method))
    tables.append(TORSION.of(one for one in found if "torsional_amplification" in one.group.variables))
    return [table for table in (*tables, states_table(project, groups, study)) if table.rows]


def states_table(
    project: AnalysisFile | None,
    groups: Mapping[str, Group],
    study: Study | None,
    spec: TableSpec[dict[str, Any]] = STATES,
) -> Table:
    """Return the response of the frame at each target displacement, with the performance level that it meets.

    Args:
        project: of the frame; None: performance levels are left out.
        groups: results of analyses by name.
        study: whose variants may have other values of the project; None: there is none.
        spec: the columns, `STATES_IN_SHORT` where there is little room.
    """
    targets = {name: group for name, group in groups.items() if group.attributes.get("kind") == TARGET}
    members = VariantMembers(project, study) if project is not None else None
    of = {name: found for found in target_sets(targets) for name in found.histories}
    rows, notes = [], []
    for name, group in targets.items():
        row: dict[str, Any] = defaultdict(lambda: None, target=name)
        rows.append(row)
        if group.attributes.get("status") != "completed":
            notes.append(f"{name}: {group.attributes.get('reason')}")
            continue
        row |= response_measures(group)
        if members is not None:
            alone = HistorySet(of[name].variant, of[name].level, {name: group}, of[name].method)
            found = set_performance(alone, members(alone.variant), "maximum")
            row |= {"level by drift": found.by_drift or None, "level by members": found.by_members or None}
    return spec.of(rows, without=_LEVELS if project is None else (), notes=notes)
