"""Softening of the MGMM by extremes that lasts from test to test, against one long history with rests between tests."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.calibrate.dampers import readings
from edesign.calibrate.dampers.extremes import extremes_after
from edesign.calibrate.dampers.prepare import damper_problem, thinned
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.readings import likely_readings
from edesign.calibrate.dampers.trial import Motion
from edesign.damper.damper import Damper
from edesign.damper.history import NONE
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaOf, GammaT
from edesign.damper.testing.campaign import load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import Extremes, LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

MGMM = law("mgmm")
TABLE_4_2 = read_parameters(MGMM, "thesis_table_4_2")
T = np.arange(0.0, 6.0, 1.0 / 200.0)
REST = 400  # samples of 5 ms: 68 relaxation times
NOISE = 20.0  # N
GAMMAS: tuple[GammaOf, ...] = ("parameters", "by_the_letter")


def motions() -> list[np.ndarray]:
    """Of five tests that begin and end at rest; a small one after the largest."""
    grow = np.clip(2.0 * np.minimum(T, T[-1] - T), 0.0, 1.0)
    smooth = grow**3 * (10.0 - 15.0 * grow + 6.0 * grow**2)
    return [
        1e-3 * a * smooth * np.sin(2.0 * np.pi * f * T)
        for a, f in ((3.0, 1.0), (6.0, 0.5), (2.0, 2.0), (4.0, 1.0), (5.0, 0.7))
    ]


def one_history() -> list[np.ndarray]:
    """Forces of the tests cut from one history."""
    each = motions()
    long = np.concatenate([part for u in each for part in (u, np.zeros(REST))])
    time = np.arange(long.size) / 200.0
    force = Damper(MGMM, TABLE_4_2).force(time, long)
    return [force[i * (T.size + REST) :][: T.size] for i in range(len(each))]


def problem(folder: Path, forces: list[np.ndarray], extremes: Extremes | None = None) -> DamperProblem:
    random = np.random.default_rng(5)
    tests = [
        DamperTest(
            f"test_{i}", T, u, f + NOISE * random.standard_normal(T.size), 20.0, use="validate" if i == 3 else "fit"
        )
        for i, (u, f) in enumerate(zip(motions(), forces, strict=True))
    ]
    choice = LawChoice("mgmm", "thesis_table_4_2", extremes=extremes)
    return damper_problem(write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, choice))


def test_lasting_extremes_are_those_of_one_history(tmp_path: Path) -> None:
    forces = one_history()
    fresh = problem(tmp_path, forces)
    lasting = replace(fresh, lasting=True)
    peak = max(float(np.max(np.abs(force))) for force in forces)
    left = []
    for one in (fresh, lasting):
        predicted = one.predict(one.declared, (), ("fit", "validate"))
        left.append([float(np.max(np.abs(p - f))) for p, f in zip(predicted, forces, strict=True) if p is not None])
    # motion that is freed from (no) noise, splines of each test by themselves
    assert max(left[1]) < 1e-3 * peak
    assert left[0][2] > 0.05 * peak  # the small test after the large one
    # those asked for alone are the same: tests between are run through
    (only,) = [p for p in lasting.predict(lasting.declared, (), ("validate",)) if p is not None]
    assert only == pytest.approx(forces[3], abs=1e-3 * peak)


@pytest.mark.slow
def test_what_predicts_the_tests_better_is_found(tmp_path: Path) -> None:
    fresh_forces = [Damper(MGMM, TABLE_4_2).force(T, u) for u in motions()]
    for name, forces, lasting in (("one", one_history(), True), ("each", fresh_forces, False)):
        given = problem(tmp_path / name, forces)
        choice = LawChoice("mgmm", "thesis_table_4_2")
        found = likely_readings(thinned(given), choice, [trial.noise for trial in given.trials])
        assert [one.problem.lasting for one in found] == [lasting]  # and no doubt about it


@pytest.mark.slow
@pytest.mark.parametrize(
    ("share", "lasting"), [(0.1, [True]), (0.4, [True, False]), (0.7, [False, True]), (0.95, [False]), (3.0, [False])]
)
def test_a_reading_that_is_near_is_searched_too(
    share: float, lasting: list[bool], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = thinned(problem(tmp_path, one_history()))
    monkeypatch.setattr(readings, "_left", lambda one, noise: 1e3 * (share if one.lasting else 1.0))
    monkeypatch.setattr(readings, "_refitted", lambda one, noise: (1e3 * (share if one.lasting else 1.0), None))
    found = likely_readings(given, LawChoice("mgmm", "thesis_table_4_2"), (1.0,) * len(given.trials))
    assert [one.problem.lasting for one in found] == lasting
    said = likely_readings(given, LawChoice("mgmm", "thesis_table_4_2", extremes="fresh"), (1.0,) * len(given.trials))
    assert [one.problem.lasting for one in said] == [False]


def test_extremes_between_samples_are_those_of_the_cubics() -> None:
    # a sine at 8 samples a cycle, whose peaks lie between them: cubics meet it to (pi/4)^4 / 384 = 1e-3
    t = (np.arange(25) + 0.5) / 8.0
    w = 2.0 * np.pi
    motion = Motion(t, np.sin(w * t), w * np.cos(w * t), -(w**2) * np.sin(w * t))
    found = extremes_after(NONE, motion)
    assert found == pytest.approx((1.0, -1.0, w, -w), rel=1e-2)
    assert found[0] > np.max(motion.displacement) * 1.05 and found[2] > np.max(motion.velocity) * 1.05
    assert extremes_after((2.0, -2.0, 9.0, -9.0), motion) == (2.0, -2.0, 9.0, -9.0)


def test_a_campaign_says_whether_extremes_last(tmp_path: Path) -> None:
    problem(tmp_path, one_history(), extremes="lasting")
    path = tmp_path / "campaign.yaml"
    campaign = load_campaign(path)
    assert campaign.law is not None and campaign.law.extremes == "lasting"
    path.write_text(path.read_text(encoding="utf-8").replace("lasting", "for ever"), encoding="utf-8")
    with pytest.raises(InputError, match="fresh"):
        load_campaign(path)


def test_a_mass_does_not_make_another_reading_of_gamma_likely(tmp_path: Path) -> None:
    """At 23 degC the letter of Eq. 4.34 makes springs softer by 4 %, as a mass of two tonnes does at 2 Hz."""
    warm, _ = GammaT().shifted(MGMM, TABLE_4_2, 23.0)
    random = np.random.default_rng(6)
    grow = np.clip(2.0 * np.minimum(T, T[-1] - T), 0.0, 1.0)
    tests = []
    for i, size in enumerate((2.0, 4.0, 6.0, 5.0)):
        u = 1e-3 * size * grow**3 * (10.0 - 15.0 * grow + 6.0 * grow**2) * np.sin(4.0 * np.pi * T)
        force = Damper(MGMM, warm).force(T, u) + 2e3 * np.gradient(np.gradient(u, T), T)
        noisy = force + NOISE * random.standard_normal(T.size)
        tests.append(DamperTest(f"test_{i}", T, u, noisy, 23.0, use="validate" if i == 3 else "fit"))
    choice = LawChoice("mgmm", "thesis_table_4_2", refit=False)
    given = damper_problem(write_campaign(tmp_path, Specimen("S", 2, 0.0414, 0.012), tests, choice))
    noise = [trial.noise for trial in given.trials]
    fast = thinned(given)
    usual, letter = (readings._left(replace(fast, gamma_of=of), noise) for of in GAMMAS)
    assert letter < 0.5 * usual  # by the declared law alone it would be the letter
    assert likely_readings(fast, choice, noise)[0].problem.gamma_of == "parameters"
