"""A figure of matplotlib as an SVG element of an HTML page: small, without clashes, readable to all."""

from __future__ import annotations

import html
import math
import re
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.backend_bases import FigureCanvasBase, RendererBase
from matplotlib.colors import rgb2hex
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, Bbox

from edesign.report.drawing.style import SEEN, contrast, fit_titles, in_style_of_figures
from edesign.report.drawing.symbols import in_parts
from edesign.report.drawing.thin_out import thin_out_all
from edesign.report.html.lettering import Ink, Written, is_cover
from edesign.report.html.section import Picture
from edesign.report.tables.visible import visible_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from matplotlib.font_manager import FontProperties
    from matplotlib.text import Text
    from matplotlib.transforms import Transform


UNITS = 10  # of the element's coordinates in a point (1/72 inch): whole numbers are short and exact enough
TOLERANCE = 0.2  # points; with roundings half a pixel, as the page shows a point as 1.24 pixels
MANY = 12  # vertices, from which a curve is thinned out
_LETTERS = {Path.MOVETO: ("M", 1), Path.LINETO: ("L", 1), Path.CURVE3: ("Q", 2), Path.CURVE4: ("C", 3)}
_LONG = re.compile("\0(\\d+)\0")  # no text of users has such a sign
_ANCHORS = {"center": "middle", "right": "end"}


def picture_of(name: str, caption: str, figure: Figure) -> Picture:
    """Return a figure as a picture of the page, with its caption as title and description.

    Args:
        name: name of the file of the figure, unique on the page.
        caption: a title, and what else is to be said.
    """
    anchor = f"figure-{name}"
    title, _, description = caption.partition(". ")
    svg, width = inline_svg(figure, anchor, title.rstrip("."), description)
    return Picture(anchor, caption, svg, width)


def inline_svg(figure: Figure, name: str, title: str, description: str = "") -> tuple[str, float]:
    """Draw a figure as an element that stands in a page with others.

    Names of its parts begin with `name`; curves lose the points that nobody can see; coordinates are rounded to a
    tenth of a point. It asks for no fonts: those of the page are narrower than those of the drawing.

    Args:
        figure: as drawn by a `styled` function.
        name: unique on the page, letters, digits, `_`, `-`, `.`.
        title: title for readers who cannot see the figure.
        description: description for them, the caption.

    Returns:
        The element, and its width in points.
    """
    renderer = rendered(figure, name)
    described = f' aria-describedby="{name}-desc"' if description else ""
    box = f"0 0 {_number(UNITS * renderer.width)} {_number(UNITS * renderer.height)}"
    texts = f'<title id="{name}-title">{_escaped(title)}</title>'
    texts += f'<desc id="{name}-desc">{_escaped(description)}</desc>' if description else ""
    start = f'<svg viewBox="{box}" role="img" aria-labelledby="{name}-title"{described}>{texts}'
    return f"{start}{renderer.element()}</svg>", renderer.width


def rendered(figure: Figure, name: str) -> PageRenderer:
    """Draw a figure as the page has it, and return what drew it.

    Args:
        figure: as drawn by a `styled` function.
        name: what names of parts begin with.
    """
    canvas, dpi = figure.canvas, figure.dpi
    with in_style_of_figures():
        fit_titles(figure)
        figure.dpi = 72
        width, height = 72.0 * figure.get_size_inches()
        renderer = PageRenderer(width, height, name)
        _PageCanvas(figure, renderer)
        figure.draw(renderer)
        figure.dpi = dpi
        figure.set_canvas(canvas)
    return renderer


