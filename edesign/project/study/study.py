"""A study: variants of a project's frame under many ground motions, what is designed, and what is demanded."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, PrivateAttr

from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis.analyses import VerticalMotion
from edesign.project.analysis.damping import ModeNumber, State
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.analysis.pushover import Pushovers
from edesign.project.analysis.shaking import Shaking
from edesign.project.analysis.wave_passage import WavePassage
from edesign.project.analysis_file import AnalysisFile, Identifier
from edesign.project.criteria.criteria import Criteria, Objectives
from edesign.project.dampers.dampers import GivenFactors
from edesign.project.dampers.designs import Bounds, Design
from edesign.project.document import Document
from edesign.project.notation.several import Names, ShortName, several
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import Duration, PositiveFactor, PositiveRatio
from edesign.project.notation.written import Written, one_or_list
from edesign.project.project import Project
from edesign.project.reading.base import FormatVersion, Model
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.values import KeyPath
from edesign.project.study.derived import Derived, Side, Vary, derived_name
from edesign.project.study.incremental import Incremental

Temperatures = Annotated[tuple[Temperature, ...], Field(min_length=1), Written(several, one_or_list)]


class Variant(Model):
    """The project's frame with one kind of dampers: none, those of the project, or those of a design.

    Attributes:
        dampers: no dampers, or those of the project; this key or `design`.
        design: design whose dampers the frame has, or a list of designs; this key or `dampers`.
        temperature: temperature of the dampers in place of that of their laws.
        property_factor: factor on all forces of the dampers: a property modification factor of EN 15129 or ASCE 7.
        values: other values of the project by their places, such as `{materials.S275.E: 200 GPa}`.
        bounds: the variant is also run with the upper and lower properties of its dampers.
    """

    dampers: Literal["none", "project"] | None = None
    design: Annotated[tuple[str, ...], Field(min_length=1), Written(several, one_or_list)] | None = None
    temperature: Temperature | None = None
    property_factor: PositiveFactor | None = None
    values: dict[str, Any] = {}
    bounds: Bounds | None = None

    @property
    def designs(self) -> tuple[str, ...]:
        """The names of its designs; none where it has another kind of dampers."""
        return self.design or ()


def warm_variant(variant: str, temperature_C: float) -> str:
    """Return the name of a variant whose dampers have another temperature than its own: `damped at 35 degC`.

    Args:
        temperature_C: of the dampers, degC.
    """
    return f"{variant} at {temperature_C:g} degC".strip()


def own_variant(name: str) -> str:
    """Return the variant of a name in tables: `damped at 35 degC`, `damped by N2`."""
    return name.partition(" at ")[0].partition(" by ")[0]


class Histories(Shaking):
    """Histories of every variant x level x record x temperature; a suite stands for all its recordings.

    Attributes:
        variants: variants of the study, or `all`.
        levels: hazard levels; records that are fitted to the spectrum need them.
        records: records of the project: a record, a suite, or `SUITE/RECORDING`.
        temperatures: temperatures of the dampers; without the key that of each variant.
        free_vibration: time after the end of the record.
        wave_passage: the motion reaches the supports one after the other; without the key all at once.
        collapse_drift: storey drift at which a history ends as collapsed.
        vertical: ground motion upwards beside each record.
    """

    variants: Names = ("all",)
    levels: Names | None = None
    records: Names
    temperatures: Temperatures | None = None
    free_vibration: Duration = 0.0
    wave_passage: WavePassage | None = None
    collapse_drift: PositiveRatio | None = None
    vertical: VerticalMotion | None = None


class Modal(Model):
    """The natural modes that are reported of every variant; dampers add their stiffness at their design strain.

    Attributes:
        modes: how many modes; without the key three, or all that there are.
        state: state of the frame: under the gravity combination, or unloaded.
    """

    modes: ModeNumber | None = None
    state: State = "gravity"


class Details(Model):
    """Records whose histories are kept whole, and the members whose ends are recorded under them.

    Attributes:
        records: records whose histories are kept whole.
        histories: what is kept of them over time.
        members: columns and beams whose end moments and rotations are kept.
    """

    records: Names
    histories: tuple[HistoryKind, ...] = ("floors", "storeys", "energy", "dampers")
    members: tuple[str, ...] = ()


class StudyOutputs(Model):
    """The results that are kept, as in a project; of the records of `details` more are kept.

    Attributes:
        archive: file of the archive, relative to the study file; without the key the name of the study file with .h5.
        histories: what is kept over time of every history.
        every: one step in so many is kept.
        details: records of which more is kept.
    """

    archive: Annotated[str, Field(min_length=1)] | None = None
    histories: tuple[HistoryKind, ...] = ()
    every: Annotated[int, Field(ge=1)] = 1
    details: Details | None = None


class Study(FileModel):
    """A study file: variants of a project's frame under many ground motions, and what is demanded of them.

    Once validated all values are in SI. Made by `load_study`, which also loads the project.

    Attributes:
        edesign_study: version of the file format.
        title: one line for tables and reports.
        document: what the cover of a report says beside the title.
        project: project or building file, relative to this file; its `analyses` are not run.
        designs: dampers to be sized, by name.
        variants: frames that are compared, by name.
        vary: values of the project in turn, each of which makes variants.
        modal: natural modes that are reported of every variant.
        histories: time histories of the plan.
        incremental: incremental dynamic analyses.
        pushovers: pushovers of the variants.
        criteria: what is demanded of the variants.
        objectives: cells of the table of FEMA 356 (performance level and probability) that are wanted.
        device_factors: factors on stroke and velocity of dampers, and on what holds them, of a code or numbers; without
            the key those that go with the code of the hazard.
        outputs: what is kept in the archive.
    """

    kind: ClassVar[str] = "study"

    edesign_study: FormatVersion
    title: Annotated[str, Field(min_length=1)]
    document: Document = Document()
    project: Annotated[str, Field(min_length=1)]
    designs: dict[Identifier, Design] = {}
    variants: Annotated[dict[ShortName, Variant], Field(min_length=1)]
    vary: tuple[Vary, ...] = ()
    modal: Modal = Modal()
    histories: tuple[Histories, ...] = ()
    incremental: tuple[Incremental, ...] = ()
    pushovers: tuple[Pushovers, ...] = ()
    criteria: Criteria = ()
    objectives: Objectives = ()
    device_factors: (
        Annotated[
            Literal["asce7", "asce7_redundant", "fema356", "fema356_redundant", "ec8", "none"] | GivenFactors, OneOf()
        ]
        | None
    ) = None
    outputs: StudyOutputs = StudyOutputs()

    _path: Path = PrivateAttr(default=Path("study.yaml"))
    _base: AnalysisFile | None = PrivateAttr(default=None)
    _derived: dict[str, Derived] = PrivateAttr(default_factory=dict)
    _projects: dict[str, AnalysisFile] = PrivateAttr(default_factory=dict)

    @property
    def base(self) -> AnalysisFile:
        """The project or building that is studied.

        Raises:
            ValueError: the study was not made by `load_study` (a mistake of the caller, not of the user).
        """
        if self._base is None:
            raise ValueError("this study has no project; use load_study")
        return self._base

    @property
    def plane(self) -> Project:
        """The project of a plane frame that is studied, for what buildings do not have; the check refuses it there."""
        assert isinstance(self.base, Project), "a building is studied"
        return self.base

    def beside(self, name: str) -> tuple[str, ...]:
        """Return the designs whose dampers stand in the frame while a design is sized, in the order of the file.

        They are those that it names, and those beside which these are sized.
        """
        found: set[str] = set()
        open_names = list(self.designs[name].beside)
        while open_names:
            if (other := open_names.pop()) in self.designs and other not in found:
                found.add(other)
                open_names += self.designs[other].beside
        return tuple(other for other in self.designs if other in found)

    @property
    def hazard(self) -> Hazard | None:
        """The seismic action of the project; None: it has none."""
        return self.base.hazard

    @property
    def more_folders(self) -> tuple[Path, ...]:
        """Folders with recordings of suites, beside those that the file names."""
        return self.base.more_folders

    def of(self, base: AnalysisFile) -> Study:
        """Return the study with another project, such as `study.base.with_values(...)`, checked against it.

        Raises:
            InputError: the study was changed otherwise than by `with_values`.
            StudyError: the study does not fit the project; the message lists all problems.
        """
        self.check_unchanged()
        assert self._read is not None
        found: Study = self._read(self._text, base=base)
        return found

    def afresh(self) -> Study:
        """Return the study without the contents of files that were read so far."""
        return self.model_copy().set_base(self.base.afresh())

    def set_base(self, base: AnalysisFile) -> Study:
        """Set, once, the project of the study."""
        self._base, self._projects = base, {}
        return self

    def with_derived(self) -> Study:
        """Return the study of the file with the variants that `vary` and `bounds` make."""
        variants, derived = dict(self.variants), {}
        for name, variant, source in self._made():
            if name not in variants:
                variants[name], derived[name] = variant, source
        found = self.model_copy(update={"variants": variants})
        found._derived = derived
        return found

    def _made(self) -> Iterator[tuple[str, Variant, Derived]]:
        for name, variant in self.variants.items():
            plain = variant.model_copy(update={"bounds": None})
            sides: tuple[Side, ...] = ("lower", "upper") if variant.bounds is not None else ()
            for side in sides:
                yield derived_name(name, side), plain, Derived(name, ("variants", name, "bounds"), bound=side)
            for at, item in enumerate(self.vary):
                for suffix, keys, values in item.points if name in item.variants else ():
                    changed = plain.model_copy(update={"values": {**variant.values, **values}})
                    source = Derived(name, ("vary", at, *keys), item.name, tuple(values.values()))
                    yield derived_name(name, suffix), changed, source

    @property
    def derived(self) -> dict[str, Derived]:
        """The variants that `vary` and `bounds` made, with their origin."""
        return self._derived

    def named(self, variant: str) -> str:
        """Return the variant of the file that a variant is, or is derived from."""
        return self._derived[variant].of if variant in self._derived else variant

    def project_of(self, variant: str) -> AnalysisFile:
        """Return the project with the values of a variant, without the dampers of its design.

        Raises:
            FileProblems: a place does not exist, or the project would be wrong.
        """
        values = self.variants[variant].values
        if not values:
            return self.base
        if variant not in self._projects:
            places: dict[KeyPath, Any] = dict(values.items())
            self._projects[variant] = self.base.with_values(places)
        return self._projects[variant]

    @property
    def checksum(self) -> str:
        """SHA-256 of the texts of study and project (UTF-8), hexadecimal."""
        return hashlib.sha256(f"{self._text}\n{self.base.text}".encode()).hexdigest()

    @property
    def analysis_checksum(self) -> str:
        """SHA-256 of the values of study and project that results may depend on."""
        return hashlib.sha256(f"{super().analysis_checksum}\n{self.base.analysis_checksum}".encode()).hexdigest()

    @property
    def archive_path(self) -> Path:
        """The path of the archive, unless the command line gives another one."""
        return self.folder / (self.outputs.archive or f"{self._path.stem}.h5")

    @property
    def planned_sets(self) -> tuple[tuple[str, str], ...]:
        """Return (variant, level) of all histories that are judged; the level is "" where they have none."""
        pairs = (
            (variant if temperature is None else warm_variant(variant, temperature), level)
            for histories in self.histories
            for variant in self.variants_of(histories)
            for temperature in histories.temperatures or (None,)
            for level in histories.levels or ("",)
        )
        return tuple(dict.fromkeys(pairs))

    def variants_of(self, histories: Histories | Incremental | Pushovers) -> tuple[str, ...]:
        """Return the names of the variants of histories or pushovers in the order of the file, with derived ones."""
        wanted = histories.variants
        if wanted == ("all",):
            return tuple(self.variants)
        return tuple(name for name in self.variants if name in wanted or self.named(name) in wanted)
