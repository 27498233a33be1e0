"""Whose archive a file is: results replace those of their own project, study or campaign, and no others."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from edesign.archive.dataset import Group
from edesign.archive.files import check_archive_name, is_hdf5
from edesign.archive.reader import DamagedArchive, open_archive
from edesign.archive.writer import partial_path
from edesign.errors import ArchiveError, split_code
from edesign.input_files import spare_inputs

_NAMES = ("project_file", "study_file", "title")  # by which archives without `source_file` are known


def check_owner(path: Path, root: Group, overwrite: bool = False) -> list[str]:
    """Refuse to replace the archive of another source, finished or interrupted, or an input of the command.

    An archive of the same state of a project with analyses that the run leaves out (`--only`) is not replaced either.
    One of an earlier state of the file is: what the file no longer asks for goes.

    Args:
        root: of this archive; the attribute `source_file` says what it is of. Of an archive without it, of an older
            version, the names and the title in it do.
        overwrite: whether the archive of something else may be replaced.

    Returns:
        The analyses of the archive that is replaced which the new one no longer has.

    Raises:
        ArchiveError: an archive stands there that is of something else, that has more, or that cannot be read.
        InputError: an input of the command stands there, or the name is not one of an archive.
    """
    spare_inputs(path, partial_path(path))
    check_archive_name(path)
    gone: list[str] = []
    for place in (path, partial_path(path)):
        if overwrite or not os.path.isfile(place) or not is_hdf5(place):
            continue  # what is no archive is spared by the writer
        try:
            with open_archive(place) as archive:
                old = archive.attributes
        except ArchiveError as error:
            if place != path and isinstance(error, DamagedArchive):
                continue  # what an interrupted run left
            damage, _ = split_code(str(error))
            raise ArchiveError(
                f"{damage}; it is left as it is: choose another name, or --overwrite [E-FILE-07]"
            ) from error
        lost = [str(name) for name in _names(old) if name not in _names(root.attributes)]
        same = file_checksum(old)
        if lost and same is not None and same == file_checksum(root.attributes):
            raise ArchiveError(
                f"{place}: this archive has {len(lost)} analyses that this run leaves out ({', '.join(lost[:3])}"
                f"{' ...' if len(lost) > 3 else ''}), and it is left as it is; choose another name (--archive), or "
                "--overwrite [E-ARCH-05]"
            )
        if _differs(old, root.attributes):
            raise ArchiveError(
                f"{place}: this is the archive of another {_described(old)}, and it is left as it is; choose another "
                "name or folder (`outputs: archive`, --archive, --output), or --overwrite [E-ARCH-05]"
            )
        gone = gone or lost
    return gone


def file_checksum(attributes: Mapping[str, object]) -> object:
    """Return the checksum of the text of the project, study or building that an archive is of; None: it has none.

    Args:
        attributes: of the root of the archive.
    """
    return attributes.get("project_checksum", attributes.get("building_checksum"))


def _differs(old: Mapping[str, object], new: Mapping[str, object]) -> bool:
    names = ("source_file",) if "source_file" in old else _NAMES
    return _kind(old) != _kind(new) or any(old.get(name) != new.get(name) for name in names)


def _names(attributes: Mapping[str, object]) -> list[object]:
    planned = attributes.get("planned")
    return planned if isinstance(planned, list) else []


def _kind(attributes: Mapping[str, object]) -> str:
    usual = "matching" if "target" in attributes and "project_file" not in attributes else "project"
    return str(attributes.get("kind") or usual)


def _described(old: Mapping[str, object]) -> str:
    file = old.get("source_file") or old.get("study_file") or old.get("project_file")
    return f"{_kind(old)} (`{old.get('title')}`{f', {file}' if file else ''})"
