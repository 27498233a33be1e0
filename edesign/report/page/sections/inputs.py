"""What was analysed: the frame in words and key numbers, the plan, and the files to the letter."""

from __future__ import annotations

from edesign.report.archive_tables import analyses_table
from edesign.report.page.project_facts import project_rows
from edesign.report.page.section import Facts, Folded, Part, Section
from edesign.report.page.source import Source


def inputs(source: Source) -> Section:
    """The input of the run; an archive without a project, as of `edesign match`, has none."""
    parts: list[Part] = []
    if source.project is not None:
        parts.append(Facts(tuple(project_rows(source.project))))
    if source.entries:
        table = analyses_table(source.entries)
        parts.append(Folded(f"All {len(source.entries)} analyses", (table,)))
    for name, what in (("study_text", "The study file"), ("project_text", "The project file")):
        text = source.text(name)
        if text:
            parts.append(Folded(f"{what}, {len(text.splitlines())} lines", text=text))
    title = source.project.title if source.project is not None else ""
    known = title == source.attributes.get("title")
    return Section("inputs", "What was analysed", (f"{title}.",) if title and not known else (), tuple(parts))
