"""One step ahead on linear problems in which the best effect alone is none of the two that are hidden."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of, of_labels

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import fit
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.screening import screen
from edesign.calibrate.search.workbench import NONE

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
    alone = [Judged(fit(one.fitted.model, one.fitted.x)) for one in (_with(bare, name) for name in "zxy")]
    best = min(alone, key=lambda judged: judged.fitted.chi2)
    assert best.names == ("z",) and best.fitted.reduced == pytest.approx(2.0 / 3.0 * SIZE**2, rel=0.1)
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.bench.rivals[NONE, held] = alone
    loop.bench.beside_refit = screen(bare.fitted, problem.candidates([]))
    found = loop.ahead.two(best)
    assert found is not None and found.names == ("x", "y")
    assert found.at_floor and found.fitted.model.held == held


def test_nothing_is_looked_for_ahead_where_the_best_effect_promises_the_floor() -> None:
    # z is most of x: with y beside it a hundredth of the noise is left, of x and y nothing
    problem = linear(seed=3, hidden={"x": SIZE, "y": SIZE})
    problem.columns["z"] = [x + 1e-2 * y for x, y in zip(problem.columns["x"], problem.columns["y"], strict=True)]
    alone = [of_labels(problem, label) for label in ("z.only", "x.only", "y.only")]
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.bench.rivals[NONE, False] = alone
    model = model_of(problem)
    loop.bench.beside_refit = screen(fit(model, model.coordinates()), problem.candidates([]))
    assert loop.ahead.two(alone[0]) is None
    assert loop.ahead.two(of_labels(problem, "x.only", "y.only")) is None  # nor beside two


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


def _with(bare: Judged, name: str) -> Judged:
    model = bare.fitted.model
    (candidate,) = (c for c in model.problem.candidates([]) if c.name == name)
    model = replace(model, effects=(candidate,))
    return Judged(fit(model, model.coordinates()))
