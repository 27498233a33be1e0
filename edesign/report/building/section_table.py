"""The catalogue of rolled sections as a table, a CSV file and plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from edesign.archive.csv_files import write_csv_file
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.steel_section import SteelSection, steel_section
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import CM2, CM3, CM4, MM, Unit

_KEYS = {
    "h_m": "h",
    "b_m": "b",
    "t_w_m": "tw",
    "t_f_m": "tf",
    "r_m": "r",
    "A_m2": "A",
    "I_y_m4": "I_y",
    "I_z_m4": "I_z",
    "W_pl_y_m3": "W_pl_y",
    "mass_kg_m": "mass",
}
"""Keys of JSON, and the properties that they are of."""
_DIGITS = 7  # of a CSV file


def _property(header: str, unit: Unit, value: str = "", digits: int = 4) -> Column[SteelSection]:
    """A column of a property: narrow, without zeros at the end of numbers; the title says the unit."""

    def of(section: SteelSection) -> Quantity:
        found = getattr(section, value or header)
        form = ".0f" if found / unit.si >= 10**digits else f".{digits}g"
        return Quantity(found, unit, form=form, beside=True)

    return col(header, unit, of, silent=True)


SECTIONS = TableSpec[SteelSection](
    "rolled_sections",
    "Rolled I sections (lengths in mm, A in cm2, I in cm4, W in cm3, mass in kg/m)",
    (
        text("section", "name"),
        _property("h", MM),
        _property("b", MM, digits=3),
        _property("t_w", MM, "tw", digits=3),
        _property("t_f", MM, "tf", digits=3),
        _property("r", MM, digits=2),
        _property("A", CM2),
        _property("I_y", CM4),
        _property("I_z", CM4),
        _property("W_pl", CM3, "W_pl_y"),
        _property("mass", Unit("kg/m"), digits=3),
    ),
    named_by_title=True,
)


def chosen_sections(what: str | None) -> list[str]:
    """Return the names of the catalogue that a family, a name or a pattern stands for, all of them if None.

    Raises:
        InputError: there is none; the message says what there is near it.
    """
    names = profile_names()
    found = list(names) if what is None else names.chosen(what)
    if not found:
        raise InputError(f"no section of the catalogue is `{what}`; {names.near(what or '')} [E-NAME-01]")
    return found


def section_table(names: Sequence[str]) -> Table:
    """Return the properties of sections, narrow enough for 80 columns: the units are in the title."""
    return SECTIONS.of(map(steel_section, names))


def section_data(names: Sequence[str]) -> list[dict[str, Any]]:
    """Return the properties of sections in SI, by keys that end in the unit."""
    return [
        {"name": name, "inch_pound_name": profile_names().inch_pound_name(name) or None}
        | {key: getattr(steel_section(name), of) for key, of in _KEYS.items()}
        for name in names
    ]


def write_sections(names: Sequence[str], path: Path) -> None:
    """Write the properties of sections as CSV, in the units of the table, seven digits.

    Raises:
        ArchiveError: it cannot be written.
    """
    _, *columns = SECTIONS.columns
    headers = ["section", "inch_pound_name", *(f"{of.header} [{of.unit_in_files}]" for of in columns)]
    rows = (
        (name, profile_names().inch_pound_name(name), *(of.data(of.of(steel_section(name))) for of in columns))
        for name in names
    )
    write_csv_file(headers, rows, path, _DIGITS)
