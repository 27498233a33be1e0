"""Tables of texts for tests of renderers, which say nothing of what stands in the cells."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.report.tables.cell import Value
from edesign.report.tables.column import Column
from edesign.report.tables.table import Table


def plain_table(
    title: str,
    headers: Sequence[str],
    rows: Sequence[Sequence[Value]] = (),
    notes: Sequence[str] = (),
    keys: int = 1,
    broken: Sequence[int] = (),
) -> Table:
    """A table with columns of texts; without headers one of facts. Columns in `broken` are broken in that order."""
    names = headers or ["" for _ in rows[0]]
    columns = (
        Column(name, kind="text", name=name or f"c{i}", broken=broken.index(i) + 1 if i in broken else 0)
        for i, name in enumerate(names)
    )
    return Table(title, tuple(columns), [list(row) for row in rows], list(notes), keys, headed=bool(headers))
