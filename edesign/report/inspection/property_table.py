"""What is found in a table of measured properties of a damper, and the study that reads it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.damper.testing.property_table import COLUMNS, read_property_table
from edesign.errors import InputError
from edesign.report.inspection.account import Account, Column, ends, quoted
from edesign.tables.table import read_table

_TELLING = ("shear_strain_percent", "G_storage_MPa", "G_eq_MPa", "loss_factor")  # no record or test has them
_QUANTITIES = {
    "temperature_C": ("temperature", "degC"),
    "shear_strain_percent": ("shear strain", "%"),
    "frequency_Hz": ("frequency", "Hz"),
    "G_storage_MPa": ("storage modulus", "MPa"),
    "G_eq_MPa": ("equivalent shear modulus", "MPa"),
    "loss_factor": ("loss factor", "1"),
}


def property_table_account(path: Path) -> Account | None:
    """Look at a table as at measured properties; None: no header names a strain, a modulus or a loss factor.

    Raises:
        InputError: the table is one of properties, and cannot be read as such.
    """
    try:
        table = read_table(path, "property table", ",".join(COLUMNS))
    except InputError:
        return None
    if not set(_TELLING) & set(table.headers):
        return None
    read_property_table(path)
    columns = tuple(
        Column(i + 1, header, *_QUANTITIES[header], float(np.min(table.rows[:, i])), float(np.max(table.rows[:, i])))
        for i, header in enumerate(table.headers)
    )
    first, last = ends(table.rows, table.lines)
    text = f"designs:\n  NAME:\n    properties: {{file: {quoted(path.name)}}}\n"
    return Account(path, "property table", table.form, columns, table.rows.shape[0], first, last, None, text)
