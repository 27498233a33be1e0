"""Tables as data frames of pandas, and groups of an archive as datasets of xarray."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from edesign.archive.dataset import Group, Variable
from edesign.errors import InputError
from edesign.report.export.catalogue import named_tables
from edesign.report.export.export_table import ExportTable
from edesign.report.tables.table import Table

if TYPE_CHECKING:
    import pandas
    import xarray

_ATTRIBUTES = (str, int, float)


def data_frame(table: ExportTable) -> pandas.DataFrame:
    """Return a table as a data frame.

    Its columns are named in words; `attrs` has `units` by column, `title`, `notes`, and `long_names` of variables.

    Raises:
        InputError: pandas is missing.
    """
    try:
        import pandas
    except ImportError as error:
        raise InputError("a table needs the package pandas: pip install 'edesign[tables]' [E-CLI-06]") from error
    frame = pandas.DataFrame({column.name: pandas.Series(list(column.values)) for column in table.columns})
    frame.attrs = {
        "title": table.title,
        "units": {column.name: column.unit for column in table.columns if column.unit},
        "long_names": {column.name: column.long_name for column in table.columns if column.long_name},
        "notes": list(table.notes),
    }
    return frame


def data_frames(tables: Iterable[Table]) -> dict[str, pandas.DataFrame]:
    """Return tables of any report, such as `edesign.report.calibration.tables.tables_of`, as data frames by name.

    Args:
        tables: whose columns the data frames have, under the names that files give them.
    """
    made = named_tables([(table.title, table) for table in tables if table.rows])
    return {table.name: data_frame(table) for table in made}


def dataset(group: Group) -> xarray.Dataset:
    """Return a group as a dataset with its coordinates; attributes `units` and `long_name` are those of the archive.

    Attributes of the group that are texts or numbers are those of the dataset.

    Raises:
        InputError: xarray is missing.
    """
    try:
        import xarray
    except ImportError as error:
        raise InputError("a dataset needs the package xarray: pip install 'edesign[tables]' [E-CLI-06]") from error
    about = {name: value for name, value in group.attributes.items() if isinstance(value, _ATTRIBUTES)}
    return xarray.Dataset(
        {name: _entry(variable) for name, variable in group.variables.items()},
        {name: _entry(variable) for name, variable in group.coords.items()},
        about,
    )


def _entry(variable: Variable) -> tuple[tuple[str, ...], Any, dict[str, str]]:
    about = {"units": variable.unit, "long_name": variable.long_name}
    return variable.dims, variable.values, {name: text for name, text in about.items() if text}
