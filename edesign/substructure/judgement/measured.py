"""Measured records of a rig: CSV with time, target, command, displacement, actuator and forces, evenly sampled."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean, listed
from edesign.tables.quantities import DISPLACEMENT, FORCE, TIME, Units
from edesign.tables.table import Table, read_table

HEADERS = ("time_s", "target_mm", "command_mm", "displacement_mm", "actuator_mm", "force_kN")
"""As virtual tests are written."""
APPLIED_FORCE = "applied_force_kN"
"""Header of the force on the numerical part, where a compensator corrects what is measured."""
EXAMPLE = ",".join(HEADERS)
COLUMNS: dict[str, tuple[Units, tuple[str, ...]]] = {
    "time": (TIME, ("time",)),
    "target": (DISPLACEMENT, ("target", "target displacement")),
    "command": (DISPLACEMENT, ("command", "command displacement")),
    "displacement": (DISPLACEMENT, ("displacement", "measured", "encoder", "measured displacement")),
    "actuator": (DISPLACEMENT, ("actuator", "lvdt", "actuator displacement", "stroke")),
    "force": (FORCE, ("force", "load", "measured force")),
    "applied_force": (FORCE, ("applied force",)),
}
"""Quantities with their units, and the names that they have in headers."""
SHARE_OF_STEP = 0.02
"""By which a sample may be off an even grid: 0.02 ms of 1 ms, a tenth of the accuracy that a delay is wanted with."""
FEWEST = 20
"""Samples: fewer are no record of a test."""
_HEADER = re.compile(r"(?P<name>[^\[(]*?)(?:[_ ](?P<unit>[A-Za-z]+)|\s*[\[(](?P<bracketed>[^\])]*)[\])])")
_CLIPPED_RUN = 4
"""Equal samples at the end of a range: two lie on both sides of any peak, a third may be the peak itself."""
_JUMP = 10.0
"""Steps of the record's own resolution r with which a channel runs into the end of its range.

