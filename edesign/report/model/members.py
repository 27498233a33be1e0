"""The members of a plane frame on a sheet, with their sections, hinges, joints and rigid ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

from edesign.project.frame.frame import Frame
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.project import Project
from edesign.report.drawing.frame_drawing import STEEL, FrameElevation
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation
from edesign.report.model.sheet import INK, SMALLEST, Entry, Point, Sheet
from edesign.report.model.words import in_two_lines, several_steels

_BUCKLES, _TENSION = (0, (7, 1.5, 1.5, 1.5)), (0, (4, 2))


def draw_frame_members(sheet: Sheet, place: Elevation, project: Project, faint: bool = False) -> list[Entry]:
    """Draw all members to scale, and the leaning column; return their lines of the legend.

    Args:
        place: where metres of the frame are on the sheet.
        faint: whether the frame is the background of something else, without lines of a legend.

    Returns:
        The lines of the legend.
    """
    frame, entries = project.frame, []
    color = STEEL if faint else INK
    lines = {name: (place.at(*start), place.at(*end)) for name, (start, end) in FrameElevation(frame).lines.items()}
    bending = [ends for name, ends in lines.items() if not isinstance(frame.members[name], BraceRun)]
    sheet.lines(bending, color, 1.1 if faint else 1.7)
    kinds: dict[str, list[tuple[Point, Point]]] = {}
    for at, run in frame.brace_at.items():
        kinds.setdefault(_brace_kind(run), []).append(lines[frame.brace_name(*at)])
    for kind, ends in kinds.items():
        style = {"buckling": _BUCKLES, "tension": _TENSION}.get(kind, "-")
        sheet.lines(ends, color, 0.8 if faint else 1.1, ls=style)
        if not faint:
            entries.append(Entry(_BRACES[kind], stroke(1.1, style)))
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
    x, levels = place.leaning_x, [place.up * y for y in place.frame.levels]
    sheet.line((x, levels[0]), (x, levels[-1]), color=color, width=1.2)
    sheet.lines([((place.width, y), (x, y)) for y in levels[1:]], color, 0.7, ls=(0, (4, 3)))
    sheet.dots([(x, y) for y in levels], 3.2)


# --- sections


def draw_sections(sheet: Sheet, project: Project, place: Elevation) -> list[str]:
    """Write the section of each run of equal members beside it; return those for which there is no room, in words.

    Args:
        place: where metres of the frame are on the sheet.
    """
    writer = _Sections(sheet, place, several_steels(member_steels(project.frame)))
    return [*writer.beams(), *writer.columns(), *writer.braces()]


def member_steels(frame: Frame) -> list[tuple[str, str]]:
    """Return kind and material of each member of a frame."""
    kinds = {ColumnRun: "column", BeamRun: "beam", BraceRun: "brace"}
    return [(kinds[type(run)], run.material) for run in frame.members.values()]


class _Sections:
    """Writes sections.

    Args:
        several: kinds of members whose materials are named.
    """

    def __init__(self, sheet: Sheet, place: Elevation, several: set[str]) -> None:
        self._sheet, self._place, self._several = sheet, place, several
        self._frame = place.frame

    def columns(self) -> Iterator[str]:
        """Equal columns above each other, beside the middle of them."""
        frame, place = self._frame, self._place
        for line, x in zip(frame.lines, frame.x, strict=True):
            standing = [s for s in range(1, frame.n_storeys + 1) if (line, s) in frame.column_at]
            for text, run in groupby(standing, key=lambda s, line=line: self._words(frame.column_at[line, s])):  # type: ignore[misc]
                storeys = list(run)
                middles = [0.5 * (frame.levels[s - 1] + frame.levels[s]) for s in storeys]
                centre = 0.5 * (middles[0] + middles[-1])
                heights = sorted(middles, key=lambda y: abs(y - centre))
                at = [place.at(x, y) for y in heights]
                high = min(place.storey(s) for s in storeys)
                if not name_column(self._sheet, at, text, high):
                    yield f"column {line}, {_numbers('storey', storeys)}: {text}"

    def beams(self) -> Iterator[str]:
        """Equal beams beside each other, above one of them."""
        frame, place = self._frame, self._place
        for floor in range(1, frame.n_storeys + 1):
            standing = [b for b in range(1, frame.n_bays + 1) if (b, floor) in frame.beam_at]
            for text, run in groupby(standing, key=lambda b, f=floor: self._words(frame.beam_at[b, f])):  # type: ignore[misc]
                bays = list(run)
                order = sorted(bays, key=lambda b: abs(b - bays[(len(bays) - 1) // 2]))[:4]
                spots = []
                for va, shift in (("bottom", 0.025), ("top", -0.03)):
                    for share in (0.5, 0.35, 0.65):
                        for bay in order:
                            x = frame.x[bay - 1] + share * frame.bay_widths[bay - 1]
                            at = place.at(x, frame.levels[floor])
                            spots.append(Spot(at[0], at[1] + shift, "center", va))
                if not self._sheet.place(spots, text):
                    yield f"beams of floor {floor}, {_numbers('bay', bays)}: {text}"

    def braces(self) -> Iterator[str]:
        """The braces of each bay and storey along the first of them."""
        frame, place = self._frame, self._place
        for (bay, storey), ways in groupby(frame.brace_at, key=lambda at: at[:2]):
            spots = []
            shares = (0.35, 0.65, 0.5) if len(places := list(ways)) > 1 else (0.5, 0.35, 0.65)
            for at in places:
                start, end = (place.node(node) for node in frame.brace_nodes(*at))
                angle = math.degrees(math.atan2(end[1] - start[1], end[0] - start[0]))
                turn = math.radians(angle)
                for side, va in ((1.0, "bottom"), (-1.0, "top")):
                    for share in (*shares, 0.25, 0.75):
                        x = start[0] + share * (end[0] - start[0]) - 0.03 * side * math.sin(turn)
                        y = start[1] + share * (end[1] - start[1]) + 0.03 * side * math.cos(turn)
                        spots.append(Spot(x, y, "center", va, angle))
            text = self._words(frame.brace_at[places[0]])
            if not self._sheet.place(spots, text):
                yield f"braces of bay {bay}, storey {storey}: {text}"

    def _words(self, run: ColumnRun | BeamRun | BraceRun) -> str:
        kind = "column" if isinstance(run, ColumnRun) else "beam" if isinstance(run, BeamRun) else "brace"
        parts = [run.section]
        parts += [run.material] if kind in self._several else []
        if not isinstance(run, BraceRun) and run.axis == "weak":
            parts.append("(weak axis)")
        return " ".join(parts)


def name_column(sheet: Sheet, at: Sequence[Point], text: str, high: float) -> bool:
    """Write the section of equal columns beside one of them, upright; where it is longer than a storey, also level.

    Args:
        at: the middles of the columns, the best first, inches.
        high: of their lowest storey, inches.

    Returns:
        Whether there was room.
    """
    spots = [Spot(x - 0.04, y, "center", "bottom", 90.0) for x, y in at]
    spots += [Spot(x + 0.04, y, "center", "top", 90.0) for x, y in at]
    ways = in_two_lines(text)
    if not all(sheet.fits(line, high, SMALLEST) for line in ways[-1].split("\n")):
        spots += [Spot(x + 0.04, y, "left") for x, y in at] + [Spot(x - 0.04, y, "right") for x, y in at]
    return sheet.place(spots, ways)


def _numbers(what: str, found: Sequence[int]) -> str:
    return f"{what} {found[0]}" if len(found) == 1 else f"{what}s {found[0]}-{found[-1]}"


def stroke(width: float, style: object) -> Callable[[Sheet, float, float], None]:
    """Return the sign of a line in the legend.

    Args:
        width: width of the line, points.
        style: the line style of matplotlib.
    """
    return lambda sheet, x, y: sheet.line((x, y), (x + 0.28, y), width=width, ls=style)


def _leaning_sign(sheet: Sheet, x: float, y: float) -> None:
    sheet.line((x, y), (x + 0.28, y), width=1.2)
    sheet.dots([(x, y), (x + 0.28, y)], 3.2)
