"""Recordings that a project may use, as a table, a CSV file and plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.ground_motion.catalogue.candidate import Refusal
from edesign.ground_motion.catalogue.listing import Listed, PlaceOfRecords
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.tables.table import Table, number

_DIGITS = 3
_FACTS = ("event", "year", "station", "component", "rsn", "magnitude", "distance", "v_s30")


def places_table(places: Sequence[PlaceOfRecords]) -> Table:
    """Return the packages and suites that projects may name."""
    table = Table(
        "Recordings at hand", ("name", "kind", "what", "recordings"), left=3, sentences=2, name="recordings_at_hand"
    )
    for place in places:
        count = "-" if place.recordings is None else str(place.recordings)
        table.rows.append([place.name, place.kind, place.about, count])
    table.notes = [
        "recordings: horizontal components",
        "`edesign records NAME` lists one of them, `edesign records FOLDER` your own files.",
    ]
    return table


def listing_tables(where: str, found: Sequence[Listed], refused: Sequence[Refusal]) -> list[Table]:
    """Return the recordings of a place with their measures, and the files that are left out.

    Args:
        where: the place that was searched.
        found: the recordings with their measures.
        refused: the files that are no records, with the reason of each.
    """
    columns = ("record", "format", "dt [s]", "t [s]", "PGA [g]", "PGV [m/s]", "Arias [m/s]", "D5-95 [s]")
    table = Table(f"{len(found)} horizontal components in {where}", columns, left=2)
    for one in found:
        values = ((one.measures.pga, STANDARD_GRAVITY), (one.measures.pgv, 1.0), (one.measures.arias, 1.0))
        table.rows.append(
            [
                one.candidate.name,
                one.file_format,
                f"{one.time_step:g}",
                f"{one.duration:.1f}",
                *(number(value, _DIGITS, unit) for value, unit in values),
                number(one.measures.duration_5_95, _DIGITS),
            ]
        )
        table.notes += [f"{one.candidate.name}: {text}" for text in one.doubts]
    if found:
        table.notes.append("t: duration; D5-95: significant duration; all as recorded, before any processing")
    else:
        table.columns = ()
        table.notes.append("none")
    if not refused:
        return [table]
    left = Table(
        "Left out", ("what", "why"), [[one.name, one.reason] for one in refused], left=2, sentences=1, name="left_out"
    )
    if any("acceleration_unit" in one.reason for one in refused):
        left.notes.append("here `--unit g` tells the unit of all tables; other units: m/s^2, cm/s^2, mm/s^2")
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
                "doubts": list(one.doubts),
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
        path: the file to be written.

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
        rows.append([*row, *(getattr(one.candidate.entry, key, None) for key in _FACTS), "; ".join(one.doubts)])
    write_csv_file(headers, rows, path)
