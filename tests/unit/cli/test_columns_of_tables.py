"""`edesign spectrum` and `match` of tables with several columns: the message lists them, `--column` chooses."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.messages import says

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
        ([], "(1 `time_s`, 2 `ax`, 3 `ay`) --column E-REC-13"),
        (["--column", "az"], "`az` time_s, ax, ay) E-REC-14"),
        (["--column", "4"], "4; 3 E-REC-14"),
        (["--column", "ay"], "--time-column E-REC-17"),
        (["--column", "ay", "--time-column", "ay"], "E-VALUE-04"),
        (["--time-column", "1"], "--time-column: --column E-CLI-01"),
    ],
)
def test_a_column_is_asked_for(table: str, options: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["spectrum", table, *ACTION, "--unit", "g", *options]) == 2
    assert says(capsys.readouterr().err, said)


def test_a_column_is_read(table: str, capsys: pytest.CaptureFixture[str]) -> None:
    reported = []
    for column, times in (("ay", "time_s"), ("3", "1"), ("ax", "1")):
        assert main(["spectrum", table, *ACTION, "--unit", "g", "--column", column, "--time-column", times]) == 0
        reported.append(capsys.readouterr().out)
    assert reported[0] == reported[1] != reported[2]
