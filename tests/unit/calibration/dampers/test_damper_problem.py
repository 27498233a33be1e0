"""The problem of damper tests: base parameters, batches, threads, which effects the core takes."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from damper_problems import LAW_VALUES, problem

from edesign.calibration.dampers.effect import REFINED
from edesign.core.damper import CoreDamper
from edesign.damper.damper import Damper
from edesign.damper.fitting.identifiable import as_held
from edesign.damper.laws import LAWS
from edesign.estimation.least_squares import fit
from edesign.estimation.model import PredictionError, predict_near
from edesign.estimation.noise import Noise


@pytest.mark.parametrize(
    ("law", "names"),
    [
        ("kelvin_voigt", ["k", "c"]),
        ("bouc_wen", ["Fy", "Y", "alpha", "beta", "n"]),
        ("mgmm", ["k1", "c1", "k0", "c_NL", "alpha", "k_a", "k_b", "u_ref", "c_a", "c_b", "v_ref"]),
    ],
)
def test_the_law_has_priors_about_what_is_declared_but_for_what_others_make_needless(law, names):
    base = problem(law).base
    assert [one.name for one in base] == names
    for one in base:
        assert one.centre == LAW_VALUES[law][one.name]
        # beta of Bouc-Wen may be negative: its value is normal, not its logarithm
        expected = (0.3 * 0.5, False) if one.name == "beta" else (0.3, True)
        assert (one.spread, one.logarithmic) == expected


def hardening_loops(displacement: np.ndarray, force: float, length: float) -> np.ndarray:
    """Return Bouc-Wen loops (n,) N with beta = -1.1 and gamma = 0.8, as in the benchmark of Noel & Schoukens (2016)."""
    z, found = 0.0, []
    for du in np.diff(displacement, prepend=0.0):
        z += (1.0 - (0.8 * np.sign(du) * np.sign(z) - 1.1) * abs(z)) * du / length
        found.append(force * z)
    return np.array(found)


def test_bouc_wen_that_data_make_harden_does_not_lose_its_strength():
    """beta + gamma = A is held. Loops that harden want less than nothing of it: beta falls, from everywhere alike."""
    tests = problem("bouc_wen", values={"n": 1.0})
    hard = [replace(one, force=hardening_loops(one.motion.displacement, 2e4, 3e-3)) for one in tests.experiments]
    tests = tests.with_experiments(hard)
    model = tests.model(())
    beta = [one.name for one in model.parameters].index("beta")
    assert (model.parameters[beta].lower, model.parameters[beta].upper) == (-10.0, pytest.approx(1.0))
    noise = Noise.of_first_fit((10.0,) * 3, tests.sizes)
    found = [fit(model, noise, np.array(start), 60) for start in ([0.0] * 5, [1.0, 1.0, -1.0, -3.0, 1.0])]
    strengths = [tests.law_values(one.values)["Fy"] for one in found]
    assert strengths[0] == pytest.approx(strengths[1], rel=1e-2)
    assert strengths[0] > max(float(np.max(np.abs(one.force))) for one in hard)
    # a search ends where a step promises 0.05 of the objective
    one, other = (sum(float(r @ r) for r in one.weighted().residuals) + float(one.z @ one.z) for one in found)
    assert abs(one - other) < 1.0


def test_bouc_wen_is_declared_in_any_unit_of_z_and_fitted_with_z_of_one():
    """z = s z': Y and Fy s times, beta and gamma s^n times as large have the same force (Wen 1976)."""
    law, own = LAWS["bouc_wen"], {**LAW_VALUES["bouc_wen"], "A": 2.0, "beta": 0.3, "gamma": 1.2, "n": 1.7}
    other = as_held(law, own)
    assert other["beta"] + other["gamma"] == pytest.approx(2.0) and other["beta"] / other["gamma"] == pytest.approx(
        0.25
    )
    t = np.arange(0.0, 4.0, 0.005)
    u, v = 5e-3 * np.sin(5.0 * t), 25e-3 * np.cos(5.0 * t)
    one, two = (Damper(law, values).core.force(t, u, v) for values in (own, other))
    np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-9 * np.max(np.abs(one)))
    assert np.max(np.abs(two - own["alpha"] * own["Fy"] / own["Y"] * u)) < (1.0 - own["alpha"]) * other["Fy"]


