"""The whole project."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field, PrivateAttr

from edesign.project.analyses import Analysis
from edesign.project.dampers import Dampers
from edesign.project.damping import Damping
from edesign.project.elements import Elements
from edesign.project.file_model import FileModel
from edesign.project.frame import Frame
from edesign.project.hazard import Hazard, Level
from edesign.project.integration import Integration
from edesign.project.loads import Loads
from edesign.project.masses import Masses
from edesign.project.materials import Material
from edesign.project.outputs import Outputs
from edesign.project.records import FileRecord, Record, SuiteRecords
from edesign.project.sections import Fibres, Section

Identifier = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


class Project(FileModel):
    """A validated project; all values are in SI. Made by `load_project`, which also keeps the text and its marks."""

    edesign: Literal[1]
    title: Annotated[str, Field(min_length=1)]
    frame: Frame
    sections: dict[Identifier, Section] = {}
    fibres: Fibres = Fibres()
    materials: dict[Identifier, Material]
    loads: Loads = Loads()
    masses: Masses | None = None
    elements: Elements = Elements()
    dampers: Dampers | None = None
    damping: Damping | None = None
    integration: Integration | None = None
    hazard: Hazard | None = None
    records: dict[Identifier, Record] = {}
    analyses: Annotated[tuple[Analysis, ...], Field(min_length=1)]
    outputs: Outputs = Outputs()

    _path: Path = PrivateAttr(default=Path("project.yaml"))

    @property
    def checksum(self) -> str:
        """SHA-256 of the text (UTF-8), hexadecimal."""
        return hashlib.sha256(self._text.encode("utf-8")).hexdigest()

    @property
    def archive_path(self) -> Path:
        """Where the archive goes unless the command line says otherwise."""
        return self.folder / (self.outputs.archive or f"{self._path.stem}.h5")

    @property
    def hazard_levels(self) -> Mapping[str, Level]:
        """The levels of the hazard by name; none without a hazard."""
        return self.hazard.levels if self.hazard is not None else {}

    def record_path(self, name: str) -> Path:
        """The file of a record that is given by `file`.

        Raises:
            KeyError: no record of this name is a file.
        """
        record = self.records[name]
        if not isinstance(record, FileRecord):
            raise KeyError(name)
        return self.folder / record.file

    def suite_path(self, name: str) -> Path:
        """The suite file of a record that is given by `suite`.

        Raises:
            KeyError: no record of this name is a suite.
        """
        record = self.records[name]
        if not isinstance(record, SuiteRecords):
            raise KeyError(name)
        return self.folder / record.suite
