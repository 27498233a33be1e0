"""The tool that writes the tables of docs/results/thesis_study.md: blocks are replaced, text stays."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.errors import InputError
from edesign.project.study.reference_loader import load_reference
from edesign.report.tables.column import count, text
from edesign.report.tables.table import Table
from tools.thesis_study_page import BLOCK, markdown, replaced

ROOT = Path(__file__).parents[3]


def test_blocks_are_replaced_again_and_again() -> None:
    page = "# Page\n\n<!-- begin Table 1 -->\nold\n<!-- end -->\n\ntext\n<!-- begin Table 2 -->\n<!-- end -->\n"
    blocks = {"Table 1 - DBE": "a", "Table 1 - MCE": "b", "Table 2": "c"}
    once = replaced(page, blocks)
    first = "<!-- begin Table 1 -->\n\na\n\nb\n\n<!-- end -->"
    assert once == f"# Page\n\n{first}\n\ntext\n<!-- begin Table 2 -->\n\nc\n\n<!-- end -->\n"
    assert replaced(once, blocks) == once
    with pytest.raises(InputError, match="Table 3.*E-NAME-01"):
        replaced(page.replace("Table 2", "Table 3"), blocks)


def test_a_table_in_markdown() -> None:
    table = Table("T", (text("quantity"), count("reference")), [["k (1)", 3]], ["(1) seen"])
    assert markdown(table) == "**T**\n\n| quantity | reference |\n| --- | --: |\n| k (1) | 3 |\n\n(1) seen"


def test_the_page_has_a_place_for_every_table_of_the_reference() -> None:
    page = (ROOT / "docs" / "results" / "thesis_study.md").read_text(encoding="utf-8")
    names = [match["name"] for match in BLOCK.finditer(page)]
    titles = [table.title for table in load_reference(ROOT / "projects/thesis_10_storey/reference.yaml").tables]
    assert [sum(title.startswith(name) for name in names) for title in titles] == [1] * len(titles)
    others = [name for name in names if not any(title.startswith(name) for title in titles)]
    causes = [f"causes, {title}" for title in titles if title.startswith("Table 5.8")]
    assert others == ["archive", "temperature", *causes, "redesign"]
