"""The whole project."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, Self

from pydantic import Field, PrivateAttr, model_validator

from edesign.project.actions.hazard import AnyHazard
from edesign.project.actions.loads import Loads
from edesign.project.actions.masses import Masses
from edesign.project.analysis.analyses import Analysis
from edesign.project.analysis.damping import Damping
from edesign.project.analysis.integration import Integration
from edesign.project.analysis.outputs import Outputs
from edesign.project.analysis.validity import Validity
from edesign.project.dampers.dampers import DamperRun, Dampers
from edesign.project.dampers.isolation import Isolation
from edesign.project.document import Document
from edesign.project.frame.elements import Elements
from edesign.project.frame.foundations import Soil
from edesign.project.frame.frame import Frame
from edesign.project.frame.hinges import Hinges, Joints, PanelZones
from edesign.project.frame.materials import Material
from edesign.project.frame.sections import Fibres, Section
from edesign.project.notation.grid import Grid
from edesign.project.reading.base import FormatVersion, Model
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.values import KeyPath
from edesign.project.records.record_files import RecordChoice, RecordFiles
from edesign.project.records.records import Record

Identifier = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


class Project(RecordFiles, FileModel):
    """A project file: a plane frame, what acts on it, what is analysed, and what is kept.

    Once validated all values are in SI. Made by `load_project`, which also keeps the text and its marks.

    Attributes:
        edesign: version of the file format.
        title: one line for tables and reports.
        document: what the cover of a report says beside the title.
        frame: the plane frame: its grid, supports and members.
        sections: own cross-sections by name; a name of the catalogue cannot be used again.
        fibres: how many fibres an I section is cut into.
        materials: steels by name, to which members refer.
        loads: permanent loads G and variable loads Q, positive downwards.
        masses: masses of the nodes, given or taken from the loads; all analyses but `gravity` need them.
        elements: how members are modelled: integration points, geometry, rigid ends.
        hinges: plastic hinges lumped at the ends of members.
        joints: semi-rigid joints, as springs between the ends of members and their nodes.
        panel_zones: joints whose panel shears.
        soils: soils by name, on which footings stand.
        dampers: dampers, tuned masses and isolators of the frame.
        damping: inherent damping of the frame; histories need it.
        integration: time integration; histories need it.
        validity: errors and drifts beyond which a result does not count.
        hazard: the seismic action at the site and its levels.
        records: ground motions by name.
        analyses: what is analysed, in this order; names differ.
        outputs: what is kept in the archive beside the envelopes.
    """

    kind: ClassVar[str] = "project"

    edesign: FormatVersion
    title: Annotated[str, Field(min_length=1)]
    document: Document = Document()
    frame: Frame
    sections: dict[Identifier, Section] = {}
    fibres: Fibres = Fibres()
    materials: dict[Identifier, Material]
    loads: Loads = Loads()
    masses: Masses | None = None
    elements: Elements = Elements()
    hinges: tuple[Hinges, ...] = ()
    joints: tuple[Joints, ...] = ()
    panel_zones: tuple[PanelZones, ...] = ()
    soils: dict[Identifier, Soil] = {}
    dampers: Dampers | None = None
    damping: Damping | None = None
    integration: Integration | None = None
    validity: Validity = Validity()
    hazard: AnyHazard | None = None
    records: dict[Identifier, Record] = {}
    analyses: Annotated[tuple[Analysis, ...], Field(min_length=1)]
    outputs: Outputs = Outputs()

    _path: Path = PrivateAttr(default=Path("project.yaml"))
    _more_folders: tuple[Path, ...] = PrivateAttr(default=())
    _choices: Mapping[str, RecordChoice] = PrivateAttr(default_factory=dict)

    @model_validator(mode="after")
    def _meet_beams(self) -> Self:
        """Dampers in place of a chevron's braces meet the middle of the beam above."""
        self.frame.meet_by_dampers(self._beams_met(self.dampers))
        return self

    def _beams_met(self, dampers: Dampers | None) -> list[tuple[int, int]]:
        grid = self.frame
        return [
            (bay, storey)
            for run in (dampers.devices if dampers is not None else ())
            if isinstance(run, DamperRun) and run.kind == "chevron_braces"
            for storey in run.storeys.numbers(1, grid.n_storeys)
            for bay in run.bays.numbers(1, grid.n_bays)
        ]

    def with_dampers(self, dampers: Dampers | None) -> Self:
        """Return the project with other dampers; those in place of a chevron's braces meet the beams above.

        Without any the beams stay as they are, so that members keep their names.
        """
        if dampers is None:
            return self.model_copy(update={"dampers": None})
        frame = self.frame.met_by_dampers(self._beams_met(dampers))
        return self.model_copy(update={"dampers": dampers, "frame": frame})

    def with_values(self, values: Mapping[KeyPath, Any] | KeyPath, value: Any = None) -> Self:
        """Return the project as its file would be with other values; see `FileModel.with_values`.

        Args:
            values: new values by key path, or one key path.
            value: the new value, if `values` is a key path.
        """
        return super().with_values(values, value).with_folders(self._more_folders)

    def with_folders(self, folders: Sequence[Path]) -> Self:
        """Return the project with more folders for recordings of suites, after those that the file names."""
        found = self.model_copy()
        found._more_folders = (*self._more_folders, *folders)
        return found

    def with_choices(self, choices: Mapping[str, RecordChoice]) -> Self:
        """Return the project with chosen recordings for its records, by their names."""
        found = self.model_copy()
        found._choices = dict(choices)
        return found

    def afresh(self) -> Self:
        """Return the project without contents of files that were read and choices made from them."""
        found = self.with_choices({})
        found._contents = {}
        if self.hazard is not None and any(self.hazard.files()):
            found = found.model_copy(update={"hazard": self.hazard.model_copy()})
            assert found.hazard is not None
            found.lend_contents(found.hazard.lend)
        return found

    @property
    def archive_path(self) -> Path:
        """The path of the archive, unless the command line gives another one."""
        return self.folder / (self.outputs.archive or f"{self._path.stem}.h5")

    @property
    def grid(self) -> Grid:
        """What stands where, by name."""
        return self.frame

    @property
    def hazard_levels(self) -> Mapping[str, Model]:
        """The levels of the hazard by name; none without a hazard."""
        return self.hazard.levels if self.hazard is not None else {}

    @property
    def largest_drift(self) -> float | None:
        """Drift ratio beyond which an analysis has failed; None: the geometry of corotational columns has no limit."""
        if self.validity.drift is not None:
            return self.validity.drift
        return None if self.elements.geometry.columns == "corotational" else self.validity.geometric_drift

    @property
    def isolation(self) -> Isolation | None:
        """The isolated base of the building; None: it stands on its supports."""
        return self.dampers.isolation if self.dampers is not None else None

    def fitted_level(self, record: str) -> str | None:
        """Return the only level that a record is fitted to; None: it is not fitted, or to the shape of all levels."""
        spec, hazard = self.records[record], self.hazard
        if not spec.fitted or hazard is None or not hazard.own_shapes:
            return None
        return spec.fit_level or (next(iter(hazard.levels)) if len(hazard.levels) == 1 else None)

    def record_choice(self, name: str) -> RecordChoice | None:
        """Return the choice that was made for a record; None if none was made."""
        return self._choices.get(name)

    def suite_folders(self, name: str) -> list[Path]:
        """Return the folders that are searched for the recordings of a suite, those of `with_folders` last.

        Raises:
            KeyError: no record of this name is a suite.
        """
        return [*super().suite_folders(name), *self._more_folders]
