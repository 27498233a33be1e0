"""What is shown of the archive of a study."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from edesign.archive.reader import Archive
from edesign.assess.sets import history_sets
from edesign.errors import EdesignError
from edesign.report.archive.kind import ArchiveKind, Figures
from edesign.report.archive.project import analyses_summary, analysis_sections, missing_analyses
from edesign.report.archive.project_tables import project_tables, warnings_table
from edesign.report.archive.short_tables import short_study_tables
from edesign.report.archive.study_tables import study_tables
from edesign.report.archived import archived_study
from edesign.report.assessment.tables import read_histories
from edesign.report.assessment.verdict_data import study_verdicts, verdict_entry, warnings_of_braces
from edesign.report.ground_motion.record_tables import tables_of
from edesign.report.tables.number import finite
from edesign.report.tables.table import Table
from edesign.study.results.kinds import STUDY


def _tables(archive: Archive) -> list[Table]:
    """The tables of a study; of a damaged one whose text cannot be read, those of its analyses."""
    try:
        tables = [warnings_table(archive), *tables_of(archive), *study_tables(archive)]
        return [table for table in tables if table.rows or table.notes]
    except EdesignError:
        if not archive.damage:
            raise
    return project_tables(archive)


def _figures() -> Sequence[Figures]:
    from edesign.report.archive.analysis_figures import FIGURES
    from edesign.report.assessment.vary_figures import vary_figures
    from edesign.report.capacity.incremental_figures import incremental_figures
    from edesign.report.model.archived import model_figures

    return (model_figures, *FIGURES, vary_figures, incremental_figures)


def _summary(archive: Archive, names: Sequence[str], whole: bool) -> tuple[dict[str, Any], list[str]]:
    """Analyses, records, and verdicts on criteria; a warning if the study is damaged or of another version."""
    found, warnings = analyses_summary(archive, names, whole)
    if not whole:
        return found, warnings
    verdicts: list[dict[str, Any]] = []
    try:
        warnings += warnings_of_braces(archive, archived_study(archive), history_sets(read_histories(archive)))
        verdicts = finite([verdict_entry(verdict) for verdict in study_verdicts(archive)])
    except EdesignError as error:
        warnings.append(f"criteria are not judged: {error}")
    records = found.pop("records")
    return found | {"criteria": verdicts, "records": records}, warnings


STUDY_KIND = ArchiveKind(
    name=STUDY,
    report="Study report",
    tables=_tables,
    short_tables=short_study_tables,
    figures=_figures,
    sections=analysis_sections,
    unfinished=missing_analyses,
    summary=_summary,
)
