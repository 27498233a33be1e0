"""The search among forms of effects on a linear problem."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from linear_problem import linear, model_of, of_labels

from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import fit
from edesign.calibrate.problem import Candidate, Part, Use
from edesign.calibrate.search.begun import begun_at, begun_from
from edesign.calibrate.search.loop import Loop
from edesign.calibrate.search.screening import Signature
from edesign.calibrate.unknown import Unknown


def test_forms_that_leave_more_than_asked_are_not_fitted_on() -> None:
    problem = linear(seed=18, hidden={"x": 5.0})
    problem.columns = {"x.whole": problem.columns["x"], "x.half": problem.columns["y"]}
    current = of_labels(problem, "x.half")
    loop = Loop(problem, (1.0,) * 6, workers=1)
    assert loop.forms.other_forms(current, current.fitted.model.effects[0], 0.5 * current.fitted.samples) == []
    loop.forms.compared.clear()
    (found,) = loop.forms.other_forms(current, current.fitted.model.effects[0], 2.0 * current.fitted.samples)
    assert found.fitted.model.effects[0].label == "x.whole"


def test_a_form_that_has_the_parameters_of_another_is_tried_where_that_one_is(monkeypatch: pytest.MonkeyPatch) -> None:
    # though no linear estimate makes it likely
    monkeypatch.setattr("edesign.calibrate.search.effect_forms.likely_forms", lambda signatures, most: [])
    problem = linear(seed=18, hidden={"x": 2.0})
    problem.columns = {"x.whole": problem.columns["x"], "x.half": problem.columns["y"]}
    current = of_labels(problem, "x.half")
    (found,) = Loop(problem, (1.0,) * 6, workers=1).forms.other_forms(current, current.fitted.model.effects[0])
    assert found.fitted.model.effects[0].label == "x.whole"


def test_a_form_begins_where_another_one_with_the_same_parameters_stands() -> None:
    problem = linear(hidden={"x": 0.5})
    own, further = Unknown("a", "", -1e6, 1e6, 1.0), Unknown("p", "", 0.1, 10.0, 3.0, logarithmic=True)
    x = next(c for c in problem.candidates([]) if c.name == "x")
    model = replace(model_of(problem), effects=(x,))
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


def test_finer_and_coarser_forms_in_turn_come_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = linear(seed=6, hidden={"x": 20.0})
    problem.columns |= {"z.one": problem.columns["y"], "z.two": problem.columns["z"]}
    forms = [c for c in problem.candidates(()) if c.label in ("z.one", "z.two")]
    models = [replace(model_of(problem), effects=(form,)) for form in forms]
    one, two = (Judged(fit(model, model.coordinates())) for model in models)
    loop, asked = Loop(problem, (1.0,) * 6, workers=1), []

    def other(judged: Judged, i: int) -> Judged:
        asked.append(judged)
        return two if judged is one else one

    monkeypatch.setattr(loop.forms, "_in_finer_form", other)
    assert not one.at_floor
    loop.forms.as_fine_as_needed(one, 0)
    assert asked == [one, two]


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


@pytest.mark.parametrize(("share", "fitted"), [(0.05, []), (0.2, ["z.fine"])])
def test_finer_forms_are_fitted_where_they_promise_a_tenth(
    share: float, fitted: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # the finer form does what the other one does and a share, in power, of what that one leaves
    problem = linear(seed=6, hidden={"x": 20.0, "y": 20.0})
    more = np.sqrt(share)
    problem.columns = {
        "z.coarse": problem.columns["x"],
        "z.fine": [
            x + more**2 * y + more * np.sqrt(1.0 - more**2) * other
            for x, y, other in zip(problem.columns["x"], problem.columns["y"], problem.columns["z"], strict=True)
        ],
    }
    problem.fine = ("z.fine",)
    coarse = of_labels(problem, "z.coarse")
    loop, tried = Loop(problem, (1.0,) * 6, workers=1), []
    known = loop.bench.with_parts

    def with_parts(current: Judged, i: int, others: Sequence[Part]) -> list[Judged]:
        tried.extend(candidate.label for candidate, _ in others)
        return known(current, i, others)

    monkeypatch.setattr(loop.bench, "with_parts", with_parts)
    loop.forms.as_fine_as_needed(coarse, 0)
    assert tried[:1] == fitted


def test_a_form_is_found_by_its_label_in_a_model_that_another_process_or_round_has_fitted() -> None:
    """There it is another object, with starts of its own; and a model that lacks it has nothing to begin from."""
    problem = linear(seed=18, hidden={"x": 2.0})
    problem.columns = {"x.whole": problem.columns["x"], "x.half": problem.columns["y"]}
    current = of_labels(problem, "x.half")
    effect = current.fitted.model.effects[0]
    twin = replace(effect, starts=((0.7,),))
    assert twin is not effect and twin != effect
    loop = Loop(problem, (1.0,) * 6, workers=1)
    assert loop.bench.without(current, twin).fitted.model.effects == ()
    found = loop.forms.other_forms(current, twin)
    assert [judged.fitted.model.effects[0].label for judged in found] == ["x.whole"]
    assert loop.forms.other_forms(current, replace(effect, form="gone")) == []
    assert loop.alternatives.others(current, twin) == loop.alternatives.others(current, effect)
