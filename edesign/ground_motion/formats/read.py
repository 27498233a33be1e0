"""Reading a record file of any known format; the format is found from content and suffix."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats import (
    afad,
    asa,
    at2,
    cosmos,
    csmip,
    csmnc,
    csv_record,
    cwb,
    esm,
    geonet,
    isesd,
    jma,
    knet,
    sac,
    smc,
    volume_one,
)
from edesign.ground_motion.formats.channels import RecordFormat
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.unknown_format import describe_text
from edesign.ground_motion.record import Record
from edesign.project.notation.table_format import TableFormat
from edesign.project.reading.problems import did_you_mean
from edesign.project.records.record_tables import Layout
from edesign.project.records.records import FileFormat
from edesign.tables.text import is_number

COMPONENT_FORMATS: dict[FileFormat, RecordFormat] = {
    "cosmos": cosmos.FORMAT,
    "smc": smc.FORMAT,
    "geonet": geonet.FORMAT,
    "csmip": csmip.FORMAT,
    "volume1": volume_one.FORMAT,
    "esm": esm.FORMAT,
    "afad": afad.FORMAT,
    "knet": knet.FORMAT,
    "jma": jma.FORMAT,
    "cwb": cwb.FORMAT,
    "csmnc": csmnc.FORMAT,
    "isesd": isesd.FORMAT,
    "asa": asa.FORMAT,
}
"""Formats whose files name their components, in the order in which their marks are looked for."""

FORMATS: dict[FileFormat, str] = {
    "at2": "PEER .AT2",
    **{name: one.title for name, one in COMPONENT_FORMATS.items()},
    "sac": "binary SAC",
    "table": "columns of text (.csv, .txt, .dat, .acc)",
}
"""Every format that is read, for people."""

_SUFFIXES: dict[str, FileFormat] = {
    **dict.fromkeys((".at2", ".vt2", ".dt2"), "at2"),
    **{suffix: name for name, one in COMPONENT_FORMATS.items() for suffix in one.suffixes},
    **dict.fromkeys((".csv", ".tsv", ".dat", ".acc"), "table"),
}
_POSSIBLE_PGA = (1e-9, 1e6)  # m/s2: below is no recorder's noise, above nothing; warnings begin far earlier
_COMMENTS = ("#", "%")
_PROOF = 5  # lines of as many numbers in turn, to the end of the head: a table below words
_HEAD = 100  # lines in which the marks of a format stand
_WIDTH = 500  # characters of these lines that may be marks; looking for one takes up to the square of them


def read_record_file(
    path: Path | str,
    *,
    file_format: FileFormat | None = None,
    acceleration_unit: str | None = None,
    time_step: float | None = None,
    time_column: int | str | None = None,
    acceleration_column: int | str | None = None,
    layout: Layout | None = None,
    table: TableFormat | None = None,
    component: str | int | None = None,
    name: str = "",
) -> Record:
    """Read a record from a file.

    Args:
        path: of the file, in any format of records.
        file_format: one of FORMATS; found from the content, and failing that from the suffix, by default.
        acceleration_unit: of tables and SAC files, which do not say it: "g", "m/s^2", "cm/s^2", "mm/s^2", or "g/10".
        time_step: s; of tables without a column of times.
        time_column: of tables; header, or number from 1.
        acceleration_column: likewise.
        layout: of tables: "columns", or "rows" of several samples in turn; found from the file by default.
        table: of tables: how they stand in their files, where these do not show it.
        component: of formats whose files name their components; needed where a file holds several.
        name: of the record; its file name by default.

    Raises:
        InputError: the file cannot be read, no format fits, an argument does not belong to the format, what the
            reader of the format finds, or peaks that no ground motion has.
    """
    path = Path(path)
    of_tables = {
        "acceleration_unit": acceleration_unit,
        "time_step": time_step,
        "time_column": time_column,
        "acceleration_column": acceleration_column,
        "layout": layout,
        "table": table,
    }
    found = _known(path, file_format) if file_format is not None else detect(path)
    _check_arguments(path, found, of_tables, component)
    if found == "table":
        record = csv_record.read_csv(
            path,
            acceleration_unit or "",
            time_step=time_step,
            time_column=time_column,
            acceleration_column=acceleration_column,
            name=name,
            layout=layout,
            given=table,
        )
    elif found == "sac":
        record = sac.read_sac(path, acceleration_unit or "", component, name)  # type: ignore[arg-type]
    elif found == "at2":
        record = at2.read_at2(path, name)
    else:
        record = COMPONENT_FORMATS[found].read(path, component, name)
    low, high = _POSSIBLE_PGA
    if record.pga > high or 0.0 < record.pga < low:
        raise InputError(
            f"{path}: the peak of {record.pga:g} m/s2 is that of no ground motion; is the unit right? [E-UNIT-03]"
        )
    return record


def component_labels(path: Path, file_format: FileFormat) -> tuple[str, ...]:
    """Return what the components of a file are called if it may hold several, which `component` then chooses.

    Raises:
        InputError: what the reader of the format finds.
    """
    known = COMPONENT_FORMATS.get(file_format)
    return tuple(channel.label for channel in known.channels(path)) if known is not None and known.several else ()


def _known(path: Path, file_format: FileFormat) -> FileFormat:
    if file_format not in FORMATS:
        hint = did_you_mean(str(file_format), FORMATS)
        raise InputError(f"{path}: unknown format `{file_format}`{hint} (formats: {', '.join(FORMATS)}) [E-VALUE-03]")
    return file_format


def names_components(file_format: FileFormat) -> bool:
    """Return whether the files of a format name their components."""
    return file_format in COMPONENT_FORMATS or file_format == "sac"


def format_by_marks(path: Path) -> FileFormat | None:
    """Find the format of a file by the marks in it; None: it has those of no format, as tables have none.

    Raises:
        InputError: the file cannot be read, or is no text and no SAC file.
    """
    if sac.is_sac(path):
        return "sac"
    head = [line[:_WIDTH] for line in read_lines(path)[:_HEAD]]
    marked = next((file_format for file_format, one in COMPONENT_FORMATS.items() if one.fits(head)), None)
    return "at2" if marked is None and at2.has_header(head) else marked


def detect(path: Path) -> FileFormat:
    """Find the format of a file.

    Raises:
        InputError: the file cannot be read, or no format fits; lists the formats.
    """
    if (found := format_by_marks(path)) is not None:
        return found
    lines = read_lines(path)
    head = lines[:_HEAD]
    if path.suffix.lower() in _SUFFIXES:
        return _SUFFIXES[path.suffix.lower()]
    kept = [line for line in head if line.strip() and not line.lstrip().startswith(_COMMENTS)]
    rows = [re.split(r"[;,\s]+", line.strip(" \t,;")) for line in kept]
    numbers = [all(map(is_number, row)) for row in rows]
    if numbers and numbers[:2][-1]:  # the first may be the headers
        return "table"
    first = next((i for i in range(len(rows)) if all(numbers[i:])), len(rows))
    if len(rows) - first >= _PROOF and len(set(map(len, rows[first:]))) == 1:
        return "table"  # below lines of words
    raise InputError(
        f"{path}: no known format fits this file: {describe_text(lines)}. Read are {', '.join(FORMATS.values())}"
        " [E-REC-01]"
    )


def _check_arguments(
    path: Path, file_format: FileFormat, of_tables: Mapping[str, object], component: str | int | None
) -> None:
    given = [key for key, value in of_tables.items() if value is not None]
    if file_format == "sac":  # which says all but the unit
        given = [key for key in given if key != "acceleration_unit"]
    if given and file_format != "table":
        raise InputError(
            f"{path}: {', '.join(given)}: only for tables; a file of the format {FORMATS[file_format]} says this itself"
            " [E-REC-16]"
        )
    if component is not None and not names_components(file_format):
        instead = "choose the column of accelerations" if file_format == "table" else "its files hold one component"
        raise InputError(
            f"{path}: component `{component}`: not for the format {FORMATS[file_format]}; {instead} [E-REC-16]"
        )
