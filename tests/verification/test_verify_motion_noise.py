"""Noise of the displacement through a law, at rest and in motion, against records with noise of their own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.floor import Floor
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen
from edesign.estimation.noise import Noise

TESTS = 12
REST = 4.0  # s
FORCE_NOISE, DISPLACEMENT_NOISE = 20.0, 7e-7  # N, m: above what is taken for the least noise of a load cell


def test_noise_is_as_strong_at_rest_as_in_motion_once_weighted(tmp_path: Path) -> None:
    """The MGMM's dashpot |v|^0.37 is steep at rest, where a micrometre of noise would make hundreds of newtons."""
    mgmm = law("mgmm")
    damper = Damper(mgmm, read_parameters(mgmm, "thesis_table_4_2"))
    random = np.random.default_rng(11)
    t = np.arange(0.0, 12.0, 1.0 / 500.0)
    since = np.maximum(t - REST, 0.0)
    tests = []
    for i in range(TESTS):
        u = (3.0 + 0.4 * i) * 1e-3 * (1.0 - np.exp(-since)) ** 2 * np.sin(2.0 * np.pi * 0.9 * since)
        force = damper.force(t, u) + FORCE_NOISE * random.standard_normal(t.size)
        noisy = u + DISPLACEMENT_NOISE * random.standard_normal(t.size)
        tests.append(DamperTest(f"test_{i + 1:02d}", t, noisy, force, 20.0, use="fit" if i % 4 else "validate"))
    choice = LawChoice("mgmm", "thesis_table_4_2")
    campaign = write_campaign(tmp_path, Specimen("S", 2, 0.0414, 0.012), tests, choice)
    problem = damper_problem(campaign, threads=1).full_rate
    (predicted,) = problem.model((), ("fit", "validate")).forces(np.array([[one.centre for one in problem.base]]))
    assert isinstance(predicted, list)
    rest, moving = t < REST - 0.2, t > REST + 1.0
    bare, weighted = [], []
    for one, values in zip(problem.experiments, predicted, strict=True):
        residual = one.force - values
        for found, r in ((bare, residual / one.noise), (weighted, one.weights * residual / one.weighted_noise)):
            found.append([float(np.mean(r[part] ** 2)) for part in (rest, moving)])
    still, fast = np.mean(bare, axis=0)
    assert still == pytest.approx(fast, rel=0.35)  # a rest is held still; before, it had 20 times as much
    # six repetitions determine a power within a tenth of a second, some ten independent values each, to 2 / sqrt(120)
    # = 0.2; noise on top of noise, which is all that a program has, is stronger by at most the two together: sqrt(2)
    assert np.mean(weighted, axis=0) == pytest.approx([1.0, 1.0], rel=0.35)


def test_noise_through_an_effect_counts_where_the_effect_is_known(tmp_path: Path) -> None:
    """Friction of 4 kN that turns within 1 mm/s makes more of eight micrometres than the law does."""
    mgmm = law("mgmm")
    damper = Damper(mgmm, read_parameters(mgmm, "thesis_table_4_2"))
    random = np.random.default_rng(12)
    t = np.arange(0.0, 12.0, 1.0 / 500.0)
    tests = []
    for i in range(6):
        size, w = (2.0 + 0.4 * i) * 1e-3, 2.0 * np.pi * (0.5 + 0.3 * i)
        grow = (1.0 - np.exp(-2.0 * t)) ** 2
        u = size * grow * np.sin(w * t)
        v = np.gradient(u, t)
        force = damper.force(t, u) + 4e3 * np.tanh(v / 1e-3) + FORCE_NOISE * random.standard_normal(t.size)
        noisy = u + 8e-6 * random.standard_normal(t.size)
        tests.append(DamperTest(f"test_{i + 1:02d}", t, noisy, force, 20.0, use="fit" if i % 3 else "validate"))
    choice = LawChoice("mgmm", "thesis_table_4_2")
    campaign = write_campaign(tmp_path, Specimen("S", 2, 0.0414, 0.012), tests, choice)
    problem = damper_problem(campaign, threads=1).full_rate
    (coulomb,) = (one for one in problem.effects if one.label == "friction.coulomb")
    true = np.array([*(one.centre for one in problem.base), 4e3, 1e-3])
    model = unbounded(problem, SETTINGS).fit((coulomb,), true, Noise.white(problem.deviations), 0)
    (forces,) = problem.model((coulomb,), ("fit", "validate")).forces(true[np.newaxis])
    assert model is not None and isinstance(forces, list)
    floor = Floor.under(problem, model, forces)
    ratios = [
        float(np.mean((one.force - f) ** 2)) / noise**2
        for one, f, noise in zip(problem.experiments, forces, floor.noise, strict=True)
    ]
    # six tests differ by a factor of ten, as friction turns a few times in each
    assert 0.6 < float(np.mean(ratios)) < 1.35
