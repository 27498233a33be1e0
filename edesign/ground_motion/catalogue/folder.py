"""Candidates among the files of a folder."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.ground_motion.catalogue.candidate import Candidate, Names, Refusal, entry_of, suite_of
from edesign.ground_motion.catalogue.file_facts import facts_of, is_vertical
from edesign.ground_motion.catalogue.flatfile import Flatfile, read_flatfile
from edesign.ground_motion.formats.read import COMPONENT_FORMATS, component_labels, detect
from edesign.ground_motion.peer_name import PeerName
from edesign.ground_motion.sources import unreadable_folder
from edesign.ground_motion.suite import Suite
from edesign.project.records.chosen_records import FolderSource

_WITHOUT_COMPONENT = (".at2", ".v1", ".v2", ".v2c", ".v1a", ".v2a", ".raw", ".smc", ".asc", ".cor", ".sac")
_SUFFIXES = (*_WITHOUT_COMPONENT, ".ns", ".ew", ".ns1", ".ew1", ".ns2", ".ew2")
_VERTICAL_SUFFIXES = (".ud", ".ud1", ".ud2")
_TABLES = (".csv", ".tsv", ".txt", ".dat", ".acc")
_PEER_TABLE = ".time_acc.csv"
_OF_FORMATS = (suffix for one in COMPONENT_FORMATS.values() for suffix in one.suffixes)
ENDINGS = tuple(dict.fromkeys((*_SUFFIXES, *_TABLES, *_VERTICAL_SUFFIXES, *_OF_FORMATS)))
"""Endings of files that may be records; all others are passed over."""


def folder_candidates(source: FolderSource, project: Path, names: Names) -> Iterator[Candidate | Refusal]:
    """Yield the horizontal components in the files below a folder, and what is refused of them.

    Args:
        source: the folder, and how its tables are read.
        project: the project file, to which paths are relative.
        names: that candidates have already; receives those of these.

    Raises:
        InputError: the folder or the flatfile cannot be read.
    """
    root = project.parent / source.folder
    flatfile = read_flatfile(project.parent / source.flatfile) if source.flatfile is not None else Flatfile({}, {})
    no_record = os.path.realpath(project.parent / source.flatfile) if source.flatfile is not None else None
    suite = suite_of(source.folder, project)
    files, refused = _files(root)
    yield from refused
    for path in files:
        below = path.relative_to(root).as_posix()
        if os.path.realpath(path) == no_record:
            continue
        if not path.is_file():
            yield Refusal(below, "it is no file, or a link to none")  # a pipe would be waited for
            continue
        try:
            yield from _components(path, below, source, suite, flatfile, names)
        except InputError as error:
            yield Refusal(below, str(error).removeprefix(f"{path}: "))


def _files(root: Path) -> tuple[list[Path], list[Refusal]]:
    """Files that may be records, those of outer folders first, as they have a right to the short names; what is not."""
    found: list[Path] = []
    refused: list[Refusal] = []

    def unreadable(error: OSError) -> None:
        if Path(error.filename) == root:
            unreadable_folder(error)
        below = Path(error.filename).relative_to(root).as_posix()
        refused.append(Refusal(_shown(below), f"the folder cannot be read: {error.strerror}"))

    for here, _, names in os.walk(root, onerror=unreadable):
        for name in names:
            if not name.lower().endswith(ENDINGS):
                continue
            path = Path(here, name)
            below = path.relative_to(root).as_posix()
            if _shown(below) == below:
                found.append(path)
            else:
                refused.append(Refusal(_shown(below), "its name is no text in UTF-8, which results bear; rename it"))
    return sorted(found, key=lambda path: (len(path.parts), path.relative_to(root).as_posix())), refused


def _shown(name: str) -> str:
    """A name of a file as text, whatever its bytes are."""
    return name.encode("utf-8", "surrogateescape").decode("utf-8", "backslashreplace")


def _components(
    path: Path, below: str, source: FolderSource, suite: Suite, flatfile: Flatfile, names: Names
) -> Iterator[Candidate | Refusal]:
    if path.suffix.lower() in _VERTICAL_SUFFIXES:
        yield Refusal(below, "it is a vertical component")
        return
    kind = detect(path)
    table: dict[str, Any] = {}
    if kind == "table":
        if path.name.lower().endswith(_PEER_TABLE):
            table = {"acceleration_unit": "g", "layout": "columns"}
        elif source.acceleration_unit is None:
            yield Refusal(below, "a table does not say the unit of its accelerations; `acceleration_unit` would")
            return
        else:
            table = {key: getattr(source, key) for key in ("acceleration_unit", "time_step", "layout")}
    elif kind == "sac":
        if source.acceleration_unit is None:
            yield Refusal(below, "a SAC file does not say the unit of its accelerations; `acceleration_unit` would")
            return
        table = {"acceleration_unit": source.acceleration_unit}
    said = facts_of(path, kind)
    facts = flatfile.facts(path, said.rsn).over(said)
    for label in component_labels(path, kind) or ("",):
        name = f"{below}, {label}" if label else below
        if is_vertical(path, label):
            yield Refusal(name, "it is a vertical component")
            continue
        peer = PeerName.parse(path.name)
        component = label or (peer.component if peer and kind == "at2" else None)
        file = (Path(source.folder) / below).as_posix()
        made = names.free(*_texts(below, label))
        yield Candidate(entry_of(made, facts, component, file=file, **table), suite, pulse=facts.pulse)


def _texts(below: str, label: str) -> tuple[str, str]:
    """Names for results: that of the file, with its component; with its folders where that is taken."""
    path = Path(below)
    stem = path.name
    for ending in (_PEER_TABLE, *_WITHOUT_COMPONENT, *_TABLES):
        if stem.lower().endswith(ending):
            stem = stem[: -len(ending)]
            break
    name = f"{stem}.{label}" if label else stem
    return name, "_".join([*path.parent.parts, name])
