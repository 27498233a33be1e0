"""Recordings that a project may use, as a table, a CSV file and plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.ground_motion.catalogue.candidate import Refusal
from edesign.ground_motion.catalogue.listing import Listed, PlaceOfRecords
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import M_S, G, S

_DIGITS = 3
_FACTS = ("event", "year", "station", "component", "rsn", "magnitude", "distance", "v_s30")
PLACES = TableSpec[PlaceOfRecords](
    "recordings_at_hand",
    "Recordings at hand",
    (text("name"), text("kind"), text("what", "about", broken=1), count("recordings")),
    notes=(
        "recordings: horizontal components",
        "`edesign records NAME` lists one of them, `edesign records FOLDER` your own files.",
    ),
    keys=3,
)
RECORDINGS = TableSpec[Listed](
    "recordings",
    "{count} horizontal components in {where}",
    (
        text("record", lambda one: one.candidate.name),
        text("format", "file_format"),
        col("dt", S, "time_step", form="g"),
        col("t", S, "duration", form=".1f"),
        col("PGA", G, lambda one: one.measures.pga, _DIGITS),
        col("PGV", M_S, lambda one: one.measures.pgv, _DIGITS),
        col("Arias", M_S, lambda one: one.measures.arias, _DIGITS),
        col("D5-95", S, lambda one: one.measures.duration_5_95, _DIGITS),
    ),
    keys=2,
    named_by_title=True,
)
LEFT_OUT = TableSpec[Refusal]("left_out", "Left out", (text("what", "name"), text("why", "reason", broken=1)), keys=2)


def places_table(places: Sequence[PlaceOfRecords]) -> Table:
    """Return the packages and suites that projects may name."""
    return PLACES.of(places)


def listing_tables(where: str, found: Sequence[Listed], refused: Sequence[Refusal]) -> list[Table]:
    """Return the recordings of a place with their measures, and the files that are left out.

    Args:
        where: the place that was searched.
        refused: the files that are no records, with the reason of each.
    """
    table = RECORDINGS.of(found, count=len(found), where=where)
    table.notes += [f"{one.candidate.name}: {text}" for one in found for text in one.warnings]
    if found:
        table.notes.append("t: duration; D5-95: significant duration; all as recorded, before any processing")
    else:
        table.columns, table.notes = (), ["none"]
    if not refused:
        return [table]
    left = LEFT_OUT.of(refused)
    if any("acceleration_unit" in one.reason for one in refused):
        left.notes.append("here `--unit g` gives the unit of all tables; other units: m/s^2, cm/s^2, mm/s^2")
    return [table, left]


def listing_data(found: Sequence[Listed], refused: Sequence[Refusal]) -> dict[str, Any]:
    """Return the recordings as plain data in SI units.

    Args:
        found: the recordings with their measures.
        refused: the files that are no records, with the reason of each.
    """
    return {
        "records": [
            {
                "name": one.candidate.name,
                "origin": one.origin,
                "place": one.place,
                "format": one.file_format,
                "time_step_s": one.time_step,
                "duration_s": one.duration,
                "measures": asdict(one.measures),
                "doubts": list(one.warnings),
                **{key: getattr(one.candidate.entry, key, None) for key in _FACTS},
            }
            for one in found
        ],
        "left_out": [asdict(one) for one in refused],
    }


def places_data(places: Sequence[PlaceOfRecords]) -> list[dict[str, Any]]:
    """Return packages and suites as plain data."""
    return [asdict(one) for one in places]


def write_listing(found: Sequence[Listed], path: Path) -> None:
    """Write the recordings as CSV, all digits, in SI units; PGA in m/s2.

    Args:
        found: the recordings with their measures.

    Raises:
        ArchiveError: it cannot be written.
    """
    headers = ["record", "origin", "place", "format", "dt [s]", "duration [s]"]
    headers += ["PGA [m/s2]", "PGV [m/s]", "PGD [m]", "Arias [m/s]", "D5-95 [s]", "D5-75 [s]", "CAV [m/s]"]
    headers += ["event", "year", "station", "component", "rsn", "magnitude", "distance [m]", "v_s30 [m/s]", "doubts"]
    rows: list[list[Cell]] = []
    for one in found:
        m = one.measures
        row: list[Cell] = [one.candidate.name, one.origin, one.place, one.file_format, one.time_step, one.duration]
        row += [m.pga, m.pgv, m.pgd, m.arias, m.duration_5_95, m.duration_5_75, m.cav]
        rows.append([*row, *(getattr(one.candidate.entry, key, None) for key in _FACTS), "; ".join(one.warnings)])
    write_csv_file(headers, rows, path)
