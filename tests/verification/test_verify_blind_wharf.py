"""The fifth laboratory of the blind tests: its laws, its floors, its sizes, its files."""

import json

import numpy as np
import pytest
import yaml
from scipy.interpolate import CubicSpline

pytest.importorskip("numba")

from blind.laboratories import CATEGORIES, LABORATORIES
from blind.laboratories.judge import judge
from blind.laboratories.wharf import campaign, generate, laws, programme
from blind.laboratories.wharf.effects import KINDS, UNLISTED
from blind.laboratories.wharf.names import NAMES
from blind.laboratories.wharf.write import truth_of

DEVICE = programme.Size(200.0, 40.0, 0.5)


def made(number, seed=1):
    category = CATEGORIES[(number - 1) % len(CATEGORIES)]
    return campaign.draw(category, np.random.default_rng([seed, number, generate.STREAM]))


def path(rate, seconds=6.0):
    """Displacement and velocity in closed form, from rest."""
    t = np.arange(round(seconds * rate) + 1) / rate
    w, s = 2 * np.pi * np.array([0.5, 1.7]), np.minimum(t, 1.0)
    grow, slope = s * s * (3 - 2 * s), np.where(t < 1, 6 * s * (1 - s), 0.0)
    x = 30 * np.sin(w[0] * t) + 9 * np.sin(w[1] * t)
    v = 30 * w[0] * np.cos(w[0] * t) + 9 * w[1] * np.cos(w[1] * t)
    return 1 / rate, grow * x, slope * x + grow * v


def root(values):
    return np.sqrt(np.mean(values**2))


@pytest.mark.parametrize("name", laws.LAWS)
def test_steps_of_laws_are_halved_without_a_difference(name):
    values = programme.parameters(name, DEVICE, np.random.default_rng(4))
    forces = [laws.run(name, values, *path(2400.0 * n))[0].sum(axis=0)[::n] for n in (1, 2, 4)]
    errors = [root(forces[n] - forces[2]) / root(forces[2]) for n in (0, 1)]
    assert errors[0] < 2e-4
    assert errors[1] < max(0.45 * errors[0], 1e-12)


def test_a_dashpot_behind_a_spring_is_a_maxwell_law():
    c, k = 1.2, 30.0
    errors = []
    for rate in (2400.0, 4800.0):
        dt, x, v = path(rate)
        force, u = laws.run_in_series("viscous", np.array([c]), dt, x, k, 0.0, 1e6)
        maxwell = laws.run("maxwell", np.array([c, c / k]), dt, x, v)[0].sum(axis=0)
        errors.append(root(force[:-1] - maxwell[:-1]) / root(maxwell))
        np.testing.assert_allclose(x[:-1] - u[:-1], force[:-1] / k, atol=2e-3 * np.abs(force).max() / k)
    assert errors[0] < 1e-4
    assert errors[1] < 0.3 * errors[0]


def test_a_gap_is_gone_through_without_force_and_a_clamp_slides_at_its_force():
    dt, x, _ = path(2400.0)
    values = np.array([5.0, 0.3])
    force, u = laws.run_in_series("kelvin_voigt", values, dt, x, 1e4, 4.0, 1e6)
    inside = np.abs(x - u) < 1.9
    assert inside.any() and np.abs(force[inside]).max() < 1e-3 * np.abs(force).max()
    assert np.abs(x - u).max() == pytest.approx(2.0, abs=0.05)
    force, u = laws.run_in_series("kelvin_voigt", values, dt, x, 1e4, 0.0, 120.0)
    assert np.abs(force).max() == pytest.approx(120.0, rel=1e-6)
    assert np.abs(np.diff(x - u)[np.abs(force[1:]) < 119.0]).max() < 0.1


def test_campaigns_are_the_same_whatever_the_number_asked_for(tmp_path):
    few = generate.make(tmp_path / "few", 1, 2, ("clean_H",))
    more = generate.make(tmp_path / "more", 1, 9, ("clean_H",))
    assert [folder.name for folder in more] == ["002_clean_H", "009_clean_H"]
    for file in sorted(few[0].iterdir()):
        assert file.read_bytes() == (more[0] / file.name).read_bytes()
    truths = [folder.with_name(folder.name + ".truth.json").read_bytes() for folder in (few[0], more[0])]
    assert truths[0] == truths[1]
    said = yaml.safe_load((few[0] / "campaign.yaml").read_text(encoding="utf-8"))
    for test in said["tests"]:
        table = np.loadtxt(few[0] / test["file"], delimiter=",", skiprows=1)
        assert np.isfinite(table).all() and (np.diff(table[:, 0]) > 0).all()


@pytest.mark.parametrize("number", [2, 9, 23])  # clean_H: viscous, Maxwell, elastic-plastic
def test_the_floor_is_what_the_true_law_leaves_along_the_files(number):
    of = made(number)
    assert not of.effects and not of.in_motion
    left = power = 0.0
    for reading in of.readings:
        if reading.test.use == "validate":
            spline = CubicSpline(reading.time, reading.displacement)
            fine = np.linspace(reading.time[0], reading.time[-1], 20 * (len(reading.time) - 1) + 1)
            law = laws.run(of.law, of.true, fine[1] - fine[0], spline(fine), spline(fine, 1))[0].sum(axis=0)[::20]
            left += np.sum((law - reading.force) ** 2)
            power += np.sum(reading.force**2)
    assert 0.7 < left / power / of.floor**2 < 1.4


@pytest.mark.parametrize("number", [10, 19])  # one effect, two effects, on Kelvin-Voigt
def test_sizes_are_what_a_refit_leaves_over_the_noise(number):
    of = made(number)
    assert len(of.effects) == {"one": 1, "two": 2}[of.category.split("_")[0]]
    for effect, ratio in zip(of.effects, of.ratios, strict=True):
        assert 2.0 <= ratio <= 50.0
        assert campaign.refit(of, campaign.simulate(of, [effect])) / of.noise == pytest.approx(ratio, rel=0.02)


def test_the_truth_has_all_that_the_judge_reads():
    of = made(10)
    truth = truth_of(of, "010_one_F", 1)
    json.dumps(truth, allow_nan=False)
    units = dict(zip(laws.LAWS[of.law].names, laws.LAWS[of.law].units, strict=True))
    plain = [(name, true) for name, true in zip(units, of.true, strict=True) if units[name] in ("kN/mm", "kN*s/mm")]
    assert {name: truth["law_true"]["parameters"][name] for name, _ in plain} == {n: 1e6 * x for n, x in plain}
    validate = [test.name for test in of.tests if test.use == "validate"]
    hidden = [{"name": effect["name"]} for effect in truth["effects"]]
    fitted = {
        n: {"interval": [0.9 * x, 1.1 * x], "standard_error": 1} for n, x in truth["law_true"]["parameters"].items()
    }
    result = {
        "effects": hidden,
        "verdict": "explained",
        "parameters": {"refit": fitted},
        "error": {"corrected": {"validate": truth["noise_floor_validate"] ** 2}},
    }
    score = judge("010_one_F", truth, result, {"seconds": 1.0, "failure": None}, validate)
    assert score["all"] and score["ratio"] == pytest.approx(1.0)
    assert score["inside"] is None  # beside a softening with temperature the law's numbers are a convention


def test_every_effect_has_a_sentence():
    assert "wharf" in LABORATORIES
    assert NAMES.keys() == KINDS.keys() and UNLISTED.keys() < KINDS.keys()
    assert all(len(sentence.split()) <= 25 and sentence.endswith(".") for sentence in NAMES.values())
