"""`edesign new`: a project to start from."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def new(
    folder: Annotated[Path, typer.Argument(help="Folder to make; it must not hold a project.", show_default=False)],
) -> None:
    """Make a folder with a small project that runs as it is."""
    from edesign.project.template import new_project

    path = new_project(folder)
    print(f"{path} written. Next: edesign check {path}; edesign run {path}")
