"""Test files: CSV with time, displacement, force, and temperature where it was measured."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

import numpy as np

from edesign.archive.csv_files import write_csv_file
from edesign.damper.testing.measured_histories import FEWEST, DamperTest, Use, gaps
from edesign.damper.testing.start import StartKind
from edesign.errors import InputError
from edesign.project.notation.table_format import TableFormat
from edesign.tables.columns import Chosen, columns_in_si, need
from edesign.tables.table import Table, read_table

EXAMPLE = "time_s,displacement_mm,force_kN"
_WHAT = "test file"
_AT_REST = 5e-3
"""Of the range of the displacement: within so much of the first sample the specimen has not moved yet. A sine from its
zero leaves it after 0.0016 of a period, a fraction of a sample at 100 samples a cycle."""
_FEWEST_AT_REST = 10
"""Samples: fewer are the beginning of a motion that starts slowly."""
DisplacementZero = Literal["as_recorded", "first_sample", "rest"]
"""What counts as no displacement: the zero of the transducer, the first sample, or the mean of the rest before."""


@dataclass(frozen=True)
class TestReading:
    """Declared form of the file of a test; what is not declared is found.

    Attributes:
        table: of the format of the table.
        columns: of its columns.
        time_step: s; of a table without a column of times.
        zero: what counts as no displacement.
    """

    __test__ = False  # no test of pytest

    table: TableFormat | None = None
    columns: Chosen = field(default_factory=Chosen)
    time_step: float | None = None
    zero: DisplacementZero = "as_recorded"


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
    said: TestReading | None = None,
    unsaid: str = "the entry of this test in `tests` says it, by `temperature: 20 degC`, whatever its law",
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
        start: how the test begins, see `DamperTest`.
        start_ramp: s, see `DamperTest`.
        said: of how the file is read.
        unsaid: how the temperature is said, for people.

    Returns:
        The test.

    Raises:
        InputError: the file cannot be read or is wrong, or no temperature is known.
    """
    path = Path(path)
    needed = ("time", "displacement", "force") if needs_force else ("time", "displacement")
    said = said or TestReading()
    table, columns, unread = _columns(path, needed, said)
    displacement, zero = _from_zero(table, columns["time"], columns["displacement"], said.zero)
    temperatures = columns.get("temperature")
    if temperature_C is None:
        if temperatures is None:
            raise InputError(
                f"{table.where()}: the temperature is not said, and the file has no column of it; {unsaid} [E-TEST-02]"
            )
        temperature_C = float(np.mean(temperatures))
    return DamperTest(
        name or path.stem,
        columns["time"],
        displacement,
        columns.get("force"),
        float(temperature_C),
        temperatures,
        title,
        use,
        str(path),
        tuple(unread),
        start,
        start_ramp,
        "; ".join(part for part in (table.form.words, zero, _gaps(table, columns["time"])) if part),
    )


def read_displacement(path: Path | str) -> tuple[np.ndarray, np.ndarray]:
    """Read time (n,) s and displacement (n,) m of a test file; other columns may be there.

    Args:
        path: of the CSV file.

    Raises:
        InputError: the file cannot be read or is wrong.
    """
    _, columns, _ = _columns(Path(path), ("time", "displacement"))
    return columns["time"], columns["displacement"]


def write_test(path: Path | str, test: DamperTest) -> None:
    """Write a test as CSV in s, mm, kN, degC, nine digits; the file appears when it is whole.

    Args:
        path: of the CSV file.
        test: the record.

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


def rest_before(displacement: np.ndarray) -> int:
    """Return how many samples of a displacement are rest before the motion; 0: it shows none.

    Args:
        displacement: (n,) m.
    """
    moved = np.abs(displacement - displacement[0]) > _AT_REST * np.ptp(displacement)
    samples = int(np.argmax(moved))
    return samples if samples >= _FEWEST_AT_REST else 0


def _gaps(table: Table, time: np.ndarray) -> str:
    """Say where samples are missing; a rate of sampling that changes and stays so is no gap."""
    found = gaps(time)
    if not found.size:
        return ""
    first = int(found[0])
    more = "" if found.size == 1 else f" and before {found.size - 1} more"
    return (
        f"no samples for {time[first + 1] - time[first]:.3g} s before line {table.lines[first + 1]}{more}, interpolated"
    )


def _from_zero(
    table: Table, time: np.ndarray, displacement: np.ndarray, zero: DisplacementZero
) -> tuple[np.ndarray, str]:
    """Displacement (n,) m from what counts as none, and what is to be noted of its beginning."""
    samples = rest_before(displacement)
    rest = f"rest before the motion for {time[samples] - time[0]:.3g} s" if samples else ""
    if zero == "as_recorded":
        first = float(displacement[0])
        if abs(first) <= _AT_REST * np.ptp(displacement):
            return displacement, rest
        note = f"the first sample is displaced by {1e3 * first:.3g} mm, taken as recorded"
        return displacement, ", ".join(part for part in (note, rest) if part)
    if zero == "rest" and not samples:
        raise InputError(
            f"{table.where(row=0)}: the displacement moves from the first samples on, so there is no rest to take its "
            "zero from; `first_sample` and `as_recorded` are left [E-TEST-03]"
        )
    offset = float(np.mean(displacement[:samples])) if zero == "rest" else float(displacement[0])
    whose = "the rest" if zero == "rest" else "the first sample"
    note = f"{1e3 * offset:.3g} mm, the displacement of {whose}, taken off all"
    return displacement - offset, ", ".join(part for part in (note, rest) if part)


def _columns(
    path: Path, needed: tuple[str, ...], said: TestReading | None = None
) -> tuple[Table, dict[str, np.ndarray], list[str]]:
    """Columns of a file in SI, checked as far as its lines matter, and the headers of those that are not read."""
    said = said or TestReading()
    table = read_table(path, _WHAT, EXAMPLE, said.columns.names, given=said.table, read=said.columns.read_of)
    columns, unread = columns_in_si(table, said.columns)
    if said.time_step is not None:
        if "time" in columns:
            raise InputError(
                f"{table.where()}: a time step is said, and the file has a column of times; give one [E-TEST-03]"
            )
        columns = {"time": said.time_step * np.arange(table.rows.shape[0])} | columns
    need(table, columns, *needed)
    time = columns["time"]
    if time.size < FEWEST:
        raise InputError(
            f"{path}:{table.lines[-1]}: a test needs at least {FEWEST} samples, not {time.size} [E-TEST-04]"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        same = "is the time of the line before" if time[at] == time[at - 1] else f"is before {time[at - 1]:g} s"
        again = time[at] <= time[0] and at >= FEWEST
        another = "; does another test begin here? Each test needs a file of its own" if again else ""
        raise InputError(
            f"{table.where(row=at)}: the time {time[at]:g} s {same}; times must ascend{another} [E-TEST-05]"
        )
    if np.ptp(columns["displacement"]) == 0.0:
        raise InputError(f"{table.where(row=0)}: the displacement is the same in all lines; nothing moved [E-TEST-06]")
    return table, columns, unread
