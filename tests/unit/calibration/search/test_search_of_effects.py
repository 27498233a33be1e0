"""The search finds what data of a spring and a dashpot hide, and nothing beside."""

from __future__ import annotations

import numpy as np
import pytest
from curve_problem import CUBIC, DRAG, DRY, EFFECTS, FIFTH, GAIN, OWN, SIGNED, CurveProblem, effect

from edesign.calibration.search.models import Fitter
from edesign.calibration.search.search import Found, Search
from edesign.calibration.search.settings import SearchSettings


def found(problem: CurveProblem, **settings: float) -> Found:
    """Return what the search finds."""
    return Search(problem, SearchSettings(**settings)).run()


@pytest.mark.parametrize("seed", [1, 2, 3, 4, 5, 6])
def test_nothing_is_found_where_nothing_is_hidden(seed: int) -> None:
    result = found(CurveProblem(seed=seed))
    assert result.best.effects == ()
    assert result.ending == "complete"
    assert result.depths == ()  # the base model leaves no more than noise


@pytest.mark.parametrize(
    "truth", [(CUBIC, (0.2,)), (FIFTH, (0.2,)), (DRAG, (0.1,)), (DRY, (0.1, 0.05)), (GAIN, (0.1,)), (SIGNED, (0.1,))]
)
def test_a_hidden_effect_is_found_alone_with_its_size(truth) -> None:
    result = found(CurveProblem(truth=(truth,)))
    assert [one.label for one in result.best.effects] == [truth[0].label]
    # ten standard errors: 1500 samples with 1 % noise
    assert result.best.fit.values[2] == pytest.approx(truth[1][0], rel=0.1)


def test_two_effects_are_found_together() -> None:
    result = found(CurveProblem(truth=((CUBIC, (0.3,)), (DRY, (0.1, 0.05)))))
    assert result.best.names == {"hardening", "friction"}


def test_zeros_of_each_test_are_its_own() -> None:
    result = found(CurveProblem(zeros=0.2))
    assert [one.label for one in result.best.effects] == [OWN.label]
    assert result.best.at_floor


def test_a_pair_is_found_whose_effects_hide_each_other() -> None:
    """Each effect alone gains nothing: what one adds along the base's own columns, the other takes away."""
    rng = np.random.default_rng(5)
    common = [rng.standard_normal(300) for _ in range(5)]
    apart = [0.05 * rng.standard_normal(300) for _ in range(5)]
    left = effect("left", "a", lambda p, i, u, v: p[0] * (common[i] + apart[i]), spread=5.0)
    right = effect("right", "b", lambda p, i, u, v: p[0] * (common[i] - apart[i]), spread=5.0)
    problem = CurveProblem(effects=(CUBIC, DRAG, left, right), truth=((left, (1.0,)), (right, (-1.0,))))
    assert found(problem).best.names == {"left", "right"}
    assert found(problem, pairs=0).best.names != {"left", "right"}


def test_the_equation_that_predicts_best_is_taken() -> None:
    tenth = [effect("hardening", f"power_{n}", lambda p, i, u, v, n=n: p[0] * np.abs(u) ** n * u) for n in (1, 2, 3, 6)]
    problem = CurveProblem(effects=(*tenth, DRAG), truth=((tenth[3], (0.6,)),), noise=0.003)
    assert found(problem, forms=1).best.label == "hardening.power_6"


def test_an_equation_that_is_nearly_right_draws_no_other_effect_in() -> None:
    """The truth is u^4 sgn u, the listed equations are u^3 and u^5; a bend of another name fits the difference."""
    truth = effect("hardening", "truth", lambda p, i, u, v: p[0] * u**4 * np.sign(u))
    bend = effect("bend", "sine", lambda p, i, u, v: p[0] * np.sin(2.0 * np.pi * u))
    problem = CurveProblem(effects=(CUBIC, FIFTH, DRAG, bend), truth=((truth, (1.0,)),))
    assert found(problem).best.names == {"hardening"}
    assert found(problem, shared_discrepancy=1e-6, own_discrepancy=1e-6).best.names == {"hardening", "bend"}


def test_an_effect_of_one_test_alone_is_found() -> None:
    problem = CurveProblem(
        effects=(*EFFECTS, effect("event", "third", lambda p, i, u, v: p[0] * np.abs(u) * (i == 2))),
        truth=((effect("event", "third", lambda p, i, u, v: p[0] * np.abs(u) * (i == 2)), (0.3,)),),
    )
    assert found(problem).best.names == {"event"}


def test_the_effort_is_counted_and_the_same_again() -> None:
    problem = CurveProblem(truth=((CUBIC, (0.3,)), (DRY, (0.1, 0.05))))
    first, second = found(problem), found(problem)
    assert first.effort == second.effort
    assert sum(first.effort.values()) > 0.0
    assert [d.fitted for d in first.depths] == [d.fitted for d in second.depths]
    np.testing.assert_array_equal(first.best.fit.z, second.best.fit.z)


def test_an_effort_that_is_spent_ends_the_search_with_the_best_that_is_fitted() -> None:
    """It is judged as any model is; a second effect is not looked for."""
    problem = CurveProblem(truth=((CUBIC, (0.3,)), (DRY, (0.1, 0.05))))
    spent = sum(found(problem).effort.values())
    names = []
    for effort in (40.0, 0.7 * spent):
        result = found(problem, effort=effort)
        assert result.ending == "effort_spent"
        names.append(result.best.names)
        before = sum(of for step, of in result.effort.items() if step != "after the effort was spent")
        assert before <= effort + 60.0  # one batch of predictions at most beyond it
    assert names == [{"friction"}, {"hardening", "friction"}]


def test_effects_that_tests_cannot_separate_are_rivals() -> None:
    like = effect("bulge", "cubic", lambda p, i, u, v: p[0] * (u**3 + 0.02 * u**5))
    result = found(CurveProblem(effects=(*EFFECTS, like), truth=((CUBIC, (0.2,)),)))
    fitter = Fitter(result.base.problem, SearchSettings())
    rivals = [one.names for one in result.models if one.effects and not fitter.compare(result.best, one).sure]
    assert {"hardening"} in rivals and {"bulge"} in rivals and {"drag"} not in rivals


def test_one_test_above_its_noise_is_searched_though_all_together_are_at_the_floor() -> None:
    """Twelve tests leave less than 1.4 times the power of their noise in the mean, one of them more than 3 times."""
    event = effect("event", "third", lambda p, i, u, v: p[0] * np.abs(u) * (i == 2))
    result = found(CurveProblem(effects=(*EFFECTS, event), truth=((event, (0.05,)),), tests=12))
    left = np.array([float(r @ r) / r.size for r in result.base.left]) / 0.01**2
    assert 1.0 < left.mean() < 1.4 and left.max() > 3.0
    assert result.best.names == {"event"}


def test_what_is_too_large_to_be_squared_is_not_seen() -> None:
    """An equation that overflows at its start is finite, and its power is not."""
    huge = effect("huge", "x", lambda p, i, u, v: 1e200 * p[0] * u)
    with np.errstate(over="ignore"):
        assert found(CurveProblem(effects=(*EFFECTS, huge), truth=((CUBIC, (0.2,)),))).best.names == {"hardening"}
