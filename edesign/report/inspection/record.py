"""What is found in a record file, and the entry of a project that reads it."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.csv_record import rises_evenly
from edesign.ground_motion.formats.record_table import RecordTable, acceleration_unit_of
from edesign.ground_motion.plausibility import LONGEST_STEP
from edesign.report.inspection.account import OPEN, Account, Column, Sampling, ends, quoted, table_keys
from edesign.tables.text import number

_TIME = re.compile(r"\s*(t|time|zeit|tempo|temps|tiempo|时间|時間)\b.*", re.IGNORECASE)
_ACCELERATION = re.compile(
    r"\s*(a|acc\w*|accel\w*|ag|beschleunigung\w*|accelerazione|accélération|加速度)\b.*", re.IGNORECASE
)
_PROOF = 5  # rows whose first numbers rise evenly: times


def record_account(path: Path) -> Account:
    """Inspect a table as a ground motion record.

    Raises:
        InputError: it is no table of numbers, or may be read in two ways.
    """
    table = RecordTable.read(path, None)
    widths = {len(row) for row in table.rows[:-1]} or {len(table.rows[-1])}
    width = max(widths)
    if len(widths) > 1:
        short = next(i for i, row in enumerate(table.rows[:-1]) if len(row) != width)
        raise InputError(
            f"{path}:{table.places[short]}: {len(table.rows[short])} columns; others have {width} [E-TABLE-07]"
        )
    full = [row for row in table.rows if len(row) == width]
    values = np.array(
        [[number(cell, path, i, "a number") for cell in row] for row, i in zip(full, table.places, strict=False)]
    )
    header = table.header if len(table.header) == width else []
    when, at, rows = _columns(header, values)
    unit = acceleration_unit_of(table, at) if at is not None else None
    columns = tuple(
        Column(
            i + 1,
            header[i] if header else "",
            "time" if i == when else "acceleration" if i == at or rows else "",
            "s" if i == when else unit or "" if i == at else "",
            float(np.min(values[:, i])),
            float(np.max(values[:, i])),
        )
        for i in range(width)
    )
    questions = []
    if at is None and not rows:
        questions.append(
            "Which column is the acceleration? In a test of a damper, which ones are displacement and force? Say it by "
            "`columns`, and `units`, in a campaign file."
        )
    if unit is None:
        questions.append("What is the unit of the acceleration: g, m/s^2, cm/s^2 or mm/s^2?")
    if when is None:
        questions.append("What is the time step?")
    if rows and width > 1:
        questions.append(
            f"Are the {width} numbers of a line samples in turn? If they are channels, `columns` stands in place of "
            "`layout`."
        )
    keys = [f"file: {quoted(path.name)}", f"acceleration_unit: {unit or OPEN}"]
    if when is None:
        keys.append(f"time_step: {OPEN} s")
    if rows and width > 1:
        keys.append("layout: rows")
    elif width > 2 or (at is None and width > 1):
        time = f"time: {when + 1}, " if when is not None else ""
        keys.append(f"columns: {{{time}acceleration: {OPEN if at is None else at + 1}}}")
    elif not header and width == 2 and len(full) < _PROOF:
        keys.append("layout: columns")
    if said := table_keys(table.form):
        keys.append(f"table: {said}")
    name = re.sub(r"\W+", "_", path.stem).strip("_") or "record"
    text = f"records:\n  {quoted(name)}:\n" + "".join(f"    {key}\n" for key in keys)
    first, last = ends(values, table.places)
    sampling = Sampling.of(values[:, when], table.places) if when is not None and len(full) > 1 else None
    count = f"{sum(map(len, table.rows))} samples" if rows else ""
    return Account(
        *(path, "record", table.form, columns, len(table.rows), first, last, sampling, text),
        (count,) if count else (),
        tuple(questions),
    )


def _columns(header: list[str], values: np.ndarray) -> tuple[int | None, int | None, bool]:
    """Columns of times and accelerations as far as they are known, and whether the lines hold samples in turn."""
    width = values.shape[1]
    if width == 1:
        return None, 0, False
    steps = np.diff(values[:, 0])
    timed = len(values) >= _PROOF and rises_evenly(values[:, 0]) and float(np.median(steps)) <= LONGEST_STEP
    if header:
        when = next((i for i, name in enumerate(header) if _TIME.fullmatch(name)), None)
        named = [i for i, name in enumerate(header) if _ACCELERATION.fullmatch(name)]
        if when is None and width == 2:
            return 0, 1, False
        if when is None and timed:
            when = 0
        at = named[0] if len(named) == 1 else 1 - when if width == 2 and when is not None else None
        return when, at, False
    if timed:
        return 0, 1 if width == 2 else None, False
    return None, None, True
