"""An open archive as people use it in Python and in notebooks: tables, datasets, and a short view of it."""

from __future__ import annotations

import os
from functools import cached_property
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.notebook import facts_html
from edesign.report.archived import input_checksum

if TYPE_CHECKING:
    import pandas
    import xarray

    from edesign.report.export.export_table import ExportTable


class OpenArchive(Archive):
    """An open archive with its tables and datasets; otherwise as `Archive`, whose arguments it takes."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.path.name}: {self.attributes.get('status', 'unknown')}>"

    def _repr_html_(self) -> str:
        about = self.attributes
        rows = [(name, about.get(name)) for name in ("title", "status", "kind", "edesign_version")]
        rows.append(("input SHA-256", input_checksum(about)))
        rows += [(place, self.names(place)) for place in self.names()]
        return facts_html(self.path.name, [*rows, ("damage", self.damage_in_short())])

    def tables(self) -> list[str]:
        """Return the names of all tables: those of the report, of `edesign show`, and of the variables in SI."""
        return [table.name for table in self._tables]

    def table(self, name: str) -> pandas.DataFrame:
        """Return a table as a data frame, with `attrs["units"]` by column.

        Args:
            name: one of `tables()`.

        Raises:
            InputError: there is no such table, or pandas is missing.
        """
        from edesign.report.export.catalogue import choose
        from edesign.report.export.frames import data_frame

        exact = [table for table in self._tables if table.name == name]
        return data_frame(exact[0] if exact else choose(self._tables, [name], str(self.path))[0])

    def dataset(self, place: str) -> xarray.Dataset:
        """Return a group with its coordinates, units and attributes.

        Args:
            place: `analyses/NAME`, `records/NAME`, `building/modes`; all of `archive.names("analyses")` and so on.

        Raises:
            ArchiveError: there is no such group, or it is damaged.
            InputError: xarray is missing.
        """
        from edesign.report.export.frames import dataset

        return dataset(self.group(place))

    def history(self, name: str) -> pandas.DataFrame:
        """Return the history or curve of an analysis, record or test as a data frame: a column for each place.

        Raises:
            InputError: it has none, or pandas is missing.
        """
        from edesign.report.export.frames import data_frame
        from edesign.report.export.value_tables import history_tables

        return data_frame(history_tables(self, [name])[0])

    @cached_property
    def _tables(self) -> list[ExportTable]:
        from edesign.report.export.catalogue import archive_tables

        return archive_tables(self)


def open_archive(path: str | os.PathLike[str], damaged: bool = False) -> OpenArchive:
    """Open an archive for reading, with its results as tables, data frames and data sets.

    Args:
        path: `NAME.h5` or `NAME.h5.partial`.
        damaged: open a damaged archive too, without what cannot be read of it; see `Archive.damage`.

    Raises:
        ArchiveError: missing, unreadable, damaged, or not an archive of edesign.
    """
    return OpenArchive(path, damaged)
