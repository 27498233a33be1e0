"""When a model is better than another by more than chance, and what equations may miss, on a linear problem."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_problem import linear, model_of

from edesign.calibrate.evidence import Evidence, Judged, compare, simplest
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.misses import may_miss


def test_an_effect_that_is_there_is_beyond_chance_and_one_that_is_not_is_not() -> None:
    problem = linear(hidden={"x": 0.5})
    model = model_of(problem)
    rival = Judged(fit(model, np.ones(3)))
    by_name = {c.name: c for c in problem.candidates([])}
    models = {
        name: Judged(fit(replace(model, effects=(by_name[name],)), np.array([1.0, 1.0, 1.0, 0.1]))) for name in "xyz"
    }
    assert compare(models["x"], rival).beyond_chance
    # what is left is less than a fifth of the noise, by chance: its excess was a quarter of the noise
    assert compare(models["x"], rival).share > 0.7
    assert not compare(models["y"], rival).beyond_chance
    assert simplest([models["y"], models["x"], rival]) is models["x"]
    assert simplest([models["y"], rival]) is rival


@pytest.mark.parametrize(
    ("share", "bic", "better"), [(0.3, 20.0, True), (0.2, 20.0, False), (0.3, 9.0, False), (-0.1, 99.0, False)]
)
def test_of_forms_of_one_effect_mean_and_criterion_decide(share: float, bic: float, better: bool) -> None:
    # t of 0.5: one test tells, the others do not agree, which no new effect may rest on
    evidence = Evidence(share, 0.5, bic, 1, 8)
    assert evidence.better_form is better
    assert not evidence.beyond_chance


@pytest.mark.parametrize(("share", "t", "expected"), [(0.95, 0.98, True), (0.85, 0.98, False), (0.95, 0.6, False)])
def test_what_one_test_alone_shows_may_cost_the_others_a_little(share: float, t: float, expected: bool) -> None:
    # gains (g, -c, ..., -c) of n tests: t = (g - (n - 1) c) / sqrt(g^2 + (n - 1) c^2) is below 1 for any c
    assert Evidence(share, t, 1e3, 4, 8).beyond_chance is expected


def test_what_equations_may_miss_is_a_share_of_what_they_do() -> None:
    problem = linear(seed=13, hidden={"x": 40.0})
    (x,) = [c for c in problem.candidates(()) if c.name == "x"]
    model = Model(problem, (1.0,) * 6, (x,))
    judged = Judged(fit(model, model.coordinates()))
    loop = Loop(problem, (1.0,) * 6, workers=1)
    fitted = [column for column, use in zip(problem.columns["x"], problem.uses, strict=True) if use == "fit"]
    done = 40.0**2 * sum(float(column @ column) for column in fitted)
    loop.bench.left = judged.fitted.residuals
    assert may_miss(judged, loop.bench.left) == pytest.approx(5e-4 * done, rel=0.01)  # 40 is told to 4 / sqrt(1000)
    # a share of what the refitted law leaves, if that is more: 1 % of ten times what the effect does
    loop.bench.left = tuple(10.0**0.5 * 40.0 * column for column in fitted)
    assert may_miss(judged, loop.bench.left) == pytest.approx(0.1 * done, rel=0.01)


def test_what_is_each_tests_own_has_no_misses_that_another_effect_could_make_up_for() -> None:
    # x takes three columns out of each test, in which the data have much: what is left beside them counts alone
    problem = linear(seed=13, hidden={"y": 40.0})
    random = np.random.default_rng(1)
    own = [random.standard_normal((200, 3)) for _ in problem.uses]
    measured = tuple(m + columns @ np.full(3, 1e3) for m, columns in zip(problem.measured, own, strict=True))
    problem = replace(problem, own={"x": own}, measured=measured)
    noise = (1.0,) * 6
    x, y, _ = problem.candidates(())
    declared = Judged(fit(Model(problem, noise, held=True), np.empty(0)))
    model = Model(problem, noise, (x, y))
    loop = Loop(problem, noise, workers=1)
    loop.bench.left = declared.fitted.residuals
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    done = 40.0**2 * sum(float(problem.columns["y"][i] @ problem.columns["y"][i]) for i in fitted)
    assert declared.fitted.chi2 > 1e3 * done
    # 1 % of what y does, but for the share of 3 columns of 200 values and of x's own column
    assert may_miss(Judged(fit(model, model.coordinates())), loop.bench.left) == pytest.approx(0.01 * done, rel=0.1)
