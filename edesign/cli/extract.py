"""`edesign extract`: a plane frame of a building as a project file."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def extract(
    building: Annotated[Path, typer.Argument(help="The building file.", show_default=False)],
    frame: Annotated[
        str, typer.Option("--frame", "-f", metavar="NAME", help="X2: along x on line 2; YA: along y on line A.")
    ],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The project file to write.")],
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file that is of something else.")] = False,
) -> None:
    """Write a plane frame of a building as a project file, with the loads and masses that fall to it."""
    from edesign.archive.files import check_own_yaml, write_yaml
    from edesign.building.building_file import load_building
    from edesign.space.extract import plane_frame, project_text
    from edesign.space.geometry import space_frame

    read = load_building(building)
    check_own_yaml(output, building, overwrite)
    found = plane_frame(read, space_frame(read), frame)
    write_yaml(project_text(found), output, building)
    print(f"{output} written. Next: edesign check {output}; edesign run {output}")
