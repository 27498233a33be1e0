"""Run the elastic design of a building into an archive, alone or beside its analyses."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from edesign.archive.dataset import Group
from edesign.archive.files import check_own_yaml, source_file, write_yaml
from edesign.archive.owner import check_owner
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.errors import ArchiveError
from edesign.frame.building_file import load_building
from edesign.one_thread import one_thread
from edesign.optional_stages import optional
from edesign.project.building.building import Building
from edesign.space.archived import PLACE, SELECTION, groups
from edesign.space.check import building_warnings
from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import elastic_design
from edesign.space.selection.archived import selection_group
from edesign.space.selection.select import Selection, select_sections
from edesign.study.results.provenance import circumstances, root_group
from edesign.study.results.warnings import ATTRIBUTE
from edesign.study.run.state import RunState

DESIGNED = "designed.yaml"
"""File that a building with chosen sections is written to, beside that of the building."""


class BuildingRun(NamedTuple):
    """The elastic design of a building that was run.

    Attributes:
        archive: with all results.
        design: forces, displacements and checks, SI.
    """

    archive: Path
    design: ElasticDesign


class BuildingChoice(NamedTuple):
    """A building whose sections were chosen.

    Attributes:
        file: the building file with the sections.
        archive: of its design, and of how the sections were chosen.
        selection: the sections of the groups, their masses (kg) and what governs them.
    """

    file: Path
    archive: Path
    selection: Selection


def run_building(
    building: Building,
    archive_path: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    progress: Callable[[str], None] = lambda stage: None,
) -> BuildingRun:
    """Analyse and check a building, and archive the results.

    Args:
        building: from `load_building`.
        archive_path: the archive; by default beside the file, with its name.
        overwrite: True replaces the archive of something else too.
        progress: called with the name of each stage at its beginning.

    Returns:
        Where the archive is, and the design.

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
    return BuildingRun(path, design)


def design_building(
    building: Building,
    output: str | os.PathLike[str] | None = None,
    overwrite: bool = False,
    workers: int = 1,
    progress: Callable[[str], None] = lambda line: None,
) -> BuildingChoice:
    """Choose the lightest sections of a building that meet all checks, and write its file with them, and its archive.

    Args:
        building: from `load_building`, with the lists `design: select`.
        output: the building file to write; by default `designed.yaml` beside that of the building.
        overwrite: True replaces files that are of something else too.
        workers: processes that analyse at the same time; the choice does not depend on them.
        progress: called with a line for each step of the search.

    Returns:
        Where file and archive are, and the sections.

    Raises:
        InputError: a list is wrong, or none of its sections meet all checks; the message says which check stands in
            the way.
        CoreError: the structure is a mechanism.
        ArchiveError: a file cannot be written, or is that of something else.
    """
    path = building.path.with_name(DESIGNED) if output is None else Path(output)
    archive = path.with_suffix(".h5")
    check_own_yaml(path, building.path, overwrite)
    check_owner(archive, _root(building, path, archive), overwrite)
    found = select_sections(building, progress, workers)
    said = f"# Sections chosen: {found.mass / 1e3:.1f} t of steel, {found.evaluations} designs analysed.\n"
    write_yaml(said + found.building.text, path, building.path)
    write_building(load_building(path), found.design, archive, selection_group(found))
    return BuildingChoice(path, archive, found)


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
