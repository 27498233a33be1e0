"""Projects, studies and buildings made in Python: what a file would say, as arguments, read and checked as a file."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import yaml
from pydantic import BaseModel, ValidationError

from edesign.errors import InputError
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building.building import Building
from edesign.project.building.loader import parse_building
from edesign.project.loader import parse_project
from edesign.project.notation.si_numbers import SiCount, SiNumber, in_si
from edesign.project.notation.units import units_of
from edesign.project.project import Project
from edesign.project.reading.file_model import FileModel
from edesign.project.reading.problems import MOST_SHOWN, FileProblems, Problem, Problems
from edesign.project.reading.yaml_nodes import Mark, parse
from edesign.project.study.study import Study
from edesign.project.study.study_loader import parse_study

F = TypeVar("F", bound=FileModel)
Block = Mapping[str, Any]
"""A mapping of a file, with its keys; values are texts with units, or numbers in SI."""
Blocks = Sequence[Block]
_LEAST, _MOST = 1.0, 10_000.0
"""Between which a number is written, if it has a unit for it; in the SI unit from a hundredth of the first on."""


class ArgumentProblems(FileProblems):
    """Arguments are wrong; the message lists the problems found by argument, at most the first of very many."""

    def __init__(self, function: str, path: Path, problems: Sequence[Problem]) -> None:
        super().__init__(path, problems)
        self.args = ("\n".join(f"{function}: {problem}" for problem in self.problems[:MOST_SHOWN]),)


def make_project(
    title: str,
    *,
    frame: Block,
    materials: Block,
    analyses: Blocks,
    sections: Block | None = None,
    fibres: Block | None = None,
    loads: Block | None = None,
    masses: Block | None = None,
    elements: Block | None = None,
    hinges: Blocks | None = None,
    joints: Blocks | None = None,
    panel_zones: Blocks | None = None,
    soils: Block | None = None,
    dampers: Block | None = None,
    damping: Block | None = None,
    integration: Block | None = None,
    validity: Block | None = None,
    hazard: Block | None = None,
    design: Block | None = None,
    records: Block | None = None,
    outputs: Block | None = None,
    document: Block | None = None,
    path: Path | str = "project.yaml",
) -> Project:
    """Make a project of what its file would say: the arguments are the keys of a project file, checked as these.

    A value with a dimension is a text with its unit, or a number in SI: `3.5`, `"3.5 m"` and `"350 cm"` are one height.
    Lists may be arrays. Values that a file writes in several ways, such as places along a member, and the parameters of
    damper laws need their units as text, and temperatures too.

    Args:
        title: one line for tables and reports.
        frame: grid, supports and members.
        materials: steels by name.
        analyses: what is analysed; names differ.
        sections: own cross-sections by name.
        fibres: how many fibres an I section is cut into.
        loads: permanent and variable loads, and their combination.
        masses: of the nodes, given or from the loads.
        elements: how members are modelled.
        hinges: plastic hinges at the ends of members.
        joints: semi-rigid joints.
        panel_zones: joints whose panel shears.
        soils: soils by name.
        dampers: laws and devices.
        damping: inherent damping.
        integration: time integration.
        validity: errors and drifts beyond which a result does not count.
        hazard: seismic action and its levels.
        design: how members are checked under the forces of histories.
        records: ground motions by name.
        outputs: what is kept in the archive.
        document: what the cover of a report says.
        path: where the file would stand: files that it names are relative to its folder, and the archive stands beside
            it. Nothing is written there; `project.to_yaml(path)` writes it.

    Returns:
        The project, as `load_project` returns it.

    Raises:
        ArgumentProblems: an argument is wrong; the message names each by its place, such as `frame.columns[0].section`.

    Examples:
        >>> project = edesign.make_project(
        ...     "Portal",
        ...     frame={"storeys": [4.0], "bays": [6.0], "supports": "fixed",
        ...            "columns": [{"storeys": "all", "section": "HEB200", "material": "S275"}],
        ...            "beams": [{"floors": "all", "section": "IPE300", "material": "S275"}]},
        ...     materials={"S275": {"law": "bilinear", "E": "210 GPa", "fy": 275e6, "hardening": 0.01}},
        ...     loads={"beams": [{"floors": "all", "G": 20e3}], "gravity": {"G": 1.0}},
        ...     masses={"from_loads": {"G": 1.0}},
        ...     analyses=[{"name": "modes", "kind": "modal", "modes": 1}],
        ... )
        >>> done = edesign.run_project(project)
        >>> with edesign.open_archive(done.archive) as archive:
        ...     f"{archive.table('periods')['T'][0]:.2f} s"
        '0.40 s'
    """
    said = {"edesign": 1, "title": title, **_given(locals(), Project)}
    return _made("make_project", said, Project, Path(path), parse_project)


def make_building(
    title: str,
    *,
    plan: Block,
    storeys: Block | Sequence[float | str],
    columns: Blocks,
    beams: Blocks,
    materials: Block,
    braces: Blocks | None = None,
    setbacks: Blocks | None = None,
    supports: str | Block | None = None,
    restrained_floors: Blocks | None = None,
    soils: Block | None = None,
    diaphragms: Any = None,
    partial_diaphragms: Blocks | None = None,
    missing: Block | None = None,
    sections: Block | None = None,
    fibres: Block | None = None,
    loads: Block | None = None,
    masses: Block | None = None,
    elements: Block | None = None,
    hinges: Blocks | None = None,
    joints: Blocks | None = None,
    panel_zones: Blocks | None = None,
    dampers: Block | None = None,
    damping: Block | None = None,
    integration: Block | None = None,
    validity: Block | None = None,
    hazard: Block | None = None,
    records: Block | None = None,
    design: Block | None = None,
    analyses: Blocks | None = None,
    outputs: Block | None = None,
    document: Block | None = None,
    path: Path | str = "building.yaml",
) -> Building:
    """Make a building of what its file would say; otherwise as `make_project`.

    Args:
        title: one line for tables and reports.
        plan: the grid in plan.
        storeys: their heights, or `{"count": 5, "height": 3.5}`.
        columns: runs of columns.
        beams: runs of beams.
        materials: steels by name.
        braces: runs of braces.
        setbacks: floors that cover some bays only.
        supports: of all columns, or by column line.
        restrained_floors: floors above the base that the ground holds.
        soils: soils by name.
        diaphragms: floors that are rigid in their plane.
        partial_diaphragms: those of which some bays alone are rigid.
        missing: members that the regular grid has and this building has not.
        sections: own cross-sections by name.
        fibres: how many fibres a section is cut into.
        loads: permanent and variable loads.
        masses: of the nodes.
        elements: how members are modelled.
        hinges: plastic hinges at the ends of members.
        joints: semi-rigid joints.
        panel_zones: joints whose panel shears.
        dampers: laws and devices.
        damping: inherent damping.
        integration: time integration.
        validity: errors and drifts beyond which a result does not count.
        hazard: seismic action and its levels.
        records: ground motions by name.
        design: what is checked.
        analyses: what is analysed beside the design.
        outputs: what is kept in the archive.
        document: what the cover of a report says.
        path: where the file would stand, as of `make_project`.

    Raises:
        ArgumentProblems: an argument is wrong.
    """
    said = {"edesign_building": 1, "title": title, **_given(locals(), Building)}
    return _made("make_building", said, Building, Path(path), parse_building)


def make_study(
    title: str,
    project: Project | Building,
    *,
    variants: Block,
    designs: Block | None = None,
    vary: Blocks | None = None,
    modal: Block | None = None,
    histories: Blocks | None = None,
    incremental: Blocks | None = None,
    pushovers: Blocks | None = None,
    criteria: Blocks | None = None,
    objectives: Sequence[str] | None = None,
    device_factors: str | Block | None = None,
    outputs: Block | None = None,
    document: Block | None = None,
    path: Path | str = "study.yaml",
) -> Study:
    """Make a study of a project or building; otherwise as `make_project`.

    Args:
        title: one line for tables and reports.
        project: from `make_project`, `load_project` or their like.
        variants: frames that are compared, by name.
        designs: dampers to be sized, by name.
        vary: values of the project in turn.
        modal: natural modes that are reported.
        histories: time histories of the plan.
        incremental: incremental dynamic analyses.
        pushovers: pushovers of the variants.
        criteria: what is demanded.
        objectives: cells of the table of FEMA 356.
        device_factors: those of the code on stroke, velocity and force of dampers.
        outputs: what is kept in the archive.
        document: what the cover of a report says.
        path: where the file would stand, as of `make_project`.

    Raises:
        ArgumentProblems: an argument is wrong.
    """
    given = _given({**locals(), "project": project.path.name}, Study)
    said = {"edesign_study": 1, "title": title, "project": project.path.name, **given}

    def read(text: str, of: Path, profiles: BuildingSections) -> Study:
        return parse_study(text, of, project, profiles)

    return _made("make_study", said, Study, Path(path), read)


def _given(arguments: Mapping[str, Any], model: type[BaseModel]) -> dict[str, Any]:
    """The arguments that are keys of a file, in its order."""
    return {key: arguments[key] for key in model.model_fields if arguments.get(key) is not None and key != "title"}


def _made(
    function: str, said: Mapping[str, Any], model: type[F], path: Path, read: Callable[[str, Path, BuildingSections], F]
) -> F:
    numbers = {}
    problems = Problems(parse("")[0])
    for key, value in said.items():
        try:
            numbers[key] = in_si(value)
        except TypeError as error:
            problems.add(Mark(1, 1), (key,), f"{error}; give texts, numbers, lists or mappings [E-VALUE-01]")
    if problems.found:
        raise ArgumentProblems(function, path, problems.found)
    meant: F | None = None
    try:
        meant = model.model_validate(numbers)  # by which numbers learn their units
    except ValidationError:
        pass  # the reader of the text says what is wrong
    text = yaml.dump(
        _with_units(numbers), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=120, default_flow_style=None
    )
    try:
        made = read(text, path, BuildingSections())
    except FileProblems as error:
        raise ArgumentProblems(function, path, error.problems) from None
    if meant is not None and meant != model.model_validate(made.root.plain()):
        raise InputError(f"{function}: a number can be read in several ways; give texts with units [E-EDIT-01]")
    return made


class _Dumper(yaml.SafeDumper):
    """Writes values out wherever they stand."""

    def ignore_aliases(self, data: Any) -> bool:
        return True


def _with_units(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _with_units(below) for key, below in value.items()}
    if isinstance(value, tuple):
        return [_with_units(below) for below in value]
    if not isinstance(value, SiNumber | SiCount):
        return value
    plain = int(value) if isinstance(value, SiCount) else float(value)
    if value.kind is None:
        return plain
    units = units_of(value.kind)
    usual = value.kind.example.split(" ", 1)[1]
    for unit in dict.fromkeys([usual, value.kind.unit, *sorted(units, key=lambda one: -units[one])]):
        factor = units.get(unit, math.inf)
        number = f"{plain / factor:.12g}"
        least = _LEAST / 100.0 if factor == 1.0 else _LEAST
        if unit and least <= abs(float(number)) < _MOST and float(number) * factor == plain:
            return f"{number} {unit}"
    return f"{plain!r} {value.kind.unit}"
