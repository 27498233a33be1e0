"""All tables of an archive by name."""

from __future__ import annotations

import fnmatch
from collections.abc import Iterator, Sequence
from dataclasses import replace
from operator import itemgetter

from edesign.archive.reader import Archive
from edesign.errors import InputError
from edesign.optional_stages import optional
from edesign.project.reading.problems import did_you_mean, listed
from edesign.report.archive.document import page_of
from edesign.report.archive.tables import details, overview
from edesign.report.export.export_table import ExportTable, as_one, export_table
from edesign.report.export.names import slug, table_names, unique_names
from edesign.report.export.value_tables import value_tables
from edesign.report.html.render import Page
from edesign.report.html.section import Facts, Folded, Heading, Part, Warnings
from edesign.report.tables.column import text
from edesign.report.tables.table import Table, TableSpec

NAMED = 12  # tables that an error names
FACTS = TableSpec[tuple[str, str]](
    "facts", "", (text("what", itemgetter(0)), text("value", itemgetter(1))), keys=2, headed=False, named_by_title=True
)
WARNINGS = TableSpec[str]("warnings", "{title}", (text("warning", str),), named_by_title=True)


def archive_tables(archive: Archive, analysis: str | None = None) -> list[ExportTable]:
    """Return all tables of an archive, each with a name of its own.

    They are the tables of the report in its order, those of `edesign show` that the report does not have, and the
    variables of the archive in SI, but for histories.

    Args:
        analysis: name of one analysis, whose tables of `edesign show --analysis` are returned instead.

    Raises:
        InputError: there is no such analysis.
    """
    if analysis is not None:
        return named_tables([(table.title, table) for table in details(archive, analysis)])
    found = list(_page_tables(page_of(archive, tables_only=True)))
    have = [_content(table) for _, table in found]
    shown: list[Table] = []
    with optional("the tables of `edesign show`"):
        shown = [table for table in overview(archive)[1:]]  # the first is of the archive itself, as the provenance does
    found += [(table.title, table) for table in shown if table.rows and _content(table) not in have]
    values: list[ExportTable] = []
    with optional("the tables of the archive's variables"):
        values = value_tables(archive)
    tables = [*named_tables(found), *values]
    names = unique_names([table.name for table in tables])
    return [replace(table, name=name) for table, name in zip(tables, names, strict=True)]


def named_tables(given: Sequence[tuple[str, Table]]) -> list[ExportTable]:
    """Return tables with their names; those that each analysis or member has one of are one table.

    Tables without a name have one that is made of their title. Where two have the same one, as those of several
    designs, what their titles say further is added.
    """
    titled = [(title, table) for title, table in given]
    alike: dict[str, list[tuple[str, Table]]] = {}
    for _, table in titled:
        if table.each is not None:
            alike.setdefault(table.each[0], []).append((table.each[1], table))
    whole: dict[str, tuple[str, Table]] = {}
    for i, (title, table) in enumerate(titled):
        if table.each is None:
            whole[str(i)] = (title, table)
        elif f"each {table.each[0]}" not in whole:
            whole[f"each {table.each[0]}"] = (table.each[0], as_one(table.each[0], alike[table.each[0]]))
    titled = list(whole.values())
    names = table_names([title for title, _ in titled], [table.name for _, table in titled])
    return [
        replace(export_table(name, table, title), sheet=_sheet(name, table))
        for name, (title, table) in zip(names, titled, strict=True)
    ]


def _sheet(name: str, table: Table) -> str:
    """The name of its sheet: the design or variant first, as the end is cut."""
    owner = slug(table.owner) if table.owner else ""
    own = table.name or name
    return f"{owner}_{own}" if owner and owner not in own.split("_") else own if owner else name


def _page_tables(page: Page) -> Iterator[tuple[str, Table]]:
    """Yield the tables, facts and warnings of a report with their titles; a table without one has that above it."""
    for section in page.sections:
        above = section.title
        for part in section.parts:
            if isinstance(part, Heading):
                above = part.text
            yield from _part_tables(part, above)


def _part_tables(part: Part, above: str) -> Iterator[tuple[str, Table]]:
    if isinstance(part, Table) and (part.rows or part.notes):
        yield part.title or above, part
    elif isinstance(part, Folded):
        for inner in part.parts:
            yield from _part_tables(inner, part.summary)
    elif isinstance(part, Facts) and part.rows:
        yield above, FACTS.of(part.rows)
    elif isinstance(part, Warnings):
        yield part.title, WARNINGS.of(part.items, title=part.title)


def choose(tables: Sequence[ExportTable], patterns: Sequence[str], where: str) -> list[ExportTable]:
    """Return the tables whose names fit one of some patterns, in the order of the tables.

    Args:
        patterns: names, with `*` for any letters.
        where: the file, for the message.

    Raises:
        InputError: no table fits a pattern.
    """
    names = [table.name for table in tables]
    for pattern in patterns:
        if not fnmatch.filter(names, pattern):
            hint = did_you_mean(pattern, names)
            some = listed(names[:NAMED]) + (" and more, see --list" if len(names) > NAMED else "")
            raise InputError(f"{where}: no table is named {pattern!r}{hint} (there are: {some}) [E-ARCH-07]")
    return [table for table in tables if any(fnmatch.fnmatchcase(table.name, pattern) for pattern in patterns)]


def _content(table: Table) -> tuple[list[str], list[list[str]]]:
    return table.headers, table.texts
