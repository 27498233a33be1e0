"""Steel sections as tables, a CSV file and plain data for JSON."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from edesign.archive.csv_files import write_csv_file
from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.channels import channel, channel_name, channel_names, gravity_centre
from edesign.frame.sections.profiles import profile_names
from edesign.frame.sections.section_lists import sections_of
from edesign.frame.sections.steel_section import steel_section
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import CM, CM2, CM3, CM4, MM, Unit

_KEYS = {
    "h_m": "h",
    "b_m": "b",
    "t_w_m": "tw",
    "t_f_m": "tf",
    "r_m": "r",
    "A_m2": "A",
    "I_y_m4": "I_y",
    "I_z_m4": "I_z",
    "i_y_m": "i_y",
    "i_z_m": "i_z",
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


_CHANNEL = (
    _property("h", MM),
    _property("b", MM),
    _property("t_w", MM, "tw", digits=3),
    _property("t_f", MM, "tf", digits=3),
    _property("A", CM2),
)
_INERTIAS = (_property("I_y", CM4), _property("I_z", CM4), _property("i_y", CM), _property("i_z", CM))


def _table(name: str, title: str, *columns: Column[SteelSection]) -> TableSpec[SteelSection]:
    """A table of sections of one shape, between their names and their masses."""
    every = (text("section", "name"), *columns, _property("mass", Unit("kg/m"), digits=3))
    return TableSpec[SteelSection](name, title, every, named_by_title=True)


def _centroid(section: SteelSection) -> Quantity:
    """The place of the centroid of a single channel, from the back of its web."""
    return Quantity(gravity_centre(section.name), CM, form=".4g", beside=True)


HOLLOW = _table(
    "hollow_sections",
    "Hollow sections (lengths in mm, i in cm, A in cm2, I in cm4, W in cm3, kg/m)",
    *(_property("h", MM), _property("b", MM), _property("t", MM, "tw", digits=3), _property("A", CM2)),
    *(*_INERTIAS, _property("W_pl", CM3, "W_pl_y")),
)
ANGLES = _table(
    "angles",
    "Angles about u and v (lengths in mm, i in cm, A in cm2, I in cm4, mass in kg/m)",
    *(_property("h", MM), _property("b", MM), _property("t", MM, "tw", digits=3), _property("r", MM, digits=3)),
    *(_property("A", CM2), _property("I_u", CM4, "I_y"), _property("I_v", CM4, "I_z")),
    *(_property("i_u", CM, "i_y"), _property("i_v", CM, "i_z")),
)
CHANNELS = _table(
    "channels",
    "Channels (sizes in mm, i and e from the back of the web in cm, cm2, cm4, kg/m)",
    *(*_CHANNEL, *_INERTIAS, col("e", CM, _centroid, silent=True)),
)
PAIRS = _table(
    "channel_pairs",
    "Pairs of channels back to back (sizes of one in mm, i in cm, cm2, cm4, kg/m)",
    *(*_CHANNEL, *_INERTIAS),
)
CORES = _table(
    "restrained_cores", "Cores of buckling-restrained braces (A in cm2, mass of the core in kg/m)", _property("A", CM2)
)
_TABLES = {"I": SECTIONS, "RHS": HOLLOW, "CHS": HOLLOW, "L": ANGLES, "U": CHANNELS, "2U": PAIRS, "BRB": CORES}


def chosen_sections(what: str | None) -> list[SteelSection]:
    """Return the sections that a family, a name or a pattern stands for; if None all rolled I sections.

    Raises:
        InputError: there is none; the message says what there is near it.
    """
    if what is None:
        return [steel_section(name) for name in profile_names()]
    one = channel_name(what)
    single = [one] if one is not None else channel_names().chosen(what) if what.upper().startswith("UP") else []
    return [channel(name) for name in single] or list(sections_of(what))


def section_tables(sections: Sequence[SteelSection]) -> list[Table]:
    """Return the properties of sections, a table a shape, narrow enough for 80 columns: the units are in the title."""
    of_shapes: dict[str, tuple[TableSpec[SteelSection], list[SteelSection]]] = {}
    for section in sections:
        spec = _TABLES[section.kind]
        of_shapes.setdefault(spec.name, (spec, []))[1].append(section)
    return [spec.of(found) for spec, found in of_shapes.values()]


def section_data(sections: Sequence[SteelSection]) -> list[dict[str, Any]]:
    """Return the properties of sections in SI, by keys that end in the unit; None where a shape has no such one."""
    return [
        {"name": section.name, "inch_pound_name": profile_names().inch_pound_name(section.name) or None}
        | {key: None if math.isnan(found := getattr(section, of)) else found for key, of in _KEYS.items()}
        for section in sections
    ]


def write_sections(sections: Sequence[SteelSection], path: Path) -> None:
    """Write the properties of sections as CSV, in the units of the tables, seven digits.

    Raises:
        ArchiveError: it cannot be written.
    """
    columns = (*SECTIONS.columns[1:], _property("i_y", CM), _property("i_z", CM))
    headers = ["section", "inch_pound_name", *(f"{of.header} [{of.unit_in_files}]" for of in columns)]
    rows = (
        (
            section.name,
            profile_names().inch_pound_name(section.name),
            *(_known(of.data(of.of(section))) for of in columns),
        )
        for section in sections
    )
    write_csv_file(headers, rows, path, _DIGITS)


def _known(cell: Any) -> Any:
    """A cell; None of a property that a shape has not."""
    return None if isinstance(cell, float) and math.isnan(cell) else cell
