"""Fit, cross-validation, screening and evidence of the loop, against numpy's least squares on a linear problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from linear_problem import LinearProblem, linear

from edesign.calibrate.contest import likely_forms, shortlist
from edesign.calibrate.cross_validation import leave_one_out
from edesign.calibrate.dampers.full_rate import likeliest_doubt
from edesign.calibrate.evidence import Evidence, Judged, compare, simplest
from edesign.calibrate.fit import BELIEF, Model, correlation_length, fit, whitened
from edesign.calibrate.forms import begun_at, begun_from
from edesign.calibrate.loop import Loop
from edesign.calibrate.outcome import predict
from edesign.calibrate.pairs import joint_gains, likely_pairs
from edesign.calibrate.problem import Candidate, Part, Use
from edesign.calibrate.screening import Screen, Signature, screen, screen_again
from edesign.calibrate.unknown import Unknown


def _stacked(problem: LinearProblem, without: int | None = None) -> tuple[np.ndarray, np.ndarray]:
    """Equations of the tests fitted to, and of the belief b = 1 with a standard deviation of BELIEF."""
    rows = [i for i, use in enumerate(problem.uses) if use == "fit" and i != without]
    matrix = np.vstack([problem.matrices[i] for i in rows] + [np.eye(3) / BELIEF])
    right = np.concatenate([problem.measured[i] for i in rows] + [np.ones(3) / BELIEF])
    return matrix, right


def _model(problem: LinearProblem, noise: float = 1.0) -> Model:
    return Model(problem, (noise,) * len(problem.names))


@pytest.mark.parametrize("logarithmic", [True, False])
def test_coordinates_and_values_go_back_and_forth(logarithmic: bool) -> None:
    unknown = Unknown("tau", "s", 1e-3, 50.0, 0.2, logarithmic)
    for value in (1e-3, 0.2, 7.0, 50.0):
        assert unknown.value(unknown.coordinate(value)) == pytest.approx(value, rel=1e-12)
    assert unknown.value(unknown.coordinate(1e3)) == pytest.approx(50.0)  # the bound
    step = 1e-6
    x = unknown.coordinate(3.0)
    slope = (unknown.value(x + step) - unknown.value(x - step)) / (2.0 * step)
    assert unknown.slope(x) == pytest.approx(slope, rel=1e-6)
    assert unknown.span == pytest.approx((unknown.coordinate(1e-3), unknown.coordinate(50.0)))


def test_fit_is_least_squares() -> None:
    problem = linear()
    found = fit(_model(problem), np.ones(3))
    matrix, right = _stacked(problem)
    assert found.x == pytest.approx(np.linalg.lstsq(matrix, right, rcond=None)[0], abs=1e-6)
    # noise of 1: chi2 per sample is 1 within 4 standard deviations of a chi2 of 1000 samples
    assert found.reduced == pytest.approx(1.0, abs=4.0 * np.sqrt(2.0 / 1000.0))
    assert np.sqrt(np.diag(found.covariance)) == pytest.approx(
        np.sqrt(np.diag(np.linalg.inv(matrix.T @ matrix))) * found.misfit, rel=1e-3
    )


def test_noise_that_changes_within_a_test_is_weighted_least_squares() -> None:
    # noise three times as strong in the first half of each test, and an effect that has a share of each test's own
    problem = linear()
    problem.weights = tuple(np.where(np.arange(y.size) < y.size // 2, 1.0 / 3.0, 1.0) for y in problem.measured)
    random = np.random.default_rng(6)
    problem.columns["slow"] = [random.standard_normal(y.size) for y in problem.measured]
    problem.own["slow"] = [random.standard_normal((y.size, 2)) for y in problem.measured]
    (slow,) = (c for c in problem.candidates([]) if c.name == "slow")
    model = replace(_model(problem), effects=(slow,))
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    # all of it at once: the parameters, and two numbers of each test
    blocks = []
    for place, i in enumerate(fitted):
        own = np.zeros((problem.measured[i].size, 2 * len(fitted)))
        own[:, 2 * place : 2 * place + 2] = problem.own["slow"][i]
        columns = [problem.matrices[i], problem.columns["slow"][i][:, np.newaxis], own]
        blocks.append(np.hstack(columns) * problem.weights[i][:, np.newaxis])
    belief = np.hstack([np.eye(3) / BELIEF, np.zeros((3, 1 + 2 * len(fitted)))])
    right = [*(problem.weights[i] * problem.measured[i] for i in fitted), np.ones(3) / BELIEF]
    expected = np.linalg.lstsq(np.vstack([*blocks, belief]), np.concatenate(right), rcond=None)[0]
    found = fit(model, model.coordinates())
    assert found.x == pytest.approx(expected[:4], abs=1e-6)
    # what is taken from a test is what that fit gives it
    errors = predict(problem, Judged(found))
    for place, i in enumerate(fitted):
        own = problem.own["slow"][i] @ expected[4 + 2 * place : 6 + 2 * place]
        shared = problem.matrices[i] @ expected[:3] + expected[3] * problem.columns["slow"][i]
        assert errors[i] == pytest.approx(shared + own, abs=1e-5)


def test_a_condition_in_doubt_is_generalised_least_squares() -> None:
    # noise I + d d^T of each test fitted to, beside the belief in the declared ones
    problem = linear()
    random = np.random.default_rng(5)
    problem.doubts = tuple(3.0 * random.standard_normal(y.size) for y in problem.measured)
    found = fit(_model(problem), np.ones(3))
    total, right, chi2 = np.eye(3) / BELIEF**2, np.ones(3) / BELIEF**2, 0.0
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    inverses = {i: np.linalg.inv(np.eye(d.size) + np.outer(d, d)) for i, d in enumerate(problem.doubts)}
    for i in fitted:
        total += problem.matrices[i].T @ inverses[i] @ problem.matrices[i]
        right += problem.matrices[i].T @ inverses[i] @ problem.measured[i]
    expected = np.linalg.solve(total, right)
    np.testing.assert_allclose(found.x, expected, rtol=1e-6)
    for i in fitted:
        left = problem.measured[i] - problem.matrices[i] @ expected
        chi2 += float(left @ inverses[i] @ left)
    assert found.chi2 == pytest.approx(chi2, rel=1e-9)


@pytest.mark.parametrize(
    ("share", "expected"), [(0.5, 0.25 * 49.0 / 50.0), (-1.9, 3.61 * 49.0 / 50.0), (-10.0, 8.0**2 * 49.0 + 2.0**2)]
)
def test_a_condition_is_not_in_doubt_without_limit(share: float, expected: float) -> None:
    # of a share s of d with |d| = 7 generalised least squares leave s^2 d^2 / (1 + d^2); beyond two all the rest
    doubt, beside = 7.0 * np.array([0.6, 0.0, 0.8]), np.array([0.8, 0.0, -0.6])
    found = whitened(share * doubt + beside, doubt)
    assert found @ found == pytest.approx(expected + 1.0, rel=1e-12)
    assert found @ beside == pytest.approx(1.0, rel=1e-12)


def test_a_bound_holds_and_the_others_find_their_best_place() -> None:
    problem = linear()
    problem.base = (Unknown("b0", "", -1.0, 0.9, 1.0), *problem.base[1:])
    found = fit(_model(problem), np.zeros(3))
    assert found.x[0] == 0.9
    matrix, right = _stacked(problem)
    # the belief about the bounded one is at its bound's distance from 1 whatever the others are
    rest = np.linalg.lstsq(matrix[:, 1:], right - 0.9 * matrix[:, 0], rcond=None)[0]
    assert found.x[1:] == pytest.approx(rest, abs=1e-6)


def test_leaving_a_test_out_is_fitting_the_others() -> None:
    problem = linear()
    found = leave_one_out(fit(_model(problem), np.ones(3)))
    for i in range(5):
        matrix, right = _stacked(problem, without=i)
        b = np.linalg.lstsq(matrix, right, rcond=None)[0]
        expected = float(np.sum((problem.measured[i] - problem.matrices[i] @ b) ** 2))
        assert found.chi2[i] == pytest.approx(expected, rel=1e-6)
    assert float(found.chi2.sum()) > fit(_model(problem), np.ones(3)).chi2


def test_a_step_too_far_without_a_test_is_shortened() -> None:
    # arctan 4 b with b of 0.5 in five tests, of 6 in one of ten times the weight: without that one, a Gauss-Newton step
    # from the flat part, where the fit with it ends, goes far beyond 0.5 and fits the five worse than before
    class Arctan(LinearProblem):
        def predict(self, base: np.ndarray, parts: Sequence[Part], uses: Sequence[Use]) -> list[np.ndarray | None]:
            return [None if y is None else np.arctan(y) for y in super().predict(base, parts, uses)]

    sizes = (20, 20, 20, 20, 20, 1000)
    values = (0.5, 0.5, 0.5, 0.5, 0.5, 6.0)
    measured = tuple(np.arctan(np.full(n, 4.0 * b)) for n, b in zip(sizes, values, strict=True))
    problem = Arctan([np.full((n, 1), 4.0) for n in sizes], {}, measured, ("fit",) * 6)
    found = fit(_model(problem, noise=0.01), np.ones(1))
    alone = sizes[-1] * ((np.arctan(24.0) - np.arctan(2.0)) / 0.01) ** 2  # of a fit to the five
    assert found.residuals[-1] @ found.residuals[-1] < leave_one_out(found).chi2[-1] < 1.1 * alone
    weight = found.hessian - found.slopes[-1].T @ found.slopes[-1]
    whole = float((found.slopes[-1].T @ found.residuals[-1])[0] / weight[0, 0])
    assert whole < -2.0
    (*_, far) = found.model.residuals(found.x + max(whole, -3.0))
    assert far @ far > 5.0 * alone


def test_screening_tells_what_a_fit_would_gain() -> None:
    problem = linear(hidden={"x": 0.5, "y": 0.05})
    rival = fit(_model(problem), np.ones(3))
    signatures = screen(rival, problem.candidates([]))
    assert signatures[0].candidate.name == "x"
    for signature in signatures:
        fitted = fit(signature.model, signature.start)
        # the belief of two parts in a thousand of the data's weight is in one cost and not in the other
        assert signature.gain == pytest.approx(rival.chi2 - fitted.chi2, rel=0.02, abs=0.2)


def test_signatures_beside_the_law_as_declared_tell_what_a_fit_of_that_law_too_would_gain() -> None:
    problem = linear(hidden={"x": 0.5, "y": 0.05})
    held = replace(_model(problem), held=True)
    beside_declared = screen(fit(held, held.coordinates()), problem.candidates([]))
    unfitted = fit(_model(problem), np.ones(3), most_steps=0)
    found = {s.candidate.name: s for s in screen_again(unfitted, beside_declared)}
    for expected in screen(unfitted, problem.candidates([])):
        signature = found[expected.candidate.name]
        # slopes by differences of numbers of 1e1 over steps of 1e-4 or more
        assert signature.gain == pytest.approx(expected.gain, rel=1e-6)
        np.testing.assert_allclose(signature.start, expected.start, rtol=1e-6)
        assert signature.model == expected.model


def test_two_effects_gain_what_both_columns_gain() -> None:
    problem = linear(hidden={"x": 0.3, "y": 0.3})
    rival = fit(_model(problem), np.ones(3))
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
    model = replace(_model(problem), effects=(x,))
    fitted = fit(model, np.array([1.0, 1.0, 1.0, 0.5]))
    slow = replace(model, effects=(replace(x, slow=True),))
    (exact,) = screen(fitted, [y])
    (quick,) = screen(fit(slow, fitted.x), [y])
    assert quick.gain == pytest.approx(exact.gain, rel=1e-6)
    np.testing.assert_allclose(quick.start, exact.start, rtol=1e-6)


def test_likely_forms_are_the_best_and_the_simplest_that_is_nearly_as_good() -> None:
    problem = linear(hidden={"x": 0.5})
    (signature, *_) = screen(fit(_model(problem), np.ones(3)), problem.candidates([]))
    (a,) = signature.candidate.unknowns

    def form(name: str, gain: float, unknowns: int) -> Signature:
        candidate = replace(signature.candidate, form=name, unknowns=(a,) * unknowns)
        return replace(signature, candidate=candidate, gain=gain)

    forms = [form("rich", 100.0, 4), form("richer", 99.0, 5), form("simple", 91.0, 1), form("poor", 50.0, 1)]
    assert [s.candidate.form for s in likely_forms(forms, 2)] == ["rich", "simple"]
    assert [s.candidate.form for s in likely_forms(forms, 4)] == ["rich", "richer", "simple", "poor"]
    assert [s.candidate.form for s in shortlist(forms)] == ["rich", "simple"]


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9])
def test_correlation_length_of_a_first_order_process(rho: float) -> None:
    random = np.random.default_rng(3)
    values = np.empty(40000)
    values[0] = random.standard_normal()
    for i, e in enumerate(random.standard_normal(values.size - 1)):
        values[i + 1] = rho * values[i] + np.sqrt(1.0 - rho**2) * e
    # sum of rho^|k| over all k; the estimate scatters by some per cent for 40000 samples
    assert correlation_length(values) == pytest.approx((1.0 + rho) / (1.0 - rho), rel=0.15)


def test_an_effect_that_is_there_is_beyond_chance_and_one_that_is_not_is_not() -> None:
    problem = linear(hidden={"x": 0.5})
    model = _model(problem)
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
    ("hidden", "found"),
    [({}, []), ({"x": 0.5}, ["x"]), ({"x": 0.9, "z": 0.7}, ["x", "z"]), ({"x": 5.0, "y": 0.3}, ["x"])],
)
def test_the_loop_finds_what_is_hidden(hidden: dict[str, float], found: list[str]) -> None:
    # in the last one the second effect is a 270th of the first in power: what the equations of the first may miss
    problem = linear(seed=5, hidden=hidden)
    selection = Loop(problem, (1.0,) * 6, workers=1).run()
    assert sorted(a.candidate.name for a in selection.adopted) == found
    assert not {candidate.name for candidate, _ in selection.refused} & set(found)
    for adopted in selection.adopted:
        # five tests of 200 values of unit noise and unit columns: a standard error of 1 / sqrt(1000)
        assert adopted.values[0] == pytest.approx(hidden[adopted.candidate.name], abs=4.0 / np.sqrt(1000.0))


@pytest.mark.parametrize(("second", "unknown", "found"), [(3.0, 0.0, ["x", "y"]), (3.0, 3.0, ["x"]), (0.8, 0.0, ["x"])])
def test_a_small_second_effect_must_be_nearly_all_that_is_left(second: float, unknown: float, found: list[str]) -> None:
    # y is a 270th of x in power or less, which the equations of x may miss: all of what is left, half of it, or all of
    # what is less than the noise
    problem = linear(seed=5, hidden={"x": 50.0, "y": second})
    random = np.random.default_rng(6)
    problem.measured = tuple(y + unknown * random.standard_normal(y.size) for y in problem.measured)
    selection = Loop(problem, (1.0,) * 6, workers=1).run()
    assert [adopted.candidate.name for adopted in selection.adopted] == found


@pytest.mark.parametrize(("second", "found"), [(0.7, ["x", "y"]), (0.0, ["x"])])
def test_a_second_effect_is_sought_beside_the_law_as_declared(second: float, found: list[str]) -> None:
    # x is nearly what the law can do, so that the law fitted again takes most of it; the declared law is right
    problem = linear(seed=7)
    random = np.random.default_rng(8)
    problem.columns["x"] = [m @ [1.0, -1.0, 0.5] + 0.7 * random.standard_normal(200) for m in problem.matrices]
    problem.measured = tuple(
        m.sum(axis=1) + 3.0 * x + second * y + random.standard_normal(200)
        for m, x, y in zip(problem.matrices, problem.columns["x"], problem.columns["y"], strict=True)
    )
    told: list[str] = []
    selection = Loop(problem, (1.0,) * 6, workers=1, progress=told.append).run()
    assert [a.candidate.name for a in selection.adopted] == found
    assert selection.final.fitted.model.held
    assert any("beside x and the law as declared" in line for line in told) == (second > 0.0)


def test_two_effects_are_sought_where_one_makes_other_tests_worse() -> None:
    # both are seen in two tests alone, and the law fitted again makes up for the one that is missing: three tests that
    # the declared law explains suffer, so that what x removes, nine tenths, may be chance
    problem = linear(seed=21)
    random = np.random.default_rng(22)
    seen = [1.0 if i in (0, 1, 5) else 0.0 for i in range(6)]
    problem.columns = {
        name: [w * (m @ like + 0.5 * random.standard_normal(200)) for w, m in zip(seen, problem.matrices, strict=True)]
        for name, like in (("x", [1.0, -1.0, 0.5]), ("y", [-0.5, 1.0, 1.0]))
    }
    problem.measured = tuple(
        m.sum(axis=1) + 8.0 * x + 3.0 * y + random.standard_normal(200)
        for m, x, y in zip(problem.matrices, *problem.columns.values(), strict=True)
    )
    free = _model(problem)
    refit, declared = (Judged(fit(model, model.coordinates())) for model in (free, replace(free, held=True)))
    loop = Loop(problem, (1.0,) * 6, workers=1)
    loop.left = declared.fitted.residuals
    found, refused = loop._round(refit, declared)
    (best, evidence), *_ = refused
    assert best.name == "x" and evidence.share > 0.8 and not evidence.adopts
    assert found is not None and sorted(effect.name for effect in found.fitted.model.effects) == ["x", "y"]


def test_an_effect_that_is_a_part_of_another_form_goes() -> None:
    # what is hidden was found as x in a form that lacks a part, and that part as y: x in its whole form is both
    problem = linear(seed=9)
    x, y = problem.columns.pop("x"), problem.columns["y"]
    problem.columns |= {"x.part": x, "x.whole": [a + b for a, b in zip(x, y, strict=True)]}
    problem.measured = tuple(m + 2.0 * w for m, w in zip(problem.measured, problem.columns["x.whole"], strict=True))
    by_label = {c.label: c for c in problem.candidates([])}
    model = replace(_model(problem), effects=(by_label["y.only"], by_label["x.part"]))
    both = Judged(fit(model, model.coordinates()))
    (left,) = Loop(problem, (1.0,) * 6, workers=1)._prune(both).fitted.parts
    assert left[0].label == "x.whole" and left[1][0] == pytest.approx(2.0, abs=4.0 / np.sqrt(2.0 * 1000.0))


@pytest.mark.parametrize(("also", "left"), [(0.0, ["x"]), (0.6, ["w", "x"])])
def test_an_effect_that_stands_for_a_law_not_as_declared_goes(also: float, left: list[str]) -> None:
    # w is roughly what the law is off by; the law fitted again takes its place where it leaves noise alone
    problem = linear(seed=16, hidden={"x": 2.0, "y": also})
    problem.declared = np.array([0.2, 1.1, 1.9])  # 1.1, 0.8 and 1.3 in truth
    random = np.random.default_rng(17)
    problem.columns["w"] = [m @ [0.9, -0.3, -0.6] + 0.8 * random.standard_normal(200) for m in problem.matrices]
    by_name = {c.name: c for c in problem.candidates([])}
    model = replace(_model(problem), effects=(by_name["w"], by_name["x"]), held=True)
    pair = Judged(fit(model, model.coordinates()))
    assert not pair.at_floor
    found = Loop(problem, (1.0,) * 6, workers=1)._last_alone(pair)
    assert [effect.name for effect in found.fitted.model.effects] == left
    assert found.fitted.model.held == (len(left) > 1)


def _of_labels(problem: LinearProblem, *labels: str) -> Judged:
    by_label = {c.label: c for c in problem.candidates([])}
    model = replace(_model(problem), effects=tuple(by_label[label] for label in labels))
    return Judged(fit(model, model.coordinates()))


def test_forms_that_leave_more_than_asked_are_not_fitted_on() -> None:
    problem = linear(seed=18, hidden={"x": 5.0})
    problem.columns = {"x.whole": problem.columns["x"], "x.half": problem.columns["y"]}
    current = _of_labels(problem, "x.half")
    loop = Loop(problem, (1.0,) * 6, workers=1)
    assert loop._other_forms(current, current.fitted.model.effects[0], 0.5 * current.fitted.samples) == []
    loop.compared.clear()
    (found,) = loop._other_forms(current, current.fitted.model.effects[0], 2.0 * current.fitted.samples)
    assert found.fitted.model.effects[0].label == "x.whole"


def test_a_form_that_has_the_parameters_of_another_is_tried_where_that_one_is(monkeypatch: pytest.MonkeyPatch) -> None:
    # though no linear estimate makes it likely
    monkeypatch.setattr("edesign.calibrate.loop.likely_forms", lambda signatures, most: [])
    problem = linear(seed=18, hidden={"x": 2.0})
    problem.columns = {"x.whole": problem.columns["x"], "x.half": problem.columns["y"]}
    current = _of_labels(problem, "x.half")
    (found,) = Loop(problem, (1.0,) * 6, workers=1)._other_forms(current, current.fitted.model.effects[0])
    assert found.fitted.model.effects[0].label == "x.whole"


@pytest.mark.parametrize("slow", [False, True])
def test_rivals_are_screened_beside_what_stays_unless_that_is_slow(slow: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    problem = linear(seed=20, hidden={"x": 2.0, "y": 2.0})
    two = _of_labels(problem, "x.only", "y.only")
    x, y = two.fitted.model.effects
    beside = replace(two.fitted.model, effects=(x, replace(y, slow=slow)))
    loop, asked = Loop(problem, (1.0,) * 6, workers=1), []
    monkeypatch.setattr(loop, "_screened", lambda fitted, pool, roughly=False: asked.append(roughly) or [])
    loop._alternatives(Judged(fit(beside, two.fitted.x)), x)
    assert asked == [slow]


def test_what_stands_beside_another_form_of_an_effect_is_no_rival_of_it() -> None:
    problem = linear(seed=19, hidden={"x": 2.0})
    problem.columns = {**problem.columns, "x.one": problem.columns["x"], "x.other": problem.columns["z"]}
    del problem.columns["x"]
    loop = Loop(problem, (1.0,) * 6, workers=1)
    both = _of_labels(problem, "x.one", "x.other")
    assert loop._alternatives(both, both.fitted.model.effects[0]) == []
    beside = _of_labels(problem, "x.one", "y.only")
    rivals = loop._alternatives(beside, beside.fitted.model.effects[1])
    assert rivals and all(judged.fitted.model.effects[-1].name != "y" for judged in rivals)


def test_of_more_than_two_effects_none_is_held_against_others() -> None:
    told: list[str] = []
    problem = linear(seed=20, hidden={"x": 2.0, "y": 2.0, "z": 2.0})
    loop = Loop(problem, (1.0,) * 6, workers=1, progress=told.append)
    three = _of_labels(problem, "x.only", "y.only", "z.only")
    assert loop._reconsider(three) is three and loop._reformed(three) is three and not told
    two = _of_labels(problem, "x.only", "y.only")
    loop._reconsider(two)
    assert told == ["reconsidering x"]


def test_a_form_begins_where_another_one_with_the_same_parameters_stands() -> None:
    problem = linear(hidden={"x": 0.5})
    own, further = Unknown("a", "", -1e6, 1e6, 1.0), Unknown("p", "", 0.1, 10.0, 3.0, logarithmic=True)
    x = next(c for c in problem.candidates([]) if c.name == "x")
    model = replace(_model(problem), effects=(x,))
    fitted = fit(model, model.coordinates())
    for unknowns, start in (
        ((own, further), (fitted.x[-1], 0.0)),
        ((further, own), (0.0, fitted.x[-1])),
        ((further,), ()),
    ):
        other = replace(x, form="other", unknowns=unknowns, starts=((0.3,) * len(unknowns),))
        signature = Signature(
            other, replace(model, effects=(other,)), np.zeros(3 + len(unknowns)), (), 0.0, np.empty(0), np.empty(0)
        )
        begun = begun_from(fitted, x, signature)
        assert (begun is None) == (not start)
        if begun is not None:
            assert begun.start == pytest.approx([*fitted.x[:3], *start], abs=1e-12)


def test_a_coarser_form_begins_where_a_finer_one_has_led() -> None:
    a, b = Unknown("a", "", -1.0, 9.0, 1.0), Unknown("b", "", -1.0, 9.0, 1.0)
    coarse = Candidate("x", "coarse", "damper", (a,), ((0.1,),), "x")
    fine = (replace(coarse, form="fine", unknowns=(b, a)), np.array([3.0, 2.0]))
    begun = begun_at(coarse, fine)
    assert begun is not None and begun[0] is coarse and begun[1].tolist() == [2.0]
    assert begun_at(fine[0], fine) is None  # the same, from where it is
    assert begun_at(replace(coarse, unknowns=(replace(b, name="c"),)), fine) is None


def test_ten_draws_without_effects_find_none() -> None:
    for seed in range(10):
        assert not Loop(linear(seed=100 + seed), (1.0,) * 6, workers=1).run().adopted


@pytest.mark.parametrize(("curved", "found"), [(0.0, "x.only"), (0.4, "x.curved")])
def test_a_finer_form_takes_the_place_of_one_that_leaves_more_than_noise(curved: float, found: str) -> None:
    # x as it is in truth differs from the form known by `curved` times what nothing else is like
    problem = linear(seed=9)
    random = np.random.default_rng(10)
    extra = [curved * random.standard_normal(200) for _ in problem.matrices]
    truth = [x + more for x, more in zip(problem.columns["x"], extra, strict=True)]
    problem.measured = tuple(y + 2.0 * x for y, x in zip(problem.measured, truth, strict=True))
    other = truth if curved else [x + 0.4 * random.standard_normal(200) for x in problem.columns["x"]]
    problem.columns["x.curved"] = other
    problem.fine = ("x.curved",)
    (adopted,) = Loop(problem, (1.0,) * 6, workers=1).run().adopted
    assert adopted.candidate.label == found
    assert adopted.values[0] == pytest.approx(2.0, abs=4.0 / np.sqrt(1000.0))


def test_a_finer_form_of_the_form_that_came_second_takes_its_place() -> None:
    # of two forms that are nearly alike the worse has a finer one, which is the truth
    problem = linear(seed=9, hidden={"x": 2.0})
    random = np.random.default_rng(10)
    truth = problem.columns.pop("x")
    for form, off in (("best", 0.3), ("second", 0.33)):
        problem.columns[f"x.{form}"] = [x + off * random.standard_normal(200) for x in truth]
    problem.columns["x.second_more"] = truth
    problem.fine = ("x.second_more",)
    (adopted,) = Loop(problem, (1.0,) * 6, workers=1).run().adopted
    assert adopted.candidate.label == "x.second_more"
    assert adopted.values[0] == pytest.approx(2.0, abs=4.0 / np.sqrt(1000.0))


def test_a_simpler_model_is_fitted_with_as_little_belief_as_the_best() -> None:
    # what was left beside the law alone has made the belief in the declared parameters strong
    problem = linear(seed=14, hidden={"x": 5.0})
    problem.declared = np.full(3, 0.5)  # 1.1, 0.8 and 1.3 in truth
    by_name = {c.name: c for c in problem.candidates([])}
    strong = replace(_model(problem), effects=(by_name["x"],), misfit=30.0)
    both = replace(_model(problem), effects=(by_name["x"], by_name["y"]))
    best, near = (Judged(fit(model, model.coordinates())) for model in (both, strong))
    assert best.at_floor and not near.at_floor
    (found,) = Loop(problem, (1.0,) * 6, workers=1)._simpler_to_the_end([near, best])
    assert found.at_floor and found.fitted.model.effects == (by_name["x"],)
    free = replace(both, effects=strong.effects)
    assert found.fitted.x == pytest.approx(fit(free, free.coordinates()).x, abs=1e-2)  # a third of a standard error


def test_an_effect_found_beside_others_stands_against_its_twins_in_the_end() -> None:
    # x and w do the same; only x was tried, as w was not among the best beside the law as declared
    problem = linear(seed=15, hidden={"x": 2.0})
    problem.columns["w"] = problem.columns["x"]
    problem.instruments = ("w",)
    model = replace(_model(problem), effects=tuple(c for c in problem.candidates([]) if c.name == "x"))
    current = Judged(fit(model, model.coordinates()))
    loop = Loop(problem, (1.0,) * 6, workers=1)
    final = loop._against_others(current)
    assert [effect.name for effect in final.fitted.model.effects] == ["w"]
    (adopted,) = loop._explain(final, final)
    assert "x" in adopted.alike
    assert loop._against_others(current) is current  # what was done in a round is not done again


def test_a_finer_form_beside_the_law_as_declared_leaves_nothing_for_others() -> None:
    # x is nearly what the law can do; the declared law is right, and the form of x found first is not quite
    problem = linear(seed=7)
    random = np.random.default_rng(8)
    truth = [m @ [1.0, -1.0, 0.5] + 0.7 * random.standard_normal(200) for m in problem.matrices]
    problem.columns["x"] = [x + 0.2 * random.standard_normal(200) for x in truth]
    problem.columns["x.curved"] = truth
    problem.fine = ("x.curved",)
    problem.measured = tuple(
        m.sum(axis=1) + 3.0 * x + random.standard_normal(200) for m, x in zip(problem.matrices, truth, strict=True)
    )
    told: list[str] = []
    selection = Loop(problem, (1.0,) * 6, workers=1, progress=told.append).run()
    assert [a.candidate.label for a in selection.adopted] == ["x.curved"]
    assert selection.final.fitted.model.held and selection.final.at_floor
    assert not any(line.startswith("effect 1") or "and the law as declared" in line for line in told)


@pytest.mark.parametrize("share", [0.0, 1.0])
def test_conditions_are_in_doubt_as_far_as_the_tests_show(share: float) -> None:
    problem = linear(seed=11, tests=12)
    random = np.random.default_rng(12)
    doubts = tuple(0.5 * random.standard_normal(200) for _ in problem.measured)
    off = random.standard_normal(12)  # standard deviations by which each condition is off
    problem.measured = tuple(
        y + share * size * doubt for y, size, doubt in zip(problem.measured, off, doubts, strict=True)
    )
    model = Model(replace(problem, doubts=doubts), (1.0,) * 12)
    chosen = likeliest_doubt(fit(model, model.coordinates()))
    # unit noise in 200 values, a doubt of 0.5 each: with 12 tests a tenth of it is no more likely than none
    assert chosen == 1.0 if share else chosen in (0.0, 0.1)


@pytest.mark.parametrize(
    ("share", "bic", "better"), [(0.3, 20.0, True), (0.2, 20.0, False), (0.3, 9.0, False), (-0.1, 99.0, False)]
)
def test_of_forms_of_one_effect_mean_and_criterion_decide(share: float, bic: float, better: bool) -> None:
    # t of 0.5: one test tells, the others do not agree, which no new effect may rest on
    evidence = Evidence(share, 0.5, bic, 1, 8)
    assert evidence.better_form is better
    assert not evidence.beyond_chance


def test_what_equations_may_miss_is_a_share_of_what_they_do() -> None:
    problem = linear(seed=13, hidden={"x": 40.0})
    (x,) = [c for c in problem.candidates(()) if c.name == "x"]
    model = Model(problem, (1.0,) * 6, (x,))
    judged = Judged(fit(model, model.coordinates()))
    loop = Loop(problem, (1.0,) * 6, workers=1)
    fitted = [column for column, use in zip(problem.columns["x"], problem.uses, strict=True) if use == "fit"]
    done = 40.0**2 * sum(float(column @ column) for column in fitted)
    loop.left = judged.fitted.residuals
    assert loop._may_miss(judged) == pytest.approx(5e-4 * done, rel=0.01)  # 40 is told to 4 / sqrt(1000)
    # a share of what the refitted law leaves, if that is more: 1 % of ten times what the effect does
    loop.left = tuple(10.0**0.5 * 40.0 * column for column in fitted)
    assert loop._may_miss(judged) == pytest.approx(0.1 * done, rel=0.01)


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
    loop.left = declared.fitted.residuals
    fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
    done = 40.0**2 * sum(float(problem.columns["y"][i] @ problem.columns["y"][i]) for i in fitted)
    assert declared.fitted.chi2 > 1e3 * done
    # 1 % of what y does, but for the share of 3 columns of 200 values and of x's own column
    assert loop._may_miss(Judged(fit(model, model.coordinates()))) == pytest.approx(0.01 * done, rel=0.1)


def test_a_form_that_the_fitted_tests_cannot_place_is_placed_by_the_others() -> None:
    # x acts from the fourth test on, or from the fifth: the fourth is to validate
    for early in (True, False):
        problem = linear(seed=5, tests=6)
        uses: tuple[Use, ...] = ("fit", "fit", "fit", "validate", "fit", "fit")
        column = problem.columns["x"]
        late = [np.zeros(200) if i < 4 else column[i] for i in range(6)]
        soon = [np.zeros(200) if i < 3 else column[i] for i in range(6)]
        measured = tuple(m + 5.0 * (soon if early else late)[i] for i, m in enumerate(problem.measured))
        problem = replace(problem, columns={"x.late": late, "x.soon": soon}, measured=measured, uses=uses)
        found = Loop(problem, (1.0,) * 6, workers=1).run()
        assert [one.candidate.label for one in found.adopted] == ["x.soon" if early else "x.late"]
        # what is adopted is what the model has, with the value of the fitted tests: 5 to 1 / sqrt(400)
        assert found.final.fitted.model.effects == (found.adopted[0].candidate,)
        assert found.adopted[0].values[0] == pytest.approx(5.0, abs=4.0 / 20.0)


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
        model = replace(_model(problem), effects=tuple(by_name[name] for name in names))
        return Judged(fit(model, model.coordinates()))

    current, near = fitted("x", "y"), fitted("z")
    assert near.fitted.chi2 > 1.5 * current.fitted.chi2 > 1.5 * 2.0 * current.fitted.samples
    assert loop._second_look(current) is None  # nothing came near
    loop.rivals[frozenset(), False] = [near]
    found = loop._second_look(current)
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
        model = replace(_model(problem), effects=tuple(by_name[name] for name in names))
        return Judged(fit(model, model.coordinates()))

    current = fitted("a", "b")
    loop.left = fitted().fitted.residuals
    loop.rivals[frozenset(), False] = [fitted("a"), fitted("b"), fitted("x")]
    found = loop._begun_with_another(current)
    assert found is not None and {e.name for e in found.fitted.model.effects} == {"x", "y"} and found.at_floor
    assert "two effects, x one of them" in told
    assert loop._begun_with_another(current) is None  # once


def test_finer_and_coarser_forms_in_turn_come_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = linear(seed=6, hidden={"x": 20.0})
    problem.columns |= {"z.one": problem.columns["y"], "z.two": problem.columns["z"]}
    forms = [c for c in problem.candidates(()) if c.label in ("z.one", "z.two")]
    models = [replace(_model(problem), effects=(form,)) for form in forms]
    one, two = (Judged(fit(model, model.coordinates())) for model in models)
    loop, asked = Loop(problem, (1.0,) * 6, workers=1), []

    def other(judged: Judged, i: int) -> Judged:
        asked.append(judged)
        return two if judged is one else one

    monkeypatch.setattr(loop, "_in_finer_form", other)
    assert not one.at_floor
    loop._as_fine_as_needed(one, 0)
    assert asked == [one, two]


def test_the_law_is_fitted_where_that_leaves_half_whatever_tests_left_out_say() -> None:
    problem = linear(seed=7, hidden={"x": 20.0})
    problem.declared = np.zeros(3)
    x = next(candidate for candidate in problem.candidates(()) if candidate.name == "x")
    loop = Loop(problem, (1.0,) * 6, workers=1)
    held = replace(_model(problem), effects=(x,), held=True)
    current = Judged(fit(held, held.coordinates()))
    freed = loop._freed_if_half(current)
    assert not freed.fitted.model.held and freed.at_floor  # the law is 1.1, 0.8 and 1.3, declared as nothing
    assert loop._freed_if_half(freed) is freed
    right = replace(problem)
    right.declared = np.array([1.1, 0.8, 1.3])
    model = Model(right, (1.0,) * 6, (x,), held=True)
    true = Judged(fit(model, model.coordinates()))
    assert Loop(right, (1.0,) * 6, workers=1)._freed_if_half(true) is true
    problem.declared = np.zeros(3)
    assert Loop(problem, (1.0,) * 6, refit=False, workers=1)._freed_if_half(current) is current
