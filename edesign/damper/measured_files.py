"""Test files: CSV with time, displacement, force, and temperature where it was measured."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.archive.csv_files import write_csv_file
from edesign.damper.column_units import columns_in_si, names_quantity, need
from edesign.damper.csv_table import CsvTable, read_csv_table
from edesign.damper.measured_histories import FEWEST, DamperTest, Use
from edesign.damper.start import StartKind
from edesign.errors import InputError

EXAMPLE = "time_s,displacement_mm,force_kN"
_WHAT = "test file"


def read_test(
    path: Path | str,
    *,
    temperature_C: float | None = None,
    title: str = "",
    use: Use = "fit",
    needs_force: bool = True,
    name: str = "",
    start: StartKind = "unknown",
    start_ramp: float | None = None,
) -> DamperTest:
    """Read a test.

    Args:
        path: CSV with the headers `time_s,displacement_mm,force_kN[,temperature_C]`, in any order and in other units
            (`displacement_m`, `force_N`, `time_ms`), or the export of a test machine (`Axial Force (kN)`). Columns of
            other quantities are not read.
        temperature_C: ambient; by default the mean of the file's column of temperatures.
        title: for people.
        use: whether laws are fitted to it.
        needs_force: whether a file without force is refused.
        name: of the test; the file name without ending by default.
        start, start_ramp: as of DamperTest.

    Raises:
        InputError: the file cannot be read or is wrong, or no temperature is known.
    """
    path = Path(path)
    needed = ("time", "displacement", "force") if needs_force else ("time", "displacement")
    table, columns, unread = _columns(path, needed)
    temperatures = columns.get("temperature")
    if temperature_C is None:
        if temperatures is None:
            raise InputError(f"{table.where()}: the temperature is not said, and the file has no column of it")
        temperature_C = float(np.mean(temperatures))
    return DamperTest(
        name or path.stem,
        columns["time"],
        columns["displacement"],
        columns.get("force"),
        float(temperature_C),
        temperatures,
        title,
        use,
        str(path),
        tuple(unread),
        start,
        start_ramp,
    )


def read_displacement(path: Path | str) -> tuple[np.ndarray, np.ndarray]:
    """Read time (n,) s and displacement (n,) m of a test file; other columns may be there.

    Raises:
        InputError: the file cannot be read or is wrong.
    """
    _, columns, _ = _columns(Path(path), ("time", "displacement"))
    return columns["time"], columns["displacement"]


def write_test(path: Path | str, test: DamperTest) -> None:
    """Write a test as CSV in s, mm, kN, degC, nine digits; the file appears when it is whole.

    Raises:
        ArchiveError: it cannot be written.
    """
    headers = ["time_s", "displacement_mm"]
    columns = [test.time, 1e3 * test.displacement]
    if test.force is not None:
        headers.append("force_kN")
        columns.append(1e-3 * test.force)
    if test.temperature_history is not None:
        headers.append("temperature_C")
        columns.append(test.temperature_history)
    write_csv_file(headers, zip(*(column.tolist() for column in columns), strict=True), Path(path), digits=9)


def _columns(path: Path, needed: tuple[str, ...]) -> tuple[CsvTable, dict[str, np.ndarray], list[str]]:
    """Columns of a file in SI, checked as far as its lines matter, and the headers of those that are not read."""
    table = read_csv_table(path, _WHAT, EXAMPLE, names_quantity)
    columns, unread = columns_in_si(table)
    need(table, columns, *needed)
    time = columns["time"]
    if time.size < FEWEST:
        raise InputError(f"{path}:{table.lines[-1]}: a test needs at least {FEWEST} samples, not {time.size}")
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        same = "is the time of the line before" if time[at] == time[at - 1] else f"is before {time[at - 1]:g} s"
        raise InputError(f"{table.where(row=at)}: the time {time[at]:g} s {same}; times must ascend")
    if np.ptp(columns["displacement"]) == 0.0:
        raise InputError(f"{table.where(row=0)}: the displacement is the same in all lines; nothing moved")
    return table, columns, unread
