"""What is shown of the archive of virtual substructure tests."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from edesign.archive.reader import Archive
from edesign.report.archive.kind import ArchiveKind, Figures
from edesign.report.archive_view import entry, results
from edesign.report.tables.table import Table
from edesign.study.results.kinds import SUBSTRUCTURE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.report.html.section import Section
    from edesign.report.page.source import Source


def _tables(archive: Archive) -> list[Table]:
    from edesign.report.substructure.building_tables import building_tables
    from edesign.report.substructure.tables import substructure_tables

    tables = [*substructure_tables(archive), *building_tables(archive)]
    return [table for table in tables if table.rows]


def _short_tables(archive: Archive, top: Table) -> list[Table]:
    return _tables(archive)


def _figures() -> Sequence[Figures]:
    from edesign.report.archive.analysis_figures import FIGURES

    return (substructure_drawings, *FIGURES)


def substructure_drawings(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield all figures of virtual substructure tests.

    Yields:
        Name of the file, caption and figure.
    """
    from edesign.report.substructure.figures import substructure_figures

    yield from substructure_figures(archive)


def _sections(source: Source) -> list[Section]:
    from edesign.report.page.sections.provenance import provenance
    from edesign.report.page.sections.substructure import substructure_sections
    from edesign.report.page.source import made_of

    return [*substructure_sections(source), *made_of(source, (provenance,))]


def _unfinished(source: Source) -> str:
    return "indicators and verdicts come at its end."


def _summary(archive: Archive, names: Sequence[str], whole: bool) -> tuple[dict[str, Any], list[str]]:
    from edesign.report.substructure.tables import substructure_summary

    tests = {"tests": substructure_summary(archive)} if whole else {}
    return {**tests, "analyses": [entry(name, results(archive, name)) for name in names]}, []


SUBSTRUCTURE_KIND = ArchiveKind(
    name=SUBSTRUCTURE,
    report="Substructure test report",
    tables=_tables,
    short_tables=_short_tables,
    figures=_figures,
    sections=_sections,
    unfinished=_unfinished,
    summary=_summary,
)
