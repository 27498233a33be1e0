"""The ends of members on a sheet: releases, plastic hinges, semi-rigid joints, panel zones, rigid ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Sequence

from edesign.errors import InputError
from edesign.frame.rigid_ends import rigid_ends
from edesign.project.frame.frame import Frame
from edesign.project.frame.hinges import AnyHinges, AnyJoints, AnyPanelZones, Hinges, Joints, PanelZones
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.drawing.style import AFTER, TARGET
from edesign.report.model.elevation import Elevation
from edesign.report.model.members import stroke
from edesign.report.model.sheet import INK, Entry, Point, Sheet
from edesign.report.model.words import short

FROM_NODE = 0.09  # of hinges from their node, inches
MARKS = ("o", "s", "D", "^", "v", "P", "X", "h")
Line = tuple[Point, Point]
Chosen = Callable[[AnyHinges | AnyJoints, float], list[Point]]


def draw_ends(sheet: Sheet, place: Elevation, project: Project) -> list[Entry]:
    """Draw releases, plastic hinges, semi-rigid joints, panel zones and rigid ends; return their lines of the legend.

    Args:
        place: where metres of the frame are on the sheet.
    """
    frame = project.frame

    def chosen(run: AnyHinges | AnyJoints, distance: float) -> list[Point]:
        assert isinstance(run, Hinges | Joints)
        return _chosen(place, run, distance)

    def joints(zones: AnyPanelZones) -> list[Point]:
        assert isinstance(zones, PanelZones)
        return [place.node(names.node_name(*node)) for node in frame.node_places(zones.lines, zones.floors)]

    return [
        *_rigid(sheet, place, project),
        *draw_panels(sheet, project.panel_zones, joints),
        *_released(sheet, place, frame),
        *draw_hinges(sheet, project.hinges, chosen),
        *draw_joints(sheet, project.joints, chosen),
    ]


def near(drawn: Line, end: int, distance: float = FROM_NODE) -> Point:
    """Return a place on a member at a distance from its start (0) or end (1), but in its first third, inches."""
    (x0, y0), (x1, y1) = drawn[end], drawn[1 - end]
    share = min(distance / math.hypot(x1 - x0, y1 - y0), 0.33)
    return x0 + share * (x1 - x0), y0 + share * (y1 - y0)


def _near(place: Elevation, member: str, end: int, distance: float = FROM_NODE) -> Point:
    start, last = (place.node(node) for node in place.frame.ends[member])
    return near((start, last), end, distance)


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


def draw_hinges(sheet: Sheet, hinges: Sequence[AnyHinges], chosen: Chosen) -> Iterator[Entry]:
    """Draw plastic hinges; yield their lines of the legend.

    Args:
        chosen: gives the ends of the drawn members that a run is at, at a distance from their nodes, inches.
    """
    for i, run in enumerate(hinges):
        mark = MARKS[i % len(MARKS)]
        reduced = run.reduced_section
        at = chosen(run, FROM_NODE + 0.05 * (reduced is not None))
        if not at:
            continue
        sheet.dots(at, 4.2, TARGET, TARGET, marker=mark)
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


def draw_joints(sheet: Sheet, joints: Sequence[AnyJoints], chosen: Chosen) -> Iterator[Entry]:
    """Draw semi-rigid joints; yield their lines of the legend.

    Args:
        chosen: as for hinges.
    """
    for run in joints:
        at = chosen(run, FROM_NODE + 0.08)
        if not at:
            continue
        sheet.dots(at, 4.6, "white", AFTER, marker="D", mew=1.1)
        text = f"semi-rigid joint, S_j = {short(run.stiffness / 1e6)} MN m/rad"
        text += f", M_j,Rd = {short(run.resistance / 1e3)} kN m" if run.resistance is not None else ""
        yield Entry(text, lambda on, x, y: on.dots([(x + 0.14, y)], 4.6, "white", AFTER, marker="D", mew=1.1))


def draw_panels(
    sheet: Sheet, zones: Sequence[AnyPanelZones], chosen: Callable[[AnyPanelZones], list[Point]]
) -> Iterator[Entry]:
    """Draw panel zones; yield their lines of the legend.

    Args:
        chosen: gives the drawn joints that a run is at.
    """
    for run in zones:
        at = chosen(run)
        if not at:
            continue
        sheet.dots(at, 7.0, "#f3dcb8", "#8c6d1f", marker="s", zorder=2.0)
        plates = f", doubler plates {short(1e3 * run.doubler)} mm" if run.doubler is not None else ""
        yield Entry(
            f"panel zone that shears{plates}",
            lambda on, x, y: on.dots([(x + 0.14, y)], 7.0, "#f3dcb8", "#8c6d1f", marker="s"),
        )


def draw_rigid(sheet: Sheet, members: Iterable[tuple[Line, tuple[float, float], float]]) -> Iterator[Entry]:
    """Draw rigid ends to scale; yield their line of the legend.

    Args:
        members: where each is drawn, the lengths of its rigid ends, and its own, m.
    """
    parts, most = [], 0.0
    for drawn, lengths, whole in members:
        for end, length in enumerate(lengths):
            if length > 0.0:
                share, most = length / whole, max(most, length)
                (x0, y0), (x1, y1) = drawn[end], drawn[1 - end]
                parts.append(((x0, y0), (x0 + share * (x1 - x0), y0 + share * (y1 - y0))))
    if parts:
        sheet.lines(parts, INK, 4.5)
        yield Entry(f"rigid ends to scale, at most {short(most)} m", stroke(4.5, "-"))


def _rigid(sheet: Sheet, place: Elevation, project: Project) -> Iterator[Entry]:
    try:
        found = rigid_ends(project)
    except InputError:  # reported where the frame is built
        return
    frame = project.frame
    drawn = {name: (place.node(start), place.node(end)) for name, (start, end) in frame.ends.items() if name in found}
    yield from draw_rigid(sheet, ((drawn[name], ends, frame.length(name)) for name, ends in found.items()))
