"""Analyses whose result does not count have failed: energy balance, drift, rotations; warnings about others."""

from __future__ import annotations

import math
import os
from pathlib import Path

import numpy as np
import pytest
from cases.incremental_portal import study
from messages import says
from numpy.typing import ArrayLike
from unit.study.frames import PORTAL, PULSE, project, shear_frame
from unit.study.test_history import COLLAPSE

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.incremental import COLLAPSE as COLLAPSED
from edesign.assess.incremental import collect_stripes, stripe_counts
from edesign.assess.sets import history_sets
from edesign.cli.main import main
from edesign.core.response import EnergyBalance
from edesign.project import ProjectError
from edesign.project.analysis.validity import Validity
from edesign.project.project import Project
from edesign.project.study.study_loader import StudyError
from edesign.report.archive_view import all_results
from edesign.study.results.warnings import warnings_of
from edesign.study.run.analyses import run_analysis
from edesign.study.run.run import run_study

SHARED = Path(os.environ.get("EDESIGN_SHARED") or Path(__file__).parents[4] / "shared") / "cases" / "runaway_history"


def run(made: Project) -> Group:
    return run_analysis(made, made.analyses[0])


def pushed(folder: Path, more: str = "") -> Project:
    """Two storeys on a ground that accelerates one way at 3 g for 30 s, which no frame stands."""
    (folder / "push.csv").write_text("0\n" + "1\n" * 600)
    return project(COLLAPSE + more, folder / "project.yaml")


def shaken(folder: Path, more: str = "") -> Project:
    """The same frame under four waves of 0.1 g."""
    wave = "\n".join(f"{math.sin(2.0 * math.pi * 0.05 * i / 0.8):.6f}" for i in range(64))
    (folder / "push.csv").write_text(wave + "\n")
    return project(COLLAPSE.replace("pga: 3 g", "pga: 0.1 g") + more, folder / "project.yaml")


def energy_error(given: ArrayLike, missing: ArrayLike, piece: int = 100) -> float:
    balance = EnergyBalance()
    for i in range(0, np.size(given), piece):
        balance.count(np.asarray(given)[i : i + piece], np.asarray(missing)[i : i + piece])
    return balance.error(1e-7)


def test_the_error_counts_from_the_start_of_the_run() -> None:
    """Gravity has put in 1000 J with an error of 1 J; the motion puts in 10 J and errs by 2 J on its way."""
    given, missing = 1000.0 + np.array([0.0, 4.0, -10.0, 5.0]), 1.0 + np.array([0.0, 0.5, -2.0, 0.1])
    assert energy_error(given, missing) == pytest.approx(0.2)
    assert energy_error(given, missing, piece=1) == energy_error(given, missing)
    still = np.array([1.0, 1.0 + 1e-9, 1.0])
    assert energy_error(np.full(3, 1000.0), still) == pytest.approx(1e-9 / 1e-4)  # equilibrium's tolerance bounds it
    assert energy_error(np.zeros(3), np.zeros(3)) == 0.0
    assert energy_error([0.0, np.inf], np.zeros(2)) == math.inf
    assert energy_error([], []) == 0.0


def test_the_drift_follows_from_the_error_of_small_rotations() -> None:
    """A column at theta = arccos(0.95) = 0.318 rad is 5 % lower than its length; it has moved by sin(theta)."""
    assert Validity().geometric_drift == pytest.approx(math.sin(math.acos(0.95)), rel=1e-12)
    assert Validity().geometric_drift == pytest.approx(0.312, abs=5e-4)
    assert Validity(energy_error=0.5).geometric_drift == pytest.approx(math.sin(math.acos(0.5)), rel=1e-12)


def test_a_history_that_runs_away_has_failed_and_ends_early(tmp_path: Path) -> None:
    group = run(pushed(tmp_path))
    assert group.attributes["status"] == "failed" and "collapsed" not in group.attributes
    assert "the drift of storey 1 reached" in group.attributes["reason"]
    assert "the geometry of the model holds up to 31.2 % (`validity.drift`)" in group.attributes["reason"]
    assert group.coords["time"].values[-1] < 1.0  # of 30 s
    assert "residual_roof_displacement" not in group.variables
    (found,) = history_sets({"h": group})
    assert found.failed == ("h",) and not found.completed


@pytest.mark.parametrize(("limit", "status"), [("0.4", "failed"), ("1000", "failed")])
def test_another_limit_of_the_drift(tmp_path: Path, limit: str, status: str) -> None:
    group = run(pushed(tmp_path, f"validity: {{drift: {limit}}}\n"))
    assert group.attributes["status"] == status
    assert ("holds up to 40 %" in group.attributes["reason"]) == (limit == "0.4")


def test_an_energy_error_fails_and_warns(tmp_path: Path) -> None:
    """The same history under three limits, of which its error lies below, between and above."""
    sound = run(shaken(tmp_path))
    error = sound.attributes["statistics"]["energy_error"]
    assert sound.attributes["status"] == "completed" and not warnings_of(sound)
    assert 0.0 < error < 0.01
    limits = "validity: {{energy_error_warning: {:.6g}, energy_error: {:.6g}, drift: 31 %}}\n"
    questionable = run(shaken(tmp_path, limits.format(0.5 * error, 2.0 * error)))
    assert questionable.attributes["status"] == "completed"
    (warning,) = warnings_of(questionable)
    assert warning.kind == "energy_error" and warning.ratio == pytest.approx(2.0, rel=1e-5)
    assert "the energy balance is wrong by" in warning.text
    failed = run(shaken(tmp_path, limits.format(0.25 * error, 0.5 * error)))
    assert failed.attributes["status"] == "failed" and not warnings_of(failed)
    assert "(`validity.energy_error`)" in failed.attributes["reason"]
    assert "residual_roof_displacement" not in failed.variables
    np.testing.assert_array_equal(failed.variables["storey_drift"].values, sound.variables["storey_drift"].values)


