"""`edesign new`: a folder of files to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from edesign.cli.shared.complete import template_names
from edesign.project import template as chosen
from edesign.report.tables.table import Table
from edesign.report.tables.text import print_tables


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
) -> None:
    """Make a folder with a small project that runs as it is: of a frame, or by another --template."""
    if list_them:
        table = Table("Templates", ("template", "what it is", "CPU [s]"), left=2, sentences=1)
        table.rows = [[one.name, one.about, f"{one.seconds:g}"] for one in chosen.templates().values()]
        table.notes = [
            "CPU: about, of all commands that `edesign new` names at its end, on one core",
            "`edesign new FOLDER --template NAME` makes one; without --template it is `frame`.",
        ]
        print_tables([table])
        return
    if folder is None:
        raise typer.BadParameter("name the folder to make; --list prints the templates", param_hint="'FOLDER'")
    path = chosen.new_project(folder, title, template)
    print(f"{path} written. Next:")
    for command in chosen.template(template).commands(folder):
        print(f"  {command}")
