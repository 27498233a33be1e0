"""`edesign extract`: a plane frame of a building as a project file, and a study of it."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated

import typer

from edesign.archive.files import check_own_yaml, source_file, write_yaml
from edesign.errors import InputError
from edesign.frame.building_file import load_building
from edesign.project.building.building import Building
from edesign.project.frame.member_design import ElasticUse
from edesign.project.notation.units import parse_ratio
from edesign.space.extract import (
    FrameRow,
    StudyNames,
    elastic_use,
    frame_row,
    left_out,
    project_text,
    study_text,
    suite_text,
)
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness


def extract(
    building: Annotated[Path, typer.Argument(help="The building file.", show_default=False)],
    frame: Annotated[
        str,
        typer.Option(
            "--frame",
            "-f",
            metavar="NAME",
            help="X2: along x on line 2; YA: along y on line A; X, Y: all of a direction.",
        ),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", metavar="FILE", help="The project file to write.")],
    study: Annotated[
        Path | None,
        typer.Option(
            "--study",
            "-s",
            metavar="FILE",
            help="Write a study too, with and without dampers, and beside it its motions, FILE_records.yaml.",
        ),
    ] = None,
    recordings: Annotated[
        Path | None,
        typer.Option("--recordings", metavar="FOLDER", help="Your recordings for the motions of the study."),
    ] = None,
    drift: Annotated[
        str | None,
        typer.Option(
            "--drift",
            metavar="RATIO",
            help="Largest storey drift in the study, `1 %`; by default what the building's limit allows.",
        ),
    ] = None,
    overwrite: Annotated[bool, typer.Option("--overwrite", help="Replace a file that is of something else.")] = False,
) -> None:
    """Write plane frames of a building as a project file, with the loads and masses that fall to them."""
    if study is None and (recordings is not None or drift is not None):
        raise InputError("--recordings and --drift belong to a study; give --study FILE too [E-CLI-01]")
    if recordings is not None and not recordings.is_dir():
        raise InputError(f"--recordings: there is no folder `{recordings}` [E-FILE-01]")
    whole = load_building(building)
    read = with_steel_by_thickness(whole)
    found = frame_row(read, space_frame(read), frame)
    elastic, unknown = _elastic_use(whole, found)
    texts = {}
    if study is None:
        texts[output] = project_text(found, elastic=elastic)
    else:
        suite = study.with_name(f"{study.stem}_records.yaml")
        folder = "" if recordings is None else source_file(recordings, output)
        names = StudyNames(source_file(output, study), source_file(suite, output), folder)
        largest = None if drift is None else _ratio(drift)
        texts = {
            suite: suite_text(found),
            output: project_text(found, names, elastic),
            study: study_text(found, names, largest),
        }
        if len(texts) < 3:
            raise InputError(f"{study}: the project and the study are two files; give them different names [E-FILE-09]")
    for path in texts:
        check_own_yaml(path, building, overwrite)
    for path, text in texts.items():
        write_yaml(text, path, building)
    if without := left_out(read):
        print(f"note: the building has {', '.join(without)} too, which {output} does not have")
    if unknown:
        print(f"note: {output} has no use of members in the elastic design: {unknown}")
    file = shlex.quote(str(study or output))
    print(f"{', '.join(map(str, texts))} written. Next: edesign check {file}; edesign run {file}")


def _elastic_use(building: Building, row: FrameRow) -> tuple[dict[str, ElasticUse], str]:
    """What the elastic design of a building found for its members, or why it did not."""
    try:
        return elastic_use(building, row.along), ""
    except InputError as error:
        return {}, str(error)


def _ratio(text: str) -> float:
    try:
        return parse_ratio(text, 0.0, 1.0, low_allowed=False)
    except ValueError as error:
        raise InputError(f"--drift: {error}") from error
