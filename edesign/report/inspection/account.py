"""What is found in a table of numbers, for people and programs: how it stands, its columns, sampling and rest."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass, field
from operator import itemgetter
from pathlib import Path
from typing import Any

import numpy as np

from edesign.report.tables.column import col, count, literal, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE
from edesign.tables.form import Form

Lines = Sequence[int] | np.ndarray
"""Numbers of lines, (n,)."""
OPEN = "?"
"""Stands in proposed YAML where the user must say a value."""
_EVEN = 0.01  # of a step: by so much times of an even sampling differ, as they are rounded
_SHOWN = 3  # rows at the beginning, and at the end
_LONGEST_CELL = 28


@dataclass(frozen=True)
class Column:
    """A column of the table.

    Attributes:
        number: from 1.
        header: of the file; empty if there is none.
        quantity: what it is taken for; empty: it is not read, or not known.
        unit: of the values, as far as it is known.
        smallest, largest: values as they stand in the file.
    """

    number: int
    header: str
    quantity: str
    unit: str
    smallest: float
    largest: float


@dataclass(frozen=True)
class Sampling:
    """The time steps from sample to sample.

    Attributes:
        step: median of the steps, s.
        duration: from the first sample to the last, s.
        even: whether all steps are the same but for rounding.
        gaps: lines of samples that come later than one and a half steps after the one before.
        backward: lines of samples whose time is not after the one before.
    """

    step: float
    duration: float
    even: bool
    gaps: tuple[int, ...] = ()
    backward: tuple[int, ...] = ()

    @classmethod
    def of(cls, time: np.ndarray, lines: Lines) -> Sampling:
        """Return the sampling of rows by their times.

        Args:
            time: times of the rows, (n,) s.
            lines: numbers of their lines in the file, (n,).
        """
        steps = np.diff(time)
        step = float(np.median(steps))
        even = bool(np.max(np.abs(steps - step)) <= max(_EVEN * step, 1.01 * _resolution(time)))
        gaps = tuple(int(lines[int(i) + 1]) for i in np.flatnonzero(steps > 1.5 * step)) if step > 0.0 else ()
        backward = tuple(int(lines[int(i) + 1]) for i in np.flatnonzero(steps <= 0.0))
        return cls(step, float(time[-1] - time[0]), even, gaps, backward)

    @property
    def words(self) -> str:
        """The sampling in words."""
        parts = [f"{self.step:.6g} s, {'even' if self.even else 'uneven'}, {self.duration:.6g} s long"]
        for what, lines in (("gaps before", self.gaps), ("time does not ascend in", self.backward)):
            if lines:
                more = f" and {len(lines) - 3} more" if len(lines) > 3 else ""
                parts.append(f"{what} line{'s' * (len(lines) > 1)} {', '.join(map(str, lines[:3]))}{more}")
        return "; ".join(parts)


@dataclass(frozen=True)
class Account:
    """The result of the inspection of a table.

    Attributes:
        path: the file.
        taken_for: "test of a damper", "property table" or "record".
        form: how the table stands in its file.
        columns: of the table.
        rows: how many there are.
        first, last: rows at the beginning and the end, as they were read, with their lines.
        sampling: None: the file has no times that are known.
        remarks: of the beginning of the motion, or of the file; sentences.
        yaml: that reads the file; `OPEN` where something must be said.
        questions: what must be said, each a sentence.
    """

    path: Path
    taken_for: str
    form: Form
    columns: tuple[Column, ...]
    rows: int
    first: tuple[tuple[int, tuple[float, ...]], ...]
    last: tuple[tuple[int, tuple[float, ...]], ...]
    sampling: Sampling | None
    yaml: str
    remarks: tuple[str, ...] = ()
    questions: tuple[str, ...] = field(default=())

    def data(self) -> dict[str, Any]:
        """Return the account for JSON."""
        data: dict[str, Any] = _without_nan(asdict(self) | {"path": str(self.path)})
        return data

    def tables(self) -> list[Table]:
        """Return the account as tables; the YAML and the questions are not in them."""
        form = self.form
        between = {"comma": "commas", "semicolon": "semicolons", "tab": "tabs", "blanks": "blanks"}[form.delimiter]
        facts = [["taken for", self.taken_for], ["encoding", form.encoding]]
        facts += [["exported by", form.mark]] if form.mark else []
        facts += [["headers", f"line {form.header_line}" if form.header_line else "none"]]
        facts += [["units", f"line {form.units_line}"]] if form.units_line else []
        facts += [["between columns", between], ["before decimals", f"{form.decimal}s"]]
        if form.file:
            facts = [["taken for", self.taken_for], ["file", f"{form.file}, of {form.mark}"]]
        where = "samples" if form.file else "lines"
        facts += [["rows", f"{self.rows}, {where} {self.first[0][0]} to {self.last[-1][0]}"]]
        facts += [["left out", f"{form.repeated} repeated lines of headers"]] if form.repeated else []
        facts += [["sampling", self.sampling.words]] if self.sampling else []
        facts += [["note", remark] for remark in self.remarks]
        heads = [literal(_cut(one.header) or str(one.number)) for one in self.columns]
        shown = [*self.first, *(row for row in self.last if row[0] > self.first[-1][0])]
        rows = [(line, *values) for line, values in shown]
        more = [col(head, ONE, _number(i), form="z.7g") for i, head in enumerate(heads, start=1)]
        return [FACTS.of(facts, path=self.path), COLUMNS.of(self.columns), ROWS.of(rows, more=more)]


def _number(column: int) -> Callable[[tuple[float, ...]], float]:
    return lambda row: row[column]


FACTS = TableSpec[list[str]](
    "inspected_file",
    "{path}",
    (text("what", itemgetter(0)), text("value", itemgetter(1), broken=1)),
    keys=2,
    headed=False,
)
COLUMNS = TableSpec[Column](
    "inspected_columns",
    "Columns",
    (
        count("", "number"),
        text("header", lambda one: _cut(one.header)),
        text("read as", lambda one: one.quantity or None),
        text("unit", lambda one: one.unit or None),
        col("smallest", ONE, form="z.6g"),  # z: no -0
        col("largest", ONE, form="z.6g"),
    ),
    keys=4,
)
ROWS = TableSpec[tuple[float, ...]]("inspected_rows", "First and last rows", (count("line", itemgetter(0)),))


def ends(rows: np.ndarray, lines: Lines) -> tuple[tuple[tuple[int, tuple[float, ...]], ...], ...]:
    """Return the first and the last rows of (n, columns) with their lines (n,).

    Args:
        rows: numbers of the table, (n, columns).
        lines: numbers of the lines in the file, (n,).
    """
    shown = range(len(rows)) if len(rows) <= 2 * _SHOWN else (*range(_SHOWN), *range(len(rows) - _SHOWN, len(rows)))
    numbered = [(int(lines[i]), tuple(map(float, rows[i]))) for i in shown]
    return tuple(numbered[:_SHOWN]), tuple(numbered[-_SHOWN:])


def extremes(values: np.ndarray) -> tuple[float, float]:
    """Return the smallest and the largest number of a column (n,); nan if it has none."""
    numbers = values[np.isfinite(values)]
    return (float(numbers.min()), float(numbers.max())) if numbers.size else (math.nan, math.nan)


def _without_nan(data: Any) -> Any:
    """The same with None in the place of nan, which JSON does not know."""
    if isinstance(data, dict):
        return {key: _without_nan(value) for key, value in data.items()}
    if isinstance(data, (list, tuple)):
        return [_without_nan(value) for value in data]
    return None if isinstance(data, float) and math.isnan(data) else data


def table_keys(form: Form) -> str:
    """Return the value of the key `table` that states the form of a table; empty for a plain one."""
    said = {
        "encoding": form.encoding if form.encoding != "utf-8" else "",
        "skip": str(form.header_line - 1) if form.header_line and form.header_line > 1 else "",
        "units_row": "true" if form.units_line else "",
        "delimiter": form.delimiter if form.delimiter != "comma" else "",
        "decimal": "comma" if form.decimal == "comma" else "",
    }
    if form.says_itself:
        return ""
    given = [f"{key}: {value}" for key, value in said.items() if value]
    alone = len(given) == 1 and said["delimiter"]  # which is found as surely
    return f"{{{', '.join(given)}}}" if given and not alone else ""


def quoted(text: str) -> str:
    """Return a text as it stands in YAML between brackets."""
    import yaml

    plain = yaml.safe_dump([text], default_flow_style=True, width=10_000, allow_unicode=True).strip()
    return plain[1:-1]


def _cut(text: str) -> str:
    return text if len(text) <= _LONGEST_CELL else f"{text[: _LONGEST_CELL - 3]}..."


def _resolution(time: np.ndarray) -> float:
    """The last decimal with which times were written, s; 0: they have more than nine."""
    size = max(1.0, float(np.max(np.abs(time))))
    return next((10.0**-n for n in range(10) if np.allclose(time, np.round(time, n), rtol=0.0, atol=1e-12 * size)), 0.0)
