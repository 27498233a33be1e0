"""`edesign check`: read a file of any kind and what it names, build what it describes, and run nothing."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import Annotated, TypeVar

import typer

from edesign.errors import InputError
from edesign.file_kinds.kinds import BUILDING, PROJECT, STUDY, SUBSTRUCTURE_TESTS
from edesign.file_kinds.recognise import kind_of
from edesign.optional_stages import optional
from edesign.project.reading.file_bytes import is_there, missing
from edesign.project.reading.file_model import FileModel
from edesign.report.tables.text import NARROWEST, PAPER, in_facts
from edesign.report.tables.visible import visible_line

Drawable = TypeVar("Drawable", bound=FileModel)


def check(
    file: Annotated[
        Path, typer.Argument(metavar="FILE", help="A file of edesign, of any kind; or a record.", show_default=False)
    ],
    drawing: Annotated[
        Path | None,
        typer.Argument(help="With --figure: the file, .pdf, .html, .svg or .png; by default beside the first one."),
    ] = None,
    figure: Annotated[bool, typer.Option("--figure", help="Draw the model, and print where.")] = False,
    folder: Annotated[
        list[Path] | None,
        typer.Option("--folder", metavar="DIR", help="More folders with your recordings of suites; may be repeated."),
    ] = None,
) -> None:
    """Check a file of any kind: a project with its records and frame, tests, laws, suites, ...; print a summary."""
    if drawing is not None and not figure:
        raise InputError(
            f"{drawing}: `check` takes one file; a second one is the drawing of its model: add --figure [E-CLI-05]"
        )
    target = None
    if figure:
        from edesign.report.model.write import check_figure_path, default_figure_path

        target = default_figure_path(file) if drawing is None else drawing
        check_figure_path(target)
    found = _summary(file, target, folder or [])
    terminal = shutil.get_terminal_size().columns if sys.stdout.isatty() else None
    for label, text in found.items():
        # elsewhere warnings stay whole: programs look for one a line
        width = terminal or (sys.maxsize if label == "warnings" else PAPER)
        for line in in_facts(f"{label}:", text, 12, max(width, NARROWEST)):
            print(visible_line(line))
    count = len(found.get("warnings", "").splitlines())
    print("ok" if not count else f"ok, with {count} warning{'s' * (count > 1)}")


def _summary(file: Path, target: Path | None, folders: list[Path]) -> dict[str, str]:
    """What is in the file; what is needed for one kind alone is loaded for it alone. The model is drawn first."""
    if not is_there(file):
        raise missing(file, "file")
    kind = kind_of(file)
    if folders and kind not in (None, PROJECT, STUDY, BUILDING):
        raise InputError(f"{file}: --folder is for recordings of projects, studies and buildings [E-CLI-01]")
    if kind == SUBSTRUCTURE_TESTS:
        from edesign.frame.sections.building_sections import BuildingSections
        from edesign.project.substructure import load_rts_file
        from edesign.project.substructure.summary import summary
        from edesign.substructure.virtual_tests import VirtualLaboratory

        tests = _drawn(load_rts_file(file, BuildingSections()), target)
        laboratory = VirtualLaboratory(tests)
        _ = laboratory.drives  # records and commands are read
        warned = "\n".join(laboratory.laboratory.warnings)
        return summary(tests) | ({"warnings": warned} if warned else {})
    from edesign.ground_motion.project_records import with_folders

    if kind == BUILDING:
        from edesign.frame.building_file import load_building
        from edesign.study.check.summary import check_project

        return check_project(with_folders(_drawn(load_building(file), target), folders))
    from edesign.frame.project_file import load_project, load_study
    from edesign.study.check.summary import check_project, check_study

    if kind == STUDY:
        study = _drawn(load_study(file), target)
        return check_study(study.of(with_folders(study.base, folders)) if folders else study)
    if kind != PROJECT:
        from edesign.report.check.by_kind import summary_of

        described = summary_of(file, kind)
        if described is not None:
            if target is not None:
                raise InputError(
                    f"{file}: --figure draws the models of projects, studies, buildings and substructure tests"
                    " [E-CLI-05]"
                )
            return described
    project = _drawn(load_project(file), target)  # which says what is wrong about a file that is none
    return check_project(with_folders(project, folders))


def _drawn(model: Drawable, target: Path | None) -> Drawable:
    """Draw a model before it is checked: what is wrong with it may be seen there first."""
    if target is not None:
        from edesign.report.model_drawings import draw_model

        with optional("the drawing of the model", passing=(InputError,)):  # which the check would report too
            for path in draw_model(model, target):
                print(f"{'figure:':<11} {path}")
    return model
