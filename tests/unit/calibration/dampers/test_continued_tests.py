"""Tests that go on where the one before ends: a record that was cut is predicted as the whole one."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.problem import DamperProblem
from edesign.damper.testing.campaign import CampaignError, load_campaign, notes_of, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.start import StartKind

STEP = 0.01  # s
T = np.arange(0.0, 12.0, STEP)
U = 1e-3 * (4.0 + 0.5 * T) * np.sin(2.0 * np.pi * 0.5 * T) * np.clip(T, 0.0, 1.0)
CUTS = (0, 470, 710, T.size)
K, SLIP, NOISE = 5e6, 8e3, 20.0  # N/m, N, N
LAW = LawChoice("friction", {"mu": 0.5, "N": "16 kN", "k": "5 kN/mm"}, refit=False)


def slipping(u: np.ndarray) -> np.ndarray:
    """Force of a spring that slips, by the return mapping of Simo & Hughes (1998), Computational Inelasticity, 1.4."""
    force, found = 0.0, [0.0]
    for step in np.diff(u):
        force = float(np.clip(force + K * step, -SLIP, SLIP))
        found.append(force)
    return np.array(found)


def cut(start: StartKind, lifted: float = 1.0) -> list[DamperTest]:
    """One record in three parts, the times of each from zero."""
    force = lifted * slipping(U) + NOISE * np.random.default_rng(1).standard_normal(U.size)
    parts = [slice(a, b) for a, b in zip(CUTS[:-1], CUTS[1:], strict=True)]
    return [
        DamperTest(
            f"test_{i}",
            T[part] - T[part][0],
            U[part],
            force[part],
            use="validate" if i == 3 else "fit",
            start=start if i > 1 else "at_rest",
        )
        for i, part in enumerate(parts, 1)
    ]


def problem_of(folder: Path, tests: list[DamperTest]) -> DamperProblem:
    return damper_problem(write_campaign(folder, None, tests, LAW, specimen_name="device"), 1)


def predicted(problem: DamperProblem, effect: str = "") -> list[np.ndarray]:
    of = [one for one in problem.effects if one.label == effect]
    effects = tuple((one.data, one.data.values(one.starts[0])) for one in of)
    assert len(effects) == bool(effect)
    (found,) = problem.full_rate.prediction.predict([(problem.declared, effects)], range(len(problem.experiments)))
    assert isinstance(found, list)
    return found


def test_a_record_that_was_cut_has_the_force_of_the_whole_one(tmp_path: Path) -> None:
    problem = problem_of(tmp_path, cut("continued"))
    assert [one.judged_from for one in problem.experiments] == [0, 0, 0]
    assert not problem.uncertain_inputs  # nothing of what went before is unknown
    off = [slipping(U)[a:b] - f for a, b, f in zip(CUTS[:-1], CUTS[1:], predicted(problem), strict=True)]
    assert max(float(np.max(np.abs(one))) for one in off) < 0.02 * SLIP
    # from rest, the force of the second part would begin on the other side
    begun = [replace(one, continued=False) for one in problem.full_rate.experiments]
    second = predicted(replace(problem.full_rate, experiments=tuple(begun)))[1]
    assert abs(second[0] - slipping(U)[CUTS[1]]) > 0.5 * SLIP


@pytest.mark.parametrize("effect", ["degradation.energy", "mullins.path", "series_flexibility.linear"])
def test_what_an_effect_remembers_goes_on_and_is_not_counted_twice(tmp_path: Path, effect: str) -> None:
    parts = predicted(problem_of(tmp_path / "parts", cut("continued")), effect)
    force = np.concatenate([one.measured_force() for one in cut("continued")])
    whole = DamperTest("test_1", T, U, force, start="at_rest")
    alike = [whole, replace(whole, name="test_2"), replace(whole, name="test_3", use="validate")]
    problem = problem_of(tmp_path / "whole", alike)
    # the same size of the effect: that of the parts' campaign
    of = next(one for one in problem_of(tmp_path / "again", cut("continued")).effects if one.label == effect)
    effects = ((of.data, of.data.values(of.starts[0])),)
    (found,) = problem.full_rate.prediction.predict([(problem.declared, effects)], (0,))
    assert isinstance(found, list)
    assert np.max(np.abs(np.concatenate(parts) - found[0])) < 0.03 * SLIP


def test_the_gap_between_two_parts_is_a_step_or_what_their_times_say(tmp_path: Path) -> None:
    first, second, _ = (one.motion for one in problem_of(tmp_path, cut("continued")).full_rate.experiments)
    joined = second.joined(first)
    assert joined.preceded == first.time.size
    assert np.diff(joined.time)[first.time.size - 1] == pytest.approx(STEP)
    later = replace(second, time=second.time + first.time[-1] + 5.0 * STEP)
    assert np.diff(later.joined(first).time)[first.time.size - 1] == pytest.approx(5.0 * STEP)


def test_a_cut_record_that_is_not_said_to_be_one_is_asked_about() -> None:
    noted = notes_of(cut("in_motion"))
    assert [one.split(":")[0] for one in noted] == ["test_2", "test_3"]
    assert "`start: continued`" in noted[0]
    assert not notes_of(cut("continued"))
    apart = [replace(one, displacement=one.displacement + 1e-3 * i) for i, one in enumerate(cut("in_motion"))]
    assert not notes_of(apart)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("use: fit, start: at_rest", "use: fit, start: continued", "before the first one there is none"),
        ("tests:", "order: unknown\ntests:", "`order: unknown` says that none does"),
        ("tests:", "start: continued\ntests:", "the first test goes on from none"),
    ],
)
def test_what_goes_on_from_nothing_is_refused(tmp_path: Path, old: str, new: str, says: str) -> None:
    path = write_campaign(tmp_path, None, cut("continued"), LAW, specimen_name="device").path
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(CampaignError, match="E-TEST-02") as error:
        load_campaign(path)
    assert says in str(error.value)
