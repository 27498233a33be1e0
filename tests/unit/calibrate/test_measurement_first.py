"""Faults of the measurement are sought before all others, and a search that ends early says what it has looked at."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import campaign, lawful
from linear_problem import linear

from edesign.calibrate.allowance import OutOfTime
from edesign.calibrate.dampers.law_unknowns import held_parameters
from edesign.calibrate.dampers.prepare import damper_problem
from edesign.calibrate.outcome import Outcome
from edesign.calibrate.result import Coverage
from edesign.calibrate.run import calibrate
from edesign.calibrate.search.beside_declared import BesideDeclared
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.selection import Selection
from edesign.calibrate.write import calibration_json, law_text
from edesign.cli.main import main
from edesign.damper.testing.campaign import load_campaign
from edesign.report.calibration.tables import verdict_text


def _out_of_time(*_: object) -> list[object]:
    raise OutOfTime


def _ended_early(monkeypatch: pytest.MonkeyPatch, instruments: tuple[str, ...]) -> Selection:
    """A search in which x and y are hidden, and which ends when the faults of the measurement have been sought."""
    monkeypatch.setattr(BesideDeclared, "one", _out_of_time)
    problem = replace(linear(seed=5, hidden={"x": 5.0, "y": 4.0}), instruments=instruments)
    return Loop(problem, (1.0,) * 6, workers=1).run()


def test_faults_of_the_measurement_are_found_before_anything_else_is_sought(monkeypatch: pytest.MonkeyPatch) -> None:
    found = _ended_early(monkeypatch, ("x", "y"))
    assert {adopted.candidate.name for adopted in found.adopted} == {"x", "y"} and found.ending == "out_of_time"
    assert found.final.at_floor
    # z was not looked at beside them
    assert found.coverage.forms == ("z.only",) and found.coverage.not_screened == ("z.only",)


def test_what_does_less_than_half_is_no_fault_that_stands(monkeypatch: pytest.MonkeyPatch) -> None:
    # y does 16 of 41 parts of what is left: with x unknown, too little for a search that has looked nowhere else
    assert _ended_early(monkeypatch, ("y",)).adopted == ()


def test_what_was_not_searched_is_told_as_that(monkeypatch: pytest.MonkeyPatch) -> None:
    found = _ended_early(monkeypatch, ("z",))
    assert found.coverage == Coverage(("x.only", "y.only", "z.only"), frozenset({"z.only"}), frozenset())
    outcome = Outcome.of(found.final.fitted.model.problem, (1.0,) * 6, found)
    assert outcome.verdict == "not_searched"
    # a search that comes to its end and finds nothing is another thing
    assert Outcome.of(outcome.problem, (1.0,) * 6, replace(found, ending="complete")).verdict == "unexplained"


def test_a_search_that_comes_to_its_end_has_screened_all_forms() -> None:
    problem = linear(seed=5)
    random = np.random.default_rng(6)
    problem.measured = tuple(y + 3.0 * random.standard_normal(y.size) for y in problem.measured)  # nothing known
    found = Loop(problem, (1.0,) * 6, workers=1).run()
    assert found.adopted == () and found.ending == "complete"
    assert set(found.coverage.forms) == {"x.only", "y.only", "z.only"} and found.coverage.not_screened == ()


@pytest.mark.slow
def test_all_files_tell_what_was_not_searched(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def hidden(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return lawful(t, u, v, a, order) + 3e10 * u**3

    monkeypatch.setattr(BesideDeclared, "one", _out_of_time)
    campaign(tmp_path, hidden)
    assert main(["calibrate", str(tmp_path / "campaign.yaml"), "--workers", "1"]) == 0
    said = capsys.readouterr().out
    told = json.loads((tmp_path / "calibration.json").read_text(encoding="utf-8"))
    assert told["verdict"] == "not_searched" and told["search"] == "out_of_time"
    screened, forms = told["coverage"]["screened"], told["coverage"]["forms"]
    assert 0 < screened < forms == screened + len(told["coverage"]["not_screened"])
    counts = f"{screened} of {forms} forms of effects were screened, {len(told['coverage']['fitted'])} fitted"
    head = (tmp_path / "law.yaml").read_text(encoding="utf-8").splitlines()[1]  # below what it was written from
    page = (tmp_path / "calibration.html").read_text(encoding="utf-8")
    for text in (" ".join(said.split()), head, " ".join(page.split())):
        assert counts in text and "ot searched" in text.replace("not_searched", "not searched")
        assert "no effect known here explains it" not in text
    assert "hardening" in said.split("Not screened, or not in all forms:")[1]


_BOUC_WEN = "law: {type: bouc_wen, parameters: {Fy: 0.8 kN, Y: 1.5 mm, alpha: 0.05}}"


def _late_bouc_wen(folder: Path) -> Path:
    """Bouc-Wen as declared (beta = gamma = 0.5, n = 1, by Euler with twenty steps a sample) with a zero of the force of
    0.1 kN, the force 25 ms late, and noise of 4 N.
    """
    random, rows = np.random.default_rng(1), []
    for number, (amplitude, frequency) in enumerate(((10.0, 0.9), (8.0, 1.0), (6.0, 1.1), (9.0, 0.95)), start=1):
        t = np.arange(0.0, 8.0, 5e-4)
        u = amplitude * np.clip(np.minimum(t, 8.0 - t) / 2.0, 0.0, 1.0) * np.sin(2.0 * np.pi * frequency * t)
        z = np.zeros_like(u)
        for i, du in enumerate(np.diff(u)):
            z[i + 1] = z[i] + (du - 0.5 * abs(du) * z[i] - 0.5 * du * abs(z[i])) / 1.5
        force = 0.05 * 0.8 / 1.5 * u + 0.95 * 0.8 * z
        force = np.interp(t - 0.025, t, force)[::20] + 0.1 + 0.004 * random.standard_normal(t[::20].size)
        lines = [f"{a:.2f},{b:.5f},{c:.5f}" for a, b, c in zip(t[::20], u[::20], force, strict=True)]
        text = "\n".join(["time_s,displacement_mm,force_kN", *lines, ""])
        (folder / f"test_{number}.csv").write_text(text, encoding="utf-8")
        use = "validate" if number == 4 else "fit"
        rows.append(f"  - {{file: test_{number}.csv, temperature: 20 degC, use: {use}}}")
    specimen = "specimen: {name: S, layers: 1, layer_area: 1000 mm^2, layer_thickness: 100 mm}"
    path = folder / "campaign.yaml"
    path.write_text("\n".join([specimen, _BOUC_WEN, "tests:", *rows, ""]), encoding="utf-8")
    return path


@pytest.mark.slow
def test_a_zero_and_a_late_force_are_found_beside_a_law_that_is_slow_to_predict(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # the search ends where all other effects would be screened, which takes minutes beside such a law
    monkeypatch.setattr(BesideDeclared, "one", _out_of_time)
    loaded = load_campaign(_late_bouc_wen(tmp_path))
    found = calibrate(loaded, workers=1, seconds=1e6)
    by_name = {effect.name: effect for effect in found.effects}
    assert set(by_name) == {"offset", "lag"} and found.verdict == "explained"
    # noise of 4 N in 2400 samples of a sine; Euler's steps of the truth are late by half a step, 0.25 ms
    assert by_name["offset"].parameters["offset"].value == pytest.approx(100.0, abs=2.0)
    assert by_name["lag"].parameters["lag"].value == pytest.approx(0.025, abs=5e-4)
    # what other parameters do is not fitted, and that is said
    assert {"A", "gamma"} == set(found.held) and "n" in found.parameters["refit"]
    assert not {"A", "gamma"} & set(found.parameters["refit"])
    assert "A is held: A only scales z" in law_text(found, loaded)
    assert set(calibration_json(found)["held"]) == {"A", "gamma"}
    assert verdict_text(found).startswith("Explained")


@pytest.mark.parametrize(
    ("law", "held"),
    [("bouc_wen", {"A", "gamma"}), ("friction", {"N"}), ("kelvin_voigt", set()), ("mgmm", set())],
)
def test_parameters_that_others_make_needless_are_held_as_in_a_fit(tmp_path: Path, law: str, held: set[str]) -> None:
    from edesign.calibrate.dampers.law_unknowns import law_unknowns
    from edesign.damper.laws import law as law_of
    from edesign.damper.parameters import read_parameters

    given = {
        "bouc_wen": {"Fy": "0.8 kN", "Y": "1.5 mm", "alpha": 0.05},
        "friction": {"mu": 0.3, "N": "150 kN", "k": "100 kN/mm"},
        "kelvin_voigt": {"k": "4 kN/mm", "c": "0.2 kN*s/mm"},
        "mgmm": "thesis_table_4_2",
    }
    chosen = law_of(law)
    assert set(held_parameters(chosen)) == held
    values = read_parameters(chosen, given[law])
    names = {unknown.name for unknown in law_unknowns(chosen, values, damper_problem(campaign(tmp_path)).sizes)}
    assert not names & held and names <= set(values)
