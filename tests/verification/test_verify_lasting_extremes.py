"""Softening of the MGMM by extremes that lasts from test to test, against one long history with rests between tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration import calibrate
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import Campaign, load_campaign, write_campaign
from edesign.damper.testing.campaign_blocks import Extremes, LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

MGMM = law("mgmm")
TABLE_4_2 = read_parameters(MGMM, "thesis_table_4_2")
T = np.arange(0.0, 6.0, 1.0 / 200.0)
REST = 400  # samples of 5 ms: 68 relaxation times
NOISE = 20.0  # N


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


def each_fresh() -> list[np.ndarray]:
    """Forces of the tests, each of a specimen of its own."""
    return [Damper(MGMM, TABLE_4_2).force(T, u) for u in motions()]


def campaign_of(folder: Path, forces: list[np.ndarray], extremes: Extremes | None = None) -> Campaign:
    random = np.random.default_rng(5)
    tests = [
        DamperTest(
            f"test_{i}", T, u, f + NOISE * random.standard_normal(T.size), 20.0, use="validate" if i == 3 else "fit"
        )
        for i, (u, f) in enumerate(zip(motions(), forces, strict=True))
    ]
    choice = LawChoice("mgmm", "thesis_table_4_2", extremes=extremes)
    return write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, choice)


def predicted(problem: DamperProblem) -> list[np.ndarray]:
    whole = problem.full_rate
    (found,) = whole.model((), ("fit", "validate")).forces(np.array([[one.centre for one in whole.base]]))
    assert isinstance(found, list)
    return found


def test_lasting_extremes_are_those_of_one_history(tmp_path: Path) -> None:
    forces = one_history()
    fresh, lasting = (
        predicted(damper_problem(campaign_of(tmp_path / one, forces, one), threads=1)) for one in ("fresh", "lasting")
    )
    peak = max(float(np.max(np.abs(force))) for force in forces)
    # motion that is freed from (no) noise, splines of each test by themselves
    assert all(np.max(np.abs(p - f)) < 1e-3 * peak for p, f in zip(lasting, forces, strict=True))
    assert np.max(np.abs(fresh[2] - forces[2])) > 0.05 * peak  # the small test after the large one


@pytest.mark.parametrize(
    ("forces", "labels"), [(one_history, ["extremes.lasting"]), (each_fresh, [])], ids=["lasting", "fresh"]
)
def test_whether_extremes_last_is_found(tmp_path: Path, forces, labels: list[str]) -> None:  # noqa: ANN001
    found = calibrate(campaign_of(tmp_path, forces()), threads=1)
    assert [effect.label for effect in found.effects] == labels
    assert found.verdict == ("explained" if labels else "none")
    assert found.errors["corrected"].validate < 1.2 * found.noise_floor


def test_extremes_between_samples_are_those_of_the_cubics() -> None:
    # a sine at 8 samples a cycle, whose peaks lie between them: cubics meet it to (pi/4)^4 / 384 = 1e-3
    t = (np.arange(25) + 0.5) / 8.0
    w = 2.0 * np.pi
    motion = Motion(t, np.sin(w * t), w * np.cos(w * t), -(w**2) * np.sin(w * t))
    found = motion.extremes
    assert found == pytest.approx((1.0, -1.0, w, -w), rel=1e-2)
    assert found[0] > np.max(motion.displacement) * 1.05 and found[2] > np.max(motion.velocity) * 1.05


def test_a_campaign_says_whether_extremes_last(tmp_path: Path) -> None:
    campaign_of(tmp_path, one_history(), extremes="lasting")
    path = tmp_path / "campaign.yaml"
    campaign = load_campaign(path)
    assert campaign.law is not None and campaign.law.extremes == "lasting"
    assert damper_problem(campaign).lasting
    path.write_text(path.read_text(encoding="utf-8").replace("lasting", "for ever"), encoding="utf-8")
    with pytest.raises(InputError, match="fresh.*E-VALUE-03"):
        load_campaign(path)
