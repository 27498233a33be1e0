"""What a project file and a building file have in common: the blocks that analyses read."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Protocol, Self, TypeVar

from pydantic import Field, PrivateAttr

from edesign.project.dampers.dampers import Dampers
from edesign.project.dampers.isolation import AnyIsolation
from edesign.project.notation.frames import Direction
from edesign.project.notation.grid import Grid
from edesign.project.reading.base import Model
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.problems import Keys
from edesign.project.reading.values import KeyPath
from edesign.project.records.record_files import RecordChoice, RecordFiles
from edesign.project.records.records import level_of_fit

if TYPE_CHECKING:
    from edesign.project.actions.hazard import AnyHazard
    from edesign.project.analysis.analyses import AnyAnalysis
    from edesign.project.analysis.damping import Damping
    from edesign.project.analysis.integration import Integration
    from edesign.project.analysis.outputs import Outputs
    from edesign.project.analysis.validity import Validity
    from edesign.project.document import Document
    from edesign.project.frame.elements import Elements
    from edesign.project.frame.foundations import Footing, Soil
    from edesign.project.frame.hinges import AnyHinges, AnyJoints, AnyPanelZones
    from edesign.project.frame.materials import Material
    from edesign.project.frame.sections import Fibres, SpaceFibres
    from edesign.project.records.pairs import AnyRecord

Identifier = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9_.+-]*$", max_length=64)]


class AnyMasses(Protocol):
    """Masses of the nodes, whatever they come from."""

    @property
    def directions(self) -> Literal["both", "horizontal"]:
        """Whether a mass resists horizontal motion only, or vertical motion too."""


class AnalysisFile(RecordFiles, FileModel):
    """A file with a structure that is analysed: a plane frame or a building.

    It declares no keys for the reader, as each file has them in its own order.

    Attributes:
        structure: what it is, for messages: "frame" or "building".
        grid_key: key of the file that says what stands where.
        member_names: how members are named, for messages.
    """

    structure: ClassVar[str]
    grid_key: ClassVar[str]
    member_names: ClassVar[str]

    if TYPE_CHECKING:
        title: str
        document: Document
        fibres: Fibres | SpaceFibres
        elements: Elements
        hinges: tuple[AnyHinges, ...]
        joints: tuple[AnyJoints, ...]
        panel_zones: tuple[AnyPanelZones, ...]
        dampers: Dampers | None
        damping: Damping | None
        integration: Integration | None
        validity: Validity
        hazard: AnyHazard | None
        records: Mapping[Identifier, AnyRecord]
        analyses: tuple[AnyAnalysis, ...]
        outputs: Outputs

        soils: Mapping[Identifier, Soil]

        @property
        def masses(self) -> AnyMasses | None:
            """Masses of the nodes; all analyses but `gravity` need them."""

    _more_folders: tuple[Path, ...] = PrivateAttr(default=())
    _choices: Mapping[str, RecordChoice] = PrivateAttr(default_factory=dict)

    @property
    @abstractmethod
    def grid(self) -> Grid:
        """What stands where, by name."""

    @property
    @abstractmethod
    def steels(self) -> Mapping[str, Material]:
        """The law of each material, by name."""

    @property
    @abstractmethod
    def footings(self) -> Mapping[str, Footing]:
        """The footings by the lines of columns that stand on them."""

    @abstractmethod
    def support_keys(self, line: str) -> Keys:
        """Return the place of the support that a line of columns takes."""

    @abstractmethod
    def widths(self, along: Direction | None = None) -> tuple[float, ...]:
        """Return the widths of the bays of frames, m.

        Args:
            along: direction of the frames of a building; None: of a plane frame.
        """

    def dissipative(self, member: str) -> bool:
        """Return whether a member is meant to yield; buildings do not say it here."""
        return False

    @abstractmethod
    def with_dampers(self, dampers: Dampers | None) -> Self:
        """Return the file with other dampers; without any the members keep their names."""

    @abstractmethod
    def with_halves(self, beams: Collection[str]) -> Self:
        """Return the file whose dampers meet those beams in the middle of which the halves are named.

        Args:
            beams: names of beams and of halves, as an analysis of a variant with dampers of its own has them; none: the
                file stays as it is.
        """

    def with_values(self, values: Mapping[KeyPath, Any] | KeyPath, value: Any = None) -> Self:
        """Return the file as it would be with other values; see `FileModel.with_values`.

        Args:
            values: new values by key path, or one key path.
            value: the new value, if `values` is a key path.
        """
        return super().with_values(values, value).with_folders(self._more_folders)

    def with_folders(self, folders: Sequence[Path]) -> Self:
        """Return the file with more folders for recordings of suites, after those that the file names."""
        found = self.model_copy()
        found._more_folders = (*self._more_folders, *folders)
        return found

    @property
    def more_folders(self) -> tuple[Path, ...]:
        """The folders of `with_folders`."""
        return self._more_folders

    def with_choices(self, choices: Mapping[str, RecordChoice]) -> Self:
        """Return the file with chosen recordings for its records, by their names."""
        found = self.model_copy()
        found._choices = dict(choices)
        return found

    def afresh(self) -> Self:
        """Return the file without contents of files that were read and choices made from them."""
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
    def hazard_levels(self) -> Mapping[str, Model]:
        """The levels of the hazard by name; none without a hazard."""
        return self.hazard.levels if self.hazard is not None else {}

    @property
    def rigid_floors(self) -> tuple[int, ...]:
        """The floors of a building that are rigid in plan, whose masses may stand beside their places."""
        return ()

    @property
    def held_floors(self) -> tuple[int, ...]:
        """The floors of a building above its base that the ground holds in plan."""
        return ()

    @property
    def accidental_torsion(self) -> float:
        """Accidental eccentricity of the masses of a building over the length of a floor."""
        return 0.0

    @property
    def largest_drift(self) -> float | None:
        """Drift ratio beyond which an analysis has failed; None: the geometry of corotational columns has no limit."""
        if self.validity.drift is not None:
            return self.validity.drift
        return None if self.elements.geometry.columns == "corotational" else self.validity.geometric_drift

    @property
    def isolation(self) -> AnyIsolation | None:
        """The isolated base of the building; None: it stands on its supports."""
        return self.dampers.isolation if self.dampers is not None else None

    def fitted_level(self, record: str) -> str | None:
        """Return the only level that a record is fitted to; None: it is not fitted, or to the shape of all levels."""
        return None if self.hazard is None else level_of_fit(self.records[record], self.hazard)

    def record_choice(self, name: str) -> RecordChoice | None:
        """Return the choice that was made for a record; None if none was made."""
        return self._choices.get(name)

    def suite_folders(self, name: str) -> list[Path]:
        """Return the folders that are searched for the recordings of a suite, those of `with_folders` last.

        Raises:
            KeyError: no record of this name is a suite.
        """
        return [*super().suite_folders(name), *self._more_folders]


File = TypeVar("File", bound=AnalysisFile)
"""A plane frame or a building, of which functions return what they take."""
