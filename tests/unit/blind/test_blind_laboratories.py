"""Laboratories of others: their files are read, their campaigns stay, and the judge counts as the page says."""

from __future__ import annotations

import json
import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from blind import run
from blind.laboratories import CATEGORIES, LABORATORIES
from blind.laboratories.__main__ import campaigns, main, score
from blind.laboratories.judge import at_floor, judge, matched
from blind.laboratories.table import line, summary
from edesign.damper.testing.campaign import load_campaign

OUTCOME = {"seconds": 3.0, "failure": None}
VALIDATE = ("test_03", "test_04")
FIRST_CLEAN = {
    "foundry": (4, "clean_H", 19.78812, 13.629673),
    "harbour": (3, "clean_H", 186.82, 104.951441),
    "polytechnic": (3, "clean_H", 873.433279, 496.366499),
    "proving": (5, "clean_H", 324.4074, 251.445747),
    "wharf": (1, "clean_F", 39.795045, 13.5172222),
}
"""Number, category, and peak and root mean square of the force of the first test in kN, as each program of the others
wrote it before it came here."""


def truth(category: str, *effects: str, accept: tuple[str, ...] = (), **changed: Any) -> dict[str, Any]:
    """A floor of 1 % of the rms force is 1e-4 of its power."""
    return {
        "category": category,
        "group": category[-1] if category[-1] in "FH" else "H",
        "law": "zener",
        "effects": [{"name": name, "accept": list(accept)} for name in effects],
        "noise_floor_validate": 0.01,
        "tests_in_motion": [],
        "nrms_is": "root: rms error over rms force",
        "law_true": {"type": "zener", "parameters": {"k0": 2.0}},
        "law_declared": {"k0": 2.1},
        **changed,
    }


def result(*names: str, validate: float = 1e-4, verdict: str = "explained", **tests: float) -> dict[str, Any]:
    corrected = {"validate": validate, "tests": tests}
    return {
        "error": {"declared": {"validate": 1.0}, "refit": {"validate": 0.5}, "corrected": corrected},
        "effects": [{"name": name, "form": "form"} for name in names],
        "verdict": verdict,
        "parameters": {"refit": {"k0": {"interval": [1.0, 1.9], "standard_error": 0.2}}},
    }


def judged(said: dict[str, Any], found: dict[str, Any] | None, name: str = "001_x", **outcome: Any) -> dict[str, Any]:
    return judge(name, said, found, {**OUTCOME, **outcome}, VALIDATE)


@pytest.mark.parametrize(
    ("found", "first", "all_named"),
    [
        (("lag",), True, True),
        (("inertia",), True, True),  # accepted
        (("extremes", "lag"), True, True),  # a reading of the law, which nobody hid
        (("lag", "hum"), True, False),
        (("hum", "lag"), False, False),
        (("hum",), False, False),
        ((), False, False),
    ],
)
def test_naming_of_one(found: tuple[str, ...], first: bool, all_named: bool) -> None:
    reported = judged(truth("one_F", "lag", accept=("inertia",)), result(*found))
    assert (reported["first"], reported["all"]) == (first, all_named)


def test_a_hidden_reading_counts() -> None:
    """Extremes count where the truth hides or accepts them."""
    hides = truth("one_F", "extremes", accept=("mullins",))
    assert judged(hides, result("extremes"))["all"]
    assert judged(hides, result("mullins"))["all"]
    assert not judged(hides, result("extremes", "mullins"))["all"]  # one effect under two names
    assert judged(truth("clean_F"), result("extremes"))["found"] == []


def test_a_part_of_a_hidden_effect_may_be_named_beside_it() -> None:
    wanders = truth("one_F", "drift")
    wanders["effects"][0]["parts"] = ["offset"]
    assert judged(wanders, result("drift", "offset"))["all"]
    assert not judged(wanders, result("offset"))["all"]
    assert not judged(truth("one_F", "drift"), result("drift", "offset"))["all"]


def test_faults_of_tests_and_spikes_are_named_too() -> None:
    """What a report says of one test, or leaves out of the fit, is named as an effect is, and counts against it too."""
    lag = {"name": "lag", "form": "delay_of_test_2"}
    reported = result("payne")
    reported["outlying_tests"] = [{"test": "test_02", "faults": [lag]}]
    assert judged(truth("two_F", "lag", "payne"), reported)["all"]
    reported["effects"].append(lag)  # told in both places, once
    assert judged(truth("two_F", "lag", "payne"), reported)["found"] == ["payne", "lag"]
    assert not judged(truth("one_F", "payne"), reported)["all"]
    several = result("payne")
    several["outlying_tests"] = [{"test": "test_02", "faults": [lag, {"name": "clock", "form": "of_test_2"}]}]
    assert judged(truth("two_F", "lag", "payne"), several)["found"] == ["payne"]
    spiky = result("lag")
    spiky["spikes"] = {"force": {"test_01": [0.5]}, "displacement": {}}
    assert judged(truth("two_F", "spikes", "lag"), spiky)["all"]
    assert not judged(truth("one_F", "lag"), spiky)["all"]


