"""Write docs/reference/tables.md: all tables of reports, of `edesign show` and of exports, with their columns."""

from __future__ import annotations

import re
import textwrap
from pathlib import Path
from typing import Any

from edesign.report.export.tables_by_name import tables_by_name
from edesign.report.tables.column import Column
from edesign.report.tables.table import MORE, TableSpec

PAGE = Path(__file__).resolve().parents[1] / "docs" / "reference" / "tables.md"
HEAD = """\
# Tables and their columns

<!-- written by tools/tables_page.py from the declarations of the tables: change these -->

These are all tables of reports, of `edesign show` and of `edesign export`, in the order of their
names. Each has its title, and its columns as files name them. Numbers have their unit in brackets,
`[-]` where they have none, and `[n]` where they count. Columns without brackets are texts, or numbers
whose units differ. Three points stand for words or columns that come of the content; some tables
have such columns at their end. A column that no row has a value for may be left out. A table marked
*titled* has in exports a name that is made of its title. Exports also hold
[the variables of the archive](archive.md) in SI.

"""


def text() -> str:
    """Return the page."""
    return HEAD + "\n".join(map(_item, tables_by_name().values())) + "\n"


def _item(spec: TableSpec[Any]) -> str:
    title = re.sub(r"\{[^}]*\}", "...", spec.title) or spec.name
    columns = "; ".join("..." if column is MORE else _column(column) for column in spec.columns)
    names = f"`{spec.named_as or spec.name}`{', *titled*' if spec.named_by_title else ''}"
    words = f"- {names}, {_plain(title)}: {columns}"
    return "\n".join(textwrap.wrap(words, 100, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False))


def _column(column: Column[Any]) -> str:
    name = _plain(re.sub(r"\{[^}]*\}", "...", column.in_files)) or "what"
    unit = f"unit by {column.unit}" if isinstance(column.unit, str) else column.unit.in_files
    sign = unit or ("n" if column.kind == "count" else "-" if column.numeric else "")
    return f"{name} [{sign}]" if sign else name


def _plain(words: str) -> str:
    """Words without what Markdown would read."""
    return "".join(f"\\{sign}" if sign in "*_|<>`" else sign for sign in words)


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
