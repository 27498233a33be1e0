"""Figures inside the page: no clashes of names, nothing of the page's own style, curves where they were."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from matplotlib.figure import Figure

from edesign.report.drawing.light_axes import LightAxes
from edesign.report.drawing.style import new_figure, styled, svg_text
from edesign.report.html.inline_svg import TOLERANCE, UNITS, inline_svg
from edesign.report.html.shared_styles import share_styles

PIXELS_PER_POINT = 1.24  # as the style sheet shows figures; 34rem on a phone is less


@styled
def _drawing(values: np.ndarray, title: str) -> Figure:
    figure, ((axes,),) = new_figure(1, 1, 5.0, 3.0)
    axes.plot(np.arange(values.size), values, "-", gid="curve")
    axes.plot([0.0, 1.0], [0.0, 1.0], "o")
    axes.set_title(title)
    return figure


def _points(path: str) -> np.ndarray:
    """Vertices of a path of M and relative l steps in points, read on their own."""
    start, steps = re.findall(r"[Ml]([^Mlz]*)", path)
    numbers = [np.array(re.findall(r"-?\d+", part), dtype=float).reshape(-1, 2) for part in (start, steps)]
    return np.cumsum(np.concatenate(numbers), axis=0) / UNITS


def test_names_of_two_figures_do_not_clash() -> None:
    texts = [inline_svg(_drawing(np.sin(np.arange(50)), "a"), name, "a")[0] for name in ("first", "second")]
    ids = [re.findall(r' id="([^"]+)"', text) for text in texts]
    assert not set(ids[0]) & set(ids[1])
    for text, names in zip(texts, ids, strict=True):
        assert len(names) == len(set(names))
        targets = re.findall(r'url\(#([^)]+)\)|href="#([^"]+)"', text)
        assert targets and {name for pair in targets for name in pair if name} <= set(names)


def test_nothing_that_would_rule_the_page_or_ask_the_network() -> None:
    text, width = inline_svg(_drawing(np.ones(9), "a"), "one", "Title", "More")
    assert width == pytest.approx(360.0)
    assert "<style" not in text and "<?xml" not in text and "<!DOCTYPE" not in text and "http" not in text
    assert "<metadata" not in text


def test_title_and_description_are_escaped_and_referred_to() -> None:
    text, _ = inline_svg(_drawing(np.ones(9), "a < b & <script>"), "one", 'drift "<script>"', "what & why")
    root = ElementTree.fromstring(text)
    named = {element.get("id"): element.text for element in root.iter() if element.get("id")}
    assert named[root.get("aria-labelledby")] == 'drift "<script>"'
    assert named[root.get("aria-describedby")] == "what & why"
    assert "<script" not in text


def test_curves_lose_points_and_stay_within_half_a_pixel() -> None:
    """Against the same figure with every vertex: matplotlib's own simplification is switched off for it."""
    import matplotlib

    t = np.arange(6000) / 100.0
    values = np.exp(-0.03 * t) * np.sin(2.0 * np.pi * 1.3 * t) + 0.05 * np.sin(2.0 * np.pi * 11.0 * t)
    with matplotlib.rc_context({"path.simplify": False}):
        full = re.search(r'id="curve">\s*<path d="([^"]+)"', svg_text(_drawing(values, "")))
    thinned, _ = inline_svg(_drawing(values, ""), "one", "")
    assert full is not None
    numbers = re.findall(r"[ML] (\S+) (\S+)", full[1])
    every = np.array(numbers, dtype=float)
    assert len(every) == 6000
    paths = re.findall(r' d="([^"]+)"', thinned)
    curve = max((_points(path) for path in paths if path.count("M") == 1 and "C" not in path), key=len)
    assert len(curve) < 4000
    distance = np.full(len(every), np.inf)
    for start, end in zip(curve[:-1], curve[1:], strict=True):
        along = end - start
        share = np.clip((every - start) @ along / max(float(along @ along), 1e-12), 0.0, 1.0)
        distance = np.minimum(distance, np.linalg.norm(every - start - share[:, None] * along, axis=1))
    assert np.max(distance) * PIXELS_PER_POINT < 0.5
    assert np.max(distance) > TOLERANCE / 10.0  # it was thinned out at all


def test_figures_of_a_page_share_styles_as_classes() -> None:
    """What looks alike has one class, whose rule is the style that was written out before; ids stay apart."""
    figures = [inline_svg(_drawing(np.sin(np.arange(50)), ' style="a"'), name, "a")[0] for name in ("one", "two")]
    page = share_styles(f"<style></style>{''.join(figures)}")
    rules = dict(re.findall(r"\.(v\d+)\{([^}]*)\}", page))
    assert len(set(rules.values())) == len(rules)
    shared = re.sub(r' class="(v\d+)"', lambda found: f' style="{rules[found[1]]}"', page[page.index("<svg") :])
    for number, name in enumerate(("one", "two"), 1):
        shared = re.sub(rf'(?<=[#"])v{number}(?=-)', name, shared)
    assert shared == "".join(figures)


