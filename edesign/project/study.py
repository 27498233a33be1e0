"""A study: variants of a project's frame under many ground motions, what is designed, and what is demanded."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field, PrivateAttr

from edesign.project.base import Model
from edesign.project.criteria import Criterion, Objective
from edesign.project.damping import ModeNumber, State
from edesign.project.designs import Design
from edesign.project.incremental import Incremental
from edesign.project.outputs import HistoryKind
from edesign.project.project import Identifier, Project
from edesign.project.temperature import Temperature
from edesign.project.units import Duration, PositiveFactor, PositiveRatio
from edesign.project.yaml_nodes import Node, find, parse


def _several(value: Any) -> Any:
    """A single name is a list of one."""
    return (value,) if isinstance(value, str) else value


Names = Annotated[tuple[str, ...], Field(min_length=1), BeforeValidator(_several)]
Temperatures = Annotated[tuple[Temperature, ...], Field(min_length=1), BeforeValidator(_several)]
VariantName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_+-]*$", max_length=24)]


class Variant(Model):
    """The project's frame with one kind of dampers: none, those of the project, or those of a design.

    `temperature` (degC) replaces that of the laws; `property_factor` multiplies all forces of the dampers, as the
    property modification factors of EN 15129 and ASCE 7 do.
    """

    dampers: Literal["none", "project"] | None = None
    design: str | None = None
    temperature: Temperature | None = None
    property_factor: PositiveFactor | None = None


class Histories(Model):
    """Histories of every variant x level x record x temperature; a suite stands for all its recordings.

    `temperatures` (degC) of the dampers, without them each variant has its own; of records that are not fitted to the
    spectrum `levels` may be left out. A history ends as collapsed beyond the storey drift `collapse_drift`.
    """

    variants: Names = ("all",)
    levels: Names | None = None
    records: Names
    temperatures: Temperatures | None = None
    free_vibration: Duration = 0.0
    collapse_drift: PositiveRatio | None = None


class Modal(Model):
    """The natural modes that are reported of every variant; dampers add their stiffness at their design strain."""

    modes: ModeNumber = 3
    state: State = "gravity"


class Details(Model):
    """Records whose histories are kept whole, and the members whose ends are recorded under them."""

    records: Names
    histories: tuple[HistoryKind, ...] = ("floors", "storeys", "energy", "dampers")
    members: tuple[str, ...] = ()


class StudyOutputs(Model):
    """What is kept, as in a project; of the records of `details` more."""

    archive: Annotated[str, Field(min_length=1)] | None = None
    histories: tuple[HistoryKind, ...] = ()
    every: Annotated[int, Field(ge=1)] = 1
    details: Details | None = None


class Study(Model):
    """A validated study; all values are in SI. Made by `load_study`, which also loads the project."""

    edesign_study: Literal[1]
    title: Annotated[str, Field(min_length=1)]
    project: Annotated[str, Field(min_length=1)]
    designs: dict[Identifier, Design] = {}
    variants: Annotated[dict[VariantName, Variant], Field(min_length=1)]
    modal: Modal = Modal()
    histories: tuple[Histories, ...] = ()
    incremental: tuple[Incremental, ...] = ()
    criteria: tuple[Criterion, ...] = ()
    objectives: tuple[Objective, ...] = ()
    outputs: StudyOutputs = StudyOutputs()

    _path: Path = PrivateAttr(default=Path("study.yaml"))
    _text: str = PrivateAttr(default="")
    _root: Node | None = PrivateAttr(default=None)
    _base: Project | None = PrivateAttr(default=None)

    @property
    def path(self) -> Path:
        """The study file, as it was given."""
        return self._path

    @property
    def folder(self) -> Path:
        """The folder that the paths in the file are relative to."""
        return self._path.parent

    @property
    def text(self) -> str:
        """The exact text of the file."""
        return self._text

    @property
    def base(self) -> Project:
        """The project that is studied.

        Raises:
            ValueError: the study was not made by `load_study` (a mistake of the caller, not of the user).
        """
        if self._base is None:
            raise ValueError("this study has no project; use load_study")
        return self._base

    def of(self, base: Project) -> Study:
        """The same study of another project."""
        study = self.model_copy()
        study._base = base
        return study

    @property
    def checksum(self) -> str:
        """SHA-256 of the texts of study and project (UTF-8), hexadecimal."""
        return hashlib.sha256(f"{self._text}\n{self.base.text}".encode()).hexdigest()

    @property
    def archive_path(self) -> Path:
        """Where the archive goes unless the command line says otherwise."""
        return self.folder / (self.outputs.archive or f"{self._path.stem}.h5")

    def variants_of(self, histories: Histories | Incremental) -> tuple[str, ...]:
        """Names of the variants that histories are of, in the order of the file."""
        wanted = histories.variants
        return tuple(self.variants) if wanted == ("all",) else tuple(n for n in self.variants if n in wanted)

    def where(self, *keys: str | int) -> str:
        """`file:line:column` of a key path; of the nearest part that exists."""
        root = self._root if self._root is not None else parse(self._text)[0]
        mark = find(root, keys).mark
        return f"{self._path}:{mark.line}:{mark.column}"
