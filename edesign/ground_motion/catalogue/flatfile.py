"""Flatfiles: tables (CSV) of what is known of recordings, by their number or the names of their files.

Read are tables with the headers below, the flatfile of NGA-West2 as CSV, and the `_SearchResults.csv` that PEER's web
page adds to a download, whose table stands below other lines.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.ground_motion.formats.facts import Facts
from edesign.ground_motion.formats.text import read_lines
from edesign.project.reading.problems import listed
from edesign.tables.text import number

_UNKNOWN = ("", "-", "--", "-999", "-999.0", "nan", "none", "---")
_TRUTH = {"yes": True, "true": True, "1": True, "no": False, "false": False, "0": False}
_FILE_HEADERS = {
    "file",
    "horizontal-1 acc. filename",
    "horizontal-2 acc. filename",
    "file name (horizontal 1)",
    "file name (horizontal 2)",
}


@dataclass(frozen=True)
class Flatfile:
    """Facts of a flatfile by record sequence number, and by the name of a file in lower case."""

    by_number: Mapping[int, Facts]
    by_file: Mapping[str, Facts]

    def facts(self, path: Path, rsn: int | None) -> Facts:
        """Return the facts on a file; none are known of a file that is not listed.

        Args:
            rsn: record sequence number, if it has one.
        """
        found = self.by_file.get(path.name.lower()) or self.by_file.get(path.stem.lower())
        return found or (self.by_number.get(rsn, Facts()) if rsn is not None else Facts())


def read_flatfile(path: Path) -> Flatfile:
    """Read a flatfile.

    Raises:
        InputError: the file cannot be read, has no line of headers, two of the same meaning, a line that names no
            recording, one twice, or a value that is none; the message names the line.
    """
    lines = read_lines(path)
    columns: dict[int, tuple[str, Callable[[str, Path, int], Any]]] = {}
    files: list[int] = []
    by_number: dict[int, Facts] = {}
    by_file: dict[str, Facts] = {}
    reader = csv.reader(lines)
    for row in reader:
        at, cells = reader.line_num, [cell.strip() for cell in row]
        if not columns:
            columns, files = _headers(path, at, cells)
            continue
        if not any(cells):
            break  # PEER's table ends with a blank line; others follow it
        facts = Facts(**{key: _value(cells, i, read, path, at) for i, (key, read) in columns.items()})
        names = [Path(cells[i].replace("\\", "/")).name.lower() for i in files if _said(cells, i)]
        if facts.rsn is None and not names:
            raise InputError(
                f"{path}:{at}: this line names neither the number nor the file of a recording [E-SUITE-08]"
            )
        for name in names:
            if by_file.setdefault(name, facts) != facts:
                raise InputError(f"{path}:{at}: `{name}` has another line already, which says otherwise [E-SUITE-09]")
        if facts.rsn is not None and by_number.setdefault(facts.rsn, facts) != facts:
            raise InputError(
                f"{path}:{at}: the recording {facts.rsn} has another line already, which says otherwise [E-SUITE-09]"
            )
    if not columns:
        raise InputError(
            f"{path}: no line of headers; needed are `rsn` or `file`, and some of {listed(sorted(_OWN))} "
            "(or the headers of PEER's tables) [E-SUITE-08]"
        )
    return Flatfile(by_number, by_file)


def _headers(path: Path, at: int, cells: list[str]) -> tuple[dict[int, Any], list[int]]:
    """Columns of a line of headers; empty if it is none."""
    names = [re.sub(r"\s+", " ", cell.lower()) for cell in cells]
    files = [i for i, name in enumerate(names) if name in _FILE_HEADERS]
    known = {i: _HEADERS[name] for i, name in enumerate(names) if name in _HEADERS}
    if not files and not any(key == "rsn" for key, _ in known.values()):
        return {}, []
    keys = [key for key, _ in known.values()]
    for key in keys:
        if keys.count(key) > 1:
            raise InputError(f"{path}:{at}: more than one column says `{key}`; leave one of them [E-SUITE-08]")
    unknown = [name for name in names if name in ("distance", "v_s30")]
    if unknown:
        allowed = listed(sorted(_OWN))
        raise InputError(
            f"{path}:{at}: the header {listed(unknown)} does not say its unit; read are {allowed} [E-SUITE-08]"
        )
    if not known:
        raise InputError(
            f"{path}:{at}: no column says what is known of the files; read are {listed(sorted(_OWN))} [E-SUITE-08]"
        )
    return known, files


def _said(cells: list[str], i: int) -> bool:
    return i < len(cells) and cells[i].lower() not in _UNKNOWN and not cells[i].startswith("---")


def _value(cells: list[str], i: int, read: Callable[[str, Path, int], Any], path: Path, at: int) -> Any:
    return read(cells[i], path, at) if _said(cells, i) else None


def _text(cell: str, path: Path, at: int) -> str:
    return cell


def _whole(cell: str, path: Path, at: int) -> int:
    value = number(cell, path, at, "a whole number")
    if value != int(value) or value < 0.0:
        raise InputError(f"{path}:{at}: `{cell}` is not a whole number [E-SUITE-10]")
    return int(value)


def _at_least_zero(what: str, factor: float = 1.0) -> Callable[[str, Path, int], float]:
    def read(cell: str, path: Path, at: int) -> float:
        value = number(cell, path, at, what)
        if value < 0.0:
            raise InputError(f"{path}:{at}: `{cell}` is negative; {what} is expected here [E-SUITE-10]")
        return factor * value

    return read


def _truth(cell: str, path: Path, at: int) -> bool:
    if cell.lower() not in _TRUTH:
        raise InputError(f"{path}:{at}: `{cell}` is neither yes nor no, which `pulse` is [E-SUITE-10]")
    return _TRUTH[cell.lower()]


_MAGNITUDE, _KM = _at_least_zero("a magnitude"), _at_least_zero("a distance in km", 1e3)
_SPEED = _at_least_zero("a velocity in m/s")
_OWN: dict[str, tuple[str, Callable[[str, Path, int], Any]]] = {
    "rsn": ("rsn", _whole),
    "event": ("event", _text),
    "year": ("year", _whole),
    "station": ("station", _text),
    "magnitude": ("magnitude", _MAGNITUDE),
    "distance_km": ("distance", _KM),
    "v_s30_m_s": ("v_s30", _SPEED),
    "pulse": ("pulse", _truth),
}
_HEADERS = {
    **_OWN,
    "record sequence number": ("rsn", _whole),
    "earthquake name": ("event", _text),
    "station name": ("station", _text),
    "earthquake magnitude": ("magnitude", _MAGNITUDE),
    "clstd (km)": ("distance", _KM),
    "rrup (km)": ("distance", _KM),
    "vs30 (m/s) selected for analysis": ("v_s30", _SPEED),
    "vs30 (m/sec)": ("v_s30", _SPEED),
}
"""Facts by header in lower case: edesign's own, then those of PEER."""
