"""How wide tables and figures become on paper, so that nothing is cut."""

from __future__ import annotations

import html
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import lru_cache

from edesign.report.html.render import alignments, typeset
from edesign.report.html.section import Heading, Part, Picture
from edesign.report.pdf.fonts import fonts_folder
from edesign.report.pdf.paper import Paper
from edesign.report.tables.table import Table, state_of

SIZES = (7.5, 7.0, 6.5, 6.0, 5.5)
"""Type of tables, points, largest first."""
UPRIGHT = 7.0  # points, of the type of tables that are cut into several so that they stand on upright sheets
SMALLEST = 5.0  # on a sheet that lies on its long side, where nothing else helps
PADDING = 1.0  # em on both sides of a cell together, with a little for rounding; as in print.css
LINES = {"text": 2.0, "long": 4.0}  # into so many a cell is broken rather than the type made smaller
LONG_WORD = 16.0  # em, from which a word is broken
LONG_TITLE = 9.0  # em, from which the title of a column is broken though there is room
BADGE = 1.4  # em around a verdict
SCALE = 0.92  # of figures: their type of 8 points is then about as large as that of the tables
HEADING, AROUND = 34.0, 27.0  # points of a heading above a figure, and of the blank around the figure and its caption
CAPTION_SIZE, CAPTION_LINE, CAPTION_WIDTH = 7.2, 1.4, 440.0  # type, line over type, and width, points; as in print.css
LEAST_SCALE = 0.69  # to which a figure is made smaller so that two stand on a sheet: its type is then 5.5 points

_TAG = re.compile(r"<[^>]*>")
_BOX = re.compile(r'viewBox="[-\d.]+ [-\d.]+ ([\d.]+) ([\d.]+)"')


@dataclass(frozen=True)
class TableFit:
    """The type size, orientation and columns in which a table is set.

    Attributes:
        size: of the type, points.
        widths: of the columns, em of that type.
        wide: whether it goes on a sheet that lies on its long side.
    """

    size: float
    widths: tuple[float, ...]
    wide: bool = False


def fit_table(table: Table, paper: Paper) -> TableFit:
    """Return the largest type in which a table fits on a sheet, upright if that can be, and its columns."""
    columns = _columns(table)
    needed = sum(column.fair for column in columns)
    for size in SIZES:
        if needed * size <= paper.line:
            return TableFit(size, _shared(columns, paper.line / size))
    for size in (*SIZES, SMALLEST):
        if needed * size <= paper.long_line:
            return TableFit(size, _shared(columns, paper.long_line / size), wide=True)
    squeezed = paper.long_line / SMALLEST / needed  # words and numbers are broken
    return TableFit(SMALLEST, tuple(squeezed * column.fair for column in columns), wide=True)


def upright(table: Table, paper: Paper) -> list[Table]:
    """Return a table that is too wide for an upright sheet as several below each other, which repeat its keys.

    Columns of one level, whose headers end alike, stay together where they fit, and those that are joined always. A
    table with words beside its keys is returned as it is.

    Args:
        table: of the page.
    """
    keys = max(1, table.keys)
    if not fit_table(table, paper).wide or not all(column.numeric for column in table.columns[keys:]):
        return [table]
    room = paper.line / UPRIGHT - sum(column.fair for column in _columns(_part(table, range(keys))))
    widths = [column.fair for column in _columns(table)]
    groups: list[list[int]] = []
    for i in range(keys, len(table.columns)):
        level = _level(table.headers[i])
        if groups and (table.columns[i].joined or level and level == _level(table.headers[groups[-1][0]])):
            groups[-1].append(i)
        else:
            groups.append([i])
    parts: list[list[int]] = [[]]
    for group in groups:
        for block in [group] if sum(widths[i] for i in group) <= room else [[i] for i in group]:
            if parts[-1] and sum(widths[i] for i in (*parts[-1], *block)) > room:
                parts.append([])
            parts[-1] += block
    made = [_part(table, [*range(keys), *part]) for part in parts]
    for number, part in enumerate(made):
        part.title = table.title if number == 0 else ""
        part.notes = table.notes if number == len(made) - 1 else []
    return made


