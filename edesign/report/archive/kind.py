"""What is shown of archives, by the kind of archive."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from edesign.archive.reader import Archive
from edesign.report.tables.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.report.html.section import Section
    from edesign.report.page.source import Source

Figures = Callable[[Archive], Iterator[tuple[str, str, "Figure"]]]
"""Gives (name of the file, caption, figure) for what an archive has of a subject."""


@dataclass(frozen=True)
class ArchiveKind:
    """What is shown of archives of a kind, and how their report is called.

    Attributes:
        name: attribute `kind` of the root of such archives; "": they have none.
        report: what the report is, above its title.
        tables: gives all tables of an archive, without the heading.
        short_tables: gives the main tables, which a run ends with; the first argument is the archive, the second the
            heading, whose rows and notes may be added to.
        figures: gives the functions that draw the figures, in the order of the report.
        sections: gives the sections of the report that have content, in its order.
        unfinished: says what is missing as long as the run goes on or was interrupted.
        summary: gives the archive as plain data by key, and warnings about the archive that were found on the way; the
            second argument has the names of analyses, the third says whether these are all.
    """

    name: str
    report: str
    tables: Callable[[Archive], list[Table]]
    short_tables: Callable[[Archive, Table], list[Table]]
    figures: Callable[[], Sequence[Figures]]
    sections: Callable[[Source], list[Section]]
    unfinished: Callable[[Source], str]
    summary: Callable[[Archive, Sequence[str], bool], tuple[dict[str, Any], list[str]]]
