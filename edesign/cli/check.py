"""`edesign check`: read a project, build its frame, and run nothing."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def check(project: Annotated[Path, typer.Argument(help="The project file.", show_default=False)]) -> None:
    """Check a project file, its records and its frame; print a summary."""
    from edesign.building.project_file import load_project
    from edesign.study.check import check_project

    for label, text in check_project(load_project(project)).items():
        typer.echo(f"{label + ':':<11} {text}")
    typer.echo("ok")
