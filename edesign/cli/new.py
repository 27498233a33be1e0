"""`edesign new`: a folder of files to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.complete import template_names
from edesign.project import template as chosen
from edesign.report.tables.column import col, text
from edesign.report.tables.table import TableSpec
from edesign.report.tables.text import print_tables
from edesign.report.tables.unit import S

TEMPLATES = TableSpec[chosen.Template](
    "templates",
    "Templates",
    (text("template", "name"), text("what it is", "about", broken=1), col("CPU", S, "seconds", form="g")),
    notes=(
        "CPU: about, of all commands that `edesign new` names at its end, on one core",
        "`edesign new FOLDER --template NAME` makes one; without --template it is `frame`.",
    ),
    keys=2,
)


def new(
    folder: Annotated[
        Path | None,
        typer.Argument(help="Folder to make; it must not hold files of the same names.", show_default=False),
    ] = None,
    template: Annotated[
        str,
        typer.Option("--template", "-t", metavar="NAME", help="What to start from.", autocompletion=template_names),
    ] = "frame",
    title: Annotated[
        str | None, typer.Option("--title", help="Of the project; the folder's name if not said.", show_default=False)
    ] = None,
    list_them: Annotated[bool, typer.Option("--list", "-l", help="Print the templates and leave.")] = False,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Do not print what comes next.")] = False,
) -> None:
    """Make a folder with a small project that runs as it is: of a frame, or by another --template."""
    if list_them:
        print_tables([TEMPLATES.of(chosen.templates().values())])
        return
    if folder is None:
        raise typer.BadParameter("name the folder to make; --list prints the templates", param_hint="'FOLDER'")
    path = chosen.new_project(folder, title, template)
    if quiet:
        return
    print(f"{path} written. Next:")
    for command in chosen.template(template).commands(folder):
        print(f"  {command}")
