"""The text of SAP2000's database tables: lines `Field=value`, grouped under `TABLE:  "NAME"`."""

from __future__ import annotations

import codecs
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.file_kinds.kinds import ARCHIVE, PAGE, PDF, PICTURE, YAML_KINDS
from edesign.project.reading.file_bytes import read_file

Value = str | float | int | bool
END = "END TABLE DATA"
_TABLE = re.compile(r'\s*TABLE:\s*"([^"]*)"\s*', re.IGNORECASE)
_FIELD = re.compile(r'\s*([A-Za-z][\w./()-]*)=(?:"([^"]*)"|\s*(?![A-Za-z][\w./()-]*=)([^\s"]*))(?=\s|$)')
_NUMBER = re.compile(r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?")
_BARE = re.compile(r"[^\s\"=,]+")
_LINE_LENGTH = 240  # where SAP2000 breaks its lines
_LARGEST = 1e30


@dataclass(frozen=True)
class Row:
    """A record of a table.

    Attributes:
        table: its name.
        line: of the file, from 1.
        fields: values by the name of their field in lower case.
        path: of the file.
    """

    table: str
    line: int
    fields: Mapping[str, str]
    path: Path

    def has(self, name: str) -> bool:
        """Whether the record has a field with a value."""
        return self.fields.get(name.lower(), "") != ""

    def text(self, name: str, default: str | None = None) -> str:
        """Return the text of a field; one that is missing is an error without a default."""
        found = self.fields.get(name.lower(), "")
        if found == "":
            if default is None:
                raise self.error(f"the field `{name}` is missing [E-SAP-03]")
            return default
        return found

    def number(self, name: str, default: float | None = None) -> float:
        """Return the number of a field; one that is missing is an error without a default."""
        if default is not None and not self.has(name):
            return default
        text = self.text(name)
        point = text.replace(",", ".") if text.count(",") == 1 and "." not in text else text
        if _NUMBER.fullmatch(point) is None or not abs(found := float(point)) < _LARGEST:
            raise self.error(f"`{name}={text}` is no number [E-SAP-03]")
        return found

    def yes(self, name: str, default: bool = False) -> bool:
        """Return whether a field is `Yes`; one that is missing has the default."""
        text = self.text(name, "Yes" if default else "No")
        if text.lower() not in ("yes", "no"):
            raise self.error(f"`{name}={text}` is neither Yes nor No [E-SAP-03]")
        return text.lower() == "yes"

    def error(self, message: str) -> InputError:
        """Return an error at this record."""
        return InputError(f"{self.path}:{self.line}: {self.table}: {message}")


@dataclass
class Tables:
    """The tables of a file by their names in capitals, in its order."""

    path: Path
    rows: dict[str, list[Row]] = field(default_factory=dict)

    def of(self, name: str) -> list[Row]:
        """Return the records of a table; none if the file does not have it."""
        return self.rows.get(name, [])


def read_tables(path: Path) -> Tables:
    """Read the tables of a text file.

    Args:
        path: of SAP2000's text (.s2k, .$2k), in UTF-8, UTF-16 or Windows-1252.

    Raises:
        InputError: the file cannot be read, is no such text, or is cut off.
    """
    text = _decoded(path, read_file(path, "SAP2000 file", refused=(ARCHIVE, *YAML_KINDS, PDF, PICTURE, PAGE)))
    found, name, ended = Tables(path), "", False
    for number, line in _logical_lines(path, text):
        if table := _TABLE.fullmatch(line):
            name = " ".join(table[1].upper().split())
            found.rows.setdefault(name, [])
        elif line.strip().upper() == END:
            ended = True
            break
        elif line.strip() and (name or not _is_heading(line)):
            if not name:
                raise InputError(
                    f'{path}:{number}: this is no SAP2000 text: it begins with lines `TABLE:  "NAME"` [E-SAP-01]'
                )
            found.rows[name].append(Row(name, number, _fields(path, number, name, line), path))
    if not found.rows:
        raise InputError(f'{path}: this is no SAP2000 text: there is no line `TABLE:  "NAME"` [E-SAP-01]')
    if not ended:
        raise InputError(
            f"{path}: the last line `{END}` is missing, so that the file may be cut off; export it again, or add the "
            "line if it is whole [E-SAP-02]"
        )
    return found


def written_tables(first_line: str, tables: Iterable[tuple[str, Iterable[Mapping[str, Any]]]]) -> str:
    """Return tables as SAP2000's text; empty ones are left out.

    Args:
        first_line: before the tables.
        tables: names and records.
    """
    text = [first_line, " "]
    for name, records in tables:
        rows = [_record(record) for record in records]
        if rows:
            text += [f'TABLE:  "{name}"', *rows, " "]
    return "\r\n".join([*text, END, ""])


def _is_heading(line: str) -> bool:
    return line.lstrip().startswith(("$", ";")) or line.lstrip().upper().startswith("FILE ")


def _decoded(path: Path, content: bytes) -> str:
    """The text of a file, whose encoding its first bytes show."""
    for mark, encoding in ((codecs.BOM_UTF8, "utf-8-sig"), (codecs.BOM_UTF16_LE, "utf-16"), (b"\xfe\xff", "utf-16")):
        if content.startswith(mark):
            text = content.decode(encoding, errors="replace")
            break
    else:
        head = content[:1000]
        if head[1::2].count(0) > len(head) // 4:
            text = content.decode("utf-16-le", errors="replace")
        else:
            try:
                text = content.decode("utf-8")
            except UnicodeDecodeError:
                text = content.decode("cp1252", errors="replace")
    if "\0" in text:
        raise InputError(f"{path}: this is no text: it has null characters; export the model as text (.s2k) [E-SAP-01]")
    return text


def _logical_lines(path: Path, text: str) -> Iterator[tuple[int, str]]:
    """Lines with their numbers; one that ends in ` _` goes on in the next."""
    begun, number = "", 0
    for n, line in enumerate(re.split("\r\n|\n|\r", text), start=1):
        number = number or n
        stripped = line.rstrip()
        if stripped == "_" or stripped.endswith((" _", "\t_")):
            begun += stripped[:-1] + " "
            continue
        yield number, begun + stripped
        begun, number = "", 0
    if begun:
        raise InputError(f"{path}:{number}: the line ends in ` _`, and none follows: the file is cut off [E-SAP-02]")


def _fields(path: Path, number: int, table: str, line: str) -> dict[str, str]:
    found: dict[str, str] = {}
    at = 0
    while match := _FIELD.match(line, at):
        name = match[1].lower()
        if name in found:
            raise InputError(f"{path}:{number}: {table}: the field `{match[1]}` is there twice [E-SAP-03]")
        found[name] = match[2] if match[2] is not None else match[3]
        at = match.end()
    if rest := line[at:].strip():
        raise InputError(f"{path}:{number}: {table}: `{rest[:40]}` is no `Field=value` [E-SAP-03]")
    return found


def _record(record: Mapping[str, Any]) -> str:
    """A record in lines of at most `_LINE_LENGTH` characters."""
    lines, line = [], ""
    for name, value in record.items():
        part = f"   {name}={_value(value)}"
        if line and len(line) + len(part) > _LINE_LENGTH:
            lines.append(f"{line} _")
            line = "     "
        line += part
    return "\r\n".join([*lines, line])


def _value(value: Value) -> str:
    if isinstance(value, bool):
        return "Yes" if value else "No"
    if isinstance(value, (int, float)):
        if not math.isfinite(value):
            raise ValueError(f"{value} cannot stand in a table")
        return repr(float(value)).removesuffix(".0").replace("e", "E")
    text = " ".join(value.replace('"', "'").split())
    return text if _BARE.fullmatch(text) else f'"{text}"'