class PageRenderer(RendererBase):
    """Writes matplotlib's drawing as elements of SVG.

    Args:
        width, height: of the figure, points, which are pixels here.
        name: what names of parts begin with.

    Attributes:
        written: the texts, in the order in which they were drawn.
        ink: lines, marks and faces that can be seen, likewise.
    """

    def __init__(self, width: float, height: float, name: str) -> None:
        super().__init__()
        self.width, self.height = width, height
        self.written: list[Written] = []
        self.ink: list[Ink] = []
        self._drawn: list[str] = []
        self._long: list[tuple[np.ndarray, bool]] = []
        self._name = name
        self._named: dict[str, str] = {}

    def get_canvas_width_height(self) -> tuple[float, float]:
        """Return width and height of the canvas, pixels, as matplotlib asks for them."""
        return self.width, self.height

    def flipy(self) -> bool:
        """Let matplotlib know that ordinates of the canvas grow downwards, as those of SVG do."""
        return True

    def get_text_width_height_descent(self, s: str, prop: FontProperties, ismath: Any) -> tuple[float, float, float]:
        """Return width, height and descent of a text, pixels; matplotlib measures mathematical text itself."""
        return super().get_text_width_height_descent(s, prop, ismath) if ismath else _text_size(s, prop)

    def draw_path(
        self, gc: Any, path: Path, transform: Transform, rgbFace: Any = None
    ) -> None:  # names of arguments are those of matplotlib
        """Draw a path, whose parts outside the clip are left out where it has no face."""
        box = None if rgbFace is not None else _grown(gc.get_clip_rectangle(), gc.get_linewidth())
        pieces = _pieces(path, transform + self._down(), self._flipped(box))
        if pieces:
            shape = f'<path d="{self._path_data(pieces)}"{_style(gc, rgbFace)}/>'
            self._clipped(gc, shape, np.concatenate([points for points, _, _ in pieces]))
            self._note(gc, [np.concatenate([p, p[:1]]) if closed else p for p, _, closed in pieces], rgbFace)

    def draw_markers(
        self,
        gc: Any,
        marker_path: Path,
        marker_trans: Transform,
        path: Path,
        trans: Transform,
        rgbFace: Any = None,
    ) -> None:
        """Draw a marker at each finite vertex of a path; the marker is defined once and used by reference."""
        pieces = _pieces(marker_path, marker_trans + Affine2D().scale(1.0, -1.0), None)
        marker = f'<path d="{self._path_data(pieces)}"{_style(gc, rgbFace)}/>'
        name = self._define(marker, "")
        at = (trans + self._down()).transform(path.vertices)
        at = at[np.all(np.isfinite(at), axis=1)]
        uses = "".join(f'<use href="#{name}" x="{_number(x)}" y="{_number(y)}"/>' for x, y in (UNITS * at).tolist())
        if uses:
            vertices = np.concatenate([points for points, _, _ in pieces])
            reach = np.ptp(vertices, axis=0).max() / 2
            self._clipped(gc, uses, np.concatenate((at - reach, at + reach)))
            outlines = [np.concatenate([points, points[:1]]) for points, _, _ in pieces]
            filled = rgbFace is not None and contrast(rgbFace) >= SEEN
            if filled:
                low, high = vertices.min(axis=0), vertices.max(axis=0)
                middle, arms = 0.5 * (low + high), 0.5 * np.diag(high - low)
                outlines = [np.array([middle - arm, middle + arm]) for arm in arms]
            placed = [points + place for place in at for points in outlines]
            self._note(gc, placed, rgbFace, rgbFace if filled else None)

    def draw_text(
        self,
        gc: Any,
        x: float,
        y: float,
        s: str,
        prop: FontProperties,
        angle: float,
        ismath: Any = False,
        mtext: Text | None = None,
    ) -> None:
        """Draw a text as an element that the fonts of the page set; mathematical text is drawn as outlines."""
        if ismath:  # as outlines
            super().draw_text(gc, x, y, s, prop, angle, ismath, mtext)
            return
        self.written.append(Written(s, _outline(s, prop, x, self.height - y, angle), len(self.ink)))
        style = [f"font-size:{_number(UNITS * prop.get_size_in_points())}px"]
        if mtext is not None and mtext.get_horizontalalignment() in _ANCHORS:
            if not angle or mtext.get_rotation_mode() == "anchor":  # fonts of the page are less wide
                x, y = self._anchor(mtext, x, y, math.radians(angle))
                style.append(f"text-anchor:{_ANCHORS[mtext.get_horizontalalignment()]}")
        style += [f"font-style:{prop.get_style()}"] * (prop.get_style() != "normal")
        style += [f"font-weight:{prop.get_weight()}"] * (prop.get_weight() not in ("normal", 400))
        red, green, blue, alpha = gc.get_rgb()
        style += [f"fill:{rgb2hex((red, green, blue))}"] * any((red, green, blue))
        style += [f"opacity:{_number(alpha)}"] * (alpha != 1.0)
        place = f'x="{UNITS * x:.0f}" y="{UNITS * y:.0f}"'
        if angle:
            place = f'transform="translate({UNITS * x:.0f} {UNITS * y:.0f}) rotate({_number(-angle)})"'
        text = f'<text {place} style="{";".join(style)}">{_with_indices(s)}</text>'
        _, high, _ = _text_size(s, prop)
        self._clipped(gc, text, np.array([[x, y - high], [x, y]]))

    def element(self) -> str:
        """Return the element of all that was drawn; long curves lose their invisible points here, all at once."""
        thinned = thin_out_all([points for points, _ in self._long], TOLERANCE)
        data = [_line_data(points, closed) for points, (_, closed) in zip(thinned, self._long, strict=True)]
        return _LONG.sub(lambda found: data[int(found[1])], "".join(self._drawn))

    def _note(self, gc: Any, lines: list[np.ndarray], face: Any, color: Any = None) -> None:
        """Note ink that can be seen; lines are in the ordinates of SVG."""
        width = max(gc.get_linewidth(), 0.1) if gc.get_linewidth() or color is not None else 0.0
        width = width if contrast(gc.get_rgb() if color is None else color) >= SEEN else 0.0
        hides = face is not None and is_cover(face)
        if width or hides:
            box = gc.get_clip_rectangle()
            clip = None if box is None else (box.x0, box.y0, box.x1, box.y1)
            self.ink.append(Ink([(0.0, self.height) + points * (1.0, -1.0) for points in lines], width, hides, clip))

    def _path_data(self, pieces: list[tuple[np.ndarray, np.ndarray, bool]]) -> str:
        """What a path is drawn by; of long curves a number, in whose place `element` puts it."""
        found = []
        for points, codes, closed in pieces:
            if codes.max() > Path.LINETO:
                found.append(_curve_data(points, codes) + "z" * closed)
            elif len(points) < MANY:
                found.append(_line_data(points, closed))
            else:
                found.append(f"\0{len(self._long)}\0")
                self._long.append((points, closed))
        return "".join(found)

    def _anchor(self, text: Text, x: float, y: float, angle: float) -> tuple[float, float]:
        """The point of a text's base line, which begins at x, y, by which it is aligned."""
        at, up = text.get_transform().transform(text.get_unitless_position())
        across = math.sin(angle) * (x - at) + math.cos(angle) * (y - self.height + up)
        return at + across * math.sin(angle), self.height - up + across * math.cos(angle)

    def _down(self) -> Affine2D:
        """From matplotlib's ordinate, upwards, to that of SVG."""
        return Affine2D().scale(1.0, -1.0).translate(0.0, self.height)

    def _flipped(self, box: Bbox | None) -> tuple[float, float, float, float] | None:
        """Left, top, right, bottom of a box."""
        return None if box is None else (box.x0, self.height - box.y1, box.x1, self.height - box.y0)

    def _clipped(self, gc: Any, shape: str, points: np.ndarray) -> None:
        """Draw a shape with these points within the clip of its context; none is needed where it does not reach."""
        path, transform = gc.get_clip_path()
        if path is not None:
            pieces = _pieces(path, transform + self._down(), None)
            outline = f'<path d="{self._path_data(pieces)}"/>'
        elif (limits := self._flipped(_grown(gc.get_clip_rectangle(), -gc.get_linewidth() / 2))) is not None:
            if np.all(points >= limits[:2]) and np.all(points <= limits[2:]):
                self._drawn.append(shape)
                return
            left, top, right, bottom = (UNITS * value for value in self._flipped(gc.get_clip_rectangle()) or ())
            size = f'width="{right - left:.0f}" height="{bottom - top:.0f}"'
            outline = f'<rect x="{left:.0f}" y="{top:.0f}" {size}/>'
        else:
            self._drawn.append(shape)
            return
        name = self._define(outline, "clipPath")
        if shape.count("<") == 1 and not shape.startswith("<use"):
            self._drawn.append(_with(shape, f'clip-path="url(#{name})"'))
        else:
            self._drawn.append(f'<g clip-path="url(#{name})">{shape}</g>')

    def _define(self, element: str, within: str) -> str:
        """The name of an element that others refer to; it is defined at its first use."""
        key = within + element
        if key not in self._named:
            name = self._named[key] = f"{self._name}-{len(self._named)}"
            inner = (
                f'<{within} id="{name}">{element}</{within}>' if within else element.replace(" ", f' id="{name}" ', 1)
            )
            self._drawn.append(f"<defs>{inner}</defs>")
        return self._named[key]


