"""The page of all tables is that of their declarations, and has what the exports of an archive have."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import edesign
from edesign.report.export.catalogue import archive_tables
from tools.tables_page import PAGE, text


def test_page_is_up_to_date() -> None:
    """`python -m tools.tables_page` writes it."""
    assert PAGE.read_text(encoding="utf-8") == text()


def test_tables_of_an_export_are_on_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    words = PAGE.read_text(encoding="utf-8").replace("\\", "")
    items = [" ".join(item.split()) for item in re.findall(r"^- .*?(?=^- |\Z)", words, re.MULTILINE | re.DOTALL)]
    names = [item.partition("`")[2].partition("`")[0] for item in items]
    found = {name: item for name, item in zip(names, items, strict=True) if names.count(name) == 1}
    done = edesign.run_project(edesign.load_project(edesign.new_project("frame")))
    with edesign.open_archive(done.archive) as archive:
        tables = [table for table in archive_tables(archive) if table.name in found and table.name != "warnings"]
    known = further = 0
    for table in tables:
        columns = found[table.name].partition(": ")[2]
        for column in table.columns:
            places = re.findall(rf"(?:^|; |: ){re.escape(column.name)}(?: \[([^]]*)\])?(?=; |$)", columns)
            if places:
                assert places[0] in ("", "-", "n", column.unit), (table.name, column.name)
            known, further = known + bool(places), further + (not places)
    assert len(tables) > 8 and known > 50 and further < 0.25 * known  # columns that come of the content
