"""`edesign spectrum` and `match` of tables with several columns: the message lists them, `--column` chooses."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.cli.main import main

ACTION = ["--country", "greece", "--zone", "3", "--ground", "C", "--points", "2"]


@pytest.fixture
def table(tmp_path: Path) -> str:
    path = tmp_path / "two.csv"
    rows = "".join(f"{0.01 * i:.2f},{i % 3},{i % 2}\n" for i in range(8))
    path.write_text("time_s,ax,ay\n" + rows, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ([], "3 columns (1 `time_s`, 2 `ax`, 3 `ay`); name the one that is the acceleration: by --column"),
        (["--column", "az"], "there is no column `az` (the columns are: time_s, ax, ay)"),
        (["--column", "4"], "there is no column 4; the columns are numbered 1 to 3"),
        (["--column", "ay"], "no column of times is named, by --time-column"),
        (["--column", "ay", "--time-column", "ay"], "cannot be both time and acceleration"),
        (["--time-column", "1"], "--time-column: only with --column"),
    ],
)
def test_a_column_is_asked_for(table: str, options: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["spectrum", table, *ACTION, "--unit", "g", *options]) == 2
    assert said in capsys.readouterr().err


def test_a_column_is_read(table: str, capsys: pytest.CaptureFixture[str]) -> None:
    reported = []
    for column, times in (("ay", "time_s"), ("3", "1"), ("ax", "1")):
        assert main(["spectrum", table, *ACTION, "--unit", "g", "--column", column, "--time-column", times]) == 0
        reported.append(capsys.readouterr().out)
    assert reported[0] == reported[1] != reported[2]
