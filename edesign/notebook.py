"""How notebooks show what edesign has: short tables of HTML, in which texts of users are only texts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from importlib import import_module

SHOWN = 12  # names of a list
PICTURES = "edesign.report.notebook_pictures"
"""The module of the report that draws; it is loaded when a notebook shows something, as nothing here knows reports."""

_LEFT, _RIGHT = (f"style='text-align:{side}'" for side in ("left", "right"))


def facts_html(title: str, rows: Iterable[tuple[str, object]]) -> str:
    """Return names and what they stand for; those that have nothing to say are left out.

    Args:
        title: above them.
        rows: name and value; of a list of texts the first are shown.
    """
    shown = [(name, _text(value)) for name, value in rows if value not in (None, "", [], ())]
    return table_html(title, (), [[name.replace("_", " "), text] for name, text in shown], left=2)


def pictures_html(thing: object) -> str:
    """Return drawings, figures or tables of a model, a record or results as HTML.

    Args:
        thing: a project, study or building, a record, or what a run, a match or a fit returned.
    """
    html: str = import_module(PICTURES).html_of(thing)
    return html


def table_html(
    title: str, columns: Sequence[str], rows: Iterable[Sequence[str]], notes: Iterable[str] = (), left: int = 1
) -> str:
    """Return a table as HTML, every text of it escaped.

    Args:
        title: above it, "" for none.
        columns: headers, () for none.
        rows: cells.
        notes: lines below.
        left: number of columns, from the first, that are aligned left.
    """
    parts = [f"<p><b>{escape(title)}</b></p>"] if title else []
    parts.append("<table>")
    if columns:
        parts.append(f"<thead><tr>{_cells('th', columns, left)}</tr></thead>")
    parts += ["<tbody>", *(f"<tr>{_cells('td', row, left)}</tr>" for row in rows), "</tbody></table>"]
    return "".join([*parts, *(f"<p>{escape(note)}</p>" for note in notes)])


def _cells(tag: str, cells: Sequence[str], left: int) -> str:
    return "".join(f"<{tag} {_LEFT if i < left else _RIGHT}>{escape(cell)}</{tag}>" for i, cell in enumerate(cells))


def _text(value: object) -> str:
    if not isinstance(value, (list, tuple)):
        return str(value)
    more = f" and {len(value) - SHOWN} more" if len(value) > SHOWN else ""
    return ", ".join(map(str, value[:SHOWN])) + more
