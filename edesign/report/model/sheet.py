"""A drawing in inches on which no two texts overlap, as large as what is drawn on it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from edesign.report.drawing.style import SEEN, contrast, styled
from edesign.report.drawing.text_size import INCH, text_size, wrapped
from edesign.report.model.boxes import Boxes, Spot, corners_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Point = tuple[float, float]
Points = Sequence[Point] | np.ndarray
"""Points, or an array of them, (n, 2)."""
INK, SOFT, FAINT = "#1c2430", "#6b7480", "#c9ced6"
"""Colours of members and texts, of what explains them, and of grid lines."""
TEXT = 7.5  # points, of labels
SMALLEST = 6.0
GAP = 0.012  # inches between texts
MOST_SPOTS = 48  # that are tried for a text
LETTER = 12.0  # points, beyond which a sign is a ring round what stands in it
MASK = 0.8  # white round a text that interrupts a line, points
MOST_UNWRITTEN = 12  # texts without room that are listed
MARGIN = 0.08  # around the drawing, inches
HANDLE = 0.42  # width of a sign in the legend
LINE = 0.145  # height of a line of the legend
LINES = 1.2  # from line to line of a text, of its size


@dataclass(frozen=True)
class Entry:
    """A line of the legend.

    Attributes:
        text: what a thing is.
        sign: of it, drawn from its left end at a height; None: of what stands above.
        high: what the sign takes above and below the middle of the line, inches.
    """

    text: str
    sign: Callable[[Sheet, float, float], None] | None = None
    high: float = 0.0


class Sheet:
    """A drawing whose coordinates are inches, to the right and upwards; it grows with its content."""

    def __init__(self) -> None:
        from matplotlib.figure import Figure

        self.figure = Figure(figsize=(1.0, 1.0))
        self.axes = self.figure.add_axes((0.0, 0.0, 1.0, 1.0))
        self.axes.set_axis_off()
        self._texts, self._signs, self._lines = Boxes(), Boxes(), Boxes()
        self._low, self._high = np.full(2, np.inf), np.full(2, -np.inf)

    # --- lines and shapes

    def lines(self, parts: Iterable[Points], color: str = INK, width: float = 0.8, **style: Any) -> None:
        """Draw lines through points as one path.

        Args:
            parts: points of each line, inches.
            color: colour of the lines.
            width: width of the line, points.
            **style: properties of matplotlib beside those.
        """
        from matplotlib.lines import Line2D

        gap = np.full((1, 2), np.nan)
        found = [part for points in parts if len(points) for part in (np.asarray(points, dtype=float), gap)]
        if not found:
            return
        path = np.concatenate(found)
        style = {"solid_capstyle": "butt", "zorder": 1.5, **style}
        self.axes.add_artist(Line2D(path[:, 0], path[:, 1], color=color, lw=width, **style))
        self._reach(path[np.isfinite(path[:, 0])])
        self._draw_round(found[::2], color, width)

    def line(self, *points: Point, color: str = INK, width: float = 0.8, **style: Any) -> None:
        """Draw one line through points.

        Args:
            *points: points of the line, inches.
            color: colour of the lines.
            width: width of the line, points.
            **style: properties of matplotlib beside those.
        """
        self.lines([points], color, width, **style)

    def shape(
        self, points: Sequence[Point], face: str = "white", edge: str = INK, width: float = 0.6, zorder: float = 2.0
    ) -> None:
        """Draw a closed shape.

        Args:
            points: corners, inches.
            face: colour of the face.
            edge: colour of the edge.
            width: width of the line, points.
            zorder: matplotlib's order of drawing.
        """
        self.shapes([points], face, edge, width, zorder)

    def shapes(
        self,
        several: Iterable[Sequence[Point]],
        face: str = "white",
        edge: str = INK,
        width: float = 0.6,
        zorder: float = 2.0,
    ) -> None:
        """Draw closed shapes of one look as one path.

        Args:
            several: corners of each shape, inches.
            face: colour of the face.
            edge: colour of the edge.
            width: width of the line, points.
            zorder: matplotlib's order of drawing.
        """
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        corners = [np.asarray([*points, points[0]], dtype=float) for points in several]
        if corners:
            path = Path.make_compound_path(*(Path(points, closed=True) for points in corners))
            self.axes.add_artist(PathPatch(path, fc=face, ec=edge, lw=width, zorder=zorder))
            self._reach(np.concatenate(corners))
            if _is_seen(face):
                for points in corners:
                    low, high = points.min(axis=0), points.max(axis=0)
                    self.block(*(0.5 * (low + high)), *(high - low))
            elif width:
                self._draw_round(corners, edge, width)

    def dots(self, at: Points, size: float, face: str = "white", edge: str = INK, **style: Any) -> None:
        """Draw circles, or other signs by `marker`, of a size in points.

        Args:
            at: the places, inches.
            size: diameter, points.
            face: colour of the face.
            edge: colour of the edge.
            **style: properties of matplotlib beside those.
        """
        from matplotlib.lines import Line2D

        if not len(at):
            return
        places = np.asarray(at, dtype=float)
        style = {"marker": "o", "mew": 0.7, "zorder": 3.0, **style}
        self.axes.add_artist(Line2D(places[:, 0], places[:, 1], ls="none", ms=size, mfc=face, mec=edge, **style))
        reach = 0.5 * size / INCH
        self._reach(np.concatenate((places - reach, places + reach)))
        if size > LETTER:  # texts may stand in it
            turn = np.linspace(0.0, 2.0 * np.pi, 17)
            ring = reach * np.column_stack((np.cos(turn), np.sin(turn)))
            self._draw_round([place + ring for place in places], edge, style.get("mew", 0.7))
        elif _is_seen(face) or _is_seen(edge):
            for x, y in places:
                self.block(x, y, 2.0 * reach, 2.0 * reach)

    def block(self, x: float, y: float, wide: float, high: float) -> None:
        """Keep texts that have a choice away from a rectangle about a point.

        Args:
            x: abscissa, inches.
            y: ordinate, inches.
            wide: width, inches.
            high: height, inches.
        """
        self._signs.add(corners_of(Spot(x, y), wide, high))

    # --- texts

    def text(self, spot: Spot, words: str, size: float = TEXT, color: str = INK, **style: Any) -> None:
        """Write a text where it is wanted, whatever stands there.

        Args:
            spot: the anchor, and how the text is turned.
            size: of the type, points.
            color: colour of the lines.
            **style: properties of matplotlib beside those.
        """
        box = self._box(spot, words, size)
        self._texts.add(box)
        self._write(spot, words, size, color, box, style)

    def place(
        self,
        spots: Iterable[Spot],
        words: str | Sequence[str],
        sizes: Sequence[float] = (TEXT, 6.8, SMALLEST),
        color: str = INK,
        **style: Any,
    ) -> bool:
        """Write a text at the first spot where no other one stands, if need be small, or so that it interrupts a line.

        Only where even that is impossible it stands over a sign.

        Args:
            spots: possible places of the text, the best first.
            words: the text, or ways to write it, such as in one line and in two, the best first.
            sizes: sizes of the type that may be taken, points.
            color: colour of the lines.
            **style: properties of matplotlib beside those.

        Returns:
            Whether there was room.
        """
        wanted, ways = list(spots)[:MOST_SPOTS], [words] if isinstance(words, str) else words
        free = [(self._box(spot, text, size), spot, text, size) for text in ways for size in sizes for spot in wanted]
        for avoided in ((self._texts, self._signs, self._lines), (self._texts, self._signs), (self._texts,)):
            free = [one for one in free if not avoided[0].meet(one[0])] if len(avoided) == 3 else free
            for box, spot, text, size in free:
                if not any(signs.meet(box) for signs in avoided[1:]):
                    self._texts.add(box)
                    mask = {"bbox": {"fc": "white", "ec": "none", "boxstyle": f"square,pad={MASK / size:.3f}"}}
                    self._write(spot, text, size, color, box, (mask if len(avoided) == 2 else {}) | style)
                    return True
        return False

    def fits(self, words: str, length: float, size: float = TEXT) -> bool:
        """Return whether a text is shorter than a length.

        Args:
            length: inches.
            size: of the type, points.
        """
        return text_size(words, size)[0] < length - 2.0 * GAP

    def _write(self, spot: Spot, words: str, size: float, color: str, box: np.ndarray, style: dict[str, Any]) -> None:
        style = {"zorder": 5.0, **style}
        self.axes.text(
            spot.x,
            spot.y,
            words,
            fontsize=size,
            color=color,
            ha=spot.ha,
            va=spot.va,
            rotation=spot.turned,
            rotation_mode="anchor",
            **style,
        )
        self._reach(box)

    @staticmethod
    def _box(spot: Spot, words: str, size: float) -> np.ndarray:
        sizes = [text_size(line, size) for line in words.split("\n")]
        wide, high = max(wide for wide, _ in sizes), sizes[0][1] + (len(sizes) - 1) * LINES * size / INCH
        return corners_of(spot, wide + 2.0 * GAP, high + GAP)

    # --- legend and end

    def legend(self, entries: Iterable[Entry], width: float) -> None:
        """Write lines below all that is drawn, in two columns where they are short; long ones are broken.

        Args:
            entries: in their order.
            width: that they may take, inches.
        """
        left, y = float(self._low[0]), float(self._low[1]) - 0.16
        wide = max(width, float(self._high[0]) - left)
        half = 0.5 * wide
        rows: list[list[Entry]] = []
        for entry in entries:
            short = HANDLE + text_size(entry.text, TEXT)[0] < half - 0.1
            if short and rows and len(rows[-1]) == 1 and HANDLE + text_size(rows[-1][0].text, TEXT)[0] < half - 0.1:
                rows[-1].append(entry)
            else:
                rows.append([entry])
        for row in rows:
            extra = max(0.0, 0.5 * (max(entry.high for entry in row) - LINE))
            y -= extra
            for column, entry in enumerate(row):
                if entry.sign is not None:
                    entry.sign(self, left + column * half, y)
                lines = wrapped(entry.text, (half if len(row) > 1 else wide) - HANDLE - 0.1, TEXT)
                for i, line in enumerate(lines):
                    self.text(Spot(left + column * half + HANDLE, y - i * LINE, "left", "center"), line)
            y -= LINE * (len(lines) if len(row) == 1 else 1) + extra

    def heading(self, lines: Sequence[str]) -> None:
        """Write a title and further lines above the drawing."""
        y = float(self._high[1]) + 0.12 + LINE * (len(lines) - 1)
        room = max(4.0, float(self._high[0] - self._low[0]))
        for i, words in enumerate(lines):
            fitted = wrapped(words, room, TEXT)
            text = fitted[0] if len(fitted) == 1 else f"{fitted[0]} …"
            self.text(Spot(float(self._low[0]), y - i * LINE, "left", "bottom"), text, 9.0 if i == 0 else TEXT)

    def finish(self) -> Figure:
        """Give the figure the size of the drawing, and return it."""
        low, high = self._low - MARGIN, self._high + MARGIN
        self.figure.set_size_inches(*(high - low))
        self.axes.set_xlim(low[0], high[0])
        self.axes.set_ylim(low[1], high[1])
        return self.figure

    @property
    def right(self) -> float:
        """The abscissa of the right edge of the drawing, inches."""
        return float(self._high[0])

    def _draw_round(self, lines: Sequence[np.ndarray], color: str, width: float) -> None:
        """Let texts that have a choice avoid lines that are seen; `width` in points."""
        if _is_seen(color):
            ends = [np.concatenate([points[part] for points in lines]) for part in (slice(-1), slice(1, None))]
            self._lines.add_lines(ends[0], ends[1], width / INCH)

    def _reach(self, points: np.ndarray) -> None:
        if len(points):
            self._low = np.minimum(self._low, points.min(axis=0))
            self._high = np.maximum(self._high, points.max(axis=0))


@lru_cache(maxsize=64)
def _is_seen(color: str) -> bool:
    from matplotlib.colors import to_rgba

    return contrast(to_rgba(color)) >= SEEN


def unwritten(texts: Sequence[str]) -> list[Entry]:
    """Return a line of the legend with texts that did not fit into a drawing; none if all did."""
    more = len(texts) - MOST_UNWRITTEN
    listed = "; ".join(texts[:MOST_UNWRITTEN]) + (f"; and {more} more, as the file says" if more > 0 else "")
    return [Entry(f"Not written in the drawing for want of room: {listed}.")] if texts else []


def on_sheet(draw: Callable[[Sheet], None], heading: Sequence[str] = ()) -> Figure:
    """Return the figure that a function draws on a new sheet, in the style of all figures.

    Args:
        heading: lines above the drawing, the first one a title.
    """

    def made() -> Figure:
        sheet = Sheet()
        draw(sheet)
        if heading:
            sheet.heading(heading)
        return sheet.finish()

    return styled(made)()
