"""`edesign quantities`: what criteria of a study may limit."""

from __future__ import annotations

from edesign.report.assessment.quantity_table import measures_table, quantities_table
from edesign.report.tables.text import print_tables


def quantities() -> None:
    """Print the quantities and measures that criteria of a study may limit, with their units and keys."""
    print_tables([quantities_table(), measures_table()])
