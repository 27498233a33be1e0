"""Where the files of records are, for all files that have `records`."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Protocol

from edesign.project.records.pairs import AnyRecord
from edesign.project.records.records import FileRecord, RecordsOfSuite
from edesign.project.records.suite_names import suite_file


class RecordChoice(Protocol):
    """The recordings that were chosen for a record of a project."""

    @property
    def factors(self) -> Mapping[str, float]:
        """The factor on each chosen recording, by its name."""
        ...


class HoldsRecords(Protocol):
    """A file with `records`: a project, or substructure tests."""

    @property
    def records(self) -> Mapping[str, AnyRecord]:
        """The records by name."""
        ...

    @property
    def path(self) -> Path:
        """The path of the file."""
        ...

    @property
    def folder(self) -> Path:
        """The folder that paths in the file are relative to."""
        ...

    def where(self, *keys: str | int) -> str:
        """Return `file:line:column` of a key path."""
        ...

    def record_path(self, name: str) -> Path:
        """Return the file of a record."""
        ...

    def suite_folders(self, name: str) -> list[Path]:
        """Return the folders in which the recordings of a suite are looked for."""
        ...

    def suite_path(self, name: str) -> Path:
        """Return the suite file of a record."""
        ...

    def record_choice(self, name: str) -> RecordChoice | None:
        """Return the choice that was made for a record; None if none was made."""
        ...


class RecordFiles:
    """The methods shared by models of files with `records`."""

    def record_path(self: HoldsRecords, name: str) -> Path:
        """Return the file of a record that is given by `file`.

        Raises:
            KeyError: no record of this name is a file.
        """
        record = self.records[name]
        if not isinstance(record, FileRecord):
            raise KeyError(name)
        return self.folder / record.file

    def suite_folders(self: HoldsRecords, name: str) -> list[Path]:
        """Return the folders that are searched for the recordings of a suite.

        Raises:
            KeyError: no record of this name is a suite.
        """
        record = self.records[name]
        if not isinstance(record, RecordsOfSuite):
            raise KeyError(name)
        return [self.folder / folder for folder in record.folders]

    def suite_path(self: HoldsRecords, name: str) -> Path:
        """Return the suite file of a record that is given by `suite`.

        Raises:
            KeyError: no record of this name is a suite.
        """
        record = self.records[name]
        if not isinstance(record, RecordsOfSuite):
            raise KeyError(name)
        return suite_file(self.folder, record.suite)

    def record_choice(self, name: str) -> RecordChoice | None:
        """Return None: only records of a project can be chosen."""
        return None
