"""The case `any_quantity`: values that its criteria were judged by, computed anew from histories and statics."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import copied_study
from scipy.signal import lsim

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.verdicts import Verdict
from edesign.cli.main import main
from edesign.frame.project_file import load_study
from edesign.report.archive.document import write_page
from edesign.report.archive.study_tables import study_tables
from edesign.report.assessment.verdict_data import study_verdicts
from edesign.report.tables.text import PAPER, print_tables
from edesign.study.run.run import run_study

Answers = dict[tuple[str, str], Verdict]
SINGLE = 2e-7  # relative: histories are kept in single precision
RECORDS = ("whole", "slow", "fast")
FLOOR_MASS = 12.0 * 20e3 / 9.80665  # kg: 20 kN/m over two bays of 6 m
LEVELS = np.array([4.0, 7.5])  # m


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return run_study(load_study(copied_study("any_quantity", tmp_path_factory.mktemp("criteria")))).archive


@pytest.fixture(scope="module")
def answers(archive: Path) -> Answers:
    with open_archive(archive) as opened:
        return {(verdict.name, verdict.variant): verdict for verdict in study_verdicts(opened)}


@pytest.fixture(scope="module")
def groups(archive: Path) -> dict[str, Group]:
    with open_archive(archive) as opened:
        return {name: opened.group(f"analyses/{name}") for name in opened.names("analyses")}


def each(groups: dict[str, Group], variant: str, name: str) -> list[np.ndarray]:
    return [np.asarray(groups[f"{variant}.DBE.{record}"].variables[name].values) for record in RECORDS]


def test_a_floor_spectrum_is_that_of_an_oscillator_on_the_floor(answers: Answers, groups: dict[str, Group]) -> None:
    """Against scipy's exact solution for motion that is linear between samples; 20 samples a period bend it by 1 %."""
    omega, zeta = 2.0 * np.pi * 5.0, 0.02
    system = ([[0.0, 1.0], [-(omega**2), -2.0 * zeta * omega]], [[0.0], [-1.0]], [[-(omega**2), -2.0 * zeta * omega]])
    for variant in ("bare", "damped"):
        peaks = [
            np.abs(lsim((*system, [[0.0]]), floors[:, 1], 0.01 * np.arange(len(floors)))[1]).max()
            for floors in each(groups, variant, "floor_acceleration")
        ]
        verdict = answers["equipment", variant]
        assert verdict.value == pytest.approx(max(peaks), rel=0.01)
        assert verdict.governing_history == f"{variant}.DBE.{RECORDS[int(np.argmax(peaks))]}"
        assert (verdict.place, verdict.statistic) == ("floor 2", "maximum")


def test_the_supports_carry_the_inertia_of_the_floors(answers: Answers, groups: dict[str, Group]) -> None:
    """Equilibrium of the whole frame at each instant, linear geometry, no mass that moves vertically."""
    for variant in ("bare", "damped"):
        moments = []
        for name in RECORDS:
            v = groups[f"{variant}.DBE.{name}"].variables
            floors = np.asarray(v["floor_acceleration"].values)
            moment = -(FLOOR_MASS * floors) @ LEVELS
            scale = np.abs(moment).max()
            assert np.abs(v["overturning_moment"].values - moment).max() < 2e-6 * scale  # equilibrium solved to 1e-7
            vertical = np.asarray(v["support_vertical_reaction"].values)
            assert vertical.sum(axis=1) == pytest.approx(np.full(len(vertical), 2 * 12.0 * 20e3), rel=1e-5)
            horizontal = np.asarray(v["support_horizontal_reaction"].values).sum(axis=1)
            assert np.abs(horizontal - FLOOR_MASS * floors.sum(axis=1)).max() < 2e-6 * scale
            # about the middle: the outer supports stand 6 m from it
            turned = 6.0 * (vertical[:, 2] - vertical[:, 0]) + np.asarray(v["support_moment"].values).sum(axis=1)
            assert np.abs(turned - moment).max() < 2e-6 * scale
            moments.append(scale)
        assert answers["overturning", variant].value == pytest.approx(np.mean(moments), rel=2e-6)
        lifts = [max(0.0, -v[:, 0].min()) for v in each(groups, variant, "support_vertical_reaction")]
        found = answers["uplift", variant]
        assert found.value == pytest.approx(max(lifts), rel=SINGLE, abs=240e3 * SINGLE)
        assert (found.governing_member, found.met) == ("A0", max(lifts) <= 10e3)


