"""The whole file of substructure tests."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal

from pydantic import Field, PrivateAttr

from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import Identifier
from edesign.project.dampers.dampers import DamperLaw
from edesign.project.dampers.device_names import devices_by_name
from edesign.project.document import Document
from edesign.project.notation.units import PositiveFactor, PositiveRatio
from edesign.project.project import Project
from edesign.project.reading.base import FormatVersion, Model
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.yaml_file import read_yaml_text, yaml_text
from edesign.project.records.record_files import RecordFiles
from edesign.project.records.records import Record
from edesign.project.substructure.compensators import Compensator
from edesign.project.substructure.loop import Integration, Loop, Sensors
from edesign.project.substructure.programme import AnyTest, RecordTest
from edesign.project.substructure.rig import AnyRig, RigFile, RigInFile, RigModel
from edesign.project.substructure.specimen import PlacedLaw, Specimen
from edesign.project.substructure.structure import ProjectStructure, Structure

Channel = Literal["target", "measured", "command", "force", "alpha", "energy", "building"]
CHANNELS: tuple[Channel, ...] = ("target", "measured", "command", "force", "alpha", "energy", "building")


class RtsCriteria(Model):
    """The criteria of a good test.

    Attributes:
        response_error: largest error of the response.
        delay_margin: least factor between the delay of the rig and the critical one.
    """

    response_error: PositiveRatio = 0.05
    delay_margin: PositiveFactor = 2.0


class RtsOutputs(Model):
    """The results that are kept beside the indicators.

    Attributes:
        archive: file of the archive, relative to this file; without the key the name of this file with .h5.
        histories: what is kept over time.
    """

    archive: Annotated[str, Field(min_length=1)] | None = None
    histories: tuple[Channel, ...] = CHANNELS


@dataclass(frozen=True)
class Motion:
    """The ground motion of a test.

    Attributes:
        record: name, or SUITE/RECORDING.
        scale: factor of the record; None with a peak.
        pga: peak acceleration that it is scaled to, m/s2; None with a factor.
        free_vibration: time after its end, s.
        of_project: whether the record is one of the project, otherwise it is one of the file.
    """

    record: str
    scale: float | None
    pga: float | None
    free_vibration: float
    of_project: bool


class RtsFile(RecordFiles, FileModel):
    """A file of substructure tests: the numerical part, the specimen, the rig, and what is done with them.

    Once validated all values are in SI. Made by `load_rts_file`, which also reads what they name.

    Attributes:
        edesign_rts: version of the file format.
        title: one line for tables and reports.
        document: what the cover of a report says beside the title.
        structure: the numerical part: a project, or a shear building.
        specimen: the damper in the laboratory.
        rig: how the actuator follows its command.
        sensors: noise and steps of the readings.
        loop: time steps of the loop.
        integration: integration of the numerical part.
        compensators: compensators of the delay, by names of your own.
        tests: what is done with the rig, test by test.
        records: ground motions by name, as in a project, without `match`.
        criteria: what a good test is.
        outputs: what is kept in the archive.
    """

    kind: ClassVar[str] = "rts_file"

    edesign_rts: FormatVersion
    title: str = ""
    document: Document = Document()
    structure: Structure | None = None
    specimen: Specimen = Specimen()
    rig: AnyRig
    sensors: Sensors = Sensors()
    loop: Loop = Loop()
    integration: Integration = Integration()
    compensators: Annotated[dict[Identifier, Compensator], Field(min_length=1)]
    tests: tuple[AnyTest, ...] = ()
    records: dict[Identifier, Record] = {}
    criteria: RtsCriteria = RtsCriteria()
    outputs: RtsOutputs = RtsOutputs()

    _path: Path = PrivateAttr(default=Path("rts.yaml"))
    _project: Project | None = PrivateAttr(default=None)
    _rig_file: RigFile | None = PrivateAttr(default=None)

    def set_named(self, project: Project | None, rig_file: RigFile | None) -> RtsFile:
        """Set, once, the project and the rig file that the file names.

        Args:
            project: the project; None: the file names none.
            rig_file: the rig file; None: the rig is in this file.
        """
        self._project, self._rig_file = project, rig_file
        return self

    @property
    def project(self) -> Project | None:
        """The project whose devices are tested; None: the structure is a shear building, or there is none."""
        return self._project

    @property
    def rig_file(self) -> RigFile | None:
        """The rig file; None: the rig stands in this file."""
        return self._rig_file

    @property
    def plant(self) -> RigModel:
        """The rig of this file or of its rig file, with the limits and the flexibility given here.

        Raises:
            ValueError: the file was not made by `load_rts_file` (a mistake of the caller, not of the user).
        """
        if not isinstance(self.rig, RigInFile):
            return self.rig
        if self._rig_file is None:
            raise ValueError("these tests have no rig; use load_rts_file")
        given: dict[str, object] = {
            key: getattr(self.rig, key) for key in ("limits", "flexibility") if key in self.rig.model_fields_set
        }
        return self._rig_file.rig.model_copy(update=given)

    @property
    def encoder_noise(self) -> float:
        """Standard deviation of the measured displacement, m: that of the sensors, of the rig file, or none."""
        if self.sensors.encoder_noise is not None:
            return self.sensors.encoder_noise
        of_rig = self._rig_file.encoder_noise if self._rig_file is not None else None
        return of_rig or 0.0

    @property
    def displacement_range(self) -> float | None:
        """Range of the encoder to either side, m; None: it has none."""
        own = self.sensors.displacement_range
        return own if own is not None else self.plant.limits.stroke

    @property
    def force_range(self) -> float | None:
        """Range of the load cell to either side, N; None: it has none."""
        own = self.sensors.force_range
        return own if own is not None else self.plant.limits.force

    @property
    def may_yield(self) -> bool:
        """Whether the numerical part is a frame with all that yields in it."""
        return isinstance(self.structure, ProjectStructure) and self.structure.frame == "nonlinear"

    @property
    def sub_step(self) -> float:
        """Time step of the rig, s."""
        return self.loop.main_step / self.loop.sub_steps

    @property
    def law(self) -> PlacedLaw | None:
        """The law of the specimen at its temperature, with its place; None: there is no specimen."""
        chosen = self.specimen.law
        placed: PlacedLaw | None = None
        if self.specimen.law_file is not None:
            placed = self._placed(DamperLaw(file=self.specimen.law_file), "law_file")
        elif isinstance(chosen, DamperLaw):
            placed = self._placed(chosen, "law")
        elif self._project is not None:
            laws = self._project.dampers.laws if self._project.dampers is not None else {}
            name = chosen or self._law_of_devices(self._project)
            if name in laws:
                keys = ("dampers", "laws", name)
                placed = PlacedLaw(self._heated(laws[name]), self._project.path, self._project.root, keys)
        return placed

    def _law_of_devices(self, project: Project) -> str | None:
        """The law that the devices in the laboratory have; None: there are none, or they have several."""
        known = devices_by_name(project.frame, project.dampers)
        physical = self.structure.physical if isinstance(self.structure, ProjectStructure) else ()
        laws = {known[name][0].law for name in physical if name in known}
        return laws.pop() if len(laws) == 1 else None

    def _placed(self, law: DamperLaw, key: str) -> PlacedLaw:
        return PlacedLaw(self._heated(law), self.path, self.root, ("specimen", key))

    def _heated(self, law: DamperLaw) -> DamperLaw:
        if self.specimen.temperature is None:
            return law
        return law.model_copy(update={"temperature": self.specimen.temperature})

    def law_file_content(self, placed: PlacedLaw) -> bytes:
        """Return the content of the law file that the law of the specimen names, as it was when first asked for.

        Raises:
            InputError: it cannot be read.
        """
        assert placed.law.file is not None
        holder: FileModel = self
        if placed.path != self.path:
            assert self._project is not None
            holder = self._project
        return holder.yaml_content(placed.law.file, "law file")

    @property
    def analysis(self) -> HistoryAnalysis | None:
        """The history of the project that tests take their record from; None: none is named."""
        name = self.structure.analysis if isinstance(self.structure, ProjectStructure) else None
        known = self._project.analyses if self._project is not None else ()
        return next((one for one in known if one.name == name and isinstance(one, HistoryAnalysis)), None)

    def motion(self, test: RecordTest) -> Motion:
        """Return the ground motion of a test: its own record, or that of the analysis.

        Raises:
            ValueError: there is neither (refused when the file is read).
        """
        free = test.free_vibration
        if test.record is not None:
            of_project = test.record.partition("/")[0] not in self.records
            return Motion(test.record, test.scale or 1.0, None, free or 0.0, of_project)
        analysis = self.analysis
        if analysis is None:
            raise ValueError(f"the test {test.name} has no record; use load_rts_file")
        scale, pga = (test.scale, None) if test.scale is not None else (analysis.scale, analysis.pga)
        factor = 1.0 if scale is None and pga is None else scale
        return Motion(analysis.record, factor, pga, analysis.free_vibration if free is None else free, True)

    @property
    def texts(self) -> dict[str, tuple[str, str]]:
        """Return the texts of all YAML files of the tests, by the names that archives give them.

        Raises:
            InputError: the rig file or a law file cannot be read.
        """
        found = {"rts_text": (self._text, "file of substructure tests")}
        if isinstance(self.rig, RigInFile):
            found["rig_text"] = read_yaml_text(self.folder / self.rig.file, "rig file"), "rig file"
        if self._project is not None:
            found["project_text"] = self._project.text, "project file"
            laws = self._project.dampers.laws if self._project.dampers is not None else {}
            for name, law in laws.items():
                if law.file is not None:
                    text = _law_text(self._project, law.file)
                    found[f"law_text_{name}"] = text, f"law file {law.file}"
        placed = self.law
        if placed is not None and placed.path == self.path and placed.law.file is not None:
            found["law_text"] = _law_text(self, placed.law.file), f"law file {placed.law.file}"
        return found

    @property
    def checksum(self) -> str:
        """SHA-256 of `texts` (UTF-8), hexadecimal; errors as theirs."""
        whole = "\n".join(text for text, _ in self.texts.values())
        return hashlib.sha256(whole.encode("utf-8")).hexdigest()

    @property
    def archive_path(self) -> Path:
        """The path of the archive, unless the command line gives another one."""
        return self.folder / (self.outputs.archive or f"{self._path.stem}.h5")


def _law_text(holder: FileModel, file: str) -> str:
    return yaml_text(holder.yaml_content(file, "law file"), holder.folder / file)
