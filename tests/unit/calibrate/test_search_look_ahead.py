"""One step ahead on linear problems in which the best effect alone is none of the two that are hidden."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of, of_labels

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import Candidate
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.screening import screen
from edesign.calibrate.search.workbench import NONE
from edesign.calibrate.unknown import Unknown

SIZE = 30.0  # of x and y, in units of noise


def hidden_behind(like: float) -> LinearProblem:
    """x and y are there; z is their sum and so many times as much of something else. Of SIZE^2 times noise, z alone
    leaves 2 like^2 / (2 + like^2), x or y alone 1, and z with one of them like^2 / (1 + like^2).
    """
    problem = linear(seed=3, hidden={"x": SIZE, "y": SIZE})
    random = np.random.default_rng(4)
    problem.columns["z"] = [
        x + y + like * random.standard_normal(200)
        for x, y in zip(problem.columns["x"], problem.columns["y"], strict=True)
    ]
    return problem


@pytest.mark.parametrize("held", [False, True])
def test_two_effects_are_found_behind_a_third_that_does_more_alone(held: bool) -> None:
    problem = hidden_behind(1.0)
    problem.declared = np.array([1.1, 0.8, 1.3]) if held else problem.declared
    model = replace(model_of(problem), held=held)
    bare = Judged(fit(model, model.coordinates()))
    by_name = {c.name: c for c in problem.candidates([])}
    alone = [_with(model, by_name[name]) for name in "zxy"]
    best = min(alone, key=lambda judged: judged.fitted.chi2)
    assert best.names == ("z",) and best.fitted.reduced == pytest.approx(2.0 / 3.0 * SIZE**2, rel=0.1)
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.bench.rivals[NONE, held] = alone
    loop.bench.beside_refit, loop.bench.left = screen(bare.fitted, problem.candidates([])), bare.fitted.residuals
    found = loop.ahead.two(best)
    assert found is not None and found.names == ("x", "y")
    assert found.at_floor and found.fitted.model.held == held


def test_nothing_is_looked_for_ahead_where_the_best_effect_promises_the_floor() -> None:
    # z is x and a little of y: with y beside it noise is left, as with x and y, which are not fitted then
    problem = linear(seed=3, hidden={"x": SIZE, "y": SIZE})
    problem.columns["z"] = [x + 1e-2 * y for x, y in zip(problem.columns["x"], problem.columns["y"], strict=True)]
    alone = [of_labels(problem, label) for label in ("z.only", "x.only", "y.only")]
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.bench.rivals[NONE, False] = alone
    model = model_of(problem)
    bare = fit(model, model.coordinates())
    loop.bench.beside_refit, loop.bench.left = screen(bare, problem.candidates([])), bare.residuals
    assert loop.ahead.two(alone[0]) is None
    assert loop.ahead.two(of_labels(problem, "x.only", "y.only")) is None  # nor beside two


def test_a_plainer_form_is_tried_beside_others_where_a_finer_one_has_taken_what_is_theirs() -> None:
    # the finer form, of two parameters, is the plainer one with most of y: alone the plainer one leaves SIZE^2, and the
    # finer one a fiftieth of that
    problem = linear(seed=3, hidden={"x": SIZE, "y": SIZE})
    random = np.random.default_rng(4)
    x, y = problem.columns["x"], problem.columns["y"]
    fine = [a + b + 0.2 * random.standard_normal(200) for a, b in zip(x, y, strict=True)]
    problem.columns = {"z.plain": x, "z.fine": fine, "y": y}
    by_label = {c.label: c for c in problem.candidates([])}
    more = (*by_label["z.fine"].unknowns, Unknown("c", "", -1.0, 1.0, 1.0))
    two = replace(by_label["z.fine"], unknowns=more, starts=((0.1, 0.1),))
    plain, current = (_with(model_of(problem), effect) for effect in (by_label["z.plain"], two))
    assert 5.0 < current.fitted.reduced < plain.fitted.reduced / 20.0
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.bench.rivals[NONE, False] = [current, plain]
    loop.bench.beside_refit, loop.bench.left = screen(plain.fitted, [by_label["y.only"]]), plain.fitted.residuals
    found = loop.ahead.two(current)
    assert found is not None and found.at_floor
    assert found.labels == {"z.plain", "y.only"}


@pytest.mark.parametrize(("off", "like"), [(0.0, 1.0), (0.5, 1.0), (0.0, 0.1)])
def test_a_pair_beside_the_law_as_declared_is_taken_where_one_effect_will_not_do(off: float, like: float) -> None:
    # like 0.1: z alone leaves 5.5 times noise, so that in another form it might do
    problem = hidden_behind(like)
    problem.declared = np.array([1.1 + off, 0.8, 1.3 - off])
    model = replace(model_of(problem), held=True)
    loop = Loop(problem, (1.0,) * 6, workers=1)
    held = loop.declared.one(Judged(fit(model, model.coordinates())))
    best = min(held, key=lambda judged: judged.fitted.chi2)
    assert best.names == ("z",)
    found = loop.ahead.beside_declared(best, held, loop.bench.freed(best))
    assert (found is not None) == (like == 1.0)
    if found is not None:
        assert found.names == ("x", "y") and found.at_floor
        assert found.fitted.model.held == (off == 0.0)


@pytest.mark.parametrize("off", [0.0, 0.5])
def test_two_effects_beside_the_law_as_declared_or_fitted_again(off: float) -> None:
    # the law alone can do nothing of x and y; where it is not as declared it is fitted beside them
    problem = hidden_behind(1.0)
    problem.declared = np.array([1.1 + off, 0.8, 1.3 - off])
    told: list[str] = []
    selection = Loop(problem, (1.0,) * 6, workers=1, progress=told.append).run()
    assert sorted(adopted.candidate.name for adopted in selection.adopted) == ["x", "y"]
    assert selection.final.at_floor and selection.final.fitted.model.held == (off == 0.0)
    assert "looking a second effect ahead" in told
    for adopted in selection.adopted:  # five tests of 200 values: four standard errors
        assert adopted.values[0] == pytest.approx(SIZE, abs=4.0 / np.sqrt(1000.0))


def _with(model: Model, effect: Candidate) -> Judged:
    one = replace(model, effects=(effect,))
    return Judged(fit(one, one.coordinates()))