def test_intervals_count_where_the_effects_are_right() -> None:
    assert judged(truth("one_F", "lag"), result("lag"))["inside"] == [0, 1]
    assert judged(truth("one_F", "lag"), result("hum"))["inside"] is None
    # z of Bouc-Wen comes to 1 as the fit holds it: with half of the true beta + gamma Fy is sqrt(1/2) times as large
    true = {"Fy": 10.0, "Y": 2.0, "beta": 0.4, "gamma": 1.6, "n": 2.0}
    said = truth("clean_H", law="bouc_wen", law_true=true, law_declared={"gamma": 0.3})
    reported = result()
    reported["parameters"]["refit"] = {
        "Fy": {"interval": [7.0, 7.1], "standard_error": 0.03},
        "Y": {"interval": [1.40, 1.42], "standard_error": 0.01},
        "beta": {"interval": [0.3, 0.5], "standard_error": 0.1},
        "n": {"interval": [2.0, 2.0], "standard_error": 0.0},
    }
    assert judged(said, reported)["inside"] == [2, 3]
    assert judged(truth("one_F", "lag", law="mgmm"), result("lag"))["inside"] is None
    for name in ("temperature_law", "one_sided", "velocity_exponent"):
        assert judged(truth("one_F", name), result(name))["inside"] is None


def test_two_effects_are_a_set() -> None:
    assert matched([{"lag", "hum"}, {"lag"}], ["lag", "hum"])  # lag is needed for the second
    assert not matched([{"lag", "hum"}, {"lag"}], ["hum", "hum"])
    assert not matched([{"lag"}, {"hum"}], ["lag"])
    reported = judged(truth("two_H", "lag", "hum"), result("hum", "lag"))
    assert reported["first"] and reported["all"]


def test_floors_are_powers() -> None:
    """The truth has roots: 1 % is 1e-4; a mean over tests is compared with a mean over tests."""
    assert judged(truth("clean_F"), result(validate=1.9e-4))["ratio"] == pytest.approx(1.9)
    assert at_floor(judged(truth("clean_F"), result(validate=1.9e-4)))
    assert not at_floor(judged(truth("clean_F"), result(validate=2.1e-4)))
    over_tests = truth("clean_F", nrms_is="root of the mean over tests of (squared error / squared force)")
    tests = {"test_01": 1.0, "test_03": 1e-4, "test_04": 5e-4}
    assert judged(over_tests, result(validate=1e-4, **tests))["ratio"] == pytest.approx(3.0)
    assert judged(over_tests, result(validate=1e-4, test_03=1e-4))["ratio"] is None


def test_table_counts() -> None:
    scores = [
        judged(truth("one_F", "lag"), result("lag")),
        judged(truth("one_H", "lag"), result("lag", "hum", validate=1e-2)),
        judged(truth("two_H", "lag", "hum", tests_in_motion=["test_02"]), result("hum", "lag")),
        judged(truth("clean_F", tests_in_motion=["test_02"]), result("hum")),
        judged(truth("clean_H"), result()),
        judged(truth("unlisted", "clipping"), result("play")),
        judged(truth("unlisted", "clipping"), result(verdict="unexplained")),
        judged(truth("one_F", "hum"), None, failure="exit 1", seconds=9.0),
    ]
    text = summary(scores)
    table = {row[:34].strip(): [c for c in row[34:].split("  ") if c] for row in text.split("\n\n")[0].splitlines()}
    reported = {label: [cell.strip() for cell in cells] for label, cells in table.items()}
    assert reported[""] == ["all", "laws F", "laws H", "at rest", "motion"]
    assert reported["campaigns"] == ["8", "3", "5", "6", "2"]
    assert reported["failures of the program"] == ["1", "1", "0", "1", "0"]
    assert reported["clean: false alarms"] == ["1 of 2", "1 of 1", "0 of 1", "0 of 1", "1 of 1"]
    assert reported["one effect: first is right"] == ["2 of 2", "1 of 1", "1 of 1", "2 of 2", "-"]
    assert reported[".. and nothing beside it"] == ["1 of 2", "1 of 1", "0 of 1", "1 of 2", "-"]
    assert reported["two effects: both, no other"] == ["1 of 1", "-", "1 of 1", "-", "1 of 1"]
    assert reported["unlisted: called explained"] == ["1 of 2", "-", "1 of 2", "1 of 2", "-"]
    assert reported["validation at most 2 x floor"] == ["4 of 5", "2 of 2", "2 of 3", "2 of 3", "2 of 2"]
    # refit of k0 = 2 from 1 to 1.9: two campaigns at rest and one in motion have the right effects
    assert reported["parameters in their intervals"] == ["0 %", "0 %", "0 %", "0 %", "0 %"]
    assert reported["seconds: longest"] == ["9", "9", "3", "9", "3"]
    assert text.count("001_x") == 4  # hum beside lag, the alarm, the unlisted that is explained, the failure
    assert all(len(row) <= 80 for row in text.split("\n\n")[0].splitlines())
    assert "wrong    clipping: play form; explained, 1 x floor" in line(scores[5])


