"""Where results come from: versions, checksums, and the moment and machine, which are kept apart from the results."""

from __future__ import annotations

import hashlib
import platform
from datetime import UTC, datetime
from importlib import metadata

import numpy as np

from edesign._version import __version__
from edesign.archive.dataset import Group
from edesign.archive.hdf5 import library_versions
from edesign.errors import InputError
from edesign.project.project import Project
from edesign.project.records import FileRecord

IDENTITY = ("project_checksum", "input_checksum", "edesign_version", "core_version")
"""Root attributes that decide whether results of an interrupted run may be reused."""


def core_version() -> str:
    """Return the version of the numerical core, "unknown" if it does not tell."""
    from edesign import core

    version = getattr(core, "version", None)
    return str(version() if callable(version) else version or "unknown")


def input_checksum(project: Project) -> str:
    """Return the SHA-256 of all that a run reads: the project text, its record files, the packages that carry records.

    Raises:
        InputError: a record file cannot be read.
    """
    checksum = hashlib.sha256(project.text.encode())
    for name in sorted(project.records):
        record = project.records[name]
        if isinstance(record, FileRecord):
            try:
                content = project.record_path(name).read_bytes()
            except OSError as error:
                place = project.where("records", name, "file")
                raise InputError(f"{place}: records.{name}: cannot read {record.file}: {error.strerror}") from error
        else:
            try:
                content = f"{record.package} {metadata.version(record.package)}".encode()
            except metadata.PackageNotFoundError:
                content = b"missing"
        checksum.update(name.encode() + hashlib.sha256(content).digest())
    return checksum.hexdigest()


def root_group(project: Project, planned: list[str]) -> Group:
    """Return the root of an archive: project text, file name, checksums, versions, names of the planned analyses."""
    group = Group(
        attributes={
            "title": project.title,
            "project_file": project.path.name,
            "project_checksum": project.checksum,
            "input_checksum": input_checksum(project),
            "edesign_version": __version__,
            "core_version": core_version(),
            "planned": planned,
            "status": "running",
        }
    )
    group.add("project_text", (), project.text, "", "text of the project file")
    return group


def circumstances() -> Group:
    """Return moment, machine and versions of others: all that may differ between runs with equal results."""
    return Group(
        attributes={
            "created": datetime.now(UTC).isoformat(timespec="seconds"),
            "python_version": platform.python_version(),
            "numpy_version": np.__version__,
            "platform": platform.platform(),
            **library_versions(),
        }
    )
