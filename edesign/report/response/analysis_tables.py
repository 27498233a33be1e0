"""The tables of analyses of any kind: labels and ends, periods, measures, storeys, computing effort, fallbacks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.profile import storey_profile
from edesign.report.assessment.measure_columns import BRACE_COLUMNS, FRAME_COLUMNS, ROUNDING
from edesign.report.response.damper_results import amplitude_notes
from edesign.report.tables.cell import Marked, State, Verdict
from edesign.report.tables.column import Column, col, count, text, verdict
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import HZ, KN, M_S2, ONE, PERCENT, M, S, Unit

KINDS = {"target": "target displacement"}
"""Kinds of analyses as people read them, where the word of the archive is another."""
STATES: Mapping[str, State] = {
    "completed": "good",
    "failed": "bad",
    "collapsed": "bad",
    "not run": "open",
    "interrupted": "open",
}
"""Of ends of analyses."""
ABSCISSAE = {
    "gravity": ("load factor", ONE),
    "pushover": ("roof u", M),
    "target": ("roof u", M),
    "history": ("time", S),
}
"""What steps of kinds of analyses are taken in."""
NOT_COMPLETED = "* not completed: as far as the analysis came, and not to be relied on"

Entry = Mapping[str, Any]
"""An analysis as `archive_view.entry` returns it, or a part of that."""


class Mode(NamedTuple):
    """A mode: its number, its period in s, its share of the mass, and that of all modes up to it; None: not known.

    Both are along x of a building, whose modes have shares along y and about the vertical besides.
    """

    number: int
    period: float
    mass: float | None
    total: float | None
    along_y: float | None = None
    about_z: float | None = None


class _Storey(NamedTuple):
    """A storey by its number from 1, and the profile of the frame."""

    number: int
    profile: Mapping[str, np.ndarray]


def marked_name(entry: Entry) -> Marked:
    """Return the name of an analysis, with a mark if it was not completed."""
    return Marked(entry["name"], "" if entry["status"] == "completed" else " *")


def _ended(entry: Entry) -> Verdict:
    return Verdict(entry["status"], STATES.get(entry["status"], ""))


def _label(name: str) -> Column[Entry]:
    return text(name, lambda entry: entry[name] or None)


def _peak(header: str, unit: Unit, quantity: str) -> Column[_Storey]:
    def of(storey: _Storey) -> float | None:
        found = storey.profile.get(quantity)
        return None if found is None else found[storey.number - 1]

    return col(header, unit, of, negligible=ROUNDING, optional=True)


ANALYSES = TableSpec[Entry](
    "analyses",
    "Analyses",
    (
        text("{first}", "name"),
        text("kind", lambda entry: KINDS.get(entry["kind"], entry["kind"] or None)),
        _label("variant"),
        _label("record"),
        _label("level"),
        verdict("status", _ended),
    ),
    keys=6,
)
MEASURES = TableSpec[Entry](
    "response_measures",
    "Response measures (largest absolute values)",
    (text("analysis"), *FRAME_COLUMNS, *BRACE_COLUMNS),
    signs=(NOT_COMPLETED,),
)
STATISTICS = TableSpec[Entry](
    "statistics",
    "Statistics",
    (
        text("analysis"),
        count("steps"),
        count("iterations"),
        count("refactorisations"),
        count("fallbacks"),
        col("CPU", S, "cpu_s", form=".3f"),
        col("energy error", ONE, "energy_error", 2),
    ),
)
PERIODS = TableSpec[Mode](
    "periods",
    "{whose}: periods",
    (
        count("mode", "number"),
        col("T", S, "period", form=".4f"),
        col("f", HZ, lambda mode: 1 / mode.period, form=".4f"),
        col("effective mass", PERCENT, "mass", form=".2f"),
        col("sum", PERCENT, "total", form=".2f"),
        col("along y", PERCENT, "along_y", form=".2f", optional=True),
        col("about z", PERCENT, "about_z", form=".2f", optional=True),
    ),
    keys=0,
    each="Periods",
)
STOREYS = TableSpec[_Storey](
    "storey_response",
    "{whose}: storeys (largest absolute values)",
    (
        count("storey", "number"),
        _peak("floor u", M, "floor_displacement"),
        _peak("drift", PERCENT, "storey_drift"),
        _peak("residual drift", PERCENT, "residual_storey_drift"),
        _peak("shear", KN, "storey_shear"),
        _peak("floor a", M_S2, "floor_acceleration"),
    ),
    keys=0,
    each="Storeys (largest absolute values)",
)
FALLBACKS = TableSpec[Mapping[str, Any]](
    "fallbacks",
    "{whose}: fallbacks",
    (count("step"), col("{abscissa}", "abscissa", "time"), text("fallback", "rung"), text("detail")),
    keys=0,
    each="Fallbacks",
    most=20,
    cut="and {more} more, in the archive",
)


def analyses_table(entries: Sequence[Entry], first: str = "analysis") -> Table:
    """Return name, kind, labels and status of each analysis; reasons of failures stand below.

    Args:
        first: header of their names.
    """
    return ANALYSES.of(
        entries, first=first, notes=[f"{one['name']}: {one['reason']}" for one in entries if one["reason"]]
    )


def measures_table(entries: Sequence[Entry]) -> Table:
    """Return the response measures of the analyses that have any; columns that apply to none are left out."""
    return MEASURES.of(
        {"analysis": marked_name(one), **one["measures"]}
        for one in entries
        if any(value is not None for value in one["measures"].values())
    )


def statistics_table(entries: Sequence[Entry]) -> Table:
    """Return the computing effort of each analysis, and the error of its energy balance."""
    return STATISTICS.of(
        {"analysis": one["name"], **one["statistics"]}
        for one in entries
        if any(value is not None for value in one["statistics"].values())
    )


def modes(group: Group) -> list[Mode]:
    """Return the modes of a modal analysis; none of another one."""
    if "period" not in group.variables:
        return []
    periods = group.variables["period"].values.tolist()
    ratio = group.variables.get("effective_mass_ratio_x")
    if ratio is None:
        return [Mode(i, period, None, None) for i, period in enumerate(periods, start=1)]
    others = [group.variables.get(f"effective_mass_ratio_{axis}") for axis in ("y", "rz")]
    found, total = [], 0.0
    for i, (period, mass) in enumerate(zip(periods, ratio.values.tolist(), strict=True)):
        total += mass
        found.append(Mode(i + 1, period, mass, total, *(None if of is None else float(of.values[i]) for of in others)))
    return found


class Leading(NamedTuple):
    """The mode that leads in a direction: the one with most of the mass of the whole building in it."""

    direction: str
    mode: Mode
    share: float


def leading_modes(found: Sequence[Mode]) -> list[Leading]:
    """Return the leading modes of a building along x, along y and about the vertical; of a plane frame none.

    Args:
        found: modes of an analysis, whose shares are known.
    """
    shares = {
        "along x": [one.mass for one in found],
        "along y": [one.along_y for one in found],
        "about z": [one.about_z for one in found],
    }
    if any(share is None for of in shares.values() for share in of):
        return []
    leading = []
    for direction, of in shares.items():
        share, number = max((float(share or 0.0), -i) for i, share in enumerate(of))
        leading.append(Leading(direction, found[-number], share))
    return leading


def _leads(one: Leading) -> str:
    return f"{one.direction} mode {one.mode.number} ({one.mode.period:.4f} s, {100.0 * one.share:.1f} %)"


def periods_table(name: str, group: Group) -> Table:
    """Return periods and effective modal masses of a modal analysis."""
    found = modes(group)
    notes = list(amplitude_notes(group)) if found else []
    if any(mode.along_y is not None for mode in found):
        notes.append("effective mass and its sum: along x; about z: share of the moment of inertia about the vertical")
        notes.append(f"leading by effective mass of the whole: {', '.join(map(_leads, leading_modes(found)))}")
    return PERIODS.of(found, whose=name, notes=notes)


def profile_table(name: str, group: Group) -> Table:
    """Return the peaks of every storey, from the roof down; the floor is the one above the storey."""
    found = storey_profile(group)
    top = max(map(len, found.values()), default=0)
    return STOREYS.of((_Storey(number, found) for number in range(top, 0, -1)), whose=name)


def fallbacks_table(name: str, group: Group) -> Table:
    """Return the fallbacks of the solver where a step did not converge; long lists are cut."""
    header, unit = ABSCISSAE.get(str(group.attributes.get("kind")), ("time", S))
    events = group.attributes.get("events")
    listed = [event for event in events if isinstance(event, Mapping)] if isinstance(events, list) else []
    return FALLBACKS.of(listed, whose=name, abscissa=header, units={"abscissa": unit})
