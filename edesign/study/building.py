"""Run the elastic design of a building into an archive."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

from edesign.archive.dataset import Group
from edesign.archive.files import source_file
from edesign.archive.owner import check_owner
from edesign.archive.writer import ArchiveWriter
from edesign.project.building.building import Building
from edesign.space.archived import groups
from edesign.space.elastic_design import ElasticDesign, elastic_design
from edesign.study.kinds import BUILDING
from edesign.study.provenance import circumstances, versions


def run_building(
    building: Building,
    archive_path: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    tell: Callable[[str], None] = lambda stage: None,
) -> tuple[Path, ElasticDesign]:
    """Analyse and check a building, and archive the results.

    Args:
        building: from `load_building`.
        archive_path: the archive; by default beside the file, with its name.
        overwrite: True replaces the archive of something else too.
        tell: called with the name of each stage at its beginning.

    Returns:
        The archive, and the design.

    Raises:
        InputError: the file lacks something that the design needs, or the values are not those of its text.
        CoreError: the structure is a mechanism.
        ArchiveError: the archive cannot be written, or is that of something else.
    """
    building.check_unchanged()
    path = Path(archive_path) if archive_path is not None else building.archive_path
    root = Group(
        attributes={
            "title": building.title,
            "kind": BUILDING,
            "building_file": building.path.name,
            "building_checksum": building.checksum,
            "source_file": source_file(building.path, path),
            **versions(),
            "planned": [],
            "status": "running",
        }
    )
    root.add("building_text", (), building.text, "", "text of the building file")
    check_owner(path, root, overwrite)
    design = elastic_design(building, tell)
    tell(f"writing {path}")
    with ArchiveWriter(path, root, extra={"provenance": circumstances()}) as writer:
        for place, group in groups(design):
            writer.write(place, group)
        writer.finish({"status": "completed"})
    return path, design
