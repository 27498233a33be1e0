"""Signatures of effects, alone and in pairs, against the fits of a linear problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from linear_problem import linear, model_of, of_labels

from edesign.calibrate.fit import Fitted, fit
from edesign.calibrate.problem import Candidate
from edesign.calibrate.search import workbench
from edesign.calibrate.search.contest import likely_forms, shortlist
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.pairs import joint_gains, likely_pairs
from edesign.calibrate.search.screening import Screen, Seen, Signature, promised, screen, screen_again


def test_screening_tells_what_a_fit_would_gain() -> None:
    problem = linear(hidden={"x": 0.5, "y": 0.05})
    rival = fit(model_of(problem), np.ones(3))
    signatures = screen(rival, problem.candidates([]))
    assert signatures[0].candidate.name == "x"
    for signature in signatures:
        fitted = fit(signature.model, signature.start)
        # the belief of two parts in a thousand of the data's weight is in one cost and not in the other
        assert signature.gain == pytest.approx(rival.chi2 - fitted.chi2, rel=0.02, abs=0.2)


def test_signatures_beside_the_law_as_declared_tell_what_a_fit_of_that_law_too_would_gain() -> None:
    problem = linear(hidden={"x": 0.5, "y": 0.05})
    held = replace(model_of(problem), held=True)
    beside_declared = screen(fit(held, held.coordinates()), problem.candidates([]))
    unfitted = fit(model_of(problem), np.ones(3), most_steps=0)
    found = {s.candidate.name: s for s in screen_again(unfitted, beside_declared)}
    for expected in screen(unfitted, problem.candidates([])):
        signature = found[expected.candidate.name]
        # slopes by differences of numbers of 1e1 over steps of 1e-4 or more
        assert signature.gain == pytest.approx(expected.gain, rel=1e-6)
        np.testing.assert_allclose(signature.start, expected.start, rtol=1e-6)
        assert signature.model == expected.model


def test_two_effects_gain_what_both_columns_gain() -> None:
    problem = linear(hidden={"x": 0.3, "y": 0.3})
    rival = fit(model_of(problem), np.ones(3))
    signatures = {s.candidate.name: s for s in screen(rival, problem.candidates([]))}
    whole = Screen(rival)
    columns = whole.free(np.column_stack([np.concatenate(problem.columns[n][:5]) for n in "xy"]))
    residual = whole.free(whole.residual)
    left = residual - columns @ np.linalg.lstsq(columns, residual, rcond=None)[0]
    expected = float(residual @ residual - left @ left)
    pair = [signatures["x"], signatures["y"]]
    assert joint_gains(rival, pair)[0, 1] == pytest.approx(expected, rel=1e-6)
    assert likely_pairs(rival, pair, 3) == [tuple(pair)]
    assert likely_pairs(rival, [pair[0], pair[0]], 3) == []  # one effect is no pair


def test_slow_effects_do_not_hide_what_others_would_gain() -> None:
    # all is linear: what a candidate changes is the same with and without the slow effect
    problem = linear(hidden={"x": 0.5, "y": 0.5})
    x, y, _ = problem.candidates([])
    model = replace(model_of(problem), effects=(x,))
    fitted = fit(model, np.array([1.0, 1.0, 1.0, 0.5]))
    slow = replace(model, effects=(replace(x, slow=True),))
    (exact,) = screen(fitted, [y])
    (quick,) = screen(fit(slow, fitted.x), [y])
    assert quick.gain == pytest.approx(exact.gain, rel=1e-6)
    np.testing.assert_allclose(quick.start, exact.start, rtol=1e-6)


def test_likely_forms_are_the_best_and_the_simplest_that_is_nearly_as_good() -> None:
    problem = linear(hidden={"x": 0.5})
    (signature, *_) = screen(fit(model_of(problem), np.ones(3)), problem.candidates([]))
    (a,) = signature.candidate.unknowns

    def form(name: str, gain: float, unknowns: int) -> Signature:
        candidate = replace(signature.candidate, form=name, unknowns=(a,) * unknowns)
        return replace(signature, candidate=candidate, gain=gain)

    forms = [form("rich", 100.0, 4), form("richer", 99.0, 5), form("simple", 91.0, 1), form("poor", 50.0, 1)]
    assert [s.candidate.form for s in likely_forms(forms, 2)] == ["rich", "simple"]
    assert [s.candidate.form for s in likely_forms(forms, 4)] == ["rich", "richer", "simple", "poor"]
    assert [s.candidate.form for s in shortlist(forms)] == ["rich", "simple"]


def test_what_could_explain_little_beside_an_effect_is_not_screened_again(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = linear(hidden={"x": 2.0, "y": 0.5})
    bench = Loop(problem, (1.0,) * 6, workers=1).bench
    held = replace(model_of(problem), held=True)
    bench.beside_declared = screen(fit(held, held.coordinates()), problem.candidates([]))
    one = of_labels(problem, "x.only").fitted
    pool = [candidate for candidate in problem.candidates([]) if candidate.name != "x"]
    every = {s.candidate.name: s.gain for s in bench.screened(one, pool)}
    asked: list[int] = []

    def counted(fitted: Fitted, candidates: Sequence[Candidate], seen: Seen) -> list[Signature]:
        asked.append(len(candidates))
        return screen(fitted, candidates, seen)

    monkeypatch.setattr(workbench, "_SCREENED", 1)
    monkeypatch.setattr(workbench, "screen", counted)
    some = {s.candidate.name: s.gain for s in bench.screened(one, pool)}
    assert asked == [1] and max(some, key=lambda name: some[name]) == "y"
    assert some == pytest.approx(every, rel=1e-3, abs=1e-3 * max(every.values()))  # all is linear here


def test_another_form_promises_what_its_fit_gains() -> None:
    problem = linear(seed=18, hidden={"x": 2.0})
    problem.columns = {"x.part": problem.columns["y"], "x.whole": problem.columns["x"]}
    current = of_labels(problem, "x.part")
    (whole,) = (c for c in problem.candidates([]) if c.label == "x.whole")
    other = of_labels(problem, "x.whole")
    gain = promised(current.fitted, 0, (whole, np.array([0.3])))
    # beside what the part does: its own column stays free, one number of 1000
    assert gain == pytest.approx(current.fitted.chi2 - other.fitted.chi2, rel=0.01)
    # the declared law's pull is in the fit, not in the estimate
    assert promised(current.fitted, 0, current.fitted.parts[0]) == pytest.approx(0.0, abs=1e-4 * current.fitted.chi2)
