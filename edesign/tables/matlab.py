"""MATLAB files of dSPACE's ControlDesk: a structure with times X and signals Y, as columns."""

from __future__ import annotations

import struct
import zlib
from contextlib import suppress
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from edesign.errors import InputError
from edesign.file_kinds.recognise import head_of
from edesign.project.reading.file_bytes import too_large
from edesign.project.reading.limits import TABLE_BYTES

MARK = "dSPACE"
_FIVE = b"MATLAB 5.0 MAT-file"
_COMPRESSED = 15  # type of an element, miCOMPRESSED
_PORTS = ("Out", "In", "Value")  # of a block, behind its path: the signal has the name of the block


def is_matlab(content: bytes) -> bool:
    """Return whether a file is one of MATLAB, in the format 5 (`save -v6` and `-v7`).

    Args:
        content: of the file, or its beginning.
    """
    return content.startswith(_FIVE)


def is_matlab_file(path: Path) -> bool:
    """Return whether a file is one of MATLAB; False too if it cannot be read, which its reader reports."""
    return is_matlab(head_of(path) or b"")


def read_signals(path: Path, content: bytes) -> tuple[list[str], np.ndarray]:
    """Read the times and the signals of a capture.

    Args:
        path: the file, for messages.

    Returns:
        Headers: `time (s)`, then the path of each signal with its unit, if the file has it; and rows (n, columns).

    Raises:
        InputError: the file is damaged, holds no capture or several, signals have times of their own, or a signal is no
            series of finite numbers.

    Source: scripts that read such files, in public: `NAME.X(1).Data`, `NAME.Y(i).Name`, `.Path` and `.Data` in AcqTools
        (Hori-Fujimoto laboratory) and others; plotOutputDSpace of OpenFresco.
    """
    from scipy.io import loadmat

    _check_size(path, content)
    try:
        variables = loadmat(BytesIO(content), struct_as_record=False, squeeze_me=True)
    except Exception as error:  # scipy raises whatever its parser meets
        raise InputError(f"{path}: the MATLAB file is damaged: {error} [E-TABLE-02]") from None
    found = {name: value for name, value in variables.items() if not name.startswith("__")}
    captures = {name: value for name, value in found.items() if hasattr(value, "X") and hasattr(value, "Y")}
    if len(captures) != 1:
        said = f"{len(captures)} captures of dSPACE" if captures else "no capture of dSPACE, a structure with X and Y"
        raise InputError(
            f"{path}: the MATLAB file holds {said} (it has: {', '.join(found) or 'nothing'}); write one as CSV, in "
            "MATLAB by `writetable` [E-TABLE-14]"
        )
    ((name, capture),) = captures.items()
    axes = [_numbers(path, f"{name}.X({i})", one) for i, one in enumerate(np.atleast_1d(capture.X), 1)]
    signals = np.atleast_1d(capture.Y)
    if any(not np.array_equal(axes[0], axis) for axis in axes[1:]):
        raise InputError(
            f"{path}: {name} has {len(axes)} columns of times that differ; export signals of one raster [E-TABLE-13]"
        )
    headers, columns = ["time (s)"], [axes[0]]
    for i, signal in enumerate(signals, 1):
        values = _numbers(path, f"{name}.Y({i})", signal)
        if values.shape != axes[0].shape:
            raise InputError(
                f"{path}: {name}.Y({i}) has {values.size} samples, and the times {axes[0].size}; export signals of one "
                "raster [E-TABLE-13]"
            )
        headers.append(_header(signal, i))
        columns.append(values)
    return headers, np.column_stack(columns)


def _check_size(path: Path, content: bytes) -> None:
    """Refuse a file whose variables are too large once they are decompressed.

    Source: MathWorks, MAT-File Format, level 5: after 128 bytes, elements with their type and number of bytes.
    """
    order = ">" if content[126:128] == b"MI" else "<"
    at, left = 128, TABLE_BYTES
    while at + 8 <= len(content) and left >= 0:
        kind, size = struct.unpack_from(f"{order}2I", content, at)
        if kind == _COMPRESSED:
            with suppress(zlib.error):  # which the reader reports
                left -= len(zlib.decompressobj().decompress(content[at + 8 : at + 8 + size], left + 1))
        at += 8 + size
    if left < 0:
        raise too_large(path, "table", TABLE_BYTES + 1, TABLE_BYTES)


def _numbers(path: Path, what: str, thing: Any) -> np.ndarray:
    data = np.atleast_1d(np.asarray(getattr(thing, "Data", np.nan)))
    if data.ndim != 1 or data.dtype.kind not in "iufb" or not np.isfinite(data).all():
        raise InputError(f"{path}: {what}.Data is no series of finite numbers [E-TABLE-13]")
    return data.astype(float)


def _header(signal: Any, number: int) -> str:
    """Path of a signal to the block that it comes from, with its unit."""
    texts = {key: str(getattr(signal, key, "")).replace('"', "").strip() for key in ("Path", "Name", "Unit")}
    parts = [part for part in f"{texts['Path']}/{texts['Name']}".split("/") if part not in ("", "[]")]
    if len(parts) > 1 and parts[-1].rstrip("0123456789") in _PORTS:
        parts.pop()
    name = "/".join(parts) or f"Y{number}"
    unit = texts["Unit"]
    return f"{name} ({unit})" if unit not in ("", "-", "[]") else name
