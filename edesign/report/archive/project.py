"""What is shown of the archive of a project, and of that of `edesign match`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from edesign.archive.reader import Archive
from edesign.assess.sets import NOT_RUN
from edesign.report.archive.kind import ArchiveKind, Figures
from edesign.report.archive.project_tables import project_tables
from edesign.report.archive.short_tables import short_project_tables
from edesign.report.archive_view import entry, record_entries, results
from edesign.report.tables.number import finite
from edesign.study.results.kinds import RECORDS

if TYPE_CHECKING:
    from edesign.report.html.section import Section
    from edesign.report.page.source import Source


def _figures() -> Sequence[Figures]:
    from edesign.report.archive.analysis_figures import FIGURES
    from edesign.report.model.archived import model_figures

    return (model_figures, *FIGURES)


def analysis_sections(source: Source) -> list[Section]:
    """Return the sections of the report of a project or study that have content."""
    from edesign.report.archive.analysis_sections import SECTIONS
    from edesign.report.page.source import made_of

    return made_of(source, SECTIONS)


def missing_analyses(source: Source) -> str:
    """Return how many analyses of a run that is not complete have no result, as the end of a sentence."""
    missing = [item["name"] for item in source.entries if item["status"] == NOT_RUN]
    return f"{len(missing)} of {len(source.entries)} analyses have no result yet."


def analyses_summary(archive: Archive, names: Sequence[str], whole: bool) -> tuple[dict[str, Any], list[str]]:
    """Return the analyses, and the records where all analyses are asked for; see `ArchiveKind.summary`.

    Args:
        archive: of a project or study.
        whole: whether these are all.
    """
    found: dict[str, Any] = {"analyses": [entry(name, results(archive, name)) for name in names]}
    return found | ({"records": finite(record_entries(archive, RECORDS))} if whole else {}), []


PROJECT_KIND = ArchiveKind(
    name="",
    report="Analysis report",
    tables=project_tables,
    short_tables=short_project_tables,
    figures=_figures,
    sections=analysis_sections,
    unfinished=missing_analyses,
    summary=analyses_summary,
)