class _PageCanvas(FigureCanvasBase):
    """Gives the layout of a figure the measures of texts."""

    def __init__(self, figure: Figure, renderer: PageRenderer) -> None:
        super().__init__(figure)
        self._renderer = renderer

    def get_renderer(self) -> PageRenderer:
        return self._renderer


@lru_cache(maxsize=4096)
def _text_size(text: str, prop: FontProperties) -> tuple[float, float, float]:
    """Width, height and descent of a line of text, points; the labels of figures recur."""
    width, height, descent = RendererBase().get_text_width_height_descent(text, prop, False)
    return float(width), float(height), float(descent)


def _outline(text: str, prop: FontProperties, x: float, y: float, angle: float) -> np.ndarray:
    """Corners of the box of a text whose base line begins at x, y, upwards, (4, 2) points."""
    width, height, descent = _text_size(text, prop)
    box = np.array([(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]) - (0.0, descent)
    turn = math.radians(angle)
    c, s = math.cos(turn), math.sin(turn)
    return np.asarray(box @ np.array([[c, s], [-s, c]]) + (x, y))


def _style(gc: Any, face: Any) -> str:
    """The attribute that says how a path is filled and drawn."""
    forced = gc.get_forced_alpha()
    style = {"fill": "none" if face is None else rgb2hex(face[:3])}
    if face is not None and len(face) == 4 and face[3] != 1.0 and not forced:
        style["fill-opacity"] = _number(face[3])
    if forced and gc.get_alpha() != 1.0:
        style["opacity"] = _number(gc.get_alpha())
    offset, dashes = gc.get_dashes()
    if gc.get_linewidth():
        red, green, blue, alpha = gc.get_rgb()
        style |= {"stroke": rgb2hex((red, green, blue)), "stroke-width": _number(UNITS * gc.get_linewidth())}
        style |= {"stroke-opacity": _number(alpha)} if alpha != 1.0 and not forced else {}
        style |= {"stroke-linejoin": gc.get_joinstyle()} if gc.get_joinstyle() != "round" else {}
        cap = {"projecting": "square"}.get(gc.get_capstyle(), gc.get_capstyle())
        style |= {"stroke-linecap": cap} if cap != "butt" else {}
        if dashes is not None:
            style["stroke-dasharray"] = ",".join(_number(UNITS * length) for length in dashes)
            style |= {"stroke-dashoffset": _number(UNITS * offset)} if offset else {}
    style = {key: value for key, value in style.items() if (key, value) != ("fill", "#000000")}
    return f' style="{";".join(f"{key}:{value}" for key, value in style.items())}"' if style else ""


def _pieces(
    path: Path, transform: Transform, clip: tuple[float, float, float, float] | None
) -> list[tuple[np.ndarray, np.ndarray, bool]]:
    """The connected parts of a path: points, shape (n, 2), codes of matplotlib, and whether it is closed."""
    clean = path.cleaned(
        transform, remove_nans=True, clip=clip, simplify=path.should_simplify and clip is not None, curves=True
    )
    vertices, codes = np.asarray(clean.vertices), np.asarray(clean.codes)
    starts = np.flatnonzero(codes == Path.MOVETO).tolist()
    found = []
    for first, after in pairwise([*starts, len(codes)]):
        part = codes[first:after]
        there = (part != Path.CLOSEPOLY) & (part != Path.STOP)
        if np.count_nonzero(there) > 1:
            found.append((vertices[first:after][there], part[there], bool((part == Path.CLOSEPOLY).any())))
    return found


def _line_data(points: np.ndarray, closed: bool) -> str:
    """One part of a path of straight lines, in steps from point to point."""
    places = np.rint(UNITS * points).astype(int)
    steps = places[1:] - places[:-1]  # of rounded places, so errors do not add up
    if len(steps) > 1:
        moved = steps.any(axis=1)
        steps = steps[moved] if moved.any() else steps[:1]
    return f"M{_joined(places[0])}l{_joined(steps)}{'z' * closed}"


def _curve_data(points: np.ndarray, codes: np.ndarray) -> str:
    """One part of a path with Bezier curves."""
    text, at = "", 0
    while at < len(codes):
        letter, count = _LETTERS[codes[at]]
        text += letter + " ".join(map(_number, (UNITS * points[at : at + count]).ravel().tolist()))
        at += count
    return text


def _with(element: str, attribute: str) -> str:
    """An element with one attribute more."""
    return element.replace(" ", f" {attribute} ", 1)


def _joined(values: np.ndarray) -> str:
    return " ".join(map(str, values.ravel().tolist())).replace(" -", "-")


def _grown(box: Bbox | None, by: float) -> Bbox | None:
    return None if box is None else Bbox([[box.x0 - by, box.y0 - by], [box.x1 + by, box.y1 + by]])


def _number(value: float) -> str:
    """A number to a hundredth, as short as can be."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") or not math.isfinite(value) else text


def _with_indices(text: str) -> str:
    """A text of a figure as content of its element, with its symbols as in the text of the page."""
    found = ""
    for before, index in in_parts(text):
        found += _escaped(before)
        if index:  # the base line is moved back by the next part; not all browsers know baseline-shift
            found += f'<tspan dy=".25em" font-size="75%">{index}</tspan><tspan dy="-.19em">&#8203;</tspan>'
    return found


def _escaped(text: str) -> str:
    return html.escape(visible_line(text), quote=False)
