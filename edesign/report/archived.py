"""The project and the study whose texts an archive holds; their files need not be at hand."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.errors import ArchiveError, EdesignError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.ground_motion.seismic_action.files import text_name
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.loader import parse_project
from edesign.project.project import Project
from edesign.project.reading.file_model import FileModel
from edesign.project.study.study import Study
from edesign.project.study.study_loader import parse_study
from edesign.study.results.kinds import BUILDING, STUDY

if TYPE_CHECKING:
    from edesign.project.building import Building


_CHECKSUMS = ("input_checksum", "project_checksum", "building_checksum", "rts_checksum")


def input_checksum(about: Mapping[str, object]) -> str:
    """Return the SHA-256 of the input of an archive, of whichever kind; "unknown" if it holds none.

    Args:
        about: attributes of the root of the archive.
    """
    of_design = about.get("kind") == BUILDING and not about.get("planned")  # that depends on its own text alone
    names = ("building_checksum",) if of_design else _CHECKSUMS
    return str(next((about[name] for name in names if about.get(name)), "unknown"))


def archived_project(archive: Archive) -> Project | None:
    """Return the project whose analyses an archive has; None if it does not have the text of it.

    Raises:
        InputError: the text is not that of a project of this version.
    """
    texts = archived_texts(archive)
    if "project_text" not in texts:
        return None
    path = Path(str(archive.attributes.get("project_file") or "project.yaml"))
    return project_of_texts(texts, path)


def archived_texts(archive: Archive) -> dict[str, str]:
    """Return the texts of the root of an archive by their names; errors as those of `Archive.group`."""
    return {name: str(one.values) for name, one in archive.view().variables.items() if one.values.ndim == 0}


def project_of_texts(texts: Mapping[str, str], path: Path) -> Project:
    """Return a project by its archived text, which takes the files of laws and hazard from the archive as well.

    Args:
        path: of the project, for messages.

    Raises:
        InputError: the text is not that of a project of this version.
    """
    project = parse_project(texts.get("project_text", ""), path, BuildingSections(), files=False)
    _take_texts(project, texts)
    return project


def _take_texts(file: AnalysisFile, texts: Mapping[str, str]) -> None:
    """Let a project or building read the files that its hazard and its laws name from the archived texts.

    Args:
        texts: texts of the root of the archive, by name.
    """
    for keys, named in file.hazard.files() if file.hazard is not None else ():
        take_text(file, named, texts.get(text_name(keys)))
    laws = file.dampers.laws if file.dampers is not None else {}
    for name, law in laws.items():
        if law.file is not None:
            take_text(file, law.file, texts.get(f"law_text_{name}"))


def take_text(holder: FileModel, file: str, text: str | None) -> None:
    """Let a file read a file that it names from the archived text, whatever is on the disk.

    Args:
        holder: the file of the user.
        text: the archived text; None: the archive has none, and the disk is read.
    """
    if text is not None:
        holder.content(holder.folder / file, lambda _: text.encode())


def archived_building(archive: Archive) -> Building | None:
    """Return the building whose design an archive has; None if it does not have the text of it.

    Raises:
        InputError: the text is not that of a building of this version.
    """
    from edesign.project.building import parse_building

    texts = archived_texts(archive)
    if "building_text" not in texts:
        return None
    path = Path(str(archive.attributes.get("building_file") or "building.yaml"))
    building = parse_building(texts["building_text"], path, BuildingSections(), files=False)
    _take_texts(building, texts)
    return building


def archived_base(archive: Archive) -> AnalysisFile | None:
    """Return the project or the building whose analyses an archive has; errors as `archived_project`."""
    return archived_project(archive) or archived_building(archive)


def archived_hazard(archive: Archive) -> Hazard | None:
    """Return the hazard of the file whose analyses an archive has; None without one, or if its text cannot be read."""
    try:
        base = archived_base(archive)
    except EdesignError:
        return None
    return None if base is None else base.hazard


def archived_frame(archive: Archive) -> Project | None:
    """Return the project of an archive of a plane frame; None of a building, or if its text cannot be read."""
    try:
        return archived_project(archive)
    except EdesignError:
        return None


def archived_study(archive: Archive) -> Study | None:
    """Return the study whose analyses an archive has; None if it is that of a project.

    Raises:
        InputError: the text is not that of a study of this version.
        ArchiveError: there is no such text.
    """
    base = archived_base(archive)
    if base is None or archive.attributes.get("kind") != STUDY:
        return None
    text = archive.view().variables.get("study_text")
    if text is None:
        raise ArchiveError(f"{archive.path}: damaged: the text of the study (`study_text`) is missing [E-ARCH-03]")
    path = Path(str(archive.attributes.get("study_file") or "study.yaml"))
    return parse_study(str(text.values), path, base)
