"""What kind of file a user names, by its content: YAML file of edesign, archive, or table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

from edesign.errors import InputError
from edesign.yaml_parser import quick_parser

HDF5 = b"\x89HDF\r\n\x1a\n"
"""How a file of HDF5 begins."""
HEAD = 1 << 16
"""Bytes at the beginning of a file that tell its kind: the keys that do stand at the top."""
_MAY_HAVE_KEYS = re.compile(r"[{?]|:(?!\S)")
"""What every mapping has. The parser takes 0.04 s to find none in the numbers of a record."""


@dataclass(frozen=True)
class FileKind:
    """A kind of file.

    Attributes:
        name: with which messages go on after "this is a": "project file".
        use: what edesign does with it, a clause.
        keys: of its outermost mapping, which it has all; none: it is no YAML.
        without: keys that it does not have.
    """

    name: str
    use: str
    keys: frozenset[str] = frozenset()
    without: frozenset[str] = frozenset()

    @property
    def described(self) -> str:
        """Name of the kind with its article and format."""
        article = "an" if self.name[0] in "aeiou" else "a"
        return f"{article} {self.name} (YAML)" if self.keys else f"{article} {self.name}"


def _kind(name: str, use: str, keys: str, without: str = "") -> FileKind:
    return FileKind(name, use, frozenset(keys.split()), frozenset(without.split()))


ARCHIVE = FileKind("archive of results (HDF5)", "`edesign show` prints what it holds")
TABLE = FileKind(
    "table of numbers (CSV)", "`edesign characterise`, `sheet`, `fit`, `rts identify` and `rts judge` read such"
)
PROJECT = _kind("project file", "`edesign run` runs it", "edesign")
STUDY = _kind("study file", "`edesign run` runs it", "edesign_study")
BUILDING = _kind("building file", "`edesign run` runs it", "edesign_building")
SUBSTRUCTURE_TESTS = _kind("substructure test file", "`edesign rts run` runs it", "edesign_rts")
SUITE = _kind("suite file", "`edesign match` and `spectrum` read it", "edesign_suite")
REFERENCE = _kind("reference file", "`edesign compare ARCHIVE` puts an archive beside it", "edesign_reference")
RIG = _kind("rig file", "a substructure test file names it by `rig: {file: ...}`", "rig", "compensators tests")
LAW = _kind("law file", "projects and substructure tests name it by `law_file`", "type parameters")
STRUCTURE_CAMPAIGN = _kind("campaign file", "`edesign calibrate` reads it", "structure channels")
PROPERTY_CAMPAIGN = _kind("campaign file", "`edesign calibrate` reads it", "properties specimen")
CAMPAIGN_OR_PROGRAMME = _kind(
    "campaign or programme file", "`edesign calibrate` or `test` reads it", "specimen tests", "compensators rig"
)
STRUCTURE = _kind(
    "structure file", "its `structure` goes into a campaign of records", "structure", "channels compensators rig tests"
)
NATIONAL = _kind("national data file", "a `hazard` names it by `country: NAME.yaml`", "zones")
YAML_KINDS = (
    PROJECT,
    STUDY,
    BUILDING,
    SUBSTRUCTURE_TESTS,
    SUITE,
    REFERENCE,
    RIG,
    LAW,
    STRUCTURE_CAMPAIGN,
    PROPERTY_CAMPAIGN,
    CAMPAIGN_OR_PROGRAMME,
)
"""Those with a key of their own, then those that are known by several."""
_FOR_CHECK = (STRUCTURE, NATIONAL)
"""Which no command takes but `check`; they are known by a key that other files may have as well."""


def kind_of_keys(keys: Iterable[str]) -> FileKind | None:
    """Return the kind of a YAML file by the keys of its outermost mapping; None: none that is known.

    Args:
        keys: of the outermost mapping.
    """
    found: set[str] = set()
    for key in keys:
        found.add(key)
        own = next((kind for kind in YAML_KINDS if kind.keys == {key} and not kind.without), None)
        if own is not None:
            return own
    several = (*YAML_KINDS, *_FOR_CHECK)
    return next((kind for kind in several if kind.keys <= found and not kind.without & found), None)


def kind_of_content(head: bytes) -> FileKind | None:
    """Return the kind of a file by its first bytes, `HEAD` of them at most; None: none that is known.

    Args:
        head: first bytes of the file.
    """
    if head.startswith(HDF5):
        return ARCHIVE
    if b"\0" in head:
        return None
    text = head.decode("utf-8-sig", errors="replace")
    return TABLE if _has_numbers(text) else kind_of_keys(_top_level_keys(text))


def kind_of(path: Path | str) -> FileKind | None:
    """Return the kind of a file; None: none that is known, or the file cannot be read.

    Args:
        path: of the file.
    """
    try:
        if not Path(path).is_file():  # what a pipe gives its reader needs
            return None
        with Path(path).open("rb") as file:
            return kind_of_content(file.read(HEAD))
    except (OSError, ValueError):  # what its reader tells
        return None


def refuse_kind(path: Path | str, found: FileKind | None, what: str, *refused: FileKind) -> None:
    """Refuse a file that is of one of some kinds.

    Args:
        path: of the file.
        found: its kind.
        what: is needed in its place, for messages.
        *refused: kinds that it cannot be.
        refused: kinds that it cannot be.

    Raises:
        InputError: it is of one of them.
    """
    if found is not None and found in refused:
        raise InputError(other_kind(path, found, what))


def other_kind(path: Path | str, found: FileKind, what: str) -> str:
    """Return the message that a file is of another kind than is needed.

    Args:
        path: of the file.
        found: its kind.
        what: is needed in its place.
    """
    article = "an" if what[0] in "aeiou" else "a"
    return f"{path}: this is {found.described}, and {article} {what} is needed; {found.use}"


def _top_level_keys(text: str) -> Iterator[str]:
    """Yield the keys of the outermost mapping as far as they are asked for; of wrong YAML those before the fault."""
    if not _MAY_HAVE_KEYS.search(text):
        return
    for parser in filter(None, (quick_parser(text), yaml.SafeLoader)):
        try:
            yield from _keys(yaml.parse(text, Loader=parser))
            return
        except yaml.YAMLError:
            pass  # the other parser may find more keys before the fault


def _keys(events: Iterable[Any]) -> Iterator[str]:
    depth, is_key = 0, False
    for event in events:
        if depth == 1:  # keys and values in turn
            is_key = not is_key
            if is_key and isinstance(event, yaml.ScalarEvent):
                yield event.value
        if isinstance(event, yaml.CollectionStartEvent):
            if depth == 0 and isinstance(event, yaml.SequenceStartEvent):
                return
            depth += 1
        elif isinstance(event, yaml.CollectionEndEvent):
            depth -= 1


def _has_numbers(text: str) -> bool:
    """Whether a line that is not indented has several numbers and nothing else, which no YAML of a mapping has."""
    return any(_is_row(line) for line in text.splitlines()[:-1] if line[:1] not in ("", " ", "\t", "#"))


def _is_row(line: str) -> bool:
    sign = next((one for one in ";\t," if one in line), None)
    if sign is None:
        return False
    cells = [cell.strip(' "').replace(",", ".") for cell in line.split(sign)]
    try:
        return len([float(cell) for cell in cells if cell]) > 1
    except ValueError:
        return False
