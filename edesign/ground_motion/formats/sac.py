"""Reader of binary SAC files of evenly sampled accelerations; the format does not say their unit.

Source: SAC Users Manual, IRIS, file format: 70 reals, 40 integers and 192 characters of header, then reals of 4 bytes.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.file_kinds.recognise import head_of
from edesign.ground_motion.formats.channels import Channel, choose
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.time_steps import check_step
from edesign.ground_motion.formats.units import ACCELERATION_UNITS, acceleration_factor
from edesign.ground_motion.record import Record
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.problems import listed

_HEADER = 632  # bytes
_INTEGERS, _TEXTS = 280, 440  # bytes before them
_STEP, _MINIMUM, _MAXIMUM = 0, 1, 2  # of the reals, from 0
_VERSION, _COUNT, _TYPE, _QUANTITY, _EVEN = 6, 9, 15, 16, 35  # of the integers, from 0
_VERSIONS = (6, 7)
_TIME_SERIES = 1
_QUANTITIES = {6: "displacement", 7: "velocity", 50: "volts"}  # accelerations are 8; 5 is unknown
_STATION, _COMPONENT, _NETWORK = slice(0, 8), slice(160, 168), slice(168, 176)  # of the characters
_UNDEFINED = -12345.0


def is_sac(path: Path) -> bool:
    """Say whether a file is of this format: its header has a version of it, and its length is that of its samples."""
    head = head_of(path)
    return head is not None and _byte_order(head[:_HEADER], path.stat().st_size) is not None


def read_sac(path: Path | str, acceleration_unit: str, component: str | None = None, name: str = "") -> Record:
    """Read a file of one component.

    Args:
        acceleration_unit: of the samples: "g", "m/s^2", "cm/s^2", "mm/s^2", also with a number ("g/10").
        component: if given it must be that of the file: its channel code (`HNE`) or the last letter of it.
        name: of the record; its file name without ending by default.

    Raises:
        InputError: not of this format, spectra or uneven samples, velocities or displacements, no unit, fewer samples
            than the header says, peaks that are not those of the header, or another component.
    """
    path = Path(path)
    data = read_file(path, "record file")
    order = _byte_order(data[:_HEADER], len(data))
    if order is None:
        raise InputError(f"{path}: this is no SAC file: its header, or its length, is not of this format [E-REC-01]")
    factor = acceleration_factor(acceleration_unit) if acceleration_unit else None
    if factor is None:
        seen = f"not `{acceleration_unit}`" if acceleration_unit else "the file does not say it"
        raise InputError(
            f"{path}: declare the unit of the accelerations, {listed(ACCELERATION_UNITS)}; {seen} [E-REC-11]"
        )
    reals = np.frombuffer(data, f"{order}f4", 70)
    integers = np.frombuffer(data, f"{order}i4", 40, _INTEGERS)
    if integers[_TYPE] != _TIME_SERIES or not integers[_EVEN]:
        raise InputError(
            f"{path}: only evenly sampled histories are read from SAC files, no spectra or pairs [E-REC-09]"
        )
    if int(integers[_QUANTITY]) in _QUANTITIES:
        raise InputError(
            f"{path}: the file holds {_QUANTITIES[int(integers[_QUANTITY])]}; only accelerations are read [E-REC-09]"
        )
    samples = np.frombuffer(data, f"{order}f4", int(integers[_COUNT]), _HEADER).astype(float)
    _check_peaks(path, reals, samples)
    texts = data[_TEXTS:_HEADER].decode("latin-1")
    station, channel, network = (_said(texts[part]) for part in (_STATION, _COMPONENT, _NETWORK))
    step = float(np.format_float_positional(reals[_STEP]))  # the shortest decimal number of this single precision
    check_step(f"{path}: header", step)
    about = ", ".join(part for part in ("SAC", ".".join(part for part in (network, station) if part)) if part)
    acceleration = (factor * samples).tolist()
    return choose(path, [Channel(channel, (channel[-1:],), acceleration, step, about)], component).record(path, name)


def _byte_order(head: bytes, size: int) -> str | None:
    """How numpy calls the order of the bytes; None: the header, or the size of the file (bytes), is of no SAC file."""
    if len(head) < _HEADER:
        return None
    for order in "<>":
        integers = np.frombuffer(head, f"{order}i4", 40, _INTEGERS)
        count = int(integers[_COUNT])
        if integers[_VERSION] in _VERSIONS and count > 1 and size >= _HEADER + 4 * count:
            return order
    return None


def _check_peaks(path: Path, reals: np.ndarray, samples: np.ndarray) -> None:
    """The extremes are those of the header, where it has them, to single precision."""
    for at, found in ((_MINIMUM, float(samples.min())), (_MAXIMUM, float(samples.max()))):
        stated = float(reals[at])
        if stated != _UNDEFINED:
            check_peak(f"{path}: header", f"{stated:.6E}", found, "(unit of the file)", 1e-6 * abs(found))


def _said(text: str) -> str:
    plain = text.split("\0")[0].strip()
    return "" if plain == "-12345" else plain
