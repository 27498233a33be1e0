"""A comparison as a CSV file and as plain data for JSON."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from edesign.archive.csv_files import Cell, write_csv_file
from edesign.report.comparison.cells import ComparedCell, ComparedChange, Comparison
from edesign.report.tables.number import finite

HEADERS = (
    "table",
    "quantity",
    "source",
    "statistic",
    "variant",
    "level",
    "index",
    "unit",
    "reference",
    "found",
    "difference_percent",
    "within_percent",
    "inside",
    "count",
    "of",
    "missing",
    "reason",
    "note",
)


def comparison_data(comparison: Comparison) -> dict[str, Any]:
    """Return a comparison as plain data: values in the units of the reference, differences and bars as ratios."""
    return finite(
        {
            "archive": comparison.archive,
            "reference": comparison.reference,
            "title": comparison.title,
            "tables": [
                {
                    "title": table.title,
                    "kind": table.kind,
                    "cells": [_cell(cell) for cell in table.cells],
                    "changes": [_change(change) for change in table.changes],
                    "notes": list(table.notes),
                }
                for table in comparison.tables
            ],
            "reasons": dict(comparison.reasons),
            "notes": list(comparison.notes),
            "cells": len(comparison.cells),
            "absent": len(comparison.absent),
            "outside": len(comparison.outside),
        }
    )


def write_comparison(comparison: Comparison, path: Path) -> None:
    """Write a line for each cell, with all digits; names of missing histories are separated by spaces.

    Args:
        comparison: an archive beside a reference file.

    Raises:
        ArchiveError: the file cannot be written.
    """
    write_csv_file(HEADERS, (_line(table.title, cell) for table in comparison.tables for cell in table.cells), path)


def _cell(cell: ComparedCell) -> dict[str, Any]:
    return {**vars(cell), "missing": list(cell.missing), "difference": cell.difference, "inside": cell.inside}


def _change(change: ComparedChange) -> dict[str, Any]:
    return {**vars(change), "difference": change.difference}


def _line(title: str, cell: ComparedCell) -> list[Cell]:
    def percent(ratio: float | None) -> float | None:
        return None if ratio is None else 100.0 * ratio

    counts = [cell.count, cell.of] if cell.statistic else [None, None]
    return [
        title,
        cell.quantity,
        cell.source,
        cell.statistic,
        cell.variant,
        cell.level,
        cell.index,
        cell.unit,
        cell.reference,
        cell.found,
        percent(cell.difference),
        percent(cell.within),
        cell.inside,
        *counts,
        " ".join(cell.missing),
        cell.reason,
        cell.note,
    ]