def test_zeros_that_an_mgmm_declares_are_fixed_where_others_make_them_needless():
    names = [one.name for one in problem("mgmm", values={"k0": 0.0, "c_b": 0.0}).base]
    assert "k0" not in names and "c_b" not in names


def test_a_law_that_is_not_to_be_fitted_has_no_parameters():
    fixed = problem(refit=False)
    assert fixed.model(()).parameters == ()
    (found,) = fixed.model(()).predict(np.zeros((1, 0)))
    (weights, *_) = fixed.model(()).weights  # 0 at the end, which is in motion
    # the force is made with the velocity of a spline, the prediction with the exact one
    assert found[0] == pytest.approx(weights * fixed.experiments[0].force, abs=1e-5 * fixed.typical.force)


@pytest.mark.parametrize("law", ["kelvin_voigt", "mgmm", "bouc_wen"])
def test_predictions_do_not_depend_on_how_sets_are_split_nor_on_threads_nor_on_what_is_kept(law):
    def sets(tests) -> tuple[object, np.ndarray]:
        chosen = [
            one for one in tests.effects if one.label in ("lag.delay", "mullins.path", "gain.force", "payne.elastic")
        ]
        random = np.random.default_rng(1)
        model = tests.model(chosen, ("fit", "validate"))
        start = [one.centre for one in tests.base] + [v for one in chosen for v in one.starts[0]]
        values = np.array(start) * np.exp(0.05 * random.standard_normal((7, len(start))))
        values[3] = values[1]  # a set that comes twice
        return model, values

    model, values = sets(problem(law, degrees=(20.0, 30.0), threads=1))
    expected = [of_test for of_set in model.predict(values) for of_test in of_set]
    for threads in (1, 2, 3):
        for split in (1, 2, 7):
            again, _ = sets(problem(law, degrees=(20.0, 30.0), threads=threads))
            found = [f for part in np.array_split(values, split) for of_set in again.predict(part) for f in of_set]
            found_kept = [f for part in np.array_split(values, split) for of_set in again.predict(part) for f in of_set]
            assert all(np.array_equal(a, b) for a, b in zip(found, expected, strict=True))
            assert all(np.array_equal(a, b) for a, b in zip(found_kept, expected, strict=True))


@pytest.mark.parametrize("law", ["mgmm", "bouc_wen"])
def test_changes_near_a_set_are_those_of_predictions_in_longer_steps(law):
    whole = problem(law)
    tests = whole.with_experiments([one.thinned() for one in whole.experiments])
    assert any(one.parts(0.5 * REFINED) < one.parts(REFINED) for one in tests.experiments)
    (rig,) = (one for one in tests.effects if one.label == "series_flexibility.linear")
    model = tests.model((rig,))
    around = np.array([*(one.centre for one in tests.base), *rig.starts[0]])
    values = around * (1.0 + 1e-3 * np.eye(around.size))
    (here,) = model.predict(around[np.newaxis])
    same, *moved = predict_near(model, np.vstack((around, values)), around, here)
    assert all(np.array_equal(a, b) for a, b in zip(same, here, strict=True))
    for rough, fine in zip(moved, model.predict(values), strict=True):
        error, change = (
            np.linalg.norm(np.concatenate([a - b for a, b in zip(fine, other, strict=True)])) for other in (rough, here)
        )
        # differences steer a search, they are no result; 1.4 % of the change is the most here, that of the rig
        assert error < 0.05 * change


def test_tests_that_are_compared_only_are_predicted_too():
    tests = problem()
    base = np.array([[one.centre for one in tests.base]])
    (every,) = tests.model((), ("fit", "validate")).forces(base)
    (fitted,) = tests.model(()).forces(base)
    assert len(every) == 4 and len(fitted) == 3
    assert all(np.array_equal(a, b) for a, b in zip(every, fitted, strict=False))


def test_a_set_without_a_prediction_says_why_and_leaves_the_others_alone():
    tests = problem(tests=5, degrees=(20.0, 40.0))
    effect = next(one for one in tests.effects if one.label == "ageing.linear")
    base = [one.centre for one in tests.base]
    good, bad = tests.model((effect,)).predict(np.array([[*base, 0.01], [*base, -2.0]]))
    assert isinstance(bad, PredictionError) and "factor" in str(bad)
    assert all(np.all(np.isfinite(one)) for one in good)


