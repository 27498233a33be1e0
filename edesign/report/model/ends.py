"""The ends of members on a sheet: releases, plastic hinges, semi-rigid joints, panel zones, rigid ends."""

from __future__ import annotations

import math
from collections.abc import Iterator

from edesign.errors import InputError
from edesign.frame.rigid_ends import rigid_ends
from edesign.project.frame.frame import Frame
from edesign.project.frame.hinges import Hinges, Joints
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.drawing.style import AFTER, TARGET
from edesign.report.model.elevation import Elevation
from edesign.report.model.members import stroke
from edesign.report.model.sheet import INK, Entry, Point, Sheet
from edesign.report.model.words import short

FROM_NODE = 0.09  # of hinges from their node, inches
MARKS = ("o", "s", "D", "^", "v", "P", "X", "h")


def draw_ends(sheet: Sheet, place: Elevation, project: Project) -> list[Entry]:
    """Draw releases, plastic hinges, semi-rigid joints, panel zones and rigid ends; return their lines of the legend.

    Args:
        place: where metres of the frame are on the sheet.
    """
    return [
        *_rigid(sheet, place, project),
        *_panels(sheet, place, project),
        *_released(sheet, place, project.frame),
        *_hinges(sheet, place, project),
        *_joints(sheet, place, project),
    ]


def _near(place: Elevation, member: str, end: int, distance: float = FROM_NODE) -> Point:
    """A place on a member at a distance (inches) from its start (0) or end (1), but in its first third."""
    ends = [place.node(node) for node in place.frame.ends[member]]
    (x0, y0), (x1, y1) = (ends[end], ends[1 - end])
    share = min(distance / math.hypot(x1 - x0, y1 - y0), 0.33)
    return x0 + share * (x1 - x0), y0 + share * (y1 - y0)


def _released(sheet: Sheet, place: Elevation, frame: Frame) -> Iterator[Entry]:
    at = [_near(place, name, end) for name, ends in frame.released.items() for end in (0, 1) if ends[end]]
    if at:
        sheet.dots(at, 4.2)
        yield Entry("hinge: released moment", lambda on, x, y: on.dots([(x + 0.14, y)], 4.2))


def _chosen(place: Elevation, run: Hinges | Joints, distance: float) -> list[Point]:
    """The ends of the members that a run of hinges or joints is at."""
    found = []
    for first, last in place.frame.members_in(run.beams, run.columns):
        found += [_near(place, first, 0, distance)] if run.ends != "end" else []
        found += [_near(place, last, 1, distance)] if run.ends != "start" else []
    return found


def _hinges(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    for i, run in enumerate(project.hinges):
        mark = MARKS[i % len(MARKS)]
        reduced = run.reduced_section
        sheet.dots(_chosen(place, run, FROM_NODE + 0.05 * (reduced is not None)), 4.2, TARGET, TARGET, marker=mark)
        values = run.parameters
        if isinstance(values, str):
            text = "by Lignos and Krawinkler (2011)"
        else:
            text = f"M_y = {short(values.M_y / 1e3)} kN m, θ_p = {short(values.theta_p)} rad"
            if values.hogging.M_y is not None:
                text += f", hogging M_y = {short(values.hogging.M_y / 1e3)} kN m"
        if reduced is not None:
            sizes = ", ".join(f"{key} = {1e3 * getattr(reduced, key):g} mm" for key in ("a", "b", "c"))
            text += f"; reduced section {sizes}"
        yield Entry(
            f"plastic hinge of {'beams' if run.beams is not None else 'columns'}, {text}",
            lambda on, x, y, m=mark: on.dots([(x + 0.14, y)], 4.2, TARGET, TARGET, marker=m),  # type: ignore[misc]
        )


def _joints(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    for run in project.joints:
        sheet.dots(_chosen(place, run, FROM_NODE + 0.08), 4.6, "white", AFTER, marker="D", mew=1.1)
        text = f"semi-rigid joint, S_j = {short(run.stiffness / 1e6)} MN m/rad"
        text += f", M_j,Rd = {short(run.resistance / 1e3)} kN m" if run.resistance is not None else ""
        yield Entry(text, lambda on, x, y: on.dots([(x + 0.14, y)], 4.6, "white", AFTER, marker="D", mew=1.1))


def _panels(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    frame = project.frame
    for run in project.panel_zones:
        at = [place.node(names.node_name(*node)) for node in frame.node_places(run.lines, run.floors)]
        sheet.dots(at, 7.0, "#f3dcb8", "#8c6d1f", marker="s", zorder=2.0)
        plates = f", doubler plates {short(1e3 * run.doubler)} mm" if run.doubler is not None else ""
        yield Entry(
            f"panel zone that shears{plates}",
            lambda on, x, y: on.dots([(x + 0.14, y)], 7.0, "#f3dcb8", "#8c6d1f", marker="s"),
        )


def _rigid(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    try:
        found = rigid_ends(project)
    except InputError:  # reported where the frame is built
        return
    frame, parts = project.frame, []
    for name, lengths in found.items():
        for end, length in enumerate(lengths):
            if length > 0.0:
                share = length / frame.length(name)
                (x0, y0), (x1, y1) = (place.node(frame.ends[name][k]) for k in (end, 1 - end))
                parts.append(((x0, y0), (x0 + share * (x1 - x0), y0 + share * (y1 - y0))))
    if parts:
        sheet.lines(parts, INK, 4.5)
        most = max(length for lengths in found.values() for length in lengths)
        yield Entry(f"rigid ends to scale, at most {short(most)} m", stroke(4.5, "-"))
