"""Figures of the plastic rotations at target displacements, on the frames that are pushed."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.assess.sets import TARGET
from edesign.project.analysis.pushover import METHODS, WAYS
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.report.archived import archived_building, archived_project
from edesign.report.capacity.pushover_figures import in_words
from edesign.report.drawing.building_drawing import BuildingElevation, frame_names
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.frame_drawing import Elevation, FrameElevation
from edesign.report.response.directions import strong_axes
from edesign.report.response.frame_figures import ROTATION, Hinges, hinge_figure, in_frame, plastic_rotations
from edesign.report.response.histories import names_of
from edesign.study.results.kinds import ANALYSES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ELEVATIONS = 4  # side by side


def hinge_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the plastic rotations at target displacements, by method and level; of a building frame by frame.

    Frames of a building are those along the push in which a hinge is drawn.

    Yields:
        Name of the file, caption and figure.
    """
    file = archived_building(archive) or archived_project(archive)
    if isinstance(file, Building):
        strong = strong_axes(archive)
        for name in frame_names(file):
            seen = archive.seen_through(partial(in_frame, name, strong))
            yield from _target_hinges(seen, BuildingElevation(file, name), name)
    elif isinstance(file, Project):
        yield from _target_hinges(archive, FrameElevation(file.frame))


def _target_hinges(archive: Archive, elevation: Elevation, frame: str = "") -> Iterator[tuple[str, str, Figure]]:
    panels: dict[tuple[str, str], list[Hinges]] = {}
    for name in archive.names(ANALYSES):
        about = archive.group_attributes(f"{ANALYSES}/{name}")
        if about.get("kind") != TARGET or about.get("status") != "completed":
            continue
        if frame and WAYS[str(about["direction"])][0] != frame[0].lower():
            continue
        method, level = str(about.get("method")), str(about.get("level"))
        group = archive.view(f"{ANALYSES}/{name}")
        title = in_words(name.removesuffix(f".{method}.{level}"))
        isolated = bool(about.get("isolated"))
        one = Hinges(title, plastic_rotations(group), tuple(names_of(group, "damper")), isolated)
        panels.setdefault((method, level), []).append(one)
    for (method, level), found in panels.items():
        if frame and not any(value > ROTATION.limits[0] for one in found for value in one.values.values()):
            continue
        words = next(text for key, text in METHODS.items() if key == method)
        where = f" in frame {frame}" if frame else ""
        caption = f"Plastic rotations of member ends{where} at the target displacements of {words} at {level}."
        for first in range(0, len(found), ELEVATIONS):
            figure = hinge_figure(elevation, found[first : first + ELEVATIONS])
            yield file_name("target_hinges", frame, method, level), caption, figure
