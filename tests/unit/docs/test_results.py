"""Tables of results are those of their data files, and every data file stands on a page or is linked there."""

from __future__ import annotations

import re
from pathlib import Path

from tools import result_tables


def test_tables_are_those_of_their_files() -> None:
    assert result_tables.out_of_date() == [], "python tools/result_tables.py writes docs/results"


def test_every_file_has_its_table_or_link() -> None:
    pages = "".join(page.read_text(encoding="utf-8") for page in result_tables.RESULTS.glob("*.md"))
    named = {found["file"] for found in result_tables.BLOCK.finditer(pages)}
    named |= set(re.findall(r"\]\((data/[^)]+\.csv)\)", pages))
    assert named == {f"data/{path.name}" for path in (result_tables.RESULTS / "data").iterdir()}


def test_table_of_a_file(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text('frame,"time, s"\nbare,1.5\n"with, dampers",\n', encoding="utf-8")
    assert (
        result_tables.table(tmp_path / "a.csv")
        == "| frame | time, s |\n|---|---|\n| bare | 1.5 |\n| with, dampers |  |\n"
    )
