"""`edesign calibrate`: its files, and what it says about campaigns that cannot be right."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml
from kelvin_voigt_campaign import campaign, lawful

from edesign.archive.reader import open_archive
from edesign.calibrate.dampers.prepare import damper_problem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.search.alternatives import Alternatives
from edesign.calibrate.search.beside_declared import BesideDeclared
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.rounds import Rounds
from edesign.cli.main import main
from edesign.damper.damper import Damper
from edesign.damper.law_file import read_law_file, resolve


def _rewritten(path: Path, change: Callable[[list[str]], list[str]]) -> None:
    """A CSV with its rows (text of the three columns) changed."""
    head, *rows = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join([head, *(",".join(change(row.split(","))) for row in rows), ""]), encoding="utf-8")


def _run(folder: Path, *more: str) -> int:
    return main(["calibrate", str(folder / "campaign.yaml"), "--workers", "1", *more])


@pytest.mark.slow
def test_a_search_that_is_interrupted_leaves_what_it_has_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 3e10 * u**3

    def interrupt(*_: object) -> Judged:
        raise KeyboardInterrupt

    campaign(tmp_path / "c", hidden)
    monkeypatch.setattr(Loop, "_prune", interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out")) == 130
    said = capsys.readouterr()
    assert "interrupt again to leave them" in said.err and "the search was interrupted; what it had found" in said.err
    assert "The search was interrupted: there may be more effects" in said.out
    told = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert told["search"] == "interrupted"
    assert [effect["name"] for effect in told["effects"]] == ["hardening"]
    assert "the search interrupted" in (tmp_path / "out/law.yaml").read_text(encoding="utf-8").splitlines()[1]
    # before there is an effect nothing is written
    monkeypatch.setattr(Rounds, "one_more", interrupt)
    monkeypatch.setattr(BesideDeclared, "one", interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "none")) == 130
    assert not (tmp_path / "none").exists()


@pytest.mark.slow
def test_look_alikes_that_were_not_asked_for_are_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 3e10 * u**3

    def interrupt(*_: object) -> list[Judged]:
        raise KeyboardInterrupt

    campaign(tmp_path / "c", hidden)
    monkeypatch.setattr(Alternatives, "others", interrupt)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out")) == 130
    told = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert told["search"] == "interrupted" and told["effects"][0]["name"] == "hardening"
    assert told["effects"][0]["indistinguishable_from"] == []
    assert "explained" in capsys.readouterr().out.lower()


@pytest.mark.slow
def test_files_and_their_contents(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 3e10 * u**3

    campaign(tmp_path / "c", hidden)
    assert _run(tmp_path / "c", "--output", str(tmp_path / "out")) == 0
    said = capsys.readouterr()
    assert "screening effects beside the law as declared" in said.err
    assert "hardening" in said.out and "Explained" in said.out
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"calibration.json", "calibration.h5", "calibration.html", "law.yaml"}
    told = json.loads((tmp_path / "out/calibration.json").read_text(encoding="utf-8"))
    assert set(told["error"]) == {"declared", "refit", "corrected"}
    for stage in told["error"].values():
        assert set(stage) == {"fit", "validate", "tests"} and len(stage["tests"]) == 8
    assert told["verdict"] == "explained"
    (effect,) = told["effects"]
    assert (effect["name"], effect["kind"]) == ("hardening", "damper")
    assert set(effect["parameters"]["k"]) == {"value", "standard_error", "interval", "unit"}
    assert told["law_held"]  # so that without the effect it is the declared law
    assert effect["delta_validate"] == pytest.approx(
        told["error"]["declared"]["validate"] - told["error"]["corrected"]["validate"], rel=1e-6
    )
    assert effect["evidence"] and effect["indistinguishable_from"] == []
    assert told["unexplained"] == {"share": 0.0, "shape": ""}
    # the corrected law alone makes the force that the archive has
    found = resolve(*read_law_file(tmp_path / "out/law.yaml"), None)
    damper = Damper(found.law, found.values, amendments=found.amendments)
    with open_archive(tmp_path / "out/calibration.h5") as archive:
        test = archive.group("tests/test_02").variables
        time, u = test["time"].values, test["displacement"].values
        force = damper.force(time, u)
        # parameters stand in the file with twelve digits; the hardening is a force on the samples
        assert force == pytest.approx(test["corrected_force"].values, abs=1e-6 * abs(force).max())


def test_the_folder_of_the_campaign_and_no_page(tmp_path: Path) -> None:
    campaign(tmp_path)
    assert _run(tmp_path, "--no-page", "--quiet") == 0
    assert (tmp_path / "calibration.json").exists() and not (tmp_path / "calibration.html").exists()


def _flip(row: list[str]) -> list[str]:
    return [row[0], row[1], str(-float(row[2]))]


def test_a_mass_that_turns_the_force_around_is_no_wrong_sign(tmp_path: Path) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 50e3 * a  # beyond 1.4 Hz more than the spring

    tests = damper_problem(campaign(tmp_path, hidden)).trials
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
        (_constant, "test_02.csv", ("test_02.csv", "1500 N throughout")),
        (_still, "test_04.csv", ("test_04.csv", "displacement", "nothing moved")),
        (_shorter, "test_06.csv", ("test_06.csv:1752", "force")),
    ],
)
def test_what_is_wrong_with_tests_is_told(
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
        ("use: validate", "use: fit", ("tests", "none has `use: validate`")),
        ("use: fit", "use: validate", ("tests", "0 with `use: fit`")),
        ("type: kelvin_voigt", "type: kelvin_voight", ("campaign.yaml:", "did you mean `kelvin_voigt`")),
    ],
)
def test_what_is_wrong_with_the_campaign_is_told(
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
    assert "two are the least" in capsys.readouterr().err


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
