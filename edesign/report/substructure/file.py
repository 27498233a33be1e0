"""The file of substructure tests whose text an archive holds, and the laboratory that it describes."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from edesign.archive.reader import Archive
from edesign.errors import EdesignError
from edesign.project.project import Project
from edesign.project.reading.yaml_file import check_model
from edesign.project.substructure.loader import read_rig_file
from edesign.project.substructure.rig import IdealRig, RigFile, RigInFile, RigModel
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure
from edesign.project.substructure.summary import summary
from edesign.report.archived import archived_texts, project_of_texts, take_text
from edesign.substructure.laboratory import Laboratory, rig_transfer
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.virtual_tests import VirtualLaboratory

RIG = "rig"
TITLES = {
    "structure": "Structure in the computer",
    "specimen": "Specimen in the rig",
    "rig": "Rig",
    "loop": "Loop",
    "compensate": "Compensators",
    "tests": "Tests",
    "runs": "Runs",
}
"""Of the lines of a summary."""


@dataclass
class ArchivedTests:
    """The description of tests in an archive, without their files.

    Attributes:
        file: None: its text cannot be read.
        notes: sentences on what is not known, or comes from elsewhere.
        plant: the rig; None: its file is not at hand.
        tests: of the file, made ready; None: they cannot be made from what is held.
        transfer: of the rig; None: not known.
    """

    file: RtsFile | None
    notes: list[str] = field(default_factory=list)
    plant: RigModel | None = None
    tests: VirtualLaboratory | None = None
    transfer: RigTransfer | None = None

    @property
    def laboratory(self) -> Laboratory | None:
        """Structure, damper and rig of the tests; None where the archived texts are not enough."""
        return self.tests.laboratory if self.tests is not None else None

    def rows(self) -> list[tuple[str, str]]:
        """Return the description of the tests, line by line: title and text."""
        if self.file is None:
            return []
        file = self.file
        if self.plant is None:  # all else can be said of a file whose rig is not known
            file = file.model_copy(update={RIG: IdealRig(kind="ideal")})
        said = summary(file)
        if self.plant is None and isinstance(self.file.rig, RigInFile):
            said[RIG] = f"that of {self.file.rig.file}"
        return [(title, said[key].replace("\n", "; ")) for key, title in TITLES.items() if key in said]


def archived_tests(archive: Archive) -> ArchivedTests:
    """Return the description of the tests in an archive; texts of another version raise no error."""
    texts = archived_texts(archive)
    if "rts_text" not in texts:
        return ArchivedTests(None, ["The archive does not hold the text of the file of tests."])
    path = Path(str(archive.attributes.get("rts_file") or "rts.yaml"))
    try:
        found, problems = check_model(texts["rts_text"], RtsFile, "substructure test file", "edesign_rts: 1")
        if found is None or problems.found:
            return ArchivedTests(None, [f"This version cannot read the text of {path.name}."])
        found.read_from(path, texts["rts_text"], problems.root)
        tests = ArchivedTests(found)
        found.set_named(_project(found, texts), _rig(found, texts, archive, tests.notes))
        placed = found.law
        if placed is not None and placed.path == found.path and placed.law.file is not None:
            take_text(found, placed.law.file, texts.get("law_text"))
    except EdesignError as error:
        return ArchivedTests(None, [f"The file of tests cannot be read: {error}."])
    _make_laboratory(tests)
    return tests


def described_tests(file: RtsFile) -> ArchivedTests:
    """Return the description of a file of tests, as `archived_tests` does of an archive.

    Args:
        file: from `load_rts_file`.
    """
    tests = ArchivedTests(file)
    _make_laboratory(tests)
    return tests


def _project(file: RtsFile, texts: dict[str, str]) -> Project | None:
    """The project; a file that needs one and has none cannot be used."""
    if not isinstance(file.structure, ProjectStructure):
        return None
    return project_of_texts(texts, Path(file.structure.project))


def _rig(file: RtsFile, texts: dict[str, str], archive: Archive, notes: list[str]) -> RigFile | None:
    """The rig file, by its text, or as it stands beside the file of tests today."""
    if not isinstance(file.rig, RigInFile):
        return None
    name = file.rig.file
    if "rig_text" in texts:
        found, problems = check_model(texts["rig_text"], RigFile, "rig file", "rig: {kind: second_order, ...}")
        if found is not None and not problems.found:
            return found
        notes.append(f"This version cannot read the text of the rig file {name}.")
        return None
    beside = archive.path.parent / str(archive.attributes.get("source_file") or file.path)
    there = beside.parent / name
    try:
        found = read_rig_file(there) if there.is_file() else None
    except EdesignError:
        found = None
    said = f"is read from {name} as it is today" if found is not None else f"stands in {name}, which is not at hand"
    notes.append(f"The archive does not hold the rig; it {said}.")
    return found


def _make_laboratory(tests: ArchivedTests) -> None:
    file = tests.file
    assert file is not None
    if isinstance(file.rig, RigInFile) and file.rig_file is None:
        return
    tests.plant = file.plant
    try:
        tests.tests = VirtualLaboratory(file)
        tests.transfer = tests.tests.laboratory.transfer
    except (EdesignError, OSError) as error:
        tests.notes.append(f"Structure and law are not drawn: {error}.")
        if tests.plant.kind != "servo_hydraulic":  # of which the specimen is a part
            tests.transfer = rig_transfer(tests.plant, 0.0)