@pytest.mark.slow  # numba compiles each program for 5 to 10 s where nothing is kept of a former run
@pytest.mark.parametrize("laboratory", LABORATORIES)
def test_edesign_reads_what_a_laboratory_writes(laboratory: str, tmp_path: Path) -> None:
    """The first clean campaign of seed 1; its first test has the force that it had."""
    if laboratory != "foundry":
        pytest.importorskip("numba", reason="make laboratories installs it")
    program = import_module(f"blind.laboratories.{laboratory}.generate")
    if laboratory != "wharf":  # it makes one of each category in turn
        # the foundry draws laws whatever the group
        assert set(program.SHARES) in (set(CATEGORIES), {category.split("_")[0] for category in CATEGORIES})
        assert sum(program.SHARES.values()) == 100
    number, category, peak, rms = FIRST_CLEAN[laboratory]
    program.make(tmp_path, 1, number, (category,))
    (made,) = campaigns(tmp_path, number)
    assert made.name == f"{number:03d}_{category}"
    assert campaigns(tmp_path, number - 1) == [] and campaigns(tmp_path, number, ("one_F",)) == []
    read = load_campaign(made / "campaign.yaml")
    assert {test.use for test in read.tests} == {"fit", "validate"}
    force = read.tests[0].force
    assert force is not None
    # written with seven digits; compilers of other machines may round the last of them otherwise
    assert 1e-3 * np.abs(force).max() == pytest.approx(peak, rel=1e-5)
    assert 1e-3 * np.sqrt(np.mean(force**2)) == pytest.approx(rms, rel=1e-5)
    said = json.loads((tmp_path / f"{made.name}.truth.json").read_text())
    assert judged(said, result(validate=said["noise_floor_validate"] ** 2))["all"] is None
    written = (tmp_path / f"{made.name}.truth.json").stat().st_mtime_ns
    program.make(tmp_path, 1, number, (category,))
    assert (tmp_path / f"{made.name}.truth.json").stat().st_mtime_ns == written  # not made again


def test_scoring_survives_failures(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Instead of the calibration a script that finds a lag, and fails in the second campaign."""
    script = tmp_path / "fake.py"
    script.write_text(
        "import pathlib, sys\n"
        "if '002' in sys.argv[1]: sys.exit('no law')\n"
        "out = pathlib.Path(sys.argv[2]); out.mkdir()\n"
        f"(out / 'calibration.json').write_text({json.dumps(json.dumps(result('lag')))})\n"
    )
    monkeypatch.setattr(
        run, "command", lambda campaign, out, options: [sys.executable, str(script), str(campaign), str(out)]
    )
    for name in ("001_one_F", "002_clean_H"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "campaign.yaml").write_text("tests:\n  - {file: test_01.csv, use: validate}\n")
        effects = ("lag",) if "one" in name else ()
        (tmp_path / f"{name}.truth.json").write_text(json.dumps(truth(name[4:], *effects)))
    scores = score(campaigns(tmp_path, 2), tmp_path)
    assert [s["failure"] and s["failure"][:14] for s in scores] == [None, "exit 1: no law"]
    assert scores[0]["all"] and json.loads((tmp_path / "scores.json").read_text()) == scores
    assert score(campaigns(tmp_path, 2), tmp_path, jobs=2) == scores


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--laboratory", "quay"), "invalid choice: 'quay'"),
        (("--laboratory", "harbour", "--only", "one"), "there is no `one`; there are clean_F, clean_H"),
        (("--laboratory", "harbour", "--motion"), "--motion is for proving"),
        (("--laboratory", "harbour", "--number", "0"), "0: 1 or more"),
    ],
)
def test_bad_options_are_reported(words: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(list(words))
    assert said in capsys.readouterr().err


def test_the_missing_compiler_is_reported(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    for name in [name for name in sys.modules if name.startswith("blind.laboratories.")]:
        if name.split(".")[2] in (*LABORATORIES, "compiled"):
            monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, "numba", None)
    with pytest.raises(SystemExit, match="needs numba, of the extra `blind`: pip install"):
        main(["--laboratory", "harbour", "--folder", str(tmp_path)])
