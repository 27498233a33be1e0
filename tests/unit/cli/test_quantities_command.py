"""`edesign quantities`, and the same table in docs/reference/assessment.md."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from edesign.cli.main import main
from edesign.project.criteria.criterion_quantities import QUANTITIES, keys_of
from edesign.project.criteria.measures import SHORT_NAMES

PAGE = Path(__file__).parents[3] / "docs" / "reference" / "assessment.md"


def test_what_is_printed_and_written_is_what_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["quantities"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert {*QUANTITIES, *SHORT_NAMES} <= {line.split(" ")[0] for line in lines}
    lines = re.findall(r"^\| `(\w+)` \| (.+) \|$", PAGE.read_text(encoding="utf-8"), re.M)
    rows = {name: cells.split(" | ") for name, cells in lines if name in QUANTITIES}
    assert sorted(rows) == sorted(QUANTITIES)
    for name, item in QUANTITIES.items():
        unit = "-" if item.kind.unit in ("", "1") else item.kind.unit.replace("*", " ")
        keys = ", ".join(f"`{key}`" for key in keys_of(name)) or "-"
        of_building = len(rows[name]) == 5  # where in a building, beside the keys
        assert [*rows[name][:2], *rows[name][2 + of_building :]] == [
            unit,
            keys,
            f"`{item.kept}`" if item.kept else "-",
            item.meaning,
        ]
