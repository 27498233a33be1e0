"""Run the elastic design of a building into an archive."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from edesign.archive.dataset import Group
from edesign.archive.files import source_file
from edesign.archive.owner import check_owner
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import ArchiveError
from edesign.optional_stages import optional
from edesign.project.building.building import Building
from edesign.space.archived import PLACE, SELECTION, groups
from edesign.space.check import building_warnings
from edesign.space.elastic_design import ElasticDesign, elastic_design
from edesign.study.results.kinds import BUILDING
from edesign.study.results.provenance import add_hazard_files, circumstances, versions
from edesign.study.results.warnings import ATTRIBUTE


def run_building(
    building: Building,
    archive_path: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Callable[[str], None] = lambda stage: None,
) -> tuple[Path, ElasticDesign]:
    """Analyse and check a building, and archive the results.

    Args:
        building: from `load_building`.
        archive_path: the archive; by default beside the file, with its name.
        overwrite: True replaces the archive of something else too.
        progress: called with the name of each stage at its beginning.

    Returns:
        The archive, and the design.

    Raises:
        InputError: the file lacks something that the design needs, or the values are not those of its text.
        CoreError: the structure is a mechanism.
        ArchiveError: the archive cannot be written, or is that of something else.
    """
    building.check_unchanged()
    path = Path(archive_path) if archive_path is not None else building.archive_path
    check_owner(path, _root(building, building.path, path), overwrite)
    selection = _kept_selection(building, path)
    design = elastic_design(building, progress)
    progress(f"writing {path}")
    write_building(building, design, path, selection)
    return path, design


def check_building_archive(building: Building, file: Path, path: Path, overwrite: bool) -> None:
    """Refuse an archive of something else at a path, where that of the building is to be written.

    Args:
        building: with the title.
        file: the building file that the archive will be of.
        overwrite: True replaces the archive of something else too.

    Raises:
        ArchiveError: the archive is that of something else.
    """
    check_owner(path, _root(building, file, path), overwrite)


def write_building(building: Building, design: ElasticDesign, path: Path, selection: Group | None = None) -> None:
    """Write the archive of the design of a building.

    Args:
        building: the file that was designed.
        selection: how its sections were chosen, if `edesign design` did so.

    Raises:
        ArchiveError: the archive cannot be written.
    """
    root = _root(building, building.path, path)
    name = f"{building.path.name}:"  # wherever the file stands
    warnings: list[str] = []
    with optional("the warnings about the building") as attempt:
        warnings = list(building_warnings(building))
    if attempt.failure is not None:
        warnings = [str(attempt.failure)]
    root.attributes[ATTRIBUTE] = [text.replace(f"{building.path}:", name) for text in warnings]
    with ArchiveWriter(path, root, extra={"provenance": circumstances()}) as writer:
        for place, group in groups(design):
            writer.write(place, group)
        if selection is not None:
            writer.write(f"{PLACE}/{SELECTION}", selection)
        writer.finish({"status": "completed"})


def _root(building: Building, file: Path, path: Path) -> Group:
    root = Group(
        attributes={
            "title": building.title,
            "document": dict(building.document.said),
            "kind": BUILDING,
            "building_file": file.name,
            "building_checksum": building.checksum,
            "source_file": source_file(file, path),
            **versions(),
            "planned": [],
            "status": "running",
        }
    )
    root.add("building_text", (), building.text, "", "text of the building file")
    add_hazard_files(root, building.hazard)
    return root


def _kept_selection(building: Building, path: Path) -> Group | None:
    """How the sections were chosen, from an earlier archive of the same text; None without one."""
    place = f"{PLACE}/{SELECTION}"
    try:
        with open_archive(path) as archive:
            same = archive.attributes.get("building_checksum") == building.checksum
            return archive.group(place) if same and archive.has(place) else None
    except ArchiveError:
        return None
