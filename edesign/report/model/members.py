"""The members of a plane frame on a sheet, with their sections, hinges, joints and rigid ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

from edesign.building.rigid_ends import rigid_ends
from edesign.errors import InputError
from edesign.project.frame.frame import Frame
from edesign.project.frame.hinges import Hinges, Joints
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.drawing.frame_drawing import member_lines
from edesign.report.drawing.style import AFTER, TARGET
from edesign.report.model.elevation import Elevation
from edesign.report.model.sheet import INK, Entry, Point, Sheet, Spot
from edesign.report.model.words import short

FROM_NODE = 0.09  # of hinges from their node, inches
_BUCKLES, _TENSION = (0, (7, 1.5, 1.5, 1.5)), (0, (4, 2))


def draw_frame_members(sheet: Sheet, place: Elevation, project: Project, faint: bool = False) -> list[Entry]:
    """Draw all members to scale, and the leaning column; return their lines of the legend.

    Args:
        sheet, place: where.
        project: the frame.
        faint: as the background of something else; nothing is said of them.
    """
    frame, entries = project.frame, []
    color = "#9aa3ae" if faint else INK
    lines = {name: (place.at(*start), place.at(*end)) for name, (start, end) in member_lines(frame).items()}
    bending = [ends for name, ends in lines.items() if not isinstance(frame.members[name], BraceRun)]
    sheet.lines(bending, color, 1.1 if faint else 1.7)
    kinds: dict[str, list[tuple[Point, Point]]] = {}
    for at, run in frame.brace_at.items():
        kinds.setdefault(_brace_kind(run), []).append(lines[names.brace_name(*at)])
    for kind, ends in kinds.items():
        style = {"buckling": _BUCKLES, "tension": _TENSION}.get(kind, "-")
        sheet.lines(ends, color, 0.8 if faint else 1.1, ls=style)
        if not faint:
            entries.append(Entry(_BRACES[kind], _stroke(1.1, style)))
    if frame.leaning_column is not None:
        _leaning(sheet, place, color)
        if not faint:
            entries.append(Entry("leaning column: struts between hinges, tied to the floors", _leaning_sign))
    return entries


_BRACES = {
    "": "brace, pinned ends",
    "buckling": "brace that buckles in the analysis",
    "tension": "brace, one of each pair acts: the one in tension",
}


def _brace_kind(run: BraceRun) -> str:
    if run.buckling is not None:
        return "buckling"
    return "" if run.compression else "tension"


def _leaning(sheet: Sheet, place: Elevation, color: str) -> None:
    x, levels = place.leaning_x, [place.up * y for y in place.frame.y]
    sheet.line((x, levels[0]), (x, levels[-1]), color=color, width=1.2)
    sheet.lines([((place.width, y), (x, y)) for y in levels[1:]], color, 0.7, ls=(0, (4, 3)))
    sheet.dots([(x, y) for y in levels], 3.2)


# --- sections


def draw_sections(sheet: Sheet, project: Project, place: Elevation) -> list[str]:
    """Write the section of each run of equal members beside it; return those for which there is no room, in words."""
    materials = {run.material for run in project.frame.members.values()}
    writer = _Sections(sheet, place, several=len(materials) > 1)
    return [*writer.columns(), *writer.beams(), *writer.braces()]


class _Sections:
    """Writes sections.

    Args:
        sheet, place: where.
        several: whether there are several materials, so that each is told.
    """

    def __init__(self, sheet: Sheet, place: Elevation, several: bool) -> None:
        self._sheet, self._place, self._several = sheet, place, several
        self._frame = place.frame

    def columns(self) -> Iterator[str]:
        """Equal columns above each other, beside the middle of them."""
        frame, place = self._frame, self._place
        for line, x in zip(frame.lines, frame.x, strict=True):
            standing = [s for s in range(1, frame.n_storeys + 1) if (line, s) in frame.column_at]
            for text, run in groupby(standing, key=lambda s, line=line: self._words(frame.column_at[line, s])):  # type: ignore[misc]
                storeys = list(run)
                middles = [0.5 * (frame.y[s - 1] + frame.y[s]) for s in storeys]
                centre = 0.5 * (middles[0] + middles[-1])
                heights = sorted(middles, key=lambda y: abs(y - centre))
                at = [place.at(x, y) for y in heights]
                spots = [Spot(a - 0.04, b, "center", "bottom", 90.0) for a, b in at]
                spots += [Spot(a + 0.04, b, "center", "top", 90.0) for a, b in at]
                if not self._sheet.place(spots, text):
                    yield f"column {line}, {_numbers('storey', storeys)}: {text}"

    def beams(self) -> Iterator[str]:
        """Equal beams beside each other, above one of them."""
        frame, place = self._frame, self._place
        for floor in range(1, frame.n_storeys + 1):
            standing = [b for b in range(1, frame.n_bays + 1) if (b, floor) in frame.beam_at]
            for text, run in groupby(standing, key=lambda b, f=floor: self._words(frame.beam_at[b, f])):  # type: ignore[misc]
                bays = list(run)
                order = sorted(bays, key=lambda b: abs(b - bays[(len(bays) - 1) // 2]))
                spots = []
                for va, shift in (("bottom", 0.025), ("top", -0.03)):
                    for share in (0.5, 0.35, 0.65):
                        for bay in order:
                            x = frame.x[bay - 1] + share * frame.bay_widths[bay - 1]
                            at = place.at(x, frame.y[floor])
                            spots.append(Spot(at[0], at[1] + shift, "center", va))
                if not self._sheet.place(spots, text):
                    yield f"beams of floor {floor}, {_numbers('bay', bays)}: {text}"

    def braces(self) -> Iterator[str]:
        """The braces of each bay and storey along the first of them."""
        frame, place = self._frame, self._place
        for (bay, storey), ways in groupby(frame.brace_at, key=lambda at: at[:2]):
            spots = []
            for at in (places := list(ways)):
                start, end = (place.node(node) for node in frame.brace_nodes(*at))
                angle = math.degrees(math.atan2(end[1] - start[1], end[0] - start[0]))
                turn = math.radians(angle)
                for side, va in ((1.0, "bottom"), (-1.0, "top")):
                    for share in (0.35, 0.5, 0.65, 0.25, 0.75):
                        x = start[0] + share * (end[0] - start[0]) - 0.03 * side * math.sin(turn)
                        y = start[1] + share * (end[1] - start[1]) + 0.03 * side * math.cos(turn)
                        spots.append(Spot(x, y, "center", va, angle))
            text = self._words(frame.brace_at[places[0]])
            if not self._sheet.place(spots, text):
                yield f"braces of bay {bay}, storey {storey}: {text}"

    def _words(self, run: ColumnRun | BeamRun | BraceRun) -> str:
        parts = [run.section]
        parts += [run.material] if self._several else []
        if not isinstance(run, BraceRun) and run.axis == "weak":
            parts.append("(weak axis)")
        return " ".join(parts)


def _numbers(what: str, found: Sequence[int]) -> str:
    return f"{what} {found[0]}" if len(found) == 1 else f"{what}s {found[0]}-{found[-1]}"


# --- ends of members


def draw_ends(sheet: Sheet, place: Elevation, project: Project) -> list[Entry]:
    """Draw releases, plastic hinges, joints that turn, panel zones and rigid ends; return their lines of the legend."""
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
    marks = ("o", "s", "D", "^", "v", "P", "X", "h")
    for i, run in enumerate(project.hinges):
        mark = marks[i % len(marks)]
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
        text = f"joint that turns, S_j = {short(run.stiffness / 1e6)} MN m/rad"
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
    except InputError:  # told where the frame is built
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
        yield Entry(f"rigid ends to scale, at most {short(most)} m", _stroke(4.5, "-"))


def _stroke(width: float, style: object) -> Callable[[Sheet, float, float], None]:
    return lambda sheet, x, y: sheet.line((x, y), (x + 0.28, y), width=width, ls=style)


def _leaning_sign(sheet: Sheet, x: float, y: float) -> None:
    sheet.line((x, y), (x + 0.28, y), width=1.2)
    sheet.dots([(x, y), (x + 0.28, y)], 3.2)