def _part(table: Table, columns: Iterable[int]) -> Table:
    """Some columns of a table."""
    chosen = list(columns)
    rows = [[row[i] for i in chosen] for row in table.rows]
    return replace(table, columns=tuple(table.columns[i] for i in chosen), rows=rows)


def _level(header: str) -> str:
    """What stands behind the last comma of a header, such as the level of `bare, DBE`; "" without one."""
    return header.rpartition(", ")[2] if ", " in header else ""


def begins_wide(parts: Iterable[Part], paper: Paper) -> bool:
    """Return whether parts begin, after headings, with a table on a sheet that lies on its long side.

    What stands above them goes on that sheet too, so that no heading is left alone.

    Args:
        parts: parts of a section.
    """
    first = next((part for part in parts if not isinstance(part, Heading)), None)
    return isinstance(first, Table) and fit_table(first, paper).wide


def picture_size(picture: Picture, paper: Paper) -> tuple[float, float]:
    """Return width and height of a figure on paper, points: with its caption it fits on one sheet.

    It becomes smaller where two such figures then stand on a sheet, and their type is not too small for that.

    Args:
        picture: a figure of the page.
    """
    box = _BOX.search(picture.svg)
    ratio = float(box[2]) / float(box[1]) if box and float(box[1]) else 0.7
    lines = math.ceil(1.03 * text_width(_as_set(picture.caption)) * CAPTION_SIZE / min(CAPTION_WIDTH, paper.line))
    beside = HEADING + AROUND + lines * CAPTION_SIZE * CAPTION_LINE
    width = min(SCALE * picture.width, paper.line, (paper.column - beside) / ratio)
    half = (0.5 * paper.column - beside) / ratio
    if LEAST_SCALE * picture.width <= half < width:
        width = half
    return width, width * ratio


@dataclass(frozen=True)
class _Column:
    """Widths of a column with its padding, em: with its cells in few lines, and in one line each; a short title too."""

    fair: float
    whole: float


def _columns(table: Table) -> list[_Column]:
    found = []
    texts = [[_as_set(cell) for cell in row] for row in table.texts]
    for i, kind in enumerate(alignments(table)):
        cells = [row[i] for row in texts]
        badges = [bool(state_of(row[i])) for row in table.rows]
        head = table.headers[i] if table.headed else ""
        words = [text_width(word, bold=True) for word in head.split()]
        if kind in LINES:
            words += [text_width(word) for cell in cells for word in cell.split()]
        least = min(max(words, default=0.0), LONG_WORD)
        whole = max(
            (
                text_width(cell, bold=True) + BADGE if badge else text_width(cell)
                for cell, badge in zip(cells, badges, strict=True)
            ),
            default=0,
        )
        title = text_width(head, bold=True)
        fair = max(least, whole / LINES.get(kind, 1.0) if whole > LONG_WORD else whole)
        found.append(_Column(fair + PADDING, max(fair, whole, title if title < LONG_TITLE else 0.0) + PADDING))
    return found


def _shared(columns: list[_Column], line: float) -> tuple[float, ...]:
    """Widths of columns: what is left of the line goes to those whose cells are broken, until none is."""
    spare = line - sum(column.fair for column in columns)
    wanted = sum(column.whole - column.fair for column in columns)
    share = min(1.0, spare / wanted) if wanted else 0.0
    return tuple(column.fair + share * (column.whole - column.fair) for column in columns)


@lru_cache(maxsize=65536)
def _as_set(text: str) -> str:
    """A text as it is printed, whose minus signs and arrows are wider than those of a terminal."""
    return html.unescape(_TAG.sub("", str(typeset(text))))


def text_width(text: str, bold: bool = False) -> float:
    """Return the width of a line of text in the type of the PDF, em.

    Args:
        bold: whether the type is bold.
    """
    widths = _widths("DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf")
    return sum(widths.get(ord(character), 1.0) for character in text)


@lru_cache(maxsize=2)
def _widths(file: str) -> dict[int, float]:
    """Return the width of each character of a font, em."""
    from fontTools.ttLib import TTFont  # comes with matplotlib, and with WeasyPrint

    with TTFont(fonts_folder() / file) as font:
        unit, glyphs = font["head"].unitsPerEm, font["hmtx"]
        return {code: glyphs[name][0] / unit for code, name in font.getBestCmap().items()}
