"""Run the elastic design of a building into an archive, alone or beside its analyses."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path

from edesign.archive.dataset import Group
from edesign.archive.files import source_file
from edesign.archive.owner import check_owner
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import ArchiveError
from edesign.one_thread import one_thread
from edesign.optional_stages import optional
from edesign.project.building.building import Building
from edesign.space.archived import PLACE, SELECTION, groups
from edesign.space.check import building_warnings
from edesign.space.elastic_design import ElasticDesign, elastic_design
from edesign.study.results.provenance import circumstances, root_group
from edesign.study.results.warnings import ATTRIBUTE
from edesign.study.run.state import RunState


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
    root.attributes[ATTRIBUTE] = archived_warnings(building)
    with ArchiveWriter(path, root, extra={"provenance": circumstances()}) as writer:
        for place, group in _groups(design, selection):
            writer.write(place, group)
        writer.finish({"status": "completed"})


def archived_warnings(building: Building) -> list[str]:
    """Return the warnings about a building, whose file they name without its folder.

    Args:
        building: from `load_building`.
    """
    warnings: list[str] = []
    with optional("the warnings about the building") as attempt:
        warnings = list(building_warnings(building))
    if attempt.failure is not None:
        warnings = [str(attempt.failure)]
    return [text.replace(f"{building.path}:", f"{building.path.name}:") for text in warnings]


def archive_design(building: Building, path: Path, run: RunState) -> None:
    """Make the elastic design of a building, and write it into the archive of its analyses.

    Args:
        building: from `load_building`; nothing is done without its `design`.
        path: of the archive that an earlier run wrote.

    Raises:
        InputError, CoreError: as `run_building`.
    """
    if building.design is None:
        return
    selection = _kept_selection(building, path)
    run.say("elastic design")
    with one_thread():
        design = elastic_design(building)
    for place, group in _groups(design, selection):
        run.archive(place, group)


def _groups(design: ElasticDesign, selection: Group | None) -> Iterator[tuple[str, Group]]:
    yield from groups(design)
    if selection is not None:
        yield f"{PLACE}/{SELECTION}", selection


def _root(building: Building, file: Path, path: Path) -> Group:
    root = root_group(building, [], {})
    root.attributes |= {"building_file": file.name, "source_file": source_file(file, path)}
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
