"""Where results come from: versions, checksums, and the moment and machine, which are kept apart from the results."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path

import numpy as np
import scipy

import edesign
from edesign import core
from edesign._version import __version__
from edesign.archive.dataset import Group
from edesign.damper.law_file import WHAT
from edesign.damper.testing.property_table import property_table_content
from edesign.ground_motion.seismic_action.files import hazard_files
from edesign.project.actions.hazard_base import Hazard
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.dampers.designs import ElastomerDesign, FileProperties
from edesign.project.study.study import Study
from edesign.study.results.kinds import BUILDING, STUDY

IDENTITY = ("analysis_checksum", "edesign_version", "core_version", "code_checksum", "libraries")
"""Root attributes that decide whether results of an earlier run may be reused: all that results depend on."""

CODE = (".py", ".so", ".pyd", ".csv", ".yaml", ".json")  # of files that results depend on; tables of codes, laws too


def code_checksum() -> str:
    """Return the SHA-256 of the installed package, which keeps results of different states of one version apart."""
    package = Path(edesign.__file__).parent
    checksum = hashlib.sha256()
    for path in sorted(path for path in package.rglob("*") if path.suffix in CODE and path.is_file()):
        content = hashlib.sha256(path.read_bytes()).hexdigest()
        checksum.update(f"{path.relative_to(package).as_posix()} {content}\n".encode())
    return checksum.hexdigest()


def input_checksum(project: AnalysisFile, records: Mapping[str, str]) -> str:
    """Return the SHA-256 of all files that a run reads.

    Args:
        project: its text counts, and the files of its laws of dampers and of its hazard.
        records: SHA-256 of the samples of each record, by name.
    """
    return _of_parts(project.checksum, *_other_inputs(project, records))


def _other_inputs(project: AnalysisFile, records: Mapping[str, str]) -> list[str]:
    """What a run reads beside the text of the project."""
    parts = [f"{name} {records[name]}" for name in sorted(records)]
    parts += [_checksum(file, content) for file, content in _law_files(project).values()]
    return parts + [_checksum(file, content) for file, content in hazard_files(project.hazard).values()]


def _of_parts(*parts: str) -> str:
    return hashlib.sha256("\n".join(parts).encode()).hexdigest()


def study_root_group(study: Study, planned: list[str], records: Mapping[str, str]) -> Group:
    """Return the root of a study's archive: that of its project, and the text of the study file.

    Args:
        study: from `load_study`.
        planned: names of the analyses.
        records: SHA-256 of the samples of each record that is used, by name.
    """
    group = root_group(study.base, planned, records)
    group.attributes |= {"kind": STUDY, "title": study.title, "study_file": study.path.name}
    group.attributes["document"] = dict(study.document.over(study.base.document).said)
    group.attributes["project_checksum"] = study.checksum
    tables = {
        name: (design.properties.file, property_table_content(study.base, study.folder / design.properties.file))
        for name, design in study.designs.items()
        if isinstance(design, ElastomerDesign) and isinstance(design.properties, FileProperties)
    }
    of_tables = [_checksum(*table) for table in tables.values()]
    others = (*_other_inputs(study.base, records), *of_tables)
    group.attributes["analysis_checksum"] = _of_parts(study.analysis_checksum, *others)
    group.attributes["input_checksum"] = _of_parts(study.checksum, str(group.attributes["input_checksum"]), *of_tables)
    group.add("study_text", (), study.text, "", "text of the study file")
    for name, table in tables.items():
        _add_file(group, f"properties_text_{name}", "property table", *table)
    return group


def _law_files(project: AnalysisFile) -> dict[str, tuple[str, bytes]]:
    """Name and content of the files of laws, by law."""
    laws = project.dampers.laws if project.dampers is not None else {}
    return {
        name: (law.file, project.yaml_content(law.file, WHAT)) for name, law in laws.items() if law.file is not None
    }


def _checksum(file: str, content: bytes) -> str:
    return f"{Path(file).name} {hashlib.sha256(content).hexdigest()}"


def _add_file(group: Group, name: str, what: str, file: str, content: bytes) -> None:
    group.add(name, (), content.decode("utf-8-sig", errors="replace"), "", f"text of the {what} {file}")


def add_hazard_files(group: Group, hazard: Hazard | None) -> None:
    """Add the texts of the files that a hazard names to the root of an archive.

    Args:
        hazard: of the project; None: it has none.
    """
    for name, file in hazard_files(hazard).items():
        _add_file(group, name, "hazard file", *file)


def root_group(project: AnalysisFile, planned: list[str], records: Mapping[str, str]) -> Group:
    """Return the root of an archive: texts of the project and its law files, checksums, versions, planned analyses.

    Args:
        project: a project or a building, which the names of its text, file and checksum say.
        records: SHA-256 of the samples of each record that is used, by name.
    """
    group = Group(
        attributes={
            "title": project.title,
            "document": dict(project.document.said),
            **({"kind": BUILDING} if isinstance(project, Building) else {}),
            f"{project.kind}_file": project.path.name,
            f"{project.kind}_checksum": project.checksum,
            "input_checksum": input_checksum(project, records),
            "analysis_checksum": _of_parts(project.analysis_checksum, *_other_inputs(project, records)),
            "record_checksums": dict(records),
            **versions(),
            "planned": planned,
            "status": "running",
        }
    )
    group.add(f"{project.kind}_text", (), project.text, "", f"text of the {project.kind} file")
    for name, file in _law_files(project).items():
        _add_file(group, f"law_text_{name}", "law file", *file)
    add_hazard_files(group, project.hazard)
    return group


def versions() -> dict[str, str]:
    """Return the version and the package checksum of the program that computes."""
    return {
        "edesign_version": __version__,
        "core_version": core.version(),
        "code_checksum": code_checksum(),
        "libraries": ", ".join(f"{name} {version}" for name, version in libraries().items()),
    }


def libraries() -> dict[str, str]:
    """Return the versions of numerical libraries, which may change the last digits of results."""
    return {
        **core.library_versions(),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "pint": metadata.version("pint"),
        "processor": platform.machine(),
    }


def circumstances() -> Group:
    """Return time, machine and versions of other libraries: whatever may differ between runs with equal results."""
    from edesign.archive.hdf5 import library_versions  # it loads h5py, which a check does not need

    return Group(
        attributes={
            "created": now(),
            "python_version": platform.python_version(),
            "numpy_version": np.__version__,
            "platform": platform.platform(),
            **library_versions(),
        }
    )


def now() -> str:
    """Return the moment as ISO 8601, UTC, to the second."""
    return datetime.now(UTC).isoformat(timespec="seconds")
