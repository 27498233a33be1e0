"""The grid of a plane frame on a sheet: its scale, axes with their names, spans, levels and heights."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import count, groupby, pairwise

import numpy as np

from edesign.project.frame.frame import Frame
from edesign.project.notation.axes import COLUMN_LINE
from edesign.report.drawing.text_size import text_size
from edesign.report.model.boxes import Spot
from edesign.report.model.sheet import FAINT, SMALLEST, SOFT, TEXT, Point, Sheet

WIDEST, TALLEST = 4.9, 6.4  # inches of a frame
MANY, OF_MANY = 6, 6.6  # bays, from which a frame may be that wide
LARGEST = 0.6  # inches a metre
LEAST_BAY, LEAST_STOREY = 0.75, 0.5  # inches, for which frames of another shape are drawn at two scales
DIMENSIONS, TOTAL, NAMES = 0.5, 0.69, 0.9  # of rows below the base, inches
HEIGHTS, LEVELS = 0.3, 0.42  # of columns left of the frame
FRAME = 0.16  # of the names of frames that stand in a row, inches above them
LEANING = 0.5  # of the last bay, from the frame to its leaning column
BUBBLE = 0.11
BELOW, ROW = 0.62, 0.3  # of the names of axes and of the spans of a plan, inches beside it
FLOORS = 0.08  # between numbers of floors and their levels


@dataclass(frozen=True)
class Grid:
    """Axes and levels on a sheet.

    Attributes:
        names: of the axes, from the left.
        xs, ys: places of the axes, and levels from the base, m.
        across, up: inches a metre.
    """

    names: tuple[str, ...]
    xs: tuple[float, ...]
    ys: tuple[float, ...]
    across: float
    up: float

    @classmethod
    def of(cls, names: Sequence[str], xs: Sequence[float], ys: Sequence[float], wide: float = 0.0) -> Grid:
        """Return axes and levels at one scale if bays and storeys are then large enough to be labelled, else at two.

        Args:
            xs: places of the axes, m, ascending.
            ys: levels above the base, m, ascending.
            wide: width of all that is drawn, m; at least the distance of the outer axes.
        """
        wide, high = max(wide, xs[-1] - xs[0]), ys[-1] - ys[0]
        widest = WIDEST if len(xs) - 1 <= MANY else OF_MANY
        scale = min(widest / wide, TALLEST / high, LARGEST)
        bay, storey = (min(b - a for a, b in pairwise(places)) for places in (xs, ys))
        across = max(scale, min(LEAST_BAY / bay, widest / wide))
        up = max(scale, min(LEAST_STOREY / storey, TALLEST / high))
        return cls(tuple(names), tuple(xs), tuple(ys), across, up)

    def at(self, x: float, y: float) -> Point:
        """Return the place on the sheet of a point of the frame.

        Args:
            x: m.
            y: m.
        """
        return self.across * x, self.up * y

    @property
    def parts(self) -> list[tuple[int, int]]:
        """The numbers of the first and last axis of each frame that stands here; one of a grid without a frame."""
        return [(0, len(self.xs) - 1)]

    @property
    def true(self) -> bool:
        """Whether widths and heights have one scale."""
        return abs(self.across - self.up) < 1e-9 * self.up

    @property
    def top(self) -> float:
        """Height of the uppermost level on the sheet, inches."""
        return self.up * self.ys[-1]


@dataclass(frozen=True)
class Elevation(Grid):
    """The place of a plane frame on a sheet, in metres of the frame.

    Attributes:
        frame: what is drawn.
    """

    frame: Frame

    @classmethod
    def of_frame(cls, frame: Frame) -> Elevation:
        """Return the elevation of a frame."""
        wide = frame.x[-1] + (LEANING * frame.bay_widths[-1] if frame.leaning_column is not None else 0.0)
        grid = Grid.of(frame.lines, frame.x, frame.levels, wide)
        return cls(grid.names, grid.xs, grid.ys, grid.across, grid.up, frame)

    def node(self, name: str) -> Point:
        """Return the place of a node of the frame."""
        return self.at(*self.frame.nodes[name])

    @property
    def width(self) -> float:
        """Width of the frame without its leaning column on the sheet, inches."""
        return self.across * self.frame.x[-1]

    @property
    def leaning_x(self) -> float:
        """Abscissa of the leaning column on the sheet, inches."""
        return self.width + LEANING * self.across * self.frame.bay_widths[-1]

    @property
    def parts(self) -> list[tuple[int, int]]:
        """The numbers of the first and last axis of each frame: those that no beam joins stand in a row."""
        joined = {bay for bay, _ in self.frame.beam_at}
        last = len(self.xs) - 1
        ends = [bay for bay in range(1, last + 1) if bay not in joined]
        return list(zip([0, *ends], [*(bay - 1 for bay in ends), last], strict=True))

    def storey(self, number: int) -> float:
        """Return the height of a storey, inches."""
        return self.up * self.frame.storey_heights[number - 1]


def draw_axes(sheet: Sheet, grid: Grid, dimensions: bool = True, beside: float = 0.0) -> None:
    """Draw axes with their names, levels, and if wanted the spans and storey heights, m.

    Args:
        grid: axes and levels on the sheet.
        dimensions: whether spans and storey heights are written, m.
        beside: what else stands at the left of the first axis, inches.
    """
    below = -(NAMES if dimensions else DIMENSIONS)
    xs = [grid.across * x for x in grid.xs]
    draw_axis_names(sheet, grid.names, [(x, below) for x in xs], [(x, -0.27) for x in xs])
    if dimensions:
        for first, last in grid.parts:
            if last > first:
                marks = [(x, -DIMENSIONS) for x in xs[first : last + 1]]
                draw_chain(sheet, marks, grid.xs[first : last + 1], 0.0)
            if last > first + 1:
                ends = (xs[first], xs[last]), (grid.xs[first], grid.xs[last])
                draw_chain(sheet, [(x, -TOTAL) for x in ends[0]], ends[1], 0.0)
        draw_chain(sheet, [(xs[0] - HEIGHTS, grid.up * y) for y in grid.ys], grid.ys, 90.0)
    if len(grid.parts) > 1:
        for first, last in grid.parts:
            name = name_of_frame(grid.names[first : last + 1])
            if name:
                at = 0.5 * (xs[first] + xs[last]), grid.top + FRAME
                sheet.place([Spot(*at, "center", "bottom")], f"frame {name}", (TEXT, SMALLEST), SOFT)
    _levels(sheet, grid, xs[0] - beside - (LEVELS if dimensions else 0.15))


def name_of_frame(names: Sequence[str]) -> str:
    """Return the name of a plane frame by the names of its column lines: X1 of A1, B1, C1, and YA of A1, A2.

    Returns:
        The name; "" where the lines have no grid line in common.
    """
    found = [COLUMN_LINE.fullmatch(name) for name in names]
    letters, numbers = ({of[k] for of in found if of is not None} for k in (1, 2))
    if len(names) < 2 or None in found or 1 not in (len(letters), len(numbers)):
        return ""
    return f"X{numbers.pop()}" if len(numbers) == 1 else f"Y{letters.pop()}"


def draw_plan_axes(sheet: Sheet, grid: Grid, numbers: Sequence[str]) -> None:
    """Draw the axes of a plan with their names and distances, m, at the left and below.

    Args:
        grid: axes across x with their names, and the places of those across y.
        numbers: names of the axes across y.
    """
    xs, ys = [grid.across * x for x in grid.xs], [grid.up * y for y in grid.ys]
    left, low = xs[0], ys[0]
    draw_axis_names(sheet, grid.names, [(x, low - BELOW) for x in xs], [(x, ys[-1]) for x in xs])
    draw_axis_names(sheet, numbers, [(left - BELOW, y) for y in ys], [(xs[-1], y) for y in ys])
    draw_chain(sheet, [(x, low - ROW) for x in xs], grid.xs, 0.0)
    draw_chain(sheet, [(left - ROW, y) for y in ys], grid.ys, 90.0)


def draw_axis_names(sheet: Sheet, names: Sequence[str], places: Sequence[Point], ends: Sequence[Point]) -> None:
    """Draw circles with the names of axes, and the axes up to where they end; farther out where two would meet.

    Args:
        places: of the circles in the first row, inches.
        ends: of the lines from there, inches.
    """
    wide, taken = 2.0 * BUBBLE + 0.01, list[Point]()
    for name, (x, y), end in zip(names, places, ends, strict=True):
        away = np.array((x, y)) - end
        step = wide * away / max(float(np.hypot(*away)), 1e-9)
        row = next(k for k in count() if _free((x + k * step[0], y + k * step[1]), taken, wide))
        at = (x + row * float(step[0]), y + row * float(step[1]))
        taken.append(at)
        sheet.line(at, end, color=FAINT, width=0.5, zorder=0.5)
        sheet.dots([at], 2.0 * BUBBLE * 72.0, mew=0.5)
        sheet.text(Spot(*at), name, _name_size(name))


def _free(at: Point, taken: Sequence[Point], wide: float) -> bool:
    return all(abs(at[0] - x) >= wide - 1e-9 or abs(at[1] - y) >= wide - 1e-9 for x, y in taken)


def _name_size(name: str) -> float:
    """The largest type of those of the drawing, points, in which a name stands in its circle; long ones reach over."""
    return next((size for size in (TEXT, SMALLEST, 5.0) if text_size(name, size)[0] < 1.8 * BUBBLE), 5.0)


def draw_chain(sheet: Sheet, marks: Sequence[Point], places: Sequence[float], turned: float) -> None:
    """Draw a line with ticks at marks and the distances between them; equal ones that do not fit are counted.

    Args:
        marks: of a horizontal or vertical line, inches.
        places: what the marks stand for, m.
        turned: 0 or 90 degrees, as the line.
    """
    along = 0 if turned == 0.0 else 1
    sheet.line(marks[0], marks[-1], color=SOFT, width=0.5)
    sheet.lines([((x - 0.03, y - 0.03), (x + 0.03, y + 0.03)) for x, y in marks], SOFT, 0.7)
    spans = list(zip([round(b - a, 6) for a, b in pairwise(places)], pairwise(marks), strict=True))
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


def _levels(sheet: Sheet, grid: Grid, left: float) -> None:
    """Floors with their levels above the base, m; the base and the roof first, the others where there is room."""
    x = left - text_size("0.00", TEXT)[1]
    last = len(grid.ys) - 1
    numbers = x - max(text_size(f"{level:+.2f}", TEXT)[0] for level in grid.ys) - FLOORS
    for floor in (0, last, *range(1, last)):
        y = grid.up * grid.ys[floor]
        text = f"{grid.ys[floor]:+.2f}" if floor else "±0.00"
        if sheet.place([Spot(x, y + 0.01, "right", "bottom")], text):
            sheet.line((numbers + FLOORS, y), (x + 0.05, y), color=SOFT, width=0.5)
            sheet.place([Spot(numbers, y + 0.01, "right", "bottom")], str(floor), (TEXT,), SOFT)
    top = grid.top + 0.2
    sheet.text(Spot(x, top, "right", "bottom"), "level [m]", SMALLEST, SOFT)
    sheet.text(Spot(min(numbers, x - 0.45), top, "right", "bottom"), "floor", SMALLEST, SOFT)
