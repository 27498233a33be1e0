"""What stands in the place of an effect, and what is looked at twice, on a linear problem."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear, model_of, of_labels

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import fit
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.workbench import NONE


@pytest.mark.parametrize("slow", [False, True])
def test_rivals_are_screened_beside_what_stays_unless_that_is_slow(slow: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    problem = linear(seed=20, hidden={"x": 2.0, "y": 2.0})
    two = of_labels(problem, "x.only", "y.only")
    x, y = two.fitted.model.effects
    beside = replace(two.fitted.model, effects=(x, replace(y, slow=slow)))
    loop, asked = Loop(problem, (1.0,) * 6, workers=1), []
    monkeypatch.setattr(loop.bench, "screened", lambda fitted, pool, roughly=False: asked.append(roughly) or [])
    loop.alternatives.others(Judged(fit(beside, two.fitted.x)), x)
    assert asked == [slow]


def test_what_stands_beside_another_form_of_an_effect_is_no_rival_of_it() -> None:
    problem = linear(seed=19, hidden={"x": 2.0})
    problem.columns = {**problem.columns, "x.one": problem.columns["x"], "x.other": problem.columns["z"]}
    del problem.columns["x"]
    loop = Loop(problem, (1.0,) * 6, workers=1)
    both = of_labels(problem, "x.one", "x.other")
    assert loop.alternatives.others(both, both.fitted.model.effects[0]) == []
    beside = of_labels(problem, "x.one", "y.only")
    rivals = loop.alternatives.others(beside, beside.fitted.model.effects[1])
    assert rivals and all(judged.fitted.model.effects[-1].name != "y" for judged in rivals)


def test_of_more_than_two_effects_none_is_held_against_others() -> None:
    told: list[str] = []
    problem = linear(seed=20, hidden={"x": 2.0, "y": 2.0, "z": 2.0})
    loop = Loop(problem, (1.0,) * 6, workers=1, progress=told.append)
    three = of_labels(problem, "x.only", "y.only", "z.only")
    assert loop.alternatives.reconsider(three) is three and loop.forms.reformed(three) is three and not told
    two = of_labels(problem, "x.only", "y.only")
    loop.alternatives.reconsider(two)
    assert told[0] == "reconsidering x"


def test_an_effect_whose_finer_form_does_better_is_not_replaced() -> None:
    # w does more of what is hidden than the coarse form of x does, but a finer form of x is what is hidden
    problem = linear(seed=16, hidden={"x": 2.0, "y": 2.0})
    hidden, other = problem.columns["x"], problem.columns["z"]
    problem.columns["x.fine"] = hidden
    problem.fine = ("x.fine",)
    problem.columns["x"] = [0.6 * a + 0.8 * b for a, b in zip(hidden, other, strict=True)]
    problem.columns["w"] = [0.8 * a - 0.6 * b for a, b in zip(hidden, other, strict=True)]
    loop = Loop(problem, (1.0,) * 6, workers=1)
    current = of_labels(problem, "x.only", "y.only")
    (w,) = (one for one in loop.alternatives.others(current, current.fitted.model.effects[0]) if "w.only" in one.labels)
    assert w.fitted.chi2 < current.fitted.chi2
    assert loop.alternatives.reconsider(current).labels == {"x.fine", "y.only"}
    problem.fine, problem.columns["x.fine"] = (), other  # there is no such form
    again = Loop(problem, (1.0,) * 6, workers=1).alternatives.reconsider(of_labels(problem, "x.only", "y.only"))
    assert again.labels == {"w.only", "y.only"}


def test_an_effect_found_beside_others_stands_against_its_twins_in_the_end() -> None:
    # x and w do the same; only x was tried, as w was not among the best beside the law as declared
    problem = linear(seed=15, hidden={"x": 2.0})
    problem.columns["w"] = problem.columns["x"]
    problem.instruments = ("w",)
    model = replace(model_of(problem), effects=tuple(c for c in problem.candidates([]) if c.name == "x"))
    current = Judged(fit(model, model.coordinates()))
    loop = Loop(problem, (1.0,) * 6, workers=1)
    final = loop.alternatives.against_others(current)
    assert [effect.name for effect in final.fitted.model.effects] == ["w"]
    (adopted,) = loop._explain(final, final)
    assert "x" in adopted.alike
    assert loop.alternatives.against_others(current) is current  # what was done in a round is not done again


def _mixed(problem: LinearProblem, name: str, of: str, share: float, seed: int) -> None:
    """A column that is another one to a share of its power, and else its own."""
    random = np.random.default_rng(seed)
    own = np.sqrt(1.0 - share**2)
    problem.columns[name] = [share * c + own * random.standard_normal(c.size) for c in problem.columns[of]]


def test_what_came_near_takes_the_place_of_two_in_a_finer_form() -> None:
    # hidden is z in a finer form; x and y are like it to 0.9 and nine tenths of what x leaves, the coarse z to 0.9
    problem = linear(seed=3)
    random = np.random.default_rng(2)
    problem.columns = {"z.exact": [random.standard_normal(200) for _ in problem.uses]}
    for name, seed in (("x", 11), ("y", 12), ("z", 13)):
        _mixed(problem, name, "z.exact", 0.9, seed)
    problem.fine = ("z.exact",)
    problem.measured = tuple(m + 20.0 * c for m, c in zip(problem.measured, problem.columns["z.exact"], strict=True))
    by_name = {candidate.name: candidate for candidate in problem.candidates(())}
    loop = Loop(problem, (1.0,) * 6, workers=1)

    def fitted(*names: str) -> Judged:
        model = replace(model_of(problem), effects=tuple(by_name[name] for name in names))
        return Judged(fit(model, model.coordinates()))

    current, near = fitted("x", "y"), fitted("z")
    assert near.fitted.chi2 > 1.5 * current.fitted.chi2 > 1.5 * 2.0 * current.fitted.samples
    assert loop.second.look(current) is None  # nothing came near
    loop.bench.rivals[NONE, False] = [near]
    found = loop.second.look(current)
    assert found is not None and [e.label for e in found.fitted.model.effects] == ["z.exact"] and found.at_floor


def test_two_effects_are_begun_with_one_that_was_not_the_best_alone() -> None:
    # hidden are x and y; what was found first are a and b, each like both of them
    problem = linear(seed=4, hidden={"x": 20.0, "y": 20.0})
    random = np.random.default_rng(5)
    both = [x + y for x, y in zip(problem.columns["x"], problem.columns["y"], strict=True)]
    for name in "ab":
        problem.columns[name] = [c + random.standard_normal(200) for c in both]
    del problem.columns["z"]
    by_name = {candidate.name: candidate for candidate in problem.candidates(())}
    told: list[str] = []
    loop = Loop(problem, (1.0,) * 6, workers=1, progress=told.append)

    def fitted(*names: str) -> Judged:
        model = replace(model_of(problem), effects=tuple(by_name[name] for name in names))
        return Judged(fit(model, model.coordinates()))

    current = fitted("a", "b")
    loop.bench.left = fitted().fitted.residuals
    loop.bench.rivals[NONE, False] = [fitted("a"), fitted("b"), fitted("x")]
    found = loop.second._begun_with_another(current)
    assert found is not None and {e.name for e in found.fitted.model.effects} == {"x", "y"} and found.at_floor
    assert "two effects, x one of them" in told
    assert loop.second._begun_with_another(current) is None  # once


def test_the_last_of_two_effects_too_is_held_against_others_in_the_end() -> None:
    # z came in when something else was missing; y was never begun beside x
    problem = linear(seed=20, hidden={"x": 2.0, "y": 2.0})
    loop = Loop(problem, (1.0,) * 6, workers=1)
    wrong = of_labels(problem, "x.only", "z.only")
    assert loop.alternatives.settled(wrong).names == ("x", "y")
    one = of_labels(problem, "x.only")
    assert loop.alternatives.settled(one) is one
