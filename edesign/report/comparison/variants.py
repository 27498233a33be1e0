"""Several variants of an archive beside one of a reference: what a response depends on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.archive.reader import Archive
from edesign.errors import InputError
from edesign.project.reading.problems import unknown_name
from edesign.project.study.reference import Reference, ResponseTable
from edesign.report.archive_view import planned, results
from edesign.report.comparison.cells import ComparedCell
from edesign.report.comparison.compare import compare
from edesign.report.comparison.tables import PRINTED, found, name_of
from edesign.report.tables.cell import Marked
from edesign.report.tables.column import Column, col, literal, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE

Row = Mapping[str, ComparedCell]
"""A value of a reference and the one of each variant."""


def _first(row: Row) -> ComparedCell:
    return next(iter(row.values()))


def _variant(name: str) -> Column[Row]:
    def of(row: Row) -> Marked:
        difference = row[name].difference
        return Marked(found(row[name]), " (-)" if difference is None else f" ({100.0 * difference:+.0f})")

    return col(literal(name), ONE, of)


VARIANTS = TableSpec[Row](
    "compared_variants",
    "{title}",
    (
        text("quantity", lambda row: name_of(_first(row))),
        col("reference", ONE, lambda row: _first(row).reference, form=PRINTED),
    ),  # and each variant
    notes=("in brackets the difference from the reference, %",),
)


def variant_tables(archive: Archive, reference: Reference, place: str) -> list[Table]:
    """Return a table for each table of responses and level: the reference's variant, and every variant of the archive.

    Args:
        archive: of a study; its variants that the reference has under their own names are left out.
        place: variant of the reference that the others are put in the place of.

    Raises:
        InputError: the reference has no such variant.
        ArchiveError: the archive cannot be read.
    """
    known = {variant for table in _responses(reference) for row in table.rows for variant in row.values}
    if place not in known:
        raise InputError(f"--variants: {unknown_name('variant', place, sorted(known))}")
    names = [name for name in _variants(archive) if name == place or name not in known]
    cells = {name: _cells(archive, renamed(reference, place, name)) for name in names}
    rows: dict[tuple[str, str], list[Row]] = {}
    for key in cells[names[0]] if names else ():
        title, level, _ = key
        rows.setdefault((title, level), []).append({name: cells[name][key] for name in names})
    more = [_variant(name) for name in names]
    return [VARIANTS.of(those, title=f"{title} - {level}", more=more) for (title, level), those in rows.items()]


def renamed(reference: Reference, place: str, name: str) -> Reference:
    """Return the responses of a reference with one variant under another name, and without the others.

    Args:
        name: the new name of the variant.
    """
    tables = []
    for table in _responses(reference):
        rows = [
            row.model_copy(update={"values": {name: row.values[place]}, "change": {}})
            for row in table.rows
            if place in row.values
        ]
        tables.append(table.model_copy(update={"rows": tuple(rows), "change": None}))
    return reference.model_copy(update={"tables": tuple(tables)})


def _responses(reference: Reference) -> list[ResponseTable]:
    return [table for table in reference.tables if isinstance(table, ResponseTable)]


def _variants(archive: Archive) -> Sequence[str]:
    """Variants with histories, in the order of the plan."""
    attributes = [results(archive, name).attributes for name in planned(archive)]
    return list(dict.fromkeys(str(a["variant"]) for a in attributes if a.get("kind") == "history"))


def _cells(archive: Archive, reference: Reference) -> dict[tuple[str, str, str], ComparedCell]:
    return {
        (table.title, cell.level, cell.quantity): cell
        for table in compare(archive, reference).tables
        for cell in table.cells
    }
