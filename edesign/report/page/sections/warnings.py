"""All warnings in one list: of the check of the input, of designs, of records, and of results."""

from __future__ import annotations

import re
from collections.abc import Iterable
from operator import itemgetter

from edesign.archive.reader import Archive
from edesign.report.archive_view import design_warnings, input_warnings
from edesign.report.assessment.verdict_data import warnings_of_braces
from edesign.report.html.section import Facts, Section
from edesign.report.page.source import Source
from edesign.report.tables.column import text
from edesign.report.tables.table import Table, TableSpec
from edesign.study.results.kinds import RECORDS
from edesign.study.results.warnings import grouped_warnings

NAMED = 20
"""Failed analyses that are named here; the others are in the table of all analyses."""
NONE = "The check of the input and the analyses gave no warnings."
_WHERE = re.compile(r"(?P<where>[^:;,.()]{1,60}(?:\.[a-z0-9]+(?::[0-9]+){0,2})?): (?P<what>.+)", re.DOTALL)
_KEY = re.compile(r"[a-z]+[a-z_]*[._[]")

WARNINGS = TableSpec[tuple[str, str]](
    "report_warnings",
    "",
    (text("applies to", itemgetter(0)), text("warning", itemgetter(1), broken=1)),
    keys=2,
    named_by_title=True,
)


def warnings(source: Source) -> Section:
    """Return all warnings with their subjects."""
    found = warning_table(source)
    if found.rows:
        return Section("warnings", "Warnings", (), (found,))
    return Section("warnings", "Warnings", (), (Facts((("Warnings", NONE),)),) if source.entries else ())


def warning_table(source: Source) -> Table:
    """Return a row for each warning: its subject, and the warning."""
    failed = [item for item in source.entries if item["status"] == "failed"]
    rows = [(item["name"], _sentence(f"failed: {item['reason'] or 'no reason is known'}")) for item in failed[:NAMED]]
    if len(failed) > NAMED:
        rows.append((f"{len(failed) - NAMED} more analyses", "Failed; the table of all analyses names them."))
    lines = [*input_warnings(source.archive), *record_warnings(source.archive), *design_warnings(source.archive)]
    lines += warnings_of_braces(source.archive, source.study, source.sets)
    rows += [_apart(line) for line in dict.fromkeys(lines)]
    for grouped in grouped_warnings(source.groups):
        if grouped.count == 1:
            rows.append((grouped.worst, _sentence(grouped.text)))
        else:
            where = f"{grouped.count} of {len(source.groups)} analyses"
            rows.append((where, _sentence(f"{grouped.common}; most in {grouped.worst}: {grouped.text}")))
    return WARNINGS.of(rows)


def record_warnings(archive: Archive) -> list[str]:
    """Return one sentence for each warning about sets of records and single records, with their names."""
    found = []
    for name in archive.names(RECORDS):
        stored = archive.group_attributes(f"{RECORDS}/{name}").get("warnings")
        found += [f"records {name}: {text}" for text in (stored if isinstance(stored, Iterable) else ())]
    return found


def _apart(line: str) -> tuple[str, str]:
    """What a warning applies to, as it begins with, and the rest of it."""
    found = _WHERE.fullmatch(line)
    return ("input", _sentence(line)) if found is None else (found["where"], _sentence(found["what"]))


def _sentence(text: str) -> str:
    """A warning as a sentence; the name of a key of the file at its beginning stays."""
    first = text if _KEY.match(text) else f"{text[:1].upper()}{text[1:]}"
    return first + ("" if text.endswith((".", "!", "?")) else ".")
