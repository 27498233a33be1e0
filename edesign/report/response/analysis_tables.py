"""The tables of analyses of any kind: labels and ends, periods, measures, storeys, computing effort, fallbacks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from edesign.archive.dataset import Group
from edesign.assess.profile import storey_profile
from edesign.report.assessment.measure_columns import BRACE_COLUMNS, FRAME_COLUMNS, ROUNDING
from edesign.report.response.damper_results import amplitude_notes
from edesign.report.tables.table import Table, formatted, number, seconds, whole

PROFILE_COLUMNS = (
    ("floor u [m]", "floor_displacement", 1.0),
    ("drift [%]", "storey_drift", 0.01),
    ("residual drift [%]", "residual_storey_drift", 0.01),
    ("shear [kN]", "storey_shear", 1e3),
    ("floor a [m/s2]", "floor_acceleration", 1.0),
)
EVENTS_SHOWN = 20
ABSCISSAE = {  # what steps are taken in
    "gravity": "load factor",
    "pushover": "roof u [m]",
    "target": "roof u [m]",
    "history": "time [s]",
}
KINDS = {"target": "target displacement"}
"""Kinds of analyses as people read them, where the word of the archive is another."""


def analyses_table(entries: list[dict[str, Any]]) -> Table:
    """Return name, kind, labels and status of each analysis; reasons of failures stand below."""
    table = Table("Analyses", ("analysis", "kind", "variant", "record", "level", "status"), left=6, name="analyses")
    for item in entries:
        kind = KINDS.get(str(item["kind"]), str(item["kind"] or "-"))
        labels = [kind, *(str(item[label] or "-") for label in ("variant", "record", "level"))]
        table.rows.append([item["name"], *labels, item["status"]])
        if item["reason"]:
            table.notes.append(f"{item['name']}: {item['reason']}")
    return table


def measures_table(entries: list[dict[str, Any]]) -> Table:
    """Return the response measures of the analyses that have any; columns that apply to none are left out."""
    rows = [item for item in entries if any(value is not None for value in item["measures"].values())]
    shown = [
        column
        for column in (*FRAME_COLUMNS, *BRACE_COLUMNS)
        if any(item["measures"][column[1]] is not None for item in rows)
    ]
    table = Table(
        "Response measures (largest absolute values)",
        ("analysis", *(header for header, _, _ in shown)),
        name="response_measures",
    )
    for item in rows:
        mark = "" if item["status"] == "completed" else " *"
        cells = [number(item["measures"][measure], scale=unit, negligible=ROUNDING) for _, measure, unit in shown]
        table.rows.append([item["name"] + mark, *cells])
    if any(item["status"] != "completed" for item in rows):
        table.notes.append("* not completed: as far as the analysis came, and not to be relied on")
    return table


def statistics_table(entries: list[dict[str, Any]]) -> Table:
    """Return the computing effort of each analysis, and the error of its energy balance."""
    table = Table(
        "Statistics",
        ("analysis", "steps", "iterations", "refactorisations", "fallbacks", "CPU [s]", "energy error"),
        name="statistics",
    )
    for item in entries:
        found = item["statistics"]
        if all(value is None for value in found.values()):
            continue
        counts = [whole(found[key]) for key in ("steps", "iterations", "refactorisations", "fallbacks")]
        table.rows.append([item["name"], *counts, seconds(found["cpu_s"]), number(found["energy_error"], 2)])
    return table


def periods_table(name: str, group: Group, most: int | None = None) -> Table:
    """Return periods and effective modal masses of a modal analysis: of the first modes, or of all.

    Args:
        name: name of the analysis.
        group: results of the analysis.
        most: number of modes that are shown; None: all.
    """
    table = Table(f"{name}: periods", ("mode", "T [s]", "f [Hz]", "effective mass [%]", "sum [%]"), left=0)
    table.each = ("Periods", name)
    table.name = "periods"
    period = group.variables.get("period")
    if period is None:
        return table
    ratio = group.variables.get("effective_mass_ratio_x")
    total = 0.0
    for mode, value in enumerate(period.values[:most]):
        cells = ["-", "-"]
        if ratio is not None:
            total += float(ratio.values[mode])
            cells = [formatted(100 * float(ratio.values[mode]), ".2f"), formatted(100 * total, ".2f")]
        table.rows.append([whole(mode + 1), formatted(value, ".4f"), formatted(1 / value, ".4f"), *cells])
    if len(table.rows) < period.values.size:
        table.notes.append(f"the first {len(table.rows)} of {period.values.size} modes")
    table.notes += amplitude_notes(group)
    return table


def profile_table(name: str, group: Group) -> Table:
    """Return the peaks of every storey, from the roof down; the floor is the one above the storey.

    Args:
        name: name of the analysis.
        group: results of the analysis.
    """
    found = storey_profile(group)
    columns = [(header, unit, found[key]) for header, key, unit in PROFILE_COLUMNS if key in found]
    table = Table(
        f"{name}: storeys (largest absolute values)", ("storey", *(header for header, _, _ in columns)), left=0
    )
    table.each = ("Storeys (largest absolute values)", name)
    table.name = "storey_response"
    if not columns:
        return table
    for storey in range(len(columns[0][2]), 0, -1):
        table.rows.append(
            [
                whole(storey),
                *(number(float(values[storey - 1]), scale=unit, negligible=ROUNDING) for _, unit, values in columns),
            ]
        )
    return table


def fallbacks_table(name: str, group: Group) -> Table:
    """Return the fallbacks of the solver where a step did not converge; long lists are cut.

    Args:
        name: name of the analysis.
        group: results of the analysis.
    """
    abscissa = ABSCISSAE.get(str(group.attributes.get("kind")), "time [s]")
    table = Table(
        f"{name}: fallbacks", ("step", abscissa, "rung", "detail"), left=0, each=("Fallbacks", name), name="fallbacks"
    )
    events = group.attributes.get("events")
    listed = [event for event in events if isinstance(event, Mapping)] if isinstance(events, list) else []
    for event in listed[:EVENTS_SHOWN]:
        table.rows.append([whole(event["step"]), number(event["time"]), str(event["rung"]), str(event["detail"])])
    if len(listed) > EVENTS_SHOWN:
        table.notes.append(f"and {len(listed) - EVENTS_SHOWN} more, in the archive")
    return table
