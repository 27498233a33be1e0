"""Sections to HTML: the template, the style sheet, and how cells of tables are set."""

from __future__ import annotations

import base64
import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import resources
from itertools import groupby

from markupsafe import Markup, escape

from edesign._version import __version__
from edesign.report.drawing.symbols import GREEK, SLENDERNESS, in_parts, with_indices_of_laws
from edesign.report.html.section import Part, Section, Viewer
from edesign.report.html.shared_styles import share_styles
from edesign.report.tables.table import Table, state_of
from edesign.report.tables.visible import visible

LONG = 34  # characters, from which a cell is broken into lines
CROWDED, SHORT = 8, 22  # columns, from which a table is set closer (page.html), and its cells broken from so many

_BRACKETED = re.compile(r"(\[[^\[\]]*\])$")  # the unit at the end of a head
_SIGNS = ((" -&gt; ", " → "), ("m/s2", "m/s²"), ("degC", "°C"), ("N*m", "N·m"), ("N*s", "N·s"), ("N*(", "N·("))
_OPERATORS = (("+- ", "± "), ("+-", "±"), ("&lt;=", "≤"), ("&gt;=", "≥"), (" - ", " \N{MINUS SIGN} "))
_ROOT = re.compile(r"\bsqrt(?=\()")
_TIMES = re.compile(r"(?<=[0-9)]) x (?=[0-9(])")
_UNIT = re.compile(r"(?<![A-Za-z])(cm)([2346])(?![A-Za-z0-9])")
_POWER = re.compile(r"\^(?:\((?P<whole>(?:[^()]|\([^()]*\))*)\)|(?P<word>[0-9.]+|[A-Za-z]+(?:_[A-Za-z0-9]+)?))")
_INDEX = r"(?:_([A-Za-z0-9]+(?:,[A-Za-z0-9]+)*))?"
_INDEXED = re.compile(rf"(?<![A-Za-z0-9_&#])({'|'.join(GREEK)}|[A-Za-z]){_INDEX}(?![A-Za-z0-9_])")
# behind a number or in a header, where it is no name
_AREA = re.compile(r"(?:(?<=[0-9] )|(?<=[\[(/])|(?<= in ))(mm|cm|m|s)([234])(?![A-Za-z0-9_])")
_CODE = re.compile(r"`([^`<>]+)`")
_RAISED = {"2": "²", "3": "³", "4": "⁴", "6": "⁶"}
_MINUS = re.compile(r"(?<![A-Za-z0-9_.)\]+-])-(?=[0-9])")  # before a number, where it joins nothing
_POWER_OF_TEN = re.compile(r"(?<![A-Za-z0-9_.])([0-9]+(?:\.[0-9]+)?)e([-+])0*([1-9][0-9]*)(?!\.?[A-Za-z0-9_])")


@dataclass(frozen=True)
class Cover:
    """The parts of a page above and below its sections.

    Attributes:
        title: of the project or study.
        kind: one line above it.
        about: one line below it.
        banner: why the run is not complete, "" if it is.
        footer: the last line.
        document: client, author, checker and the like, by what they are.
        origin: version and date of what is shown, at the foot of printed pages.
        created: the moment of the run, ISO 8601; "" if it is not known.
    """

    title: str
    kind: str
    about: str
    banner: str = ""
    footer: str = ""
    document: tuple[tuple[str, str], ...] = ()
    origin: str = ""
    created: str = ""


@dataclass(frozen=True)
class Page:
    """A report, before it is HTML or a PDF.

    Attributes:
        cover: title and what stands around the sections.
        sections: those that have content, in their order.
    """

    cover: Cover
    sections: tuple[Section, ...]


def render(cover: Cover, sections: Sequence[Section]) -> str:
    """Return the page; all text is escaped and without control characters, only the figures are taken as they are.

    Args:
        cover: title and what stands around the sections.
        sections: those that have content, in their order.
    """
    css = resources.files("edesign.report.html").joinpath("page.css").read_text(encoding="utf-8")
    return share_styles(visible(fill_template(cover, sections, css))) + "\n"


