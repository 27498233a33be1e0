"""The models of docs/reference/python.md run as they stand there, one after the other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import edesign

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "python.md"


def test_models_of_the_page_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    section = PAGE.read_text(encoding="utf-8").partition("## A model in Python")[2].partition("\n## ")[0]
    blocks = re.findall(r"(?:^    .*\n|^\n(?=    ))+", section, re.MULTILINE)
    code = "\n".join(re.sub("^    ", "", block, flags=re.MULTILINE) for block in blocks)
    names: dict[str, object] = {}
    exec(compile(code, PAGE.name, "exec"), names)
    assert len(code[: code.index("summary")].strip().splitlines()) <= 13  # a frame in ten lines, after its import
    with edesign.open_archive("stiffer.h5") as archive:
        assert len([name for name in archive.names("analyses") if name.endswith(".modes")]) == 5
    periods = []
    for archive_name in ("project.h5", "HEB260.h5", "HEB280.h5"):
        with edesign.open_archive(archive_name) as archive:
            periods.append(archive.table("periods")["T"][0])
    assert periods == sorted(periods, reverse=True)  # stiffer columns, shorter periods
