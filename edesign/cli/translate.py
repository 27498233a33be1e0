"""`edesign translate`: the model of a project for another program."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def translate(
    project: Annotated[Path, typer.Argument(help="The project file.", show_default=False)],
    model: Annotated[
        Path,
        typer.Argument(
            help="The file to write; its ending says for which program: .py OpenSeesPy, .tcl OpenSees.",
            show_default=False,
        ),
    ],
    without_dampers: Annotated[
        bool, typer.Option("--without-dampers", help="Leave dampers, isolators and tuned masses out.")
    ] = False,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace files that edesign did not write.")] = False,
) -> None:
    """Write the model of a project, with its analyses and motions, for another program that checks it."""
    from edesign.building.project_file import load_project
    from edesign.exchange.formats import check_own_files, find_format, write_translation
    from edesign.report.tables.visible import visible_line

    form = find_format(model)
    read = load_project(project)
    found = form.translate(read, model, without_dampers)
    check_own_files(found, overwrite)
    write_translation(found)
    others = len(found.files) - 1
    beside = f", and {others} file{'s' * (others > 1)} beside it" if others else ""
    print(visible_line(f"{model} written for {form.program}{beside}. Next: {form.use.format(model)}"))
    for sentence in found.left_out:
        print(visible_line(f"left out: {sentence}"))
    for sentence in found.differences:
        print(visible_line(f"differs: {sentence}"))
