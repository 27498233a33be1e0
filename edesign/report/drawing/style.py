"""What all figures share: size, type, colours, and how they are written."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import wraps
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, ParamSpec

import numpy as np

from edesign.archive.files import write_whole
from edesign.errors import InputError
from edesign.report.drawing.symbols import in_parts
from edesign.report.drawing.text_size import wrapped
from edesign.report.tables.visible import visible

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

P = ParamSpec("P")
FORMATS = ("svg", "png", "pdf")
MOST_TICKS = 13
BESIDE, ORDINATE = 0.18, 0.5  # inches from the title of axes to those beside it, and of the labels of the ordinate
SURE = 0.95
"""Of the width of a figure that a legend may take: types are up to 5 % wider at other resolutions than measured."""
BEFORE, AFTER, TARGET, MEAN = "#8a8f98", "#1f5fa8", "#c0392b", "#111111"
"""Colours that stay apart in grey print and for colour-blind readers."""

VARIANTS = ("#d9822b", AFTER, "#3aa08f", "#7b3f98", "#5a5f66", "#b8476b", "#8c6d1f", "#4fa3d9")
"""Of the variants of a structure, in their order; of a ninth the first again."""

RECORDS = "#b4bac3"
"""Of each of many records."""

SEEN = 3.0
"""Contrast to paper from which a line or mark is seen, of graphical objects by WCAG 2.1, 1.4.11; grids are fainter."""
Rgb = Sequence[float]
"""Red, green and blue, 0 to 1, and perhaps the opacity."""

_STYLE: Any = {
    "font.size": 8.0,
    "axes.titlesize": 9.0,
    "axes.labelsize": 8.0,
    "legend.fontsize": 7.5,
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.linewidth": 0.4,
    "grid.color": "#d9dce1",
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "svg.hashsalt": "edesign",  # the same figure is the same file
    "svg.fonttype": "none",
    "text.parse_math": False,  # dollar signs in users' texts are dollar signs
}


@contextmanager
def in_style_of_figures() -> Iterator[None]:
    """Let matplotlib draw in the style of this file until the end of the context."""
    import matplotlib

    with matplotlib.rc_context(_STYLE):
        yield


def styled(draw: Callable[P, Figure]) -> Callable[P, Figure]:
    """Let a function draw in the style of this file."""

    @wraps(draw)
    def in_style(*args: P.args, **kwargs: P.kwargs) -> Figure:
        with in_style_of_figures():
            return draw(*args, **kwargs)

    return in_style


@contextmanager
def garbage_between_figures() -> Iterator[Callable[[], object]]:
    """Collect garbage only when the function that is given is called, after each figure when it is let go.

    A figure is some hundred thousand objects in circles, all of which live until it is drawn: to look through them
    ever again meanwhile takes a quarter of the time.
    """
    collects = gc.isenabled()
    gc.disable()
    try:
        yield lambda: gc.collect(1)
    finally:
        if collects:
            gc.enable()


def new_figure(rows: int, columns: int, width: float, height: float) -> tuple[Figure, list[list[Axes]]]:
    """Return a figure without a window, and its axes row by row; to be called from a `styled` function.

    Args:
        width: width of the figure, inches.
        height: height of the figure, inches.

    Returns:
        The figure, and its axes as a list of rows.
    """
    from matplotlib.figure import Figure

    from edesign.report.drawing.light_axes import LightAxes

    figure = Figure(figsize=(width, height), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, subplot_kw={"axes_class": LightAxes})
    return figure, axes.tolist()


def save(figure: Figure, path: Path) -> None:
    """Write a figure; the suffix says the format.

    Raises:
        ArchiveError: it cannot be written.
    """
    suffix = path.suffix.lower()
    fit_titles(figure)
    if suffix == ".svg":
        text = svg_text(figure)
        write_whole(path, lambda partial: partial.write_text(text, encoding="utf-8"))
        return
    set_indices(figure)
    metadata = {"CreationDate": None} if suffix == ".pdf" else None
    with in_style_of_figures():
        write_whole(path, lambda partial: figure.savefig(partial, dpi=160, metadata=metadata))


def check_format(name: str) -> str:
    """Return the format of figures if it is one.

    Raises:
        InputError: it is none of `FORMATS`.
    """
    if name not in FORMATS:
        from edesign.project.reading.problems import did_you_mean

        raise InputError(
            f"--format: `{name}` is unknown{did_you_mean(name, FORMATS)} (allowed: {', '.join(FORMATS)}) [E-CLI-04]"
        )
    return name


def check_figure_name(path: Path) -> None:
    """Check the suffix of a figure.

    Raises:
        InputError: it is of no format that is drawn.
    """
    if path.suffix.lower().lstrip(".") not in FORMATS:
        raise InputError(f"{path}: a figure ends in {', '.join(f'.{name}' for name in FORMATS)} [E-FILE-08]")


def set_indices(figure: Figure) -> None:
    """Set the symbols of the codes in the texts of a figure with their indices, as matplotlib does; the rest stays.

    Args:
        figure: that goes into a file of its own; a page sets its texts itself.
    """
    texts: list[Any] = list(figure.texts)
    legends = list(figure.legends)
    for axes in figure.axes:  # not all children of the figure: light axes would make objects of their ticks
        texts += [*axes.texts, axes.title, axes._left_title, axes._right_title, axes.xaxis.label, axes.yaxis.label]  # type: ignore[attr-defined]
        legends += [legend for legend in [axes.get_legend()] if legend is not None]
    texts += [text for legend in legends for text in legend.get_texts()]
    for text in texts:
        parts = list(in_parts(text.get_text()))
        if any(index for _, index in parts):
            escaped = ((before.replace("$", r"\$"), index) for before, index in parts)
            text.set_text(
                "".join(f"{before}$_{{\\mathrm{{{index}}}}}$" if index else before for before, index in escaped)
            )
            text.set_parse_math(True)
        elif parts:
            text.set_text("".join(before for before, _ in parts))


def svg_text(figure: Figure) -> str:
    """Return a figure, as drawn by a `styled` function, as an SVG file; `savefig` would draw it twice to lay it out."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    text, dpi = StringIO(), figure.dpi
    set_indices(figure)
    with in_style_of_figures():
        FigureCanvasSVG(figure).print_svg(text, metadata={"Date": None})
    figure.dpi = dpi
    return visible(text.getvalue())  # XML has no control characters