def test_what_stands_within_its_axes_needs_no_clip() -> None:
    """A curve that leaves its axes is clipped at them, and at them only; one within them is not."""

    @styled
    def drawn(limit: float) -> str:
        figure, ((axes,),) = new_figure(1, 1, 5.0, 3.0)
        axes.plot([0.0, 1.0, 2.0], [0.0, 1.0, 0.5], lw=1.0)
        axes.set_xlim(-1.0, 3.0)
        axes.set_ylim(-1.0, limit)
        return inline_svg(figure, "one", "")[0]

    assert "clip" not in drawn(2.0)
    clipped = ElementTree.fromstring(drawn(0.8))
    (limits,) = clipped.iter("clipPath")
    (rectangle,) = limits
    (curve,) = (element for element in clipped.iter("path") if element.get("clip-path"))
    assert curve.get("clip-path") == f"url(#{limits.get('id')})"
    x, y, width, height = (float(str(rectangle.get(key))) for key in ("x", "y", "width", "height"))
    start = [float(number) for number in re.findall(r"\d+", str(curve.get("d")))[:2]]
    assert start == pytest.approx([x + width / 4, y + height * 0.8 / 1.8], abs=1.0)


def test_texts_stand_where_matplotlib_puts_them() -> None:
    """Labels of ticks, titles and legends against the SVG file of matplotlib itself, drawn with its own ticks.

    The power of ten is written as in print, where matplotlib writes 1e−8.
    """
    from matplotlib.axes import Axes

    @styled
    def drawn(kind: type[Axes]) -> Figure:
        figure = Figure(figsize=(5.0, 3.0), layout="none")
        figure.subplots_adjust(0.15, 0.2, 0.9, 0.9)
        axes = figure.add_subplot(axes_class=kind)
        axes.plot([0.0, 7.0], [-2.0e-8, 3.0e-8], label="a curve")
        axes.legend(loc="upper left")
        axes.set(xlabel="time (s)", ylabel="force (N)")
        axes.set_title("above the power of ten of the ordinate", loc="left")
        return figure

    found = _texts(inline_svg(drawn(LightAxes), "one", "")[0], UNITS)
    own = _texts(svg_text(drawn(Axes)).replace("1e\N{MINUS SIGN}8", "× 10⁻⁸"), 1.0)
    assert [text for text, *_ in found] == [text for text, *_ in own] and len(own) > 10
    assert "× 10⁻⁸" in {text for text, *_ in found}
    for (text, *here), (_, *there) in zip(found, own, strict=True):
        assert here == pytest.approx(there, abs=0.3), text  # the height of a line, and rounding to a tenth of a point


def _texts(svg: str, units: float) -> list[tuple[str, float, float]]:
    """Texts of a drawing with their places in points, sorted."""
    found = []
    for about, text in re.findall(r"<text ([^>]*)>([^<]+)</text>", svg):
        place = re.search(r'x="([\d.]+)" y="([\d.]+)"', about) or re.search(r"translate\(([\d.]+),? ([\d.]+)\)", about)
        assert place is not None, about
        found.append((text, float(place[1]) / units, float(place[2]) / units))
    return sorted(found)


def test_a_power_of_ten_stands_below_a_label_that_is_in_its_way() -> None:
    """A narrow panel of residual drifts of an elastic frame: power and label have no point in common."""

    @styled
    def drawn() -> Figure:
        figure, ((axes,),) = new_figure(1, 1, 2.0, 2.2)
        axes.plot([0.0, 1.1e-5], [1.0, 2.0])
        axes.set_xlabel("residual interstorey drift (%)")
        return figure

    below = {text: y for text, _, y in _texts(inline_svg(drawn(), "one", "")[0], UNITS)}
    assert below["× 10⁻⁵"] - below["residual interstorey drift (%)"] > 8.0  # points, the size of the type


def test_symbols_in_figures_have_an_index_as_those_in_the_text() -> None:
    @styled
    def drawn() -> Figure:
        figure, ((axes,),) = new_figure(1, 1, 5.0, 3.0)
        axes.set_title("a_gR = 0.2 g, steel_f_y, gamma_Rd Omega", loc="left")
        return figure

    svg = ElementTree.fromstring(inline_svg(drawn(), "one", "")[0])
    (title,) = (element for element in svg.iter("text") if "= 0.2" in "".join(element.itertext()))
    assert "".join(title.itertext()).replace("\N{ZERO WIDTH SPACE}", "") == "agR = 0.2 g, steel_f_y, γRd Ω"
    assert [element.text for element in title.iter("tspan") if element.get("font-size")] == ["gR", "Rd"]


def test_a_figure_in_a_file_of_its_own_has_indices_too_and_its_dollar_signs() -> None:
    @styled
    def drawn() -> Figure:
        figure, ((axes,),) = new_figure(1, 1, 5.0, 3.0)
        axes.set_title("$5, f_y = 355 MPa, $6", loc="left")
        return figure

    letters = re.findall(r">([^<])</tspan>", svg_text(drawn()))
    assert sorted("".join(letters).replace("\N{NO-BREAK SPACE}", " ")) == sorted("$5, fy = 355 MPa, $6")
