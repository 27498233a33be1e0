"""`edesign check`: read a project, study, building or substructure tests, build the frame, and run nothing."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from edesign.project.reading.file_model import FileModel


def check(
    project: Annotated[
        Path, typer.Argument(help="The project, study, building or substructure test file.", show_default=False)
    ],
    drawing: Annotated[
        Path | None,
        typer.Argument(help="With --figure: the file, .pdf, .html, .svg or .png; by default beside the first one."),
    ] = None,
    figure: Annotated[bool, typer.Option("--figure", help="Draw the model, and tell where.")] = False,
) -> None:
    """Check a project, study, building or substructure test file, its records and its frame; print a summary."""
    from edesign.errors import InputError
    from edesign.file_kinds import BUILDING, STUDY, SUBSTRUCTURE_TESTS, kind_of
    from edesign.report.tables.visible import visible_line

    if drawing is not None and not figure:
        raise InputError(f"{drawing}: `check` takes one file; a second one is the drawing of its model: add --figure")
    target = None
    if figure:
        from edesign.report.model.write import check_figure_path, default_figure_path

        target = default_figure_path(project) if drawing is None else drawing
        check_figure_path(target)
    kind = kind_of(project)  # what is needed for one kind alone is loaded for it alone
    if kind == SUBSTRUCTURE_TESTS:
        from edesign.building.building_sections import BuildingSections
        from edesign.project.substructure import load_rts_file
        from edesign.project.substructure.summary import summary
        from edesign.substructure.virtual_tests import VirtualLaboratory

        tests = load_rts_file(project, BuildingSections())
        _draw(tests, target)
        laboratory = VirtualLaboratory(tests)
        _ = laboratory.drives  # records and commands are read
        warned = "\n".join(laboratory.laboratory.warnings)
        found = summary(tests) | ({"warnings": warned} if warned else {})
    elif kind == BUILDING:
        from edesign.building.building_file import load_building
        from edesign.space.check import check_building

        building = load_building(project)
        _draw(building, target)
        found = check_building(building)
    elif kind == STUDY:
        from edesign.building.project_file import load_study
        from edesign.study.check.summary import check_study

        study = load_study(project)
        _draw(study, target)
        found = check_study(study)
    else:
        from edesign.building.project_file import load_project
        from edesign.study.check.summary import check_project

        loaded = load_project(project)
        _draw(loaded, target)
        found = check_project(loaded)
    for label, text in found.items():
        for i, line in enumerate(text.split("\n")):
            print(visible_line(f"{label + ':' if i == 0 else '':<11} {line}"))
    count = len(found.get("warnings", "").splitlines())
    print("ok" if not count else f"ok, with {count} warning{'s' * (count > 1)}")


def _draw(file: FileModel, target: Path | None) -> None:
    """Draw a model before it is checked: what is wrong with it may be seen there first."""
    if target is None:
        return
    from edesign.report.model.drawings import draw_model

    for path in draw_model(file, target):
        print(f"{'figure:':<11} {path}")
