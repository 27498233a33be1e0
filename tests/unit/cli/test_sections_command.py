"""`edesign sections`: the catalogue as a table, JSON and CSV."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest
from support.messages import says

from edesign.cli.main import main
from edesign.frame.sections.profiles import profile_names


def test_the_table_fits_a_terminal_of_80_columns(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sections"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == 3 + len(profile_names()) and max(map(len, lines)) <= 80
    assert main(["sections", "HE 300 B"]) == 0
    row = capsys.readouterr().out.splitlines()[-1].split()
    assert row == ["HEB300", "300", "300", "11", "19", "27", "149.1", "25166", "8563", "1869", "117"]  # EN 10365


@pytest.mark.parametrize(
    ("what", "count", "first"),
    [("heb", 24, "HEB100"), ("HE", 72, "HEA100"), ("UB457*", 11, "UB457x191x106"), ("W14x9?", 2, "W360x370x147")],
)
def test_families_and_patterns(what: str, count: int, first: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sections", what, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert len(found) == count and found[0]["name"] == first


def test_json_and_csv_hold_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sections", "W14x90", "--json", "--csv", str(tmp_path / "s.csv")]) == 0
    (found,) = json.loads(capsys.readouterr().out)
    assert (found["name"], found["inch_pound_name"], found["h_m"]) == ("W360x370x134", "W14x90", 0.356)
    with (tmp_path / "s.csv").open(encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert row["section"] == "W360x370x134"
    assert float(row["I_y [cm4]"]) == pytest.approx(1e8 * found["I_y_m4"], rel=1e-6)  # seven digits


def test_nothing_of_that_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sections", "L100x10"]) == 2
    assert says(capsys.readouterr().err, "`L100x10`; no L sections E-NAME-01")