def test_dampers_are_judged_by_their_histories(answers: Answers, groups: dict[str, Group]) -> None:
    strokes = [np.abs(u[:, 0]).max() for u in each(groups, "damped", "damper_deformation")]
    assert answers["stroke", "damped"].value == pytest.approx(np.mean(strokes), rel=SINGLE)
    # a viscous damper shows its velocity: F = c v, of the dashpot behind a brace in series
    rates = [np.abs(f[:, 0]).max() / 150e3 for f in each(groups, "damped", "damper_force")]
    assert answers["velocity", "damped"].value == pytest.approx(np.mean(rates), rel=2e-3)
    forces = [np.abs(f[:, 0]).max() for f in each(groups, "damped", "storey_damper_force")]
    assert answers["force of dampers", "damped"].value == pytest.approx(np.mean(forces), rel=SINGLE)
    final = [
        dict(zip(groups["damped.DBE.whole"].coords["energy_term"].values, e[-1], strict=True))
        for e in each(groups, "damped", "energy")
    ]
    shares = [e["dampers"] / e["input"] for e in final]
    assert answers["share of the dampers", "damped"].value == pytest.approx(np.mean(shares), rel=1e-6)


def test_statistics_of_floors_and_storeys(answers: Answers, groups: dict[str, Group]) -> None:
    for variant in ("bare", "damped"):
        floor = [np.abs(a[:, 0]).max() for a in each(groups, variant, "floor_acceleration")]
        assert answers["acceleration of floor 1", variant].value == pytest.approx(np.median(floor), rel=SINGLE)
        roof = [np.abs(u[:, 1]).max() for u in each(groups, variant, "floor_displacement")]
        assert answers["displacement of the roof", variant].value == pytest.approx(max(roof), rel=SINGLE)  # 84 % of 3
        drift = answers["drift of storey 2", variant]
        assert drift.statistic == "maximum"  # EN 1998-1: of three motions
        relative = [np.abs(u[:, 1] - u[:, 0]).max() / 3.5 for u in each(groups, variant, "floor_displacement")]
        assert drift.value == pytest.approx(max(relative), rel=1e-5) and drift.ratio == pytest.approx(
            max(relative) / 0.004, rel=1e-5
        )
        shears = [
            max(
                groups[f"{variant}.DBE.{name}"].variables["storey_shear_max"].values[0],
                -groups[f"{variant}.DBE.{name}"].variables["storey_shear_min"].values[0],
            )
            for name in RECORDS
        ]
        assert answers["shear of storey 1", variant].value == np.mean([shear <= 0.4e6 for shear in shears])


def test_what_does_not_apply_is_not_open(archive: Path, answers: Answers, capsys: pytest.CaptureFixture[str]) -> None:
    idle = {key: verdict.remark for key, verdict in answers.items() if verdict.answer == "does not apply"}
    assert idle == {
        **{(name, "bare"): "there are no dampers" for name in ("stroke", "velocity", "force of dampers")},
        ("share of the dampers", "bare"): "there are no dampers",
        ("drift at MCE", "damped"): "the study runs no such histories",
    }
    assert not any(verdict.answer == "open" for verdict in answers.values())
    assert main(["show", str(archive), "--json"]) == 0
    reported = json.loads(capsys.readouterr().out)["criteria"]
    assert len(reported) == len(answers) == 17 * 2 + 1
    by_name = {(item["criterion"], item["variant"]): item for item in reported}
    assert by_name["stroke", "bare"]["verdict"] == "does not apply" and by_name["stroke", "bare"]["value"] is None
    assert by_name["uplift", "damped"]["governing_place"] == "A0"
    table = archive.with_name("verdicts.csv")
    assert main(["show", str(archive), "--csv", str(table)]) == 0
    capsys.readouterr()
    rows = list(csv.DictReader(io.StringIO(table.read_text(encoding="utf-8"))))
    assert [row["verdict"] for row in rows] == [item["verdict"] for item in reported]


def test_verdicts_fit_a_terminal_and_stand_in_the_report(archive: Path) -> None:
    stream = io.StringIO()
    with open_archive(archive) as opened:
        tables = study_tables(opened)
    print_tables([table for table in tables if "riteria" in table.title], stream, widest=PAPER)
    assert max(map(len, stream.getvalue().splitlines())) <= PAPER
    page = write_page(archive, archive.with_suffix(".html")).read_text(encoding="utf-8")
    assert "does not apply" in page and "floor spectral acceleration at 5 Hz" in page