def contrast(color: Rgb) -> float:
    """Return the contrast of a colour to white paper: 1 of white, 21 of black (WCAG 2.1, relative luminance).

    Args:
        color: what shows through an opacity below 1 is white.
    """
    opacity = color[3] if len(color) > 3 else 1.0
    shown = np.asarray(color[:3], dtype=float) * opacity + 1.0 - opacity
    linear = np.where(shown <= 0.04045, shown / 12.92, ((shown + 0.055) / 1.055) ** 2.4)
    return 1.05 / (float(linear @ np.array((0.2126, 0.7152, 0.0722))) + 0.05)


def legend_label(text: str) -> str:
    """Return a user's text as a label; one that begins with an underscore would be left out of legends."""
    return f" {text}" if text.startswith("_") else text


def legend_above(axis: Axes, columns: int = 2) -> None:
    """Put the legend of an axis above it, from the left.

    Args:
        axis: the axes to draw on.
    """
    axis.legend(loc="lower left", bbox_to_anchor=(-0.02, 1.0), ncols=columns, borderaxespad=0.2)


def legend_below(
    figure: Figure, handles: Sequence[Any] = (), labels: Sequence[str] = (), most: int = 8, title: str = ""
) -> None:
    """Put a legend below the axes, in as many columns as fit the width of the figure; to be called when `styled`.

    Args:
        figure: of its final size.
        handles: the lines or patches of the legend; by default all that have a label in the figure.
        labels: the text of each handle; by default its own.
        most: the largest number of columns, however wide the figure is.
        title: above it.
    """
    if not handles:
        found = [axes.get_legend_handles_labels() for axes in figure.axes]
        handles, labels = [one for some, _ in found for one in some], [text for _, some in found for text in some]
    labels = labels or [str(handle.get_label()) for handle in handles]
    for columns in range(min(most, len(handles)), 0, -1):
        legend = figure.legend(handles, labels, loc="outside lower center", ncols=columns, title=title or None)
        if columns == 1 or legend.get_window_extent().width <= SURE * figure.bbox.width:
            return
        legend.remove()


def grid_figure(count: int, columns: int, width: float, height: float) -> tuple[Figure, list[Axes]]:
    """Return a figure of `count` panels in rows of at most `columns`, and their axes; to be called when `styled`.

    Args:
        columns: the largest number of panels in a row.
        width: width of a panel, inches.
        height: height of a panel, inches.

    Returns:
        The figure, and the axes of the panels in reading order.
    """
    across = min(columns, count)
    down = -(-count // across)
    figure, axes = new_figure(down, across, 0.5 + width * across, 0.5 + height * down)
    cells = [axis for row in axes for axis in row]
    for axis in cells[count:]:
        axis.set_visible(False)
    return figure, cells[:count]


def label_outer(cells: list[Axes], columns: int, abscissa: str, ordinate: str) -> None:
    """Label the axes of panels with common scales: ordinates at the left, abscissas where nothing stands below.

    Args:
        cells: the axes in reading order.
    """
    across = min(columns, len(cells))
    for place, axis in enumerate(cells):
        if place % across == 0:
            axis.set_ylabel(ordinate)
        else:
            axis.tick_params(labelleft=False)
        if place + across >= len(cells):
            axis.set_xlabel(abscissa)
        else:
            axis.tick_params(labelbottom=False)


def fit_titles(figure: Figure) -> None:
    """Break titles of axes into lines where they would run into those beside them, or out of the figure.

    Args:
        figure: of its final size, before it is laid out.
    """
    for axes in figure.axes:
        cell = axes.get_subplotspec()
        if cell is None:
            continue
        grid, columns = cell.get_gridspec(), cell.colspan
        ratios = np.asarray(grid.get_width_ratios(), dtype=float)
        share = float(ratios[columns.start : columns.stop].sum() / ratios.sum())
        room = share * (figure.get_figwidth() - ORDINATE) - BESIDE
        for title in (axes.title, axes._left_title):  # type: ignore[attr-defined]
            words = title.get_text()
            if words and "\n" not in words:
                title.set_text("\n".join(wrapped(words, room, float(title.get_fontsize()))))


def align_ordinates(column: Iterable[Axes]) -> None:
    """Let the labels of the ordinates of axes that stand below each other stand in one line."""
    aligned: tuple[Any, ...] = tuple(axes.yaxis for axes in column)
    for axis in aligned:
        axis.aligned = aligned


def some_of(numbers: Sequence[int] | np.ndarray) -> Sequence[int] | np.ndarray:
    """Return the numbers of storeys, modes or rounds that an axis shows: all of a few, about eight of many."""
    return numbers if len(numbers) <= MOST_TICKS else numbers[:: len(numbers) // 8]


def logarithmic(axis: Axes) -> None:
    """Give the abscissa a logarithmic scale with plain numbers: 0.1, 0.2, 0.5, 1."""
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    axis.set_xscale("log")
    axis.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axis.xaxis.set_minor_formatter(NullFormatter())