def fill_template(
    cover: Cover, sections: Sequence[Section], css: str, printed: Mapping[str, object] | None = None
) -> str:
    """Return the page that the template makes of a cover and sections.

    Args:
        cover: what stands above and below the sections.
        sections: the sections that have content, in their order.
        css: the style sheet.
        printed: what the template needs for a PDF (see `edesign.report.pdf.document`), None for a page.

    Returns:
        The page as HTML.
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined

    loader = PackageLoader("edesign.report.html", ".")
    environment = Environment(loader=loader, autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    environment.filters |= {
        "typeset": typeset,
        "formula": formula,
        "head": _head,
        "alignments": alignments,
        "cells": cells,
        "runs": runs,
    }
    page = environment.get_template("page.html")
    moving = [part for section in sections for part in section.parts if isinstance(part, Viewer)]
    viewer = _viewer(any(part.in_space for part in moving)) if moving and printed is None else None
    return page.render(**vars(cover), sections=sections, css=css, version=__version__, printed=printed, viewer=viewer)


def _viewer(in_space: bool) -> dict[str, str]:
    """The one program of a page, and its checksum, which is all that the page's security policy lets run."""
    names = ("viewer_of_buildings.js", "viewer.js") if in_space else ("viewer.js",)
    text = "".join(resources.files("edesign.report.html").joinpath(name).read_text(encoding="utf-8") for name in names)
    digest = base64.b64encode(hashlib.sha256(text.encode()).digest()).decode("ascii")
    return {"text": text, "policy": f"; script-src 'sha256-{digest}'"}


def typeset(text: str) -> Markup:
    """Return text, escaped, with the signs of print in place of those of a terminal; what a user types stays."""
    if text == "-":
        return Markup("–")
    words = _CODE.split(text)  # every second one is code
    return Markup("".join(f"<code>{escape(word)}</code>" if i % 2 else _in_print(word) for i, word in enumerate(words)))


def _in_print(text: str) -> str:
    found = str(escape(text))
    for plain, printed in _SIGNS:
        found = found.replace(plain, printed)
    found = _POWER_OF_TEN.sub(_power_of_ten, _AREA.sub(_raised, found))
    found = _MINUS.sub("\N{MINUS SIGN}", found)
    return "".join(f"{before}<sub>{index}</sub>" if index else before for before, index in in_parts(found))


def _power_of_ten(found: re.Match[str]) -> str:
    factor, sign, exponent = found.groups()
    minus = "\N{MINUS SIGN}" if sign == "-" else ""
    power = f"10<sup>{minus}{exponent}</sup>"
    return power if factor == "1" else f"{factor} × {power}"


def formula(text: str) -> Markup:
    """Return a formula in the symbols of the codes, escaped, with Greek letters, indices and powers."""
    found = str(typeset(with_indices_of_laws(text)))
    if found == "–":
        return Markup(found)
    for plain, printed in _OPERATORS:
        found = found.replace(plain, printed)
    found = _UNIT.sub(_raised, _TIMES.sub(" × ", _ROOT.sub("√", found)))
    found = _POWER.sub(lambda power: f"<sup>{power['whole'] or power['word']}</sup>", found)
    return Markup(_INDEXED.sub(_indexed, found))


def _head(text: Markup) -> Markup:
    """Head of a column, typeset, whose unit stays in one line."""
    return Markup(_BRACKETED.sub(r'<span class="unit">\1</span>', str(text)))


def _raised(found: re.Match[str]) -> str:
    return f"{found[1]}{_RAISED[found[2]]}"


def _indexed(found: re.Match[str]) -> str:
    name, index = found[1], found[2]
    name = SLENDERNESS if name == "lambda" and index else GREEK.get(name, name)
    return f"{name}<sub>{index}</sub>" if index else name


def cells(table: Table) -> list[list[tuple[str, str, bool]]]:
    """Return the cells of a table, each its text, the state of its verdict, "" without, and whether it is a formula."""
    symbols = [column.symbols for column in table.columns]
    return [
        [(text, state_of(value), of) for text, value, of in zip(texts, row, symbols, strict=True)]
        for texts, row in zip(table.texts, table.rows, strict=True)
    ]


def alignments(table: Table) -> list[str]:
    """Return the alignment of each column: numbers to the right, words to the left, long texts in lines."""
    texts = table.texts
    found = []
    longest = SHORT if len(table.columns) > CROWDED else LONG
    for i, column in enumerate(table.columns):
        if any(len(row[i]) > longest and " " in row[i] for row in texts):
            found.append("long")
        else:
            found.append("right" if column.numeric and i >= table.keys else "text")
    return found


def runs(parts: Iterable[Part]) -> list[tuple[str, list[Part]]]:
    """Return the parts as runs of one kind, so that figures that follow each other stand side by side."""
    return [(kind, list(run)) for kind, run in groupby(parts, key=lambda part: type(part).__name__)]
