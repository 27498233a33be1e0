"""Axes that draw their ticks without an object for each.

For every tick matplotlib makes five objects (two marks, a grid line, two labels), and asks them several times over for
their extent when it lays a figure out. In a report that is half of the time. An axis of this file asks the same
locators and formatters, and draws all grid lines as one path, all marks as one path, and the labels with one text.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.axis import Axis, XAxis, YAxis
from matplotlib.path import Path
from matplotlib.text import Text
from matplotlib.ticker import FixedFormatter, FixedLocator, NullLocator
from matplotlib.transforms import Bbox, IdentityTransform

from edesign.report.drawing.symbols import power_of_ten

Kind = Literal["major", "minor"]

_KINDS: tuple[Kind, ...] = ("major", "minor")
_SETTINGS: Any = rcParams
_BLANK = 0.5  # between labels of ticks beside each other, of their height: a blank and a half
_ROUNDING = 1e-6  # of the length of an axis, far below a pixel: ticks at its ends are in sight


@dataclass(frozen=True, eq=False)
class _Ticks:
    """Ticks of one kind: their places along the axis, and their labels with their widths, the largest and the height.

    Sizes are in pixels.
    """

    at: np.ndarray
    labels: list[str]
    widths: np.ndarray
    width: float
    height: float


class _LightAxis(Axis):
    """What both axes share. Ticks stand below and at the left."""

    _along: int
    """0 of the abscissa, 1 of the ordinate."""

    _side: str
    """Where its ticks stand."""

    aligned: tuple[Any, ...] = ()
    """Axes whose labels stand in one line, this among them; (): this alone."""

    def reset_ticks(self) -> None:
        """Have no objects of ticks; they are made when somebody asks for them."""
        self.majorTicks: list[Any] = []
        self.minorTicks: list[Any] = []
        self._computed: dict[Kind, tuple[Any, _Ticks]] = {}
        self._placed_at: dict[Kind, tuple[Any, _Ticks]] = {}
        self._texts: dict[Kind, Text] = {}

    def set_ticks(self, ticks: Any, labels: Any = None, *, minor: bool = False, **style: Any) -> list[Any]:
        """Put ticks at places, with labels; arguments as those of `matplotlib.axis.Axis`, but minor ones and styles."""
        if minor or style:
            return super().set_ticks(ticks, labels, minor=minor, **style)
        places = np.asarray(ticks, dtype=float)
        if places.size:
            self.set_view_interval(places.min(), places.max())
        self.set_major_locator(FixedLocator(places.tolist()))
        if labels is not None:
            self.set_major_formatter(FixedFormatter(list(labels)))
        return self.majorTicks

    def get_ticks_position(self) -> Any:
        """Where the ticks stand."""
        return super().get_ticks_position() if self.majorTicks else self._side  # type: ignore[misc]

    def get_tightbbox(self, renderer: Any = None, *, for_layout_only: bool = False) -> Bbox | None:
        """The extent of labels of ticks and axis, pixels; arguments as those of `matplotlib.axis.Axis`."""
        objects = self.majorTicks or self.minorTicks  # somebody asked for them, and may have changed one
        if objects or renderer is None:
            return super().get_tightbbox(renderer, for_layout_only=for_layout_only)
        if not self.get_visible():
            return None
        boxes = [self._outside(renderer)]
        self._place_texts(renderer)
        for text in (self.label, self.offsetText):
            if text.get_visible() and text.get_text():
                extent = text.get_window_extent(renderer)
                if text is self.label and for_layout_only:  # layouts cannot give room along the axis
                    corners = extent.get_points()
                    corners[:, self._along] = corners[:, self._along].mean() + np.array([-0.5, 0.5])
                    extent = Bbox(corners)
                boxes.append(extent)
        return Bbox.union(boxes)

    def draw(self, renderer: Any) -> None:
        """Draw grid, marks, labels of ticks, and the label of the axis."""
        if self.majorTicks or self.minorTicks:
            super().draw(renderer)
            return
        if not self.get_visible():
            return
        renderer.open_group(__name__)
        for kind, ticks in self._ticks(renderer).items():
            style = self.get_tick_params(kind)
            if style.get("gridOn"):
                self._draw_lines(renderer, ticks.at, self._span(), "grid.color", _SETTINGS["grid.linewidth"])
            if style.get(self._side):
                edge = self._span()[0]
                length = self._length(renderer, kind)
                width = _SETTINGS[f"{self._name}.{kind}.width"]
                self._draw_lines(renderer, ticks.at, (edge - length, edge), f"{self._name}.color", width)
            if any(ticks.labels):
                self._draw_labels(renderer, ticks, kind)
        self._place_texts(renderer)
        self.label.draw(renderer)
        self.offsetText.draw(renderer)
        renderer.close_group(__name__)
        self.stale = False

    @property
    def _name(self) -> str:
        """The name of the axis in settings."""
        return "xtick" if self._along == 0 else "ytick"

    def _span(self) -> tuple[float, float]:
        """The edges of the axes across this axis, pixels; ticks stand at the first."""
        return tuple(self.axes.bbox.get_points()[:, 1 - self._along])

    def _ticks(self, renderer: Any) -> dict[Kind, _Ticks]:
        """Ticks of each kind that are in sight, where they stand now."""
        kinds = _KINDS[:1] if isinstance(self.minor.locator, NullLocator) else _KINDS
        return {kind: ticks for kind in kinds if (ticks := self._placed(renderer, kind)).at.size}

    def _placed(self, renderer: Any, kind: Kind) -> _Ticks:
        ticks = self._labelled(renderer, kind)
        now = (ticks, self.axes.bbox.bounds)
        if self._placed_at.get(kind, (None,))[0] != now:
            points = np.zeros((ticks.at.size, 2))
            points[:, self._along] = ticks.at
            transform = self.axes.get_xaxis_transform() if self._along == 0 else self.axes.get_yaxis_transform()
            self._placed_at[kind] = now, replace(ticks, at=transform.transform(points)[:, self._along])
        return self._placed_at[kind][1]

    def _labelled(self, renderer: Any, kind: Kind) -> _Ticks:
        """Ticks with their places in data; they follow from the limits and the room, and are kept as long as these."""
        ticker = self.major if kind == "major" else self.minor
        named = self.get_tick_params(kind).get(f"label{self._side}", True)
        low, high = self.get_view_interval()
        now = (low, high, self.get_tick_space(), self.axes.figure.dpi, ticker.locator, ticker.formatter, named)
        if self._computed.get(kind, (None,))[0] != now:
            places = np.asarray(self.get_majorticklocs() if kind == "major" else self.get_minorticklocs(), dtype=float)
            formatter = self.get_major_formatter() if kind == "major" else self.get_minor_formatter()
            labels = formatter.format_ticks(places.tolist())
            ends = np.sort(self.get_transform().transform([low, high]))
            with np.errstate(invalid="ignore", divide="ignore"):
                at = self.get_transform().transform(places)
                seen = np.abs(at - ends.mean()) <= (0.5 + _ROUNDING) * (ends[1] - ends[0])
            shown = [label if named else "" for label, there in zip(labels, seen, strict=True) if there]
            font = self._label_text(kind).get_fontproperties()
            texts = ("lp", *filter(None, shown))  # a line is as high as l and p
            sizes = [renderer.get_text_width_height_descent(text, font, False) for text in texts]
            widths = np.array([next(drawn)[0] if label else 0.0 for drawn in [iter(sizes[1:])] for label in shown])
            width = float(widths.max(initial=0.0))
            self._computed[kind] = now, _Ticks(places[seen], shown, widths, width, max(size[1] for size in sizes))
        return self._computed[kind][1]

    def _label_text(self, kind: Kind) -> Text:
        """The text that draws all labels of a kind, in pixels."""
        if kind not in self._texts:
            size = self.get_tick_params(kind).get("labelsize", _SETTINGS[f"{self._name}.labelsize"])
            across: Any = (
                {"ha": "center", "va": "top"} if self._along == 0 else {"ha": "right", "va": "center_baseline"}
            )
            text = Text(fontsize=size, color=_SETTINGS[f"{self._name}.color"], transform=IdentityTransform(), **across)
            text.set_figure(self.axes.figure)
            self._texts[kind] = text
        return self._texts[kind]

    def _length(self, renderer: Any, kind: Kind) -> float:
        """Return the length of marks, pixels."""
        shown = self.get_tick_params(kind).get(self._side)
        return float(renderer.points_to_pixels(_SETTINGS[f"{self._name}.{kind}.size"])) if shown else 0.0

    def _from_edge(self, renderer: Any, kind: Kind) -> float:
        """Distance of labels from the edge of the axes, pixels."""
        pad = self.get_tick_params(kind).get("pad", _SETTINGS[f"{self._name}.{kind}.pad"])
        return self._length(renderer, kind) + float(renderer.points_to_pixels(pad))

    def _draw_labels(self, renderer: Any, ticks: _Ticks, kind: Kind) -> None:
        text = self._label_text(kind)
        place = self._span()[0] - self._from_edge(renderer, kind)
        for at, label in zip(ticks.at, self._apart(ticks), strict=True):
            if label:
                text.set_text(label)
                text.set_position((at, place) if self._along == 0 else (place, at))
                text.draw(renderer)

    def _apart(self, ticks: _Ticks) -> list[str]:
        """The labels that do not run into each other: all, or every second, third, ..., with that of 0 among them."""
        labelled = [i for i, label in enumerate(ticks.labels) if label]
        sizes = ticks.widths + _BLANK * ticks.height if self._along == 0 else np.full(ticks.at.size, ticks.height)
        zero = next((i for i in labelled if ticks.labels[i].strip("0.") == ""), labelled[0] if labelled else 0)
        for step in range(1, len(labelled) + 1):
            kept = labelled[labelled.index(zero) % step :: step]
            gaps = np.abs(np.diff(ticks.at[kept])) - 0.5 * (sizes[kept][1:] + sizes[kept][:-1])
            if np.all(gaps >= 0.0):
                return [label if i in kept else "" for i, label in enumerate(ticks.labels)]
        return ticks.labels

    def _draw_lines(self, renderer: Any, at: np.ndarray, across: tuple[float, float], color: str, width: float) -> None:
        """One path of lines across the axis."""
        ends = np.empty((at.size, 2, 2))
        ends[:, :, self._along] = at[:, None]
        ends[:, :, 1 - self._along] = across
        codes = np.tile(np.array([Path.MOVETO, Path.LINETO], dtype=Path.code_type), at.size)
        context = renderer.new_gc()
        context.set_foreground(_SETTINGS[color])
        context.set_linewidth(width)
        renderer.draw_path(context, Path(ends.reshape(-1, 2), codes), IdentityTransform())
        context.restore()

    def _outside(self, renderer: Any) -> Bbox:
        """The box of all labels of ticks, pixels; without labels it is empty, at the edge of the axes."""
        edge = self._span()[0]
        far = edge
        low, high = sorted(self.axes.bbox.get_points()[:, self._along])
        for kind, ticks in self._ticks(renderer).items():
            far = min(far, edge - self._length(renderer, kind))
            if any(ticks.labels):
                size, half = (ticks.height, ticks.width / 2) if self._along == 0 else (ticks.width, ticks.height / 2)
                far = min(far, edge - self._from_edge(renderer, kind) - size)
                low, high = min(low, ticks.at[0] - half), max(high, ticks.at[-1] + half)
        corners = np.empty((2, 2))
        corners[:, self._along], corners[:, 1 - self._along] = (low, high), (far, edge)
        return Bbox(corners)

    def _place_texts(self, renderer: Any) -> None:
        """Put the label of the axis, and the power of ten of its ticks, outside the labels of ticks."""
        boxes = [axis._outside(renderer) for axis in self.aligned or (self,)]
        far = min(box.get_points()[0, 1 - self._along] for box in boxes)
        place = [0.5, 0.5]
        place[1 - self._along] = far - renderer.points_to_pixels(self.labelpad)
        self.label.set_position((place[0], place[1]))
        factor = self.get_major_formatter().get_offset()
        self.offsetText.set_text(f"× {power_of_ten(factor)}" if factor.startswith("1e") else factor)
        if self.offsetText.get_text():
            away = renderer.points_to_pixels(self.OFFSETTEXTPAD)
            own = self._outside(renderer)
            at = (1.0, own.y0 - away) if self._along == 0 else (0.0, self.axes.bbox.ymax + away)
            self.offsetText.set_position(at)
            if self._along == 0 and self.label.get_text():
                label = self.label.get_window_extent(renderer)
                if label.overlaps(self.offsetText.get_window_extent(renderer)):
                    self.offsetText.set_position((1.0, label.y0 - away))


class _LightXAxis(_LightAxis, XAxis):
    _along, _side = 0, "bottom"


class _LightYAxis(_LightAxis, YAxis):
    _along, _side = 1, "left"


class LightAxes(Axes):
    """Axes whose ticks are drawn by this file."""

    name = "light"

    def _init_axis(self) -> None:
        """Make the axes; the place where projections of matplotlib do so."""
        self.xaxis, self.yaxis = _LightXAxis(self, clear=False), _LightYAxis(self, clear=False)
        for spine in self.spines.values():  # one that knew its axis would ask it for objects of ticks
            spine.set_position(("outward", 0.0))
            spine.set_in_layout(False)
