"""The grid of a plane frame on a sheet: its scale, axes with their names, spans, levels and heights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise

from edesign.project.frame.frame import Frame
from edesign.report.model.sheet import FAINT, INK, SOFT, Point, Sheet, Spot, text_size

WIDEST, TALLEST = 4.9, 6.4  # inches of a frame
MANY, OF_MANY = 6, 6.6  # bays, from which a frame may be that wide
LARGEST = 0.6  # inches a metre
LEAST_BAY, LEAST_STOREY = 0.75, 0.42  # inches, for which frames of another shape are drawn at two scales
DIMENSIONS, TOTAL, NAMES = 0.5, 0.68, 0.88  # of rows below the base, inches
HEIGHTS, LEVELS = 0.3, 0.4  # of columns left of the frame
LEANING = 0.5  # of the last bay, from the frame to its leaning column
BUBBLE = 0.105


@dataclass(frozen=True)
class Elevation:
    """Where metres of a frame are on a sheet.

    Attributes:
        frame: what is drawn.
        across, up: inches a metre.
    """

    frame: Frame
    across: float
    up: float

    @classmethod
    def of(cls, frame: Frame) -> Elevation:
        """Return the elevation of a frame, at one scale if its bays and storeys are then large enough to be labelled."""
        wide = frame.x[-1] + (LEANING * frame.bay_widths[-1] if frame.leaning_column is not None else 0.0)
        widest = WIDEST if frame.n_bays <= MANY else OF_MANY
        scale = min(widest / wide, TALLEST / frame.height, LARGEST)
        across = max(scale, min(LEAST_BAY / min(frame.bay_widths), widest / wide))
        up = max(scale, min(LEAST_STOREY / min(frame.storey_heights), TALLEST / frame.height))
        return cls(frame, across, up)

    def at(self, x: float, y: float) -> Point:
        """Return the place of a point in metres."""
        return self.across * x, self.up * y

    def node(self, name: str) -> Point:
        """Return the place of a node of the frame."""
        return self.at(*self.frame.nodes[name])

    @property
    def true(self) -> bool:
        """Whether widths and heights have one scale."""
        return abs(self.across - self.up) < 1e-9 * self.up

    @property
    def width(self) -> float:
        """Of the frame without its leaning column, inches."""
        return self.across * self.frame.x[-1]

    @property
    def top(self) -> float:
        """Of the roof, inches above the base."""
        return self.up * self.frame.height

    @property
    def leaning_x(self) -> float:
        """Of the leaning column, inches."""
        return self.width + LEANING * self.across * self.frame.bay_widths[-1]

    def storey(self, number: int) -> float:
        """Return the height of a storey, inches."""
        return self.up * self.frame.storey_heights[number - 1]


def draw_axes(sheet: Sheet, place: Elevation, dimensions: bool = True) -> None:
    """Draw axes with their names, levels, and if wanted the spans and storey heights, m."""
    frame = place.frame
    below = -(NAMES if dimensions else DIMENSIONS)
    xs = [place.across * x for x in frame.x]
    _axis_names(sheet, frame.lines, xs, below, dimensions)
    if dimensions:
        marks = [(x, -DIMENSIONS) for x in xs]
        _chain(sheet, marks, frame.bay_widths, 0.0)
        if frame.n_bays > 1:
            _chain(sheet, [marks[0], marks[-1]], (frame.x[-1],), 0.0, DIMENSIONS - TOTAL)
        _chain(sheet, [(-HEIGHTS, place.up * y) for y in frame.y], frame.storey_heights, 90.0)
    _levels(sheet, place, LEVELS if dimensions else 0.15)


def _axis_names(sheet: Sheet, names: Sequence[str], xs: Sequence[float], below: float, ticks: bool) -> None:
    last = xs[-1]
    told: list[float] = []
    for name, x in sorted(zip(names, xs, strict=True), key=lambda axis: axis[1] not in (0.0, last)):
        wide = 2.0 * BUBBLE + 0.01
        if any(abs(x - other) < wide for other in told):
            continue
        told.append(x)
        sheet.line((x, -0.27), (x, below + BUBBLE), color=FAINT, width=0.5, zorder=0.5)
        sheet.dots([(x, below)], 2.0 * BUBBLE * 72.0, mew=0.5)
        sheet.text(Spot(x, below), name, 6.5 if len(name) < 3 else 5.0)


def _chain(
    sheet: Sheet, marks: Sequence[Point], lengths: Sequence[float], turned: float, shift: float = 0.0
) -> None:
    """Draw a line with ticks at marks and the lengths between them, m; equal ones that do not fit are counted."""
    along = 0 if turned == 0.0 else 1
    marks = [(x, y + shift) if along == 0 else (x + shift, y) for x, y in marks]
    sheet.line(marks[0], marks[-1], color=SOFT, width=0.5)
    sheet.lines([((x - 0.03, y - 0.03), (x + 0.03, y + 0.03)) for x, y in marks], SOFT, 0.7)
    spans = list(zip(lengths, pairwise(marks), strict=True))
    for length, run in groupby(spans, key=lambda span: span[0]):
        parts = [ends for _, ends in run]
        text = f"{length:.2f}" if abs(round(length, 2) - length) < 1e-9 else f"{length:.3f}"
        if all(sheet.fits(text, end[along] - start[along]) for start, end in parts):
            for start, end in parts:
                sheet.place([_beside(start, end, along)], text)
        else:
            sheet.place([_beside(parts[0][0], parts[-1][1], along)], f"{len(parts)} × {text}" if parts[1:] else text)


def _beside(start: Point, end: Point, along: int) -> Spot:
    x, y = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
    return Spot(x, y + 0.02, "center", "bottom") if along == 0 else Spot(x - 0.02, y, "center", "bottom", 90.0)


def _levels(sheet: Sheet, place: Elevation, left: float) -> None:
    """Floors with their levels above the base, m; the base and the roof first, the others where there is room."""
    frame = place.frame
    x = -left - text_size("0.00", 6.5)[1]
    order = [0, frame.n_storeys, *range(1, frame.n_storeys)]
    for floor in order:
        y = place.up * frame.y[floor]
        text = f"{frame.y[floor]:+.2f}" if floor else "±0.00"
        if sheet.place([Spot(x, y + 0.01, "right", "bottom")], text):
            sheet.line((x - 0.33, y), (x + 0.05, y), color=SOFT, width=0.5)
            sheet.place([Spot(x - 0.42, y + 0.01, "right", "bottom")], str(floor), (SMALLEST_FLOOR,), SOFT)
    top = place.top + 0.2
    sheet.text(Spot(x, top, "right", "bottom"), "level [m]", 5.5, SOFT)
    if frame.n_storeys:
        sheet.text(Spot(x - 0.42, top, "right", "bottom"), "floor", 5.5, SOFT)


SMALLEST_FLOOR = 6.0  # points, of numbers of floors


def draw_members(
    sheet: Sheet, place: Elevation, lines: Sequence[tuple[Point, Point]], color: str = INK, width: float = 1.6, **s: object
) -> None:
    """Draw members from their ends, m."""
    sheet.lines([(place.at(*start), place.at(*end)) for start, end in lines], color, width, **s)
