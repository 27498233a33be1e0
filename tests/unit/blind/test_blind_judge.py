"""The judge of blind tests: what counts as right, confounded, late, wrong; floors, intervals, tables, failed runs."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import pytest

from blind import run
from blind.judge import judge, visible
from blind.plan import Planned
from blind.quantities import compared
from blind.score import SCORES, score
from blind.table import summary

OUTCOME = {"seconds": 3.0, "failure": None}


def true_effect(name: str, kind: str, form: str, **parameters: tuple[float, str]) -> dict[str, Any]:
    reported = {key: {"value": value, "unit": unit} for key, (value, unit) in parameters.items()}
    return {"name": name, "kind": kind, "form": form, "nrms": 0.01, "parameters": reported}


def truth(*effects: dict[str, Any], kind: str = "one", floor: float = 1e-5, **changed: Any) -> dict[str, Any]:
    return {
        "number": 1,
        "kind": kind,
        "effects": list(effects),
        "nrms_of_effects": 0.01 if effects else 0.0,
        "nrms_after_refit": 0.008 if effects else None,
        "noise_floor": floor,
        "noise_floor_with_channels": floor,
        "law": {"refit": True},
        **changed,
    }


def effect(name: str, kind: str, *confounded: str, **parameters: dict[str, Any]) -> dict[str, Any]:
    return {
        "name": name,
        "kind": kind,
        "form": "form",
        "parameters": parameters,
        "indistinguishable_from": list(confounded),
    }


def result(
    *effects: dict[str, Any], validate: float = 1e-5, floor: float = 1e-5, verdict: str = "explained"
) -> dict[str, Any]:
    stages = {stage: {"fit": 0.1, "validate": 0.1} for stage in ("declared", "refit")}
    return {
        "error": {**stages, "corrected": {"fit": validate, "validate": validate}},
        "noise_floor": floor,
        "effects": list(effects),
        "verdict": verdict,
    }


FRICTION = true_effect("friction", "rig", "coulomb", force=(1.5, "kN"))
HANGING = true_effect("static_offset", "rig", "hanging_mass", force=(1.5, "kN"))
LAG = true_effect("lag", "instrument", "force_late", delay=(0.004, "s"))


@pytest.mark.parametrize(
    ("found", "expected"),
    [
        ([effect("friction", "rig")], "right"),
        ([effect("friction", "damper") | {"may_be": {"kind": "rig"}}], "right"),
        ([effect("friction", "damper") | {"may_be": None}], "wrong"),
        ([effect("friction", "damper")], "wrong"),
        ([effect("play", "rig", "friction")], "confounded"),
        ([effect("play", "rig"), effect("friction", "rig")], "late"),
        ([effect("play", "rig"), effect("lag", "instrument")], "wrong"),
        ([], "nothing"),
    ],
)
def test_naming_of_one(found: list[dict[str, Any]], expected: str) -> None:
    judged = judge(truth(FRICTION), result(*found), OUTCOME)
    assert judged["named"] == expected
    assert judged["all_named"] == (expected == "right")
    assert judged["all_named_or_confounded"] == (expected in ("right", "confounded"))


def test_same_equation_under_another_name() -> None:
    assert judge(truth(HANGING), result(effect("offset", "instrument")), OUTCOME)["named"] == "equal"
    reported = judge(truth(HANGING), result(effect("offset", "instrument", "static_offset")), OUTCOME)
    assert reported["named"] == "confounded" and not reported["all_named"] and reported["all_named_or_confounded"]
    assert judge(truth(FRICTION), result(effect("offset", "instrument")), OUTCOME)["named"] == "wrong"


def test_two_effects_are_a_set() -> None:
    both = truth(FRICTION, LAG, kind="two")
    lag, friction, play = effect("lag", "instrument"), effect("friction", "rig"), effect("play", "rig", "friction")
    assert judge(both, result(lag, friction), OUTCOME)["all_named"]
    assert not judge(both, result(lag), OUTCOME)["all_named"]
    assert judge(both, result(lag), OUTCOME)["named"] == "right"
    surplus = judge(both, result(lag, friction, play), OUTCOME)
    assert not surplus["all_named"] and surplus["surplus"] == 1
    assert judge(both, result(play, lag), OUTCOME)["all_named_or_confounded"]
    assert not judge(both, result(lag, lag), OUTCOME)["all_named"]


def test_floors() -> None:
    judged = judge(truth(FRICTION, floor=1e-5), result(effect("friction", "rig"), validate=3e-5, floor=2e-5), OUTCOME)
    assert judged["at_own_floor"] and not judged["at_true_floor"]
    noisy = truth(FRICTION, floor=1e-5, noise_floor_with_channels=2e-5)
    assert judge(noisy, result(validate=3e-5), OUTCOME)["at_true_floor"]
    assert visible(truth(FRICTION)) and not visible(truth(FRICTION, nrms_after_refit=2e-5))
    assert visible(truth(FRICTION, nrms_after_refit=2e-5, law={"refit": False}))


def test_intervals_in_any_unit() -> None:
    """1.5 kN against 1490 N +- 10 N is inside, +- 4 N is not; another quantity of that name is not compared."""
    said = {"value": 1490.0, "standard_error": 10.0, "unit": "N"}
    (one,) = compared(FRICTION, effect("friction", "rig", F_c=said))
    assert one["inside"] and one["true"] == pytest.approx(1500.0) and one["value"] == 1490.0
    assert not compared(FRICTION, effect("friction", "rig", F_c={**said, "standard_error": 4.0}))[0]["inside"]
    assert compared(FRICTION, effect("friction", "rig", F_c={**said, "unit": "mm"})) == []
    assert (
        compared(true_effect("friction", "rig", "lugre", force=(1.5, "kN")), effect("friction", "rig", F_c=said)) == []
    )


def test_every_compared_parameter_is_reported() -> None:
    """The keys and forms of the table are those of the generator."""
    import numpy as np

    from blind.effects import EFFECTS
    from blind.programme import programme
    from blind.quantities import SAME, SI

    tests = programme(np.random.default_rng(0), temperatures=True)
    for name, pairs in SAME.items():
        forms = {form.form: form for form in EFFECTS[name]}
        for same in pairs:
            for form in same.forms:
                reported = forms[form](np.random.default_rng(0), tests).true_parameters()
                assert reported[same.true][1] in SI, (name, form, same.true)


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Path:
    """Instead of the calibration a script that finds friction, and fails in campaigns with 9 or more tests."""
    script = tmp_path / "fake.py"
    script.write_text(
        "import json, pathlib, sys\n"
        "text = pathlib.Path(sys.argv[1]).read_text()\n"
        "if text.count('file:') >= 9: sys.exit('too many tests')\n"
        "out = pathlib.Path(sys.argv[2]); out.mkdir()\n"
        f"(out / 'calibration.json').write_text({json.dumps(json.dumps(result(effect('friction', 'rig'))))})\n"
        "(out.parent / 'calls').open('a').write('x')\n"
    )
    monkeypatch.setattr(
        run,
        "command",
        lambda campaign, out, options: [sys.executable, str(script), str(campaign / "campaign.yaml"), str(out)],
    )
    return tmp_path


def test_scoring_resumes_and_survives_failures(fake: Path) -> None:
    folder = fake / "campaigns"
    folder.mkdir()
    planned = [Planned(1, "clean"), Planned(2, "clean"), Planned(3, "clean"), Planned(4, "one", (("friction", 0),))]
    reported: list[int] = []
    scores = score(planned, 8, folder, progress=lambda judged: reported.append(judged["number"]))
    assert reported == [1, 2, 3, 4]
    ran = [s for s in scores if not s["failure"]]
    failed = [s for s in scores if s["failure"]]
    assert ran and failed
    assert all("too many tests" in s["failure"] for s in failed)
    assert all(s["found"] == [["friction", "form"]] for s in ran)
    assert len((folder / "calls").read_text()) == len(ran)
    assert score(planned, 8, folder) == scores
    assert len((folder / "calls").read_text()) == len(ran)  # none has run again
    assert json.loads((folder / SCORES).read_text()) == scores
    text = summary(scores)
    alarms = sum(s["kind"] == "clean" for s in ran)
    assert f"{'failures of the program':52s}{len(failed)}\n" in text
    assert f"{'clean: false alarms':52s}{alarms} of {alarms}\n" in text


def test_table_counts() -> None:
    scores = [
        judge(truth(FRICTION), result(effect("friction", "rig")), OUTCOME),
        judge(truth(FRICTION), result(effect("play", "rig", "friction"), validate=1e-3), OUTCOME),
        judge(truth(kind="clean"), result(), OUTCOME),
        judge(
            truth(true_effect("beat", "instrument", "modulation"), kind="unlisted"),
            result(verdict="unexplained"),
            OUTCOME,
        ),
        judge(truth(FRICTION, LAG, kind="two"), result(effect("lag", "instrument")), OUTCOME),
    ]
    lines = {line[:52].strip(): line[52:].strip() for line in summary(scores).splitlines()}
    assert lines["one effect: named right, first"] == "1 of 2"
    assert lines[".. or reported as confounded"] in ("2 of 2", "0 of 1")
    assert lines["clean: false alarms"] == "0 of 1"
    assert lines["two effects: both named, no other"] == "0 of 1"
    assert lines["unlisted: called explained"] == "0 of 1"
    assert lines["validation at most 2 x true floor, listed effects"] == "3 of 4"
