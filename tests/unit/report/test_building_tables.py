"""Tables of a building: their width, what stands in one row, and what they say of an archive that is not whole."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import h5py
import pytest
from building_examples import SMALL
from plain_tables import plain_table

from edesign.archive.reader import Archive, open_archive
from edesign.cli.main import main
from edesign.errors import ArchiveError, InputError
from edesign.frame.building_file import load_building
from edesign.report.building.checks import CHECKS
from edesign.report.building.results import BuildingResults
from edesign.report.building.tables.all import building_tables
from edesign.report.building.tables.combinations import combinations_table, sway_table
from edesign.report.tables.text import broken, plain, print_tables, printed
from edesign.study.run.building import run_building


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("building")
    (folder / "small.yaml").write_text(SMALL, encoding="utf-8")
    return run_building(load_building(folder / "small.yaml"))[0]


RULES = "Rules for the building, clauses of EN 1998-1 where no other code is named"


@pytest.fixture
def archive(path: Path) -> Iterator[Archive]:
    with open_archive(path) as opened:
        yield opened


def test_combinations_that_differ_in_signs_stand_in_one_row(archive: Archive) -> None:
    rows = combinations_table(BuildingResults(archive)).rows
    names = [row[1] for row in rows]
    assert names[:2] == ["1.35 G + 1.5 Q", "1.35 G + 1.5 Q +- S"]
    assert names[2:4] == ["G + 0.3 Q +- E_x +- 0.3 E_y", "G + 0.3 Q +- E_y +- 0.3 E_x"]
    assert [row[0] for row in rows] == ["1", "2-5", "6-9", "10-13", "14-17", "18-21", "22"]
    assert [row[2] for row in rows[4:6]] == ["seismic, 1.1 gamma_ov Omega"] * 2


def test_patterns_directions_and_signs_of_own_cases_stand_in_one_row(tmp_path: Path) -> None:
    """Three arrangements of Q and three winds that exclude each other: 3 + 3 x 3 + 3 + 3 combinations by 6.10.

    Each of the 18 has four more with a sway imperfection, which stand behind them.
    """
    cases = "  pattern: chessboard\n  cases:\n"
    cases += "    wind_x: {category: wind, reversed: true, floors: [{floors: all, x: 9 kN}]}\n"
    cases += "    wind_y: {category: wind, floors: [{floors: all, y: 9 kN}]}\nmasses:"
    (tmp_path / "own.yaml").write_text(SMALL.replace("masses:", cases), encoding="utf-8")
    with open_archive(run_building(load_building(tmp_path / "own.yaml"))[0]) as archive:
        table = combinations_table(BuildingResults(archive))
    rows = {str(row[1]): str(row[0]) for row in table.rows if row[2] == "fundamental"}
    bare = ["1.35 G + 1.5 [Q]", "1.35 G + 1.5 [Q] + 0.9 [wind]", "1.35 G + 1.05 Q + 1.5 [wind]", "G + 1.5 [wind]"]
    assert sorted(rows) == sorted([*bare, *(f"{name} +- S" for name in bare)])
    assert [len(numbers_in(rows[name])) for name in bare] == [3, 9, 3, 3]
    assert [len(numbers_in(rows[f"{name} +- S"])) for name in bare] == [12, 36, 12, 12]
    assert sorted(sum(map(numbers_in, rows.values()), [])) == [*range(1, 18 * 5 + 1)]
    assert {"Q: Q1 + Q2", "[Q]: one of Q1 + Q2, Q1, Q2", "[wind]: one of wind_x, -wind_x, wind_y"} <= set(table.notes)
    assert table.rows[-1][1] == "G + [wind]" and table.rows[-1][2] == "characteristic"


def numbers_in(text: str) -> list[int]:
    """All numbers of ranges such as `2-5, 9`."""
    ends = [[int(end) for end in part.split("-")] for part in text.split(", ")]
    return [number for end in ends for number in range(end[0], end[-1] + 1)]


def test_tables_fit_on_80_columns(archive: Archive) -> None:
    stream = io.StringIO()
    print_tables([replace(table, notes=[]) for table in building_tables(archive)], stream, widest=80)
    assert max(map(len, stream.getvalue().splitlines())) <= 80


def test_sentences_are_broken_where_the_table_is_too_wide() -> None:
    table = plain_table("T", ("a", "rule", "b"), [["1", "one two three four five six", "x"]], keys=2, broken=(1,))
    assert broken(shown := printed(table), 40) is shown
    found = broken(printed(table), 26)
    assert found.rows == [["1", "one two three four", "x"], ["", "five six", ""]]
    assert max(map(len, plain(found).splitlines())) <= 26


def test_a_second_column_is_broken_where_the_first_is_not_enough() -> None:
    rows = [["a criterion with a long name", "DBE", "ImperialValley1979_H-EMO000"]]
    table = plain_table("T", ("criterion", "level", "motion"), rows, keys=3, broken=(0, 2))
    found = broken(printed(table), 50)
    assert max(map(len, plain(found).splitlines())) <= 50
    assert " ".join(row[0] for row in found.rows if row[0]) == rows[0][0] and len(found.rows) > 1
    assert found.rows[0][2] == rows[0][2] and found.rows[0][1] == "DBE"


def test_missing_groups_are_named_and_the_others_are_shown(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    damaged = tmp_path / "damaged.h5"
    damaged.write_bytes(path.read_bytes())
    missing = [f"there is no building/{name}" for name in ("modes", "criteria", "storeys_x", "members")]
    with h5py.File(damaged, "a") as file:
        for text in missing:
            del file[text.removeprefix("there is no ")]
    assert main(["show", str(damaged), "--all"]) == 4  # the file is not as it was written
    said = " ".join(capsys.readouterr().out.split())
    assert all(f"{damaged}: {text}" in said for text in missing) and "Seismic action" in said
    assert main(["show", "--json", str(damaged)]) == 4
    assert f"{damaged}: {missing[0]}" in capsys.readouterr().err
    assert main(["report", str(damaged)]) == 4
    page = damaged.with_suffix(".html").read_text(encoding="utf-8")
    assert all(text in page for text in missing) and "Traceback" not in capsys.readouterr().err


def test_a_missing_variable_is_named(archive: Archive) -> None:
    with pytest.raises(ArchiveError, match="building/modes .*`velocity`.*E-ARCH-03"):
        BuildingResults(archive).values("modes", "velocity")


def test_limit_and_value_of_the_drift_have_one_unit(archive: Archive) -> None:
    tables = {table.title: table for table in building_tables(archive)}
    storeys = tables["Storeys, direction x"]
    largest = max(row[-1] for row in storeys.rows)
    number = tables[RULES].column("clause").index("4.4.3.2(1)")
    assert tables[RULES].rows[number][2] == pytest.approx(largest, rel=1e-12)
    assert f"Limit of nu d_r/h: {tables[RULES].texts[number][3]} " in storeys.notes[-1]


def test_json_is_valid(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", "--json", str(path)]) == 0
    assert json.loads(capsys.readouterr().out)["building"]["groups"]


@pytest.mark.parametrize("version", ["true", "2", "1.5"])
def test_the_version_of_the_format_is_a_number(tmp_path: Path, version: str) -> None:
    file = tmp_path / "building.yaml"
    file.write_text(SMALL.replace("edesign_building: 1", f"edesign_building: {version}"), encoding="utf-8")
    with pytest.raises(InputError, match=f"1:19: edesign_building: .*`{version}`.*E-FILE-05"):
        load_building(file)


def test_sway_of_combinations_that_are_alike_stands_in_one_row(tmp_path: Path) -> None:
    """Patterns of Q and directions of wind: 18 persistent combinations in four rows, each with its least alpha_cr."""
    cases = "  pattern: chessboard\n  cases:\n"
    cases += "    wind_x: {category: wind, reversed: true, floors: [{floors: all, x: 9 kN}]}\n"
    cases += "    wind_y: {category: wind, floors: [{floors: all, y: 9 kN}]}\nmasses:"
    (tmp_path / "own.yaml").write_text(SMALL.replace("masses:", cases), encoding="utf-8")
    with open_archive(run_building(load_building(tmp_path / "own.yaml"))[0]) as archive:
        results = BuildingResults(archive)
        table = sway_table(results)
        names = [str(name) for name in results.values("sway", "persistent")]
        alpha, phi = results.values("sway", "alpha_cr_x"), results.values("sway", "initial_sway_x")
    rows = {str(row[0]): row for row in table.rows}
    of = {
        "1.35 G + 1.5 [Q]": [name for name in names if "wind" not in name],
        "1.35 G + 1.5 [Q] + 0.9 [wind]": [name for name in names if "0.9 wind" in name],
        "1.35 G + 1.05 Q + 1.5 [wind]": [name for name in names if "1.05" in name],
        "G + 1.5 [wind]": [name for name in names if name.startswith("G ")],
    }
    assert sorted(rows) == sorted(of) and sum(map(len, of.values())) == len(names) == 18
    at = table.headers.index("alpha_cr,x")
    for name, several in of.items():
        numbers = [names.index(one) for one in several]
        assert int(str(rows[name][1])) == len(several)
        assert float(str(rows[name][at])) == pytest.approx(float(alpha[numbers].min()), rel=5e-3)  # three digits
        assert float(str(rows[name][at + 4])) == pytest.approx(1.0 / float(phi[numbers].max()), rel=5e-3)


def test_noise_of_doubles_is_0_in_checks() -> None:
    row = {"check": "V_Y", "use": 6.78e-18, "combination": 71, "x / L": 0.0, "clause": "EN 1993-1-1, 6.2.6"}
    assert CHECKS.of([row], whose="BY_A_2_1_2").texts[0][1] == "0"
