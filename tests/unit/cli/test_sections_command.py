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
    assert main(["sections", "M100x10"]) == 2
    assert says(capsys.readouterr().err, "`M100x10`; no M sections other families L, IPN, SHS, CHS E-NAME-01")
    assert main(["sections", "RHS"]) == 2
    assert says(capsys.readouterr().err, "no list of sizes; one by one E-SECT-03")


@pytest.mark.parametrize(
    ("what", "row"),
    [
        ("SHS160x10", "SHS160x10 160 160 10 58.93 2186 2186 6.09 6.09 329 46.3"),  # EN 10210-2: 58.9 2186 6.09 329 46.3
        ("CHS219.1x10", "CHS219.1x10 219.1 219.1 10 65.69 3598 3598 7.401 7.401 437.6 51.6"),  # Celsius: 65.7 3598 438
        ("L 100x10", "L100x100x10 100 100 10 12 19.15 280.3 73.01 3.826 1.952 15"),  # EN 10056-1: 19.2 280 73 3.83 1.95
    ],
)
def test_hollow_sections_and_angles_have_tables_of_their_own(
    what: str, row: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["sections", what]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[-1].split() == row.split() and max(map(len, lines)) <= 80


def test_patterns_of_hollow_sections(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sections", "SHS160*"]) == 0
    names = [line.split()[0] for line in capsys.readouterr().out.splitlines()[3:]]
    assert names[0] == "SHS160x5" and names[-1] == "SHS160x16" and len(names) == 8
    assert main(["sections", "L100*", "--json", "--csv", str(tmp_path / "l.csv")]) == 0
    assert json.loads(capsys.readouterr().out)[0]["W_pl_y_m3"] is None
    with (tmp_path / "l.csv").open(encoding="utf-8") as file:
        assert next(csv.DictReader(file))["W_pl [cm3]"] == ""
