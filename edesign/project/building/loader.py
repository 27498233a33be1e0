"""Reading a building file."""

from __future__ import annotations

from pathlib import Path
from typing import TypeVar

from edesign.project.building.building import Building
from edesign.project.building.checks.analyses import check_analyses
from edesign.project.building.checks.dampers import check_dampers
from edesign.project.building.checks.design import check_design
from edesign.project.building.checks.ends import check_building_ends
from edesign.project.building.checks.isolation import check_isolation
from edesign.project.building.checks.layout import check_layout
from edesign.project.building.checks.loads import check_loads
from edesign.project.building.checks.plausible import check_given_masses, check_plausible
from edesign.project.building.members import BeamRun, BraceRun, ColumnRun
from edesign.project.checks.foundations import check_foundations
from edesign.project.frame.sections import Catalogue
from edesign.project.reading.file_model import Reader
from edesign.project.reading.problems import FileProblems
from edesign.project.reading.yaml_file import check_model, read_yaml_text

_WHAT, _BEGINS = "building file", "edesign_building: 1"
R = TypeVar("R", ColumnRun, BeamRun, BraceRun)


class BuildingError(FileProblems):
    """A building file is wrong."""


def load_building(path: Path | str, profiles: Catalogue | None = None) -> Building:
    """Read and check a building file.

    Args:
        path: the YAML file, UTF-8.
        profiles: names of the catalogue's sections, which take the place of other spellings of them in the building;
            None leaves section names unchecked.

    Returns:
        The building, all values in SI.

    Raises:
        InputError: the file cannot be read.
        BuildingError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    return parse_building(read_yaml_text(path, _WHAT), path, profiles)


def parse_building(
    text: str, path: Path | str = "building.yaml", profiles: Catalogue | None = None, files: bool = True
) -> Building:
    """Check the text of a building file that (supposedly) stands at `path`; otherwise as `load_building`.

    Args:
        path: where the file stands, for messages and for the files that it names.
        profiles: names of the catalogue's sections, as for `load_building`.
        files: whether the files that it names must exist.

    Returns:
        The building, all values in SI.

    Raises:
        BuildingError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    building, problems = check_model(text, Building, _WHAT, _BEGINS)
    if building is not None:
        read = Reader(parse_building, path, {"profiles": profiles, "files": files}, _completed)
        building = read.completed(building)
        building.read_from(path, text, problems.root, read)
        # cross checks need a whole building, those of loads and design one whose members stand
        check_plausible(building, problems)
        check_layout(building, problems, profiles)
        check_foundations(building, problems, building.supports, ("supports",))
        if not problems.found:
            check_loads(building, problems, profiles)
            check_given_masses(building, problems)
            check_design(building, problems, files)
            check_dampers(building, problems, profiles)
            check_building_ends(building, problems)
            check_isolation(building, problems, profiles)
            check_analyses(building, problems, files)
    if building is None or problems.found:
        raise BuildingError(path, problems.found)
    return building


def _completed(building: Building, profiles: Catalogue | None) -> Building:
    """The building with the catalogue's names of sections, beside its own ones, and with all groups named."""

    def section(written: str, brace: bool = False) -> str:
        if profiles is None or written in building.sections:
            return written
        return profiles.canonical(written) or profiles.canonical_in_building(written, brace) or written

    def named(run: R, group: str) -> R:
        known = section(run.section, isinstance(run, BraceRun))
        return run.model_copy(update={"section": known, "group": run.group or group})

    dampers, loads = building.dampers, building.loads
    areas = tuple(
        area
        if area.secondary_section is None
        else area.model_copy(update={"secondary_section": section(area.secondary_section)})
        for area in loads.areas
    )
    return building.model_copy(
        update={
            "loads": loads.model_copy(update={"areas": areas}),
            "dampers": dampers if dampers is None else dampers.with_sections(section),
            "columns": tuple(named(run, f"C{i}") for i, run in enumerate(building.columns, 1)),
            "beams": tuple(named(run, f"B{run.along.upper()}{i}") for i, run in enumerate(building.beams, 1)),
            "braces": tuple(named(run, f"D{i}") for i, run in enumerate(building.braces, 1)),
        }
    )