def test_laws_are_offered_what_the_core_takes_with_them():
    labels = {law: {one.label for one in problem(law, degrees=(20.0, 30.0)).effects} for law in LAW_VALUES}
    assert "payne.whole_inside" in labels["mgmm"] and "payne.whole_inside" not in labels["kelvin_voigt"]
    assert "temperature_law.gamma" in labels["mgmm"] and "temperature_law.gamma" not in labels["bouc_wen"]
    assert all("payne.whole" in own and "series_flexibility.linear" in own for own in labels.values())


def test_samples_that_are_not_judged_have_no_weight_and_the_others_stand_for_them():
    from dataclasses import replace

    from edesign.damper.testing.start import Start

    tests = problem()
    first = replace(tests.experiments[0], start=Start(1e-3, 0.0, 1.0, True))
    started = tests.with_experiments([first, *tests.experiments[1:]])
    weights = started.model(()).weights[0]
    judged = slice(250, -3)  # the record ends in motion
    assert np.all(weights[judged] == weights[250]) and not np.any(weights[:250]) and not np.any(weights[-3:])
    assert math.isclose(float(weights @ weights), weights.size)


def test_a_softened_specimen_stays_so_where_extremes_last():
    fresh, lasting = (problem("mgmm", lasting=one) for one in (False, True))
    base = np.array([[one.centre for one in fresh.base]])
    (one,), (other,) = (tests.model((), ("fit", "validate")).forces(base) for tests in (fresh, lasting))
    assert np.array_equal(one[0], other[0])
    # the fourth test is far smaller than the third one
    assert np.max(np.abs(other[3])) < 0.95 * np.max(np.abs(one[3]))


def test_extremes_that_last_are_those_of_the_specimen_behind_its_rig():
    """Equilibrium: the law, moved as the spring leaves it and softened by how it moved before, has its force."""
    tests, stiffness = problem("mgmm", lasting=True), 5e6
    effect = next(one for one in tests.effects if one.label == "series_flexibility.linear")
    values = np.array([[*(one.centre for one in tests.base), stiffness]])
    (forces,) = tests.model((effect,), ("fit", "validate")).forces(values)
    prior = (0.0, 0.0, 0.0, 0.0)
    for one, force in zip(tests.experiments, forces, strict=True):
        time = one.motion.time
        moved = one.motion.displacement - force / stiffness
        law = CoreDamper("mgmm", tuple(LAWS["mgmm"].complete(tests.declared).values()), prior_extremes=prior)
        speed = np.gradient(moved, time)
        error = law.force(time, moved, speed) - force
        assert np.max(np.abs(error)) < 5e-3 * np.max(np.abs(force))
        most = [float(f(x)) for x in (moved, speed) for f in (np.max, np.min)]
        prior = tuple(f(a, b) for f, a, b in zip((max, min, max, min), prior, most, strict=True))


def test_lasting_extremes_are_an_effect_of_laws_that_they_soften():
    fresh, lasting = (problem("mgmm", lasting=one) for one in (False, True))
    (effect,) = [one for one in fresh.effects if one.name == "extremes"]
    assert "extremes" not in {one.name for one in (*lasting.effects, *problem().effects)}
    base = np.array([[one.centre for one in fresh.base]])
    (one,), (other,) = fresh.model((effect,)).forces(base), lasting.model(()).forces(base)
    assert all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))


def test_an_error_of_the_thermometer_is_a_share_of_each_test():
    tests = problem(degrees=(20.0, 30.0))
    effect = next(one for one in tests.effects if one.label == "temperature_law.exponential")
    model, b = tests.model((effect,)), 0.03
    values = np.array([*(one.centre for one in tests.base), b])
    (forces,) = model.forces(values)
    for column, force, weights in zip(model.nuisance_columns(values), forces, model.weights, strict=True):
        # 0.2 K of a resistor of class A
        assert column[:, 0] == pytest.approx(weights * force * np.expm1(-0.2 * b), abs=1e-9 * tests.typical.force)
    assert tests.model(()).nuisance_columns(values[:2]) == [None] * 3
    assert (
        problem("mgmm").model(()).nuisance_columns(np.array([one.centre for one in problem("mgmm").base])) == [None] * 3
    )
    warm = problem("mgmm", degrees=(20.0, 30.0))
    assert warm.model(()).nuisance_columns(np.array([one.centre for one in warm.base]))[0].shape == (750, 1)
