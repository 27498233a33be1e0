"""Residuals of a test are weighted by its noise and by what a model leaves: closed forms, and a numpy least squares."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from damper_problems import problem
from scipy.optimize import least_squares

from edesign.calibration import calibrate
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.testing.campaign import Campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.specimen import Specimen

C, ALPHA, SPRING = 3.0e4, 0.4, 2.0e6  # N (s/m)^alpha, -, N/m: the spring is in no law of a dashpot
NOISE = 4e-6  # m, of the displacement: it makes force where the dashpot is slow


def motion(amplitude: float, frequency: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, displacement and velocity of a sine."""
    t = np.arange(0.0, 4.0, 0.005)
    w = 2.0 * np.pi * frequency
    return t, amplitude * np.sin(w * t), amplitude * w * np.cos(w * t)


def made(folder: Path, stuck: range = range(0)) -> tuple[Campaign, list[tuple[np.ndarray, np.ndarray]]]:
    """A campaign of a dashpot of a power beside a spring, and velocity and force of each test.

    Args:
        stuck: samples at which the logger of the second test repeats the reading before them.
    """
    random, tests, known = np.random.default_rng(3), [], []
    for order, of in enumerate(((4e-3, 1.0), (3e-3, 2.0), (5e-3, 0.75), (4e-3, 1.5))):
        t, u, v = motion(*of)
        force = C * np.sign(v) * np.abs(v) ** ALPHA + SPRING * u + 5.0 * random.standard_normal(t.size)
        read = u + NOISE * random.standard_normal(t.size)
        if order == 1 and stuck:
            read[stuck] = read[stuck[0] - 1]
        use = "fit" if order < 3 else "validate"
        tests.append(DamperTest(f"test_{order + 1:02d}", t, read, force, 20.0, use=use, start="in_motion"))
        known.append((v, force))
    law = LawChoice("viscous_power", {"c": f"{C / 1e3} kN*s^0.4/m^0.4", "alpha": f"{ALPHA}"})
    return write_campaign(folder, Specimen("S", 2, 0.0414, 0.012), tests, law), known


def test_a_test_counts_as_many_samples_as_it_has_however_uneven_its_noise() -> None:
    """One sample of a hundred has a thousand times the noise: those beside it have no more weight than before."""
    (one, *_) = problem().experiments
    local = np.full(one.force.size, 2.0)
    local[::100] = 2000.0
    uneven = replace(one, local_noise=local)
    assert np.mean(uneven.weights**2) == pytest.approx(1.0)
    known = local[one.judged]
    assert np.max(uneven.weights) == pytest.approx(np.sqrt(local.size / np.count_nonzero(known < 3.0)), rel=1e-6)
    # the noise of a weighted residual is the harmonic mean of its power, where it is judged
    assert uneven.weighted_noise == pytest.approx(np.sqrt(known.size / np.sum(known**-2.0)))


def test_what_a_model_leaves_evens_weights_out() -> None:
    (one, *_) = problem().experiments
    local = np.where(np.arange(one.force.size) % 2, 3.0, 30.0)
    noisy, known = replace(one, local_noise=local).weighed(40.0), np.array([40.0**2 + 30.0**2, 40.0**2 + 3.0**2])
    assert noisy.weights[0] / noisy.weights[1] == pytest.approx(np.sqrt(known[1] / known[0]))
    assert replace(one, local_noise=local).weights[0] == pytest.approx(0.1 * replace(one, local_noise=local).weights[1])


def test_the_share_that_a_model_leaves_is_found_beside_uneven_noise() -> None:
    tests, random = problem(), np.random.default_rng(1)
    local = [np.where(np.arange(one.force.size) % 4, 1.0, 50.0) for one in tests.experiments]
    tests = tests.with_experiments(
        [replace(one, local_noise=n) for one, n in zip(tests.experiments, local, strict=True)]
    ).weighed(0.1**2)
    left = []
    for i in tests.fitted:
        one = tests.experiments[i]
        discrepancy = 0.07 * one.rms_force * random.standard_normal(one.force.size)
        left.append(one.weights * (discrepancy + local[i] * random.standard_normal(one.force.size)))
    assert np.sqrt(tests.share_of(left)) == pytest.approx(0.07, rel=0.05)


def test_a_spell_of_readings_that_repeat_gives_the_other_samples_no_more_weight(tmp_path: Path) -> None:
    """A logger that repeats a reading makes jumps of the motion; what is not known there is of few samples."""
    tests, known = made(tmp_path, range(300, 304))
    sizes = damper_problem(tests, 1).sizes
    assert sizes == pytest.approx([np.sqrt(np.mean(force**2)) for _, force in known[:3]], rel=0.1)


def test_a_law_that_misses_something_fits_as_least_squares_do(tmp_path: Path) -> None:
    """Noise of the motion is far more where the dashpot is slow; what the law leaves is as much at all times.

    Reference: least squares of scipy along the true velocities.
    """
    tests, known = made(tmp_path)
    found = calibrate(tests, replace(SETTINGS, depth=0), threads=1)

    def left(p: np.ndarray, among: slice) -> np.ndarray:
        return np.concatenate([f - p[0] * np.sign(v) * np.abs(v) ** p[1] for v, f in known[among]])

    careful = least_squares(left, (C, ALPHA), x_scale=(C, ALPHA), args=(slice(0, 3),)).x
    (_, force), error = known[3], left(careful, slice(3, 4))
    assert found.errors["refit"].validate < 1.1 * float(error @ error) / float(force @ force)