A peak -a k^2/2 that stays within r over four samples has a <= 8 r/9, and comes to them in a step of 2 a <= 1.8 r;
rounding adds r. So 2.8 are the most of a smooth motion; the rest is for ones that come to rest at their largest value.
"""


@dataclass(frozen=True)
class MeasuredRecord:
    """A record of a test in the laboratory, in SI.

    Attributes:
        path: the file.
        time: (n,) s.
        step: between samples, s.
        channels: (n,) m, N by `COLUMNS`; those that the file has.
        unread: headers of columns of other quantities.
    """

    path: Path
    time: np.ndarray
    step: float
    channels: Mapping[str, np.ndarray]
    unread: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> np.ndarray:
        """A channel that was asked for as needed."""
        return self.channels[name]


def read_measured(path: Path | str, *needed: str) -> MeasuredRecord:
    """Read a record, as `edesign rts run --csv` or a laboratory writes it.

    Args:
        path: CSV with headers as `EXAMPLE`, in any order and in other units (`target_m`, `Force (N)`).
        *needed: names of `COLUMNS` that must be there, beside the time.
        needed: names of `COLUMNS` that must be there, beside the time.

    Raises:
        InputError: the file cannot be read, a column is missing or twice, its unit is wrong, a needed one is constant,
            times do not ascend, or the sampling is uneven.
    """
    path = Path(path)
    table = read_table(path, "measured record", EXAMPLE, lambda header: _quantity(_name_and_unit(header)[0]) != "")
    channels, unread = _columns(table)
    for name in ("time", *needed):
        if name not in channels:
            example = f"{name}_{next(iter(COLUMNS[name][0]))}"
            raise InputError(
                f"{table.where()}: there is no column of {name}, such as `{example}` (the columns are: "
                f"{', '.join(table.headers)}) [E-MEAS-01]"
            )
    time = channels.pop("time")
    if time.size < FEWEST:
        raise InputError(
            f"{path}:{table.lines[-1]}: {time.size} samples are no record; at least {FEWEST} are needed [E-MEAS-02]"
        )
    step = _even_step(table, time)
    for name in needed:
        if np.ptp(channels[name]) == 0.0:
            raise InputError(f"{path}: the {name} is the same in all lines; was its channel connected? [E-MEAS-03]")
    return MeasuredRecord(path, time, step, channels, tuple(unread))


def clipped(values: np.ndarray) -> float | None:
    """Return the level at which a channel is cut off, None if it is not.

    A smooth motion comes to its peak in steps of the resolution of the record; one that is cut off runs into a level
    with its own speed and stays there.

    Args:
        values: (n,).

    Returns:
        The level in the unit of the channel, or None.
    """
    steps = np.abs(np.diff(values))
    moves = steps[steps > 0.0]
    if not moves.size:
        return None
    resolution = float(np.min(moves))
    for level in (float(np.max(values)), float(np.min(values))):
        at = np.flatnonzero(values == level)
        runs = np.split(at, np.flatnonzero(np.diff(at) > 1) + 1)
        for run in runs:
            before = steps[run[0] - 1] if run[0] > 0 else 0.0
            if run.size >= _CLIPPED_RUN and before > _JUMP * resolution:
                return level
    return None


def _columns(table: Table) -> tuple[dict[str, np.ndarray], list[str]]:
    found: dict[str, np.ndarray] = {}
    unread = []
    for i, header in enumerate(table.headers):
        name, unit = _name_and_unit(header)
        quantity = _quantity(name)
        if not quantity:
            near = did_you_mean(name.strip().lower(), COLUMNS)
            if near:
                raise InputError(
                    f"{table.where(i)}: the column is unknown{near} (allowed: {listed(COLUMNS, 10)}) [E-MEAS-01]"
                )
            unread.append(header)
            continue
        if quantity in found:
            raise InputError(f"{table.where(i)}: there is a column of {quantity} already [E-MEAS-01]")
        units = COLUMNS[quantity][0]
        if unit not in units:
            said = f"the unit `{unit}` is none of {quantity}" if unit else "the unit is missing"
            allowed = ", ".join(f"`{quantity}_{one}`" for one in units)
            raise InputError(f"{table.where(i)}: {said} (allowed: {allowed}) [E-TABLE-12]")
        factor, zero = units[unit]
        found[quantity] = factor * table.rows[:, i] + zero
    return found, unread


def _name_and_unit(header: str) -> tuple[str, str]:
    """Name and unit of `target_mm` or `Force (kN)`; the unit of a bare name is empty."""
    match = _HEADER.fullmatch(header.strip())
    if match is None or _quantity(header):
        return header, ""
    return match["name"], (match["unit"] or match["bracketed"] or "").strip()


def _quantity(name: str) -> str:
    """The quantity of `COLUMNS` that a name stands for; empty: another one."""
    plain = name.strip().lower().replace("_", " ")
    return next((quantity for quantity, (_, names) in COLUMNS.items() if plain in names), "")


def _even_step(table: Table, time: np.ndarray) -> float:
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        raise InputError(f"{table.where(row=at)}: the time {time[at]:g} s is not after {time[at - 1]:g} s [E-MEAS-02]")
    step = float(time[-1] - time[0]) / (time.size - 1)
    off = time - (time[0] + step * np.arange(time.size))
    worst = int(np.argmax(np.abs(off)))
    if abs(off[worst]) > max(SHARE_OF_STEP * step, 0.51 * _printed_digit(time)):
        raise InputError(
            f"{table.where(row=worst)}: the sampling is uneven: this sample is {1e3 * abs(off[worst]):.3g} ms off an "
            f"even step of {1e3 * step:.6g} ms; are samples missing? [E-MEAS-02]"
        )
    return step


def _printed_digit(time: np.ndarray) -> float:
    """The last decimal with which times were written, s: they are rounded to it."""
    for digits in range(10):
        if np.allclose(time, np.round(time, digits), rtol=0.0, atol=1e-12 * max(float(np.max(np.abs(time))), 1.0)):
            return 10.0**-digits
    return 0.0