def test_a_motion_of_zeros_is_no_error(tmp_path: Path) -> None:
    (tmp_path / "pulse.csv").write_text("\n".join(["0.0"] * len(PULSE)) + "\n")
    made = shear_frame("{name: h, kind: history, record: pulse}", path=str(tmp_path / "project.yaml"))
    group = run(made)
    assert group.attributes["status"] == "completed" and not warnings_of(group)


def test_a_stripe_with_a_large_error_is_neither_collapsed_nor_standing(tmp_path: Path) -> None:
    about = "variants: bare, records: shake, intensity: pga, levels: [0.1 g, 20 g], free_vibration: 5 s"
    found = {}
    for name, limit in (("strict", 1e-12), ("usual", 0.05)):
        (tmp_path / name).mkdir()
        base = study(tmp_path / name, about)
        validity = {"energy_error": limit, "energy_error_warning": limit, "drift": 0.31}
        made = base.of(base.base.with_values("validity", validity))
        with open_archive(run_study(made, backend="serial").archive) as opened:
            groups = all_results(opened)  # read as they are asked for
            stripes = collect_stripes(groups, "ida", "bare", ["interstorey_drift"])["interstorey_drift"]
        found[name] = stripe_counts(stripes, COLLAPSED)
    with_result, fallen = found["strict"]
    assert with_result.tolist() == [0, 0] and fallen.tolist() == [0, 0]
    with_result, fallen = found["usual"]
    assert with_result.tolist() == [1, 1] and fallen.tolist() == [0, 1]  # nothing stands 20 g


def test_gravity_that_bends_the_frame_beyond_recognition_has_failed() -> None:
    """A beam between hinges: its mean deflection q l^4 / (120 E I) is 163 m, whose work the loads do."""
    text = PORTAL.replace("bays: [1000 m]", "bays: [8 m]").replace("inertia: 1e6 m^4", "inertia: 1e-8 m^4")
    text = text.replace("sections:\n", "loads: {beams: [{floors: 1, G: 10 kN/m}]}\nsections:\n", 1)
    text = text.replace("  diaphragms: all\n", "  releases: [{beams: {floors: 1}, ends: both}]\n")
    old = "  - {name: push, kind: pushover, pattern: uniform, roof_drift: 10 %, steps: 100}"
    group = run(project(text.replace(old, "  - {name: g, kind: gravity}")))
    assert group.attributes["status"] == "failed"
    assert "the loads sank by 163 m on average" in group.attributes["reason"]


def test_a_pushover_ends_where_a_storey_leaves_the_geometry() -> None:
    """Four plastic hinges: the rotation of each is about the drift."""
    group = run(project(PORTAL.replace("roof_drift: 10 %", "roof_drift: 15 %") + "validity: {drift: 15 %}\n"))
    assert group.attributes["status"] == "completed"
    short = run(project(PORTAL + "validity: {drift: 10 %}\n"))
    assert short.attributes["status"] == "completed"
    bent = PORTAL.replace("storeys: [4 m]", "storeys: [4 m, 4 m]").replace(
        "{floors: 1, section", "{floors: all, section"
    )
    group = run(project(bent + "validity: {drift: 10 %}\n"))
    assert group.attributes["status"] == "failed"
    assert "at a roof displacement of" in group.attributes["reason"]
    assert group.variables["storey_drift"].values.max() < 0.12  # ended within a step beyond


@pytest.mark.parametrize(
    ("validity", "place", "said"),
    [
        ("{drift: 5 %}", "analyses[0].roof_drift", "5 % E-VALUE-02"),
        ("{energy_error: 1 %, energy_error_warning: 2 %}", "validity.energy_error_warning", "E-VALUE-04"),
        ("{energy_error: 0}", "validity.energy_error", "E-VALUE-02"),
        ("{energy_eror: 1 %}", "validity.energy_eror", "`energy_error` E-KEY-01"),
    ],
)
def test_limits_that_contradict_each_other_are_refused(validity: str, place: str, said: str) -> None:
    with pytest.raises(ProjectError) as error:
        project(f"{PORTAL}validity: {validity}\n")
    (problem,) = error.value.problems
    assert problem.keys_text == place and says(problem.message, said)


def test_a_collapse_drift_beyond_the_geometry_is_refused(tmp_path: Path) -> None:
    about = "variants: bare, records: shake, intensity: pga, levels: [0.1 g, 3 g], collapse_drift: 50 %"
    with pytest.raises(StudyError, match="collapse_drift: .* 31.2 %.*E-VALUE-02"):
        study(tmp_path, about)


def test_corotational_columns_have_no_limit() -> None:
    made = project(PORTAL.replace("columns: linear", "columns: corotational"))
    assert made.largest_drift is None
    assert project(PORTAL).largest_drift == Validity().geometric_drift


@pytest.mark.skipif(not SHARED.is_dir(), reason="the handed case is not here")
def test_the_handed_history_that_ran_to_7e9_m(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("p.yaml", "rec.csv"):
        (tmp_path / name).write_bytes((SHARED / name).read_bytes())
    assert main(["run", str(tmp_path / "p.yaml")]) == 3
    assert "1 of 4 analyses failed" in capsys.readouterr().err
    assert main(["show", str(tmp_path / "p.h5")]) == 0
    shown = capsys.readouterr().out
    assert "analyses  3 of 4 completed, 1 failed" in shown and "el_centro: failed: " in shown and "e+0" not in shown
