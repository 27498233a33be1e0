"""The catalogue of rolled sections as a table, a CSV file and plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from edesign.archive.csv_files import write_csv_file
from edesign.building.sections.profiles import profile_names
from edesign.building.sections.steel_section import steel_section
from edesign.errors import InputError
from edesign.report.tables.table import Table, formatted

_HEADERS = ("h", "b", "t_w", "t_f", "r", "A", "I_y", "I_z", "W_pl", "mass")
_UNITS = ("mm", "mm", "mm", "mm", "mm", "cm2", "cm4", "cm4", "cm3", "kg/m")
_IN_SI = (1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-4, 1e-8, 1e-8, 1e-6, 1.0)
_KEYS = ("h_m", "b_m", "t_w_m", "t_f_m", "r_m", "A_m2", "I_y_m4", "I_z_m4", "W_pl_y_m3", "mass_kg_m")
_SHOWN_DIGITS = {"b": 3, "t_w": 3, "t_f": 3, "r": 2, "mass": 3}  # of the table, so that it fits; others four
_DIGITS = 7  # of a CSV file


def chosen_sections(what: str | None) -> list[str]:
    """Return the names of the catalogue that a family, a name or a pattern stands for, all of them if None.

    Raises:
        InputError: there is none; the message says what there is near it.
    """
    names = profile_names()
    found = list(names) if what is None else names.chosen(what)
    if not found:
        raise InputError(f"no section of the catalogue is `{what}`; {names.near(what or '')}")
    return found


def section_table(names: Sequence[str]) -> Table:
    """Return the properties of sections, narrow enough for 80 columns: the units are in the title."""
    title = "Rolled I sections (lengths in mm, A in cm2, I in cm4, W in cm3, mass in kg/m)"
    table = Table(title, ("section", *_HEADERS))
    for name in names:
        values = [value / unit for value, unit in zip(_values(name), _IN_SI, strict=True)]
        table.rows.append([name, *(_shown(value, header) for value, header in zip(values, _HEADERS, strict=True))])
    return table


def section_data(names: Sequence[str]) -> list[dict[str, Any]]:
    """Return the properties of sections in SI, by keys that end in the unit."""
    return [
        {"name": name, "inch_pound_name": profile_names().inch_pound_name(name) or None}
        | dict(zip(_KEYS, _values(name), strict=True))
        for name in names
    ]


def write_sections(names: Sequence[str], path: Path) -> None:
    """Write the properties of sections as CSV, in the units of the table, seven digits.

    Args:
        names: names of sections.
        path: the file to be written.

    Raises:
        ArchiveError: it cannot be written.
    """
    headers = ["section", "inch_pound_name"]
    headers += [f"{header} [{unit}]" for header, unit in zip(_HEADERS, _UNITS, strict=True)]
    rows = (
        [name, profile_names().inch_pound_name(name)]
        + [value / unit for value, unit in zip(_values(name), _IN_SI, strict=True)]
        for name in names
    )
    write_csv_file(headers, rows, path, _DIGITS)


def _values(name: str) -> tuple[float, ...]:
    found = steel_section(name)
    return (found.h, found.b, found.tw, found.tf, found.r, found.A, found.I_y, found.I_z, found.W_pl_y, found.mass)


def _shown(value: float, header: str) -> str:
    digits = _SHOWN_DIGITS.get(header, 4)
    return formatted(value, ".0f") if value >= 10**digits else formatted(value, f".{digits}g")
