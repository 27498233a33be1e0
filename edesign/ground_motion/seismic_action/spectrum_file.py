"""Reader of spectra in CSV files, such as `edesign spectrum --csv` writes them."""

from __future__ import annotations

import csv
import re
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.units import ACCELERATION_UNITS
from edesign.project.actions.hazard_base import Hazard
from edesign.project.actions.spectrum_tables import SpectrumFile
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.problems import did_you_mean, listed
from edesign.project.reading.yaml_file import yaml_text
from edesign.tables.text import number

EXAMPLE = "T [s],Se [g]"
_UNIT = re.compile(r"[\[(]\s*([^\])]*?)\s*[\])]\s*$")
_SAME = {"m/s2": "m/s^2", "cm/s2": "cm/s^2", "mm/s2": "mm/s^2"}
_WHAT = "spectrum file"


def read_spectrum(hazard: Hazard, table: SpectrumFile) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Read periods and ordinates of a CSV file.

    The first line has headers with units in brackets, `T [s],Se [g]`; the first column is the period. Blank lines and
    lines that begin with # are skipped; commas or semicolons stand between the columns.

    Args:
        table: its name, and the header of the ordinates.

    Returns:
        Periods, s, and ordinates, m/s2.

    Raises:
        InputError: the file cannot be read, or a header, a unit or a number is wrong; with file and line.
    """
    path = hazard.path_of(table.file)
    text = yaml_text(hazard.content(table.file, lambda path: read_file(path, _WHAT)), path)
    lines = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip() and not line.startswith("#")]
    if not lines:
        raise InputError(f"{path}: the {_WHAT} is empty; its first line is like `{EXAMPLE}` [E-SPEC-05]")
    first, header = lines[0]
    delimiter = ";" if ";" in header else ","
    headers = [cell.strip() for cell in next(csv.reader([header], delimiter=delimiter))]
    if len(headers) < 2:
        raise InputError(f"{path}:{first}: two columns are needed, with headers like `{EXAMPLE}` [E-SPEC-05]")
    _period_unit(headers[0], path, first)
    at = _column(headers, table.column, path, first)
    unit = _acceleration_unit(headers[at], path, first)
    periods, ordinates = [], []
    for line, words in ((i, next(csv.reader([row], delimiter=delimiter))) for i, row in lines[1:]):
        if len(words) != len(headers):
            raise InputError(
                f"{path}:{line}: there are {len(words)} columns here, and {len(headers)} in line {first} [E-TABLE-07]"
            )
        periods.append(number(words[0].strip(), path, line, "a period"))
        ordinates.append(number(words[at].strip(), path, line, "a spectral acceleration") * unit)
    return tuple(periods), tuple(ordinates)


def _period_unit(header: str, path: Path, line: int) -> None:
    found = _UNIT.search(header)
    if found is None or found[1] != "s":
        raise InputError(
            f"{path}:{line}: the first column is `{header}`; it must be the period in s, like `T [s]` [E-SPEC-05]"
        )


def _column(headers: list[str], wanted: str | None, path: Path, line: int) -> int:
    if wanted is None:
        return 1
    if wanted not in headers[1:]:
        hint = did_you_mean(wanted, headers[1:])
        raise InputError(
            f"{path}:{line}: there is no column `{wanted}`{hint} (there are: {listed(headers[1:])}) [E-SPEC-06]"
        )
    return headers.index(wanted, 1)


def _acceleration_unit(header: str, path: Path, line: int) -> float:
    found = _UNIT.search(header)
    unit = _SAME.get(found[1], found[1]) if found is not None else ""
    if unit not in ACCELERATION_UNITS:
        raise InputError(
            f"{path}:{line}: the column `{header}` has no unit of acceleration in brackets, like `Se [g]` (allowed: "
            f"{listed(ACCELERATION_UNITS)}) [E-SPEC-05]"
        )
    return ACCELERATION_UNITS[unit]
