"""Assumptions and limits of the analyses, for those who sign for the results."""

from __future__ import annotations

from edesign.report.html.section import Facts, Section
from edesign.report.inputs.assumptions import assumption_rows
from edesign.report.page.source import Source


def assumptions(source: Source) -> Section:
    """Return the section on the assumptions of the model, as they follow from the project."""
    title = "Assumptions and limits"
    if source.project is None or not source.entries:
        return Section("assumptions", title)
    rows = assumption_rows(source.project, source.study)
    return Section("assumptions", title, (), (Facts(tuple(rows)),))
