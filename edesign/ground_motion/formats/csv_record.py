"""Reader of records in tables of text (.csv, .txt, .dat, .acc): columns, or lines of several samples in turn."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.record_table import COLUMNS, ROWS, RecordTable, check_units, form_in_words
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.formats.units import ACCELERATION_UNITS, acceleration_factor
from edesign.ground_motion.plausibility import LONGEST_STEP
from edesign.ground_motion.record import Record
from edesign.project.notation.table_format import TableFormat
from edesign.project.reading.problems import did_you_mean, listed
from edesign.project.records.record_tables import Layout
from edesign.tables.text import number

LAYOUTS: tuple[Layout, ...] = ("columns", "rows")
"""How samples stand in a table: each line is one instant, or the samples run on along the lines."""

_UNEVEN = 0.1  # of a step: times in files are rounded; a missing line moves the others by half a step or more
_ROUNDING = 1e-6  # relative, between a given step and that of the time column
_PROOF = 5  # numbers that rise evenly and so are times: three samples in a row do so by chance, five hardly ever
CHOICE = "by --column on the command line, by `columns` in a project or suite file"
_OTHERWISE = (
    "; if the first column is not the time, name the columns by `columns` in a project or suite file, or, if both are "
    f"samples, write {ROWS}"
)


def read_csv(
    path: Path | str,
    acceleration_unit: str,
    time_step: float | None = None,
    time_column: int | str | None = None,
    acceleration_column: int | str | None = None,
    name: str = "",
    layout: Layout | None = None,
    given: TableFormat | None = None,
) -> Record:
    """Read a record from a table separated by commas, semicolons or blanks.

    With headers or columns named, each line is one instant. Without, one number a line is the acceleration, and of two
    the first is the time (s) if it rises evenly; what may be read in more than one way is refused. The motion begins
    at the first sample, whatever time it bears.

    Args:
        acceleration_unit: "g", "m/s^2", "cm/s^2" or "mm/s^2", also with a number ("g/10"); a table does not say it, so
            it must be declared.
        time_step: s; needed without a time column, and checked against it otherwise.
        time_column: its header, or its number from 1.
        acceleration_column: its header, or its number from 1.
        name: of the record; its file name without ending by default.
        layout: "columns", or "rows" of several samples in turn; found from the file by default.
        given: what is said of how the table stands in its file.

    Returns:
        The record, in m/s2.

    Raises:
        InputError: unreadable file, unknown unit, column or layout, something else than finite numbers, lines of
            different length, fewer than two samples, no time step, times that are not evenly spaced, or a file that
            does not show its layout.
    """
    path = Path(path)
    if not acceleration_unit:
        raise InputError(
            f"{path}: a table does not say the unit of its accelerations; declare it: {', '.join(ACCELERATION_UNITS)}"
            " [E-REC-11]"
        )
    factor = acceleration_factor(acceleration_unit)
    if factor is None:
        raise InputError(
            f"{path}: unknown unit `{acceleration_unit}`; allowed: {', '.join(ACCELERATION_UNITS)} [E-UNIT-02]"
        )
    if layout is not None and layout not in LAYOUTS:
        hint = did_you_mean(str(layout), LAYOUTS)
        raise InputError(f"{path}: unknown layout `{layout}`{hint}; allowed: {listed(LAYOUTS)} [E-VALUE-03]")
    table = RecordTable.read(path, given)
    named = time_column is not None or acceleration_column is not None
    if layout == "rows":
        if named:
            raise InputError(f"{path}: {ROWS} has no columns, but columns are named; give one or the other [E-KEY-03]")
        samples = _along_rows(table)
    else:
        table.check_width(may_be_rows=layout is None)
        when, at = _columns_of(table, time_column, acceleration_column)
        if when is None and table.width > 1 and layout is None and not table.header:
            raise InputError(
                f"{table.where}: {table.width} numbers a line without headers may be {table.width} channels, or "
                f"{table.width} samples in turn; write {COLUMNS}, or {ROWS} without `columns` [E-REC-15]"
            )
        check_units(table, when, at, acceleration_unit)
        samples = table.numbers(at)
        if when is not None:
            times = np.array(table.numbers(when, "a time in s"))
            found = _uniform_step(table, times, time_step, "" if named else _OTHERWISE)
            if layout is None and not (named or table.header or time_step):
                _check_proof(table, found)
            time_step = found
    if time_step is None:
        several = acceleration_column is not None and table.width > 1
        which = (
            "no column of times is named, by --time-column or `columns`"
            if several
            else "the file has no column of times"
        )
        raise InputError(f"{path}: {which}; a time step is needed (--time-step, or `time_step`) [E-REC-17]")
    check_step(f"{path}", time_step)
    how = f"{path.name} in {acceleration_unit}", form_in_words(table.form, given)
    source = ", ".join(part for part in how if part)
    with np.errstate(over="ignore"):
        acceleration = factor * np.array(samples)
    if (beyond := np.flatnonzero(~np.isfinite(acceleration))).size:
        number_of = int(beyond[0])
        raise InputError(
            f"{path}: sample {number_of + 1} is {samples[number_of]:g} {acceleration_unit}, beyond all numbers in m/s2"
            " [E-UNIT-03]"
        )
    return Record(name or path.stem, acceleration, time_step, source)


def _columns_of(
    table: RecordTable, time_column: int | str | None, acceleration_column: int | str | None
) -> tuple[int | None, int]:
    """Columns of times, if there are any, and of accelerations; of two without a name the first has the times."""
    if acceleration_column is None and table.width > 2:
        hint = "" if table.header else f"; if they are samples in turn, write {ROWS}"
        which = f" ({', '.join(f'{i} `{name}`' for i, name in enumerate(table.header, 1))})" if table.header else ""
        raise InputError(
            f"{table.where}: {table.width} columns{which}; name the one that is the acceleration: {CHOICE}{hint}"
            " [E-REC-13]"
        )
    if time_column is None and acceleration_column is None:
        return (0 if table.width == 2 else None), table.width - 1
    at = table.width - 1 if acceleration_column is None else _column(table, acceleration_column)
    when = None if time_column is None else _column(table, time_column)
    if when == at:
        raise InputError(f"{table.path}: column {at + 1} cannot be both time and acceleration [E-VALUE-04]")
    return when, at


def _check_proof(table: RecordTable, step: float) -> None:
    """The first of two numbers a line is a time only if enough of them show it, at a step that recorders have."""
    if len(table.rows) < _PROOF:
        why = f"{len(table.rows)} lines do not show it"
    elif step > LONGEST_STEP:
        why = f"the step would be {step:g} s, and recorders have at most {LONGEST_STEP:g} s"
    else:
        return
    raise InputError(
        f"{table.where}: is the first of two numbers a line the time? {why}; write {COLUMNS} if it is, or {ROWS} if "
        "both are samples [E-REC-15]"
    )


def _along_rows(table: RecordTable) -> list[float]:
    """The numbers of all lines one after the other; the last line may be shorter."""
    if table.header:
        raise InputError(
            f"{table.path}:{table.places[0] - 1}: {ROWS} is for lines of numbers alone; put # before a line of text "
            f"(`{' '.join(table.header)[:40]}`) [E-REC-15]"
        )
    rows = [row[:-1] if len(row) > 1 and not row[-1] else row for row in table.rows]  # a comma may end a line
    width = len(rows[0])
    for row, line in zip(rows, table.places, strict=True):
        if len(row) != width and not (row is rows[-1] and len(row) < width):
            raise InputError(
                f"{table.path}:{line}: {len(row)} samples; the others have {width}, the last perhaps less [E-REC-07]"
            )
    values = [[number(cell, table.path, i) for cell in row] for row, i in zip(rows, table.places, strict=True)]
    full = np.array([row for row in values if len(row) == width])
    rising = [k for k in range(width) if rises_evenly(full[:, k])]
    if len(full) >= _PROOF and 0 < len(rising) < width:
        step = full[1, rising[0]] - full[0, rising[0]]
        raise InputError(
            f"{table.where}: in {ROWS} every number is a sample, but number {rising[0] + 1} of each line rises "
            f"evenly by {step:g}, as times do; leave the times out, or give one time and one sample a line [E-REC-15]"
        )
    samples = [value for row in values for value in row]
    if len(samples) < 2:
        raise InputError(f"{table.where}: a record needs at least two samples, not {len(samples)} [E-REC-21]")
    return samples


def _column(table: RecordTable, wanted: int | str) -> int:
    path, header, width = table.path, table.header, table.width
    if isinstance(wanted, int):
        if not 1 <= wanted <= width:
            raise InputError(f"{path}: there is no column {wanted}; the columns are numbered 1 to {width} [E-REC-14]")
        return wanted - 1
    if not header:
        raise InputError(
            f"{path}: there is no column `{wanted}`: the file has no headers; give the number of the column [E-REC-14]"
        )
    if wanted not in header:
        hint = did_you_mean(wanted, header)
        raise InputError(
            f"{path}: there is no column `{wanted}`{hint} (the columns are: {', '.join(header)}) [E-REC-14]"
        )
    return header.index(wanted)


def _uniform_step(table: RecordTable, times: np.ndarray, given: float | None, hint: str) -> float:
    """The step of evenly spaced times, s; a given one is returned if it is the same."""
    path, places = table.path, table.places
    steps = np.diff(times)
    backwards = np.flatnonzero(steps <= 0.0)
    if backwards.size:
        at = int(backwards[0]) + 1
        raise InputError(
            f"{path}:{places[at]}: the time {times[at]:g} s is not after the time {times[at - 1]:g} s before it{hint}"
            " [E-REC-19]"
        )
    mean = float((times[-1] - times[0]) / steps.size)
    if not rises_evenly(times):
        usual = float(np.sort(steps)[(steps.size - 1) // 2])  # the median, one of the steps that occur
        at = int(np.argmax(np.abs(steps - usual))) + 1
        raise InputError(
            f"{path}:{places[at]}: the times are not evenly spaced: here the step is {steps[at - 1]:g} s, "
            f"mostly {usual:g} s{hint} [E-REC-19]"
        )
    if given is not None:
        if abs(given - mean) > max(_ROUNDING, _UNEVEN / steps.size) * mean:
            raise InputError(
                f"{path}: the time column has a step of {mean:g} s, but {given:g} s is given{hint} [E-REC-18]"
            )
        return given
    return float(f"{mean:.9g}")  # the decimal number that the file means


def rises_evenly(values: np.ndarray) -> bool:
    """Return whether numbers rise by one step but for the rounding of times in files.

    Args:
        values: (n,).
    """
    if values.size < 2 or np.any(np.diff(values) <= 0.0):
        return False
    mean = (values[-1] - values[0]) / (values.size - 1)
    return bool(np.max(np.abs(values - (values[0] + mean * np.arange(values.size)))) <= _UNEVEN * mean)
