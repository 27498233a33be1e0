"""What kind of file a user names, by its content: YAML file of edesign, archive, or table."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import yaml

from edesign.errors import InputError
from edesign.file_kinds.kinds import (
    ARCHIVE,
    CHECKED_KINDS,
    EMPTY,
    JSON,
    PACKED,
    PAGE,
    PDF,
    PICTURE,
    RECORDING,
    SAP2000,
    TABLE,
    TEXT,
    WORKBOOK,
    YAML_KINDS,
    FileKind,
)
from edesign.yaml_parser import quick_parser

HDF5 = b"\x89HDF\r\n\x1a\n"
"""How a file of HDF5 begins."""
HEAD = 1 << 16
"""Bytes at the beginning of a file that show its kind: the keys that do stand at the top."""
_MAY_HAVE_KEYS = re.compile(r"[{?]|:(?!\S)")
"""What every mapping has. The parser takes 0.04 s to find none in the numbers of a record."""

_TABLE_OF_SAP2000 = re.compile(rb'^\s*TABLE:\s+"', re.MULTILINE)
_NUMBER_OF_POINTS = re.compile(rb"\bNPTS\s*=\s*\d")
"""Of the headers of the PEER data base."""
_JSON = re.compile(rb'\{\s*"[^"\n]*"\s*:|\[\s*\{\s*"')
"""Keys in quotes at the beginning, as programs write them."""

_SIGNATURES = (
    (b"%PDF-", PDF),
    (b"\x89PNG", PICTURE),
    (b"\xff\xd8\xff", PICTURE),
    (b"PK\x03\x04", WORKBOOK),
    (b"\xd0\xcf\x11\xe0", WORKBOOK),  # of Excel before 2007
    (b"\x1f\x8b", PACKED),
    (b"BZh", PACKED),
    (b"\xfd7zXZ", PACKED),
)
_TAGS = ((b"<!doctype html", PAGE), (b"<html", PAGE), (b"<svg", PICTURE))


def kind_of_keys(keys: Iterable[str]) -> FileKind | None:
    """Return the kind of a YAML file by the keys of its outermost mapping; None: none that is known."""
    found: set[str] = set()
    for key in keys:
        found.add(key)
        own = next((kind for kind in YAML_KINDS if kind.keys == (key,) and not kind.without), None)
        if own is not None:
            return own
    several = (kind for kind in (*YAML_KINDS, *CHECKED_KINDS) if kind.entries is None)
    return next((kind for kind in several if found.issuperset(kind.keys) and found.isdisjoint(kind.without)), None)


def kind_of_content(head: bytes) -> FileKind | None:
    """Return the kind of a file by its first bytes, `HEAD` of them at most; None: none that is known."""
    if head.startswith(HDF5):
        return ARCHIVE
    if b"\0" in head:
        return None
    text = head.decode("utf-8-sig", errors="replace")
    return TABLE if _has_numbers(text) else kind_of_keys(_top_level_keys(text))


def foreign_kind(path: Path | str) -> FileKind | None:
    """Return what a file is that no command of edesign takes in this place, by its first bytes; None: nothing known."""
    head = head_of(path)
    if head is None:
        return None
    found = foreign_content(head)
    return TEXT if found is None and _is_text(head) else found


def foreign_content(head: bytes) -> FileKind | None:
    """Return what a file is that is none of edesign, by its first bytes; None: nothing that is known."""
    if not head.strip():
        return EMPTY
    found = next((kind for mark, kind in _SIGNATURES if head.startswith(mark)), None)
    if found is not None:
        return found
    text = head.removeprefix(b"\xef\xbb\xbf").lstrip()
    begin = text[:64].lower()
    found = next((kind for mark, kind in _TAGS if begin.startswith(mark)), None)
    if found is None and _TABLE_OF_SAP2000.search(head):
        return SAP2000
    if found is None and _NUMBER_OF_POINTS.search(head[:500]):
        return RECORDING
    return JSON if found is None and _JSON.match(text) else found


def kind_of(path: Path | str) -> FileKind | None:
    """Return the kind of a file; None: none that is known, or the file cannot be read."""
    head = head_of(path)
    return None if head is None else kind_of_content(head)


def head_of(path: Path | str) -> bytes | None:
    """Return the first `HEAD` bytes of a file; None: it cannot be read, or is no regular file; its reader says so."""
    try:
        if not Path(path).is_file():  # a pipe may give nothing, a device may have no end
            return None
        with Path(path).open("rb") as file:
            return file.read(HEAD)
    except (OSError, ValueError):
        return None


def refuse_kind(path: Path | str, found: FileKind | None, what: str, *refused: FileKind) -> None:
    """Refuse a file that is of one of some kinds.

    Args:
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
        what: is needed in its place.
    """
    article = "an" if what[0] in "aeiou" else "a"
    return f"{path}: this is {found.described}, and {article} {what} is needed; {found.use} [E-FILE-05]"


def _is_text(head: bytes) -> bool:
    """Whether bytes are text in UTF-8; a last character that is cut off counts as whole."""
    return b"\0" not in head and "\ufffd" not in head.decode("utf-8", errors="replace").rstrip("\ufffd")


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
