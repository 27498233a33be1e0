"""Which effects of a final model are hypotheses: those that the tests do not bear out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from kelvin_voigt_campaign import campaign, lawful
from linear_problem import LinearProblem, linear, model_of

from edesign.calibrate.dampers import carried
from edesign.calibrate.dampers.effects.friction import Loaded, LuGre, Stribeck
from edesign.calibrate.dampers.effects.play import Closing
from edesign.calibrate.dampers.prepare import damper_problem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.outcome import Outcome
from edesign.calibrate.problem import USUAL_GAIN, Candidate, Described, Part
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.selection import Selection
from edesign.calibrate.search.tenable import Tenable, size_uncertainty
from edesign.calibrate.unknown import Unknown
from edesign.calibrate.write import calibration_json


def _tenable(problem: LinearProblem) -> Tenable:
    loop = Loop(problem, (1.0,) * len(problem.names), workers=1)
    return loop.tenable


def _with(problem: LinearProblem, name: str, **changes: object) -> tuple[Judged, Judged]:
    """The model with an effect, fitted, and that without."""
    effect = next(candidate for candidate in problem.candidates(()) if candidate.name == name)
    model = model_of(problem)
    larger = replace(model, effects=(replace(effect, **changes),))  # type: ignore[arg-type]
    return Judged(fit(larger, larger.coordinates())), Judged(fit(model, model.coordinates()))


def _scattered(sizes: tuple[float, ...]) -> LinearProblem:
    """x is there in each test with a size of its own."""
    problem = linear(seed=5, tests=len(sizes))
    problem.measured = tuple(
        y + size * x for y, x, size in zip(problem.measured, problem.columns["x"], sizes, strict=True)
    )
    return problem


@pytest.mark.parametrize(
    ("sizes", "kept"),
    # of five tests fitted to: alike; mean 1, standard error 0.85, t of 4 degrees of freedom is 2.8
    [((1.0, 1.2, 0.8, 1.1, 0.9, 1.0), True), ((4.0, -1.0, 1.5, 0.5, 0.0, 1.0), False)],
)
def test_an_effect_whose_interval_reaches_to_nothing_is_a_hypothesis(sizes: tuple[float, ...], kept: bool) -> None:
    problem = _scattered(sizes)
    judged, rival = _with(problem, "x")
    final, hypotheses = _tenable(problem).part(judged, rival)
    assert (final is judged) == kept
    if not kept:
        (one,) = hypotheses
        assert final is rival and one.adopted.candidate.name == "x" and "reaches to nothing" in one.why
        assert one.adopted.values[0] == pytest.approx(1.0, abs=0.2)


def test_an_effect_of_several_sizes_is_judged_by_all_of_them_together() -> None:
    # a and b do nearly the same: each alone is uncertain, their sum is not
    problem = linear(seed=7)
    random = np.random.default_rng(8)
    near = [x + 0.01 * random.standard_normal(x.size) for x in problem.columns["x"]]
    a, b = Unknown("a", "", -9.0, 9.0, 1.0), Unknown("b", "", -9.0, 9.0, 1.0)
    both = Candidate("x", "both", "damper", (a, b), ((0.1, 0.1),), "both")

    def predict(base: np.ndarray, parts: list[Part], uses: tuple[str, ...]) -> list[np.ndarray | None]:
        found: list[np.ndarray | None] = []
        for matrix, x, other, use in zip(problem.matrices, problem.columns["x"], near, problem.uses, strict=True):
            value = matrix @ base
            for _, values in parts:
                value = value + values[0] * x + values[1] * other
            found.append(value if use in uses else None)
        return found

    problem.measured = tuple(y + x for y, x in zip(problem.measured, problem.columns["x"], strict=True))
    problem.predict = predict  # type: ignore[method-assign, assignment]
    model = replace(model_of(problem), effects=(both,))
    judged = Judged(fit(model, model.coordinates()))
    # of both together 1 +- sqrt(2 F(2, 4)) / sqrt(1000) by the noise, and no more than thrice that by five tests
    assert size_uncertainty(judged, both) < 0.4
    deviations = np.sqrt(np.diag(judged.fitted.covariance))[-2:]
    assert np.all(1.96 * deviations > 2.0 * np.abs(judged.fitted.x[-2:]))


@pytest.mark.parametrize(("hidden", "told"), [(2.0, True), (-0.5, False)])
def test_an_effect_of_logarithms_alone_needs_one_that_the_tests_tell(hidden: float, told: bool) -> None:
    # a positive size of what is there with the other sign ends at its lower bound
    size = Unknown("a", "", 1e-6, 1e3, 0.5, logarithmic=True)
    judged, _ = _with(linear(seed=9, hidden={"x": hidden}), "x", unknowns=(size,), starts=((1.0,),))
    assert (size_uncertainty(judged, judged.fitted.model.effects[0]) < 1.0) == told


@pytest.mark.parametrize(("tests", "kept"), [(3, False), (4, True)])
@pytest.mark.parametrize("changes", [{"between_tests": True}, {"usual": USUAL_GAIN}])
def test_two_tests_do_not_bear_out_what_acts_between_tests_nor_large_gains(
    tests: int, kept: bool, changes: dict[str, object]
) -> None:
    problem = linear(seed=5, hidden={"x": 2.0}, tests=tests)  # the last one is for validation
    judged, rival = _with(problem, "x", **changes)
    final, hypotheses = _tenable(problem).part(judged, rival)
    assert (final is judged) == kept and len(hypotheses) == (not kept)


class _Between(LinearProblem):
    """x acts between tests."""

    def candidates(self, residuals: Sequence[np.ndarray]) -> tuple[Candidate, ...]:
        return tuple(replace(c, between_tests=c.name == "x") for c in super().candidates(residuals))


@pytest.mark.parametrize(("tests", "adopted", "hypotheses"), [(3, ["y"], ["x"]), (5, ["x", "y"], [])])
def test_with_two_tests_what_acts_between_them_is_sought_last_and_is_a_hypothesis(
    tests: int, adopted: list[str], hypotheses: list[str]
) -> None:
    problem = linear(seed=5, hidden={"x": 3.0, "y": 4.0}, tests=tests)
    problem = _Between(problem.matrices, problem.columns, problem.measured, problem.uses)
    found = Loop(problem, (1.0,) * tests, workers=1).run()
    assert sorted(one.candidate.name for one in found.adopted) == adopted
    assert [one.adopted.candidate.name for one in found.hypotheses] == hypotheses
    assert "x.only" not in found.coverage.forms  # adopted, or no candidate
    for one in found.hypotheses:
        assert one.adopted.values[0] == pytest.approx(3.0, abs=4.0 / np.sqrt(400.0))
        assert one.adopted.without is found.final


def test_a_declared_law_that_predicts_the_validation_tests_worse_than_its_refit_is_not_the_result() -> None:
    # what nothing known is like hides that the law is not as declared, in tests fitted to
    problem = linear(seed=31)
    problem.declared = np.array([1.0, 1.0, 1.2])
    random = np.random.default_rng(32)
    loud = [4.0 * random.standard_normal(200) for _ in problem.measured[:-1]]
    problem.measured = (*(y + more for y, more in zip(problem.measured[:-1], loud, strict=True)), problem.measured[-1])
    selection = Loop(problem, (1.0,) * 6, workers=1).run()
    held = replace(selection, final=selection.declared)
    outcome = Outcome.of(problem, (1.0,) * 6, held)
    assert outcome.found.final is selection.refit and outcome.found.hypotheses == ()
    assert outcome.errors["corrected"] == outcome.errors["refit"]


def test_a_gain_as_instruments_have_it_needs_two_tests() -> None:
    problem = linear(seed=5, hidden={"x": 0.02}, tests=3, noise=0.01)
    effect = next(candidate for candidate in problem.candidates(()) if candidate.name == "x")
    model = replace(model_of(problem, 0.01), effects=(replace(effect, usual=USUAL_GAIN),))
    judged = Judged(fit(model, model.coordinates()))
    assert _tenable(problem).part(judged, judged)[0] is judged


def test_what_acts_between_tests_is_known(tmp_path: Path) -> None:
    problem = damper_problem(campaign(tmp_path))
    every = problem.candidates([trial.force for trial in problem.trials if trial.use == "fit"])
    between = {candidate.label for candidate in every if candidate.between_tests}
    assert {"mullins.path", "ageing.linear", "gain.force_from_test_3", "lag.growing", "degradation.energy"} <= between
    assert not between & {"gain.force", "lag.delay", "offset.constant", "friction.tanh", "payne.whole"}
    assert {candidate.name for candidate in every if candidate.usual == USUAL_GAIN} == {"gain"}


def test_nested_forms_do_what_the_larger_ones_do_at_an_end() -> None:
    # values of a page each: s = 0, mu = 0; ratio -> infinity
    known = {"F_c": 2.0, "x0": 1e-3, "s": 0.0, "v_s": 0.05}
    ((form, values),) = LuGre().simpler(known)
    assert form.form == "presliding" and {"F_c", "x0"} <= set(values)
    ((form, values),) = Stribeck().simpler({"F_c": 2.0, "s": 0.0, "v_s": 0.05})
    assert (form.form, values) == ("tanh", {"F_c": 2.0, "v0": pytest.approx(0.005)})
    ((form, _),) = Loaded().simpler({"F_c": 2.0, "v0": 1e-3, "mu": 0.0})
    assert form.form == "tanh"
    gap = dict(
        (form.form, values) for form, values in Closing().simpler({"stiffness": 1e6, "F_c": 50.0, "ratio": 1e3})
    )["gap"]
    own, other = Closing().series({"stiffness": 1e6, "F_c": 50.0, "ratio": 1e3}), gap
    assert other["play"] == pytest.approx(own.play) and other["stiffness"] == pytest.approx(own.stiffness)


class _Nested(LinearProblem):
    """x has a second parameter that does next to nothing; its nested form has none."""

    def simpler(self, part: Part) -> tuple[Part, ...]:
        if part[0].form != "wide":
            return ()
        plain = next(c for c in self.candidates(()) if c.name == part[0].name)
        return ((plain, part[1][:1]),)


@pytest.mark.parametrize("bound", [True, False])
def test_a_parameter_at_its_bound_or_untold_asks_for_the_nested_form(bound: bool) -> None:
    problem = linear(seed=5, hidden={"x": 2.0})
    problem = _Nested(problem.matrices, problem.columns, problem.measured, problem.uses)
    further = Unknown("s", "", 0.0, 1.0, 1.0) if bound else Unknown("p", "", 1e-3, 1e3, 1.0, logarithmic=True)
    own = Unknown("a", "", -9.0, 9.0, 1.0)
    judged, rival = _with(problem, "x", form="wide", unknowns=(own, further), starts=((0.1, 0.5),))
    final, _ = _tenable(problem).part(judged, rival)
    assert final.labels == {"x.only"}


def _outcome(size_there: float) -> Outcome:
    """x is in the tests fitted to, and in the validation test with another size."""
    problem = linear(seed=5, hidden={"x": 2.0})
    last = problem.measured[-1] + (size_there - 2.0) * problem.columns["x"][-1]
    problem.measured = (*problem.measured[:-1], last)
    selection: Selection = Loop(problem, (1.0,) * 6, workers=1).run()
    assert [adopted.candidate.name for adopted in selection.adopted] == ["x"]
    return Outcome.of(problem, (1.0,) * 6, selection)


@pytest.mark.parametrize(("size_there", "withheld"), [(2.0, False), (-1.0, True)])
def test_effects_that_make_the_validation_tests_worse_than_the_refit_are_withheld(
    size_there: float, withheld: bool
) -> None:
    outcome = _outcome(size_there)
    assert (outcome.found.adopted == ()) == withheld
    assert outcome.errors["corrected"].validate <= outcome.errors["refit"].validate
    if withheld:
        (one,) = outcome.found.hypotheses
        assert one.adopted.candidate.name == "x" and "predicted worse" in one.why
        assert outcome.found.final is outcome.found.refit and outcome.verdict == "unexplained"


def test_withheld_effects_are_told_as_hypotheses() -> None:
    told = _outcome(-1.0).calibration("t", "", lambda c: Described(c.label, "s"), "shape", None, (), 1.0)
    assert told.effects == ()
    (one,) = told.hypotheses
    # delta_validate is of the model with it: what it makes worse is negative
    assert one.effect.delta_validate < 0.0
    (written,) = calibration_json(told)["hypotheses"]
    assert written["name"] == "x" and "predicted worse" in written["why"]


@pytest.mark.parametrize(("off", "withheld"), [(1.5, True), (1.0, False)])
def test_a_law_file_has_the_refitted_law_where_its_forms_predict_the_validation_tests_worse(
    off: float, withheld: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def worn(t, u, v, a, order):  # type: ignore[no-untyped-def]
        return (1.0 - 0.05 * order) * lawful(t, u, v, a, order)

    problem = damper_problem(campaign(tmp_path, worn))
    noise = tuple(trial.noise for trial in problem.trials)
    every = problem.candidates([trial.force for trial in problem.trials if trial.use == "fit"])
    lacking = next(candidate for candidate in every if candidate.label == "degradation.work")
    known = next(candidate for candidate in every if candidate.label == "ageing.linear")
    bare = Model(problem, noise)
    refit = fit(bare, bare.coordinates())
    final, other = (fit(one, one.coordinates()) for one in (replace(bare, effects=(e,)) for e in (lacking, known)))
    # the nearest form of law files is right, or predicts half as much again
    wrong = replace(other, x=np.array([other.x[0] + np.log(off), *other.x[1:]]))
    monkeypatch.setattr(carried, "_in_known_forms", lambda *_: wrong)
    law = carried.carried_law(final, refit, problem, problem, 1e-4)
    assert law.withheld == withheld and law.replaced == ("degradation.work",)
    assert (law.effects == ()) == withheld
    assert law.parameters["k"] == pytest.approx((refit if withheld else other).base[0])
