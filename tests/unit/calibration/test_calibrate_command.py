"""`edesign calibrate`: its files, and what it says about campaigns that cannot be right."""

from __future__ import annotations

import errno
import json
import os
import signal
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml
from kelvin_voigt_campaign import campaign, lawful
from messages import says

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.results import outcome
from edesign.calibration.search.search import Search
from edesign.cli.main import main


def _rewritten(path: Path, change: Callable[[list[str]], list[str]]) -> None:
    """A CSV with its rows (text of the three columns) changed."""
    head, *rows = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([head, *(",".join(change(row.split(","))) for row in rows), ""]), encoding="utf-8")


def _run(folder: Path, *more: str) -> int:
    return main(["calibrate", str(folder / "campaign.yaml"), "--workers", "1", *more])


def _hardened(t, u, v, a, order):  # type: ignore[no-untyped-def]
    return lawful(t, u, v, a, order) + 3e10 * u**3


def _interrupt(*_: object) -> bool:
    raise KeyboardInterrupt


def test_a_search_that_is_interrupted_leaves_what_it_has_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    campaign(tmp_path / "c", _hardened, tests=5)
    monkeypatch.setattr(Search, "_challenged", _interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out"), "--no-page") == 130
    said = capsys.readouterr()
    assert (
        "interrupting again writes it as it stands" in said.err
        and "the search was interrupted; what it had found" in said.err
    )
    assert "The search was interrupted: there may be more effects" in said.out
    reported = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert reported["search"] == "interrupted" and reported["next_test"] is None and reported["models"] == []
    assert [effect["name"] for effect in reported["effects"]] == ["hardening"]
    assert reported["effects"][0]["indistinguishable_from"] == []
    assert "interrupted" in (tmp_path / "out/law.yaml").read_text(encoding="utf-8").splitlines()[1]


def test_a_second_interrupt_while_tests_are_predicted_loses_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    campaign(tmp_path / "c", _hardened, tests=5)
    monkeypatch.setattr(Search, "_challenged", _interrupt)
    before, predicted = signal.getsignal(signal.SIGINT), outcome.predicted

    def interrupted(*given):  # type: ignore[no-untyped-def]
        signal.raise_signal(signal.SIGINT)
        return predicted(*given)

    monkeypatch.setattr(outcome, "predicted", interrupted)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out"), "--no-page") == 130
    assert "interrupted: what was found is written as it stands" in capsys.readouterr().err
    reported = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert reported["search"] == "interrupted" and [effect["name"] for effect in reported["effects"]] == ["hardening"]
    assert (tmp_path / "out/law.yaml").exists() and (tmp_path / "out/calibration.h5").exists()
    assert signal.getsignal(signal.SIGINT) is before  # once it is done, Ctrl-C is Ctrl-C again


def test_a_search_that_is_interrupted_before_it_finds_anything_is_not_searched(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    campaign(tmp_path / "c", _hardened, tests=5)
    monkeypatch.setattr(Search, "_grow", _interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out")) == 130
    assert "Not searched: something is missing" in capsys.readouterr().out
    reported = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert (reported["verdict"], reported["search"], reported["effects"]) == ("not_searched", "interrupted", [])
    assert "Not searched" in (tmp_path / "out/calibration.html").read_text(encoding="utf-8")
    # before the law is fitted there is nothing to write
    monkeypatch.setattr(Search, "_roots", _interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "none")) == 130
    assert not (tmp_path / "none").exists()


def test_an_effort_that_is_spent_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path / "c", _hardened, tests=5)
    assert _run(tmp_path / "c", "--effort", "3") == 2
    assert says(capsys.readouterr().err, "--effort 3: E-CALIB-06")
    assert not (tmp_path / "c/calibration.json").exists()
    assert _run(tmp_path / "c", "--effort", "60", "--no-page") == 0
    reported = json.loads((tmp_path / "c/calibration.json").read_text(encoding="utf-8"))
    assert (reported["verdict"], reported["search"]) == ("not_searched", "effort_spent")
    assert reported["coverage"]["effort"] < 100.0 and reported["coverage"]["most_effort"] == 60.0
    said = " ".join(capsys.readouterr().out.split())  # paragraphs are broken into lines
    assert "ended with its effort of 60 (--effort)" in said and "effects may have been missed" in said


def test_the_folder_of_the_campaign_and_no_page(tmp_path: Path) -> None:
    campaign(tmp_path)
    assert _run(tmp_path, "--no-page", "--quiet") == 0
    assert (tmp_path / "calibration.json").exists() and not (tmp_path / "calibration.html").exists()


def test_what_cannot_be_written_is_reported_before_the_search(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    campaign(tmp_path)
    (tmp_path / "out" / "calibration.json").mkdir(parents=True)
    assert _run(tmp_path, "--output", str(tmp_path / "out")) == 4
    error = capsys.readouterr().err
    assert says(error, "calibration.json: folder E-FILE-06") and "fitting the law" not in error


def test_a_folder_in_which_nothing_can_be_made_is_reported_before_the_search(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """An administrator may write everywhere by his rights, and cannot in `/proc` or a file system of a device."""

    def refused(*_: object, **__: object) -> None:
        raise OSError(errno.ENOENT, "No such file or directory")

    campaign(tmp_path / "c")
    monkeypatch.setattr(os, "mkdir", refused)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out")) == 4
    error = capsys.readouterr().err
    assert f"nothing can be made in the folder {tmp_path}" in error and "reading the tests" not in error


def test_an_unknown_temperature_is_reported_by_what_can_say_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = campaign(tmp_path).path
    given = yaml.safe_load(path.read_text(encoding="utf-8"))
    for test in given["tests"]:
        del test["temperature_C"]
    path.write_text(yaml.safe_dump(given), encoding="utf-8")
    assert _run(tmp_path) == 2
    error = capsys.readouterr().err
    assert "`temperature: 20 degC`" in error and "--temperature" not in error
    assert main(["sheet", str(tmp_path / "test_01.csv")]) == 2
    assert '--temperature "20 degC"' in capsys.readouterr().err


def _pause(rest: bool) -> Callable[[list[str]], list[str]]:
    """100 s later from 4 s on; at rest: the specimen has stood still since 3 s."""

    def change(row: list[str]) -> list[str]:
        t, u, f = (float(cell) for cell in row)
        still = rest and 3.0 <= t < 5.0
        return [str(t + 100.0 * (t >= 4.0)), "1.0" if still else str(u), str(f)]

    return change


def test_a_motion_that_is_missing_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path, tests=5)
    _rewritten(tmp_path / "test_02.csv", _pause(rest=False))
    assert _run(tmp_path) == 2
    error = capsys.readouterr().err
    assert says(error, "test_02.csv: 3.996 s 104 E-CALIB-03")
    assert not (tmp_path / "calibration.json").exists()


def test_a_pause_at_rest_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path, tests=5)
    _rewritten(tmp_path / "test_02.csv", _pause(rest=True))
    assert _run(tmp_path, "--no-page", "--effort", "50") == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "test_02 lacks samples, for 100 s at most: its motion is interpolated there." in said


def _flip(row: list[str]) -> list[str]:
    return [row[0], row[1], str(-float(row[2]))]


def test_a_mass_that_turns_the_force_around_is_no_wrong_sign(tmp_path: Path) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 50e3 * a  # beyond 1.4 Hz more than the spring

    tests = damper_problem(campaign(tmp_path, hidden)).experiments
    assert min(float(np.corrcoef(test.force, test.motion.displacement)[0, 1]) for test in tests) < -0.5


def _thousand(row: list[str]) -> list[str]:
    return [row[0], row[1], str(1000.0 * float(row[2]))]


def _constant(row: list[str]) -> list[str]:
    return [row[0], row[1], "1.5"]


def _still(row: list[str]) -> list[str]:
    return [row[0], "0.5", row[2]]


def _shorter(row: list[str]) -> list[str]:
    return row if float(row[0]) < 7.0 else [row[0], row[1], ""]


@pytest.mark.parametrize(
    ("change", "which", "said"),
    [
        (_flip, "all", ("all 8 tests", "sign")),
        (_flip, "test_03.csv", ("test_03.csv", "sign")),
        (_thousand, "all", ("all 8 tests", "1000", "N", "kN")),
        (_thousand, "test_05.csv", ("test_05.csv", "1000", "kN")),
        (_constant, "test_02.csv", ("test_02.csv", "1500 N", "E-TEST-06")),
        (_still, "test_04.csv", ("test_04.csv", "displacement", "E-TEST-06")),
        (_shorter, "test_06.csv", ("test_06.csv:1752", "force")),
    ],
)
def test_what_is_wrong_with_tests_is_reported(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    change: Callable[[list[str]], list[str]],
    which: str,
    said: tuple,
) -> None:
    campaign(tmp_path)
    for path in tmp_path.glob("*.csv" if which == "all" else which):
        _rewritten(path, change)
    assert _run(tmp_path) == 2
    error = capsys.readouterr().err
    for text in said:
        assert text in error, error
    assert "Traceback" not in error
    assert not (tmp_path / "calibration.json").exists()


def test_a_temperature_that_the_law_does_not_know(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path)
    path = tmp_path / "campaign.yaml"
    given = yaml.safe_load(path.read_text(encoding="utf-8"))
    given["law"] = {"type": "mgmm", "parameters": "thesis_table_4_2"}
    given["tests"][2]["temperature_C"] = 293  # kelvin, as often
    path.write_text(yaml.safe_dump(given), encoding="utf-8")
    assert _run(tmp_path) == 2
    error = capsys.readouterr().err
    assert "test_03" in error and "293 degC" in error and "edesign itself" not in error


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("use: validate", "use: fit", ("tests: ", "`use: validate`", "E-CALIB-02")),
        ("use: fit", "use: validate", ("tests: 0 ", "E-CALIB-02")),
        ("type: kelvin_voigt", "type: kelvin_voight", ("campaign.yaml:", "did you mean `kelvin_voigt`")),
    ],
)
def test_what_is_wrong_with_the_campaign_is_reported(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], old: str, new: str, said: tuple[str, ...]
) -> None:
    campaign(tmp_path)
    path = tmp_path / "campaign.yaml"
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(old, new), encoding="utf-8")
    assert _run(tmp_path) == 2
    error = capsys.readouterr().err
    for part in said:
        assert part in error, error
    assert "Traceback" not in error


def test_one_test_alone_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path, tests=3)  # one to fit, two to validate
    assert _run(tmp_path) == 2
    assert says(capsys.readouterr().err, "tests: E-CALIB-02")


def test_a_campaign_without_law_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    campaign(tmp_path)
    path = tmp_path / "campaign.yaml"
    lines = [
        line
        for line in path.read_text(encoding="utf-8").splitlines()
        if not line.startswith(("law:", "  type:", "  parameters:"))
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    assert _run(tmp_path) == 2
    assert "law" in capsys.readouterr().err
