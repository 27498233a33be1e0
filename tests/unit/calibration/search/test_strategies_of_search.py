"""What each strategy of the search is for: a problem whose truth is missed, or is added to, without it."""

from __future__ import annotations

import itertools
from dataclasses import replace

import numpy as np
import pytest
from curve_problem import DRAG, OWN, Change, CurveProblem, effect

from edesign.calibration.search.adoption import Adoption
from edesign.calibration.search.models import Fitter
from edesign.calibration.search.problem import Effect
from edesign.calibration.search.search import Found, Search
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.estimation.left_out import Difference, score
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter

TESTS, SAMPLES = 5, 300
Columns = list[np.ndarray]


def found(problem: CurveProblem, **settings: float) -> Found:
    """Return what the search finds."""
    return Search(problem, SearchSettings(**settings)).run()


def columns(seed: int) -> Columns:
    """White noise of size one in each test."""
    random = np.random.default_rng(seed)
    return [random.standard_normal(SAMPLES) for _ in range(TESTS)]


def linear(name: str, shape: Columns, form: str = "x") -> Effect:
    """An effect that adds so many times a column."""
    return effect(name, form, lambda p, i, u, v: p[0] * shape[i])


def positive(name: str, shape: Columns) -> Effect:
    """The same with a size that is never nothing."""
    size = Parameter("a", "", 1e-6, 1e3, 0.3, 2.0, True)
    return Effect(name, "x", "damper", (size,), ((0.3,), (1.0,)), False, False, lambda p, i, u, v: p[0] * shape[i])


def proxy_of_two() -> tuple[Effect, Effect, Effect]:
    """Two effects, and a third that does nearly what both do together: alone it is better than each of them."""
    first, second, own = columns(1), columns(2), columns(3)
    both = [a + b + 0.3 * c for a, b, c in zip(first, second, own, strict=True)]
    return linear("first", first), linear("second", second), positive("proxy", both)


def varying(shape: Columns) -> Columns:
    """A column whose size is another one in each test, and of no certain sign."""
    return [a * x for a, x in zip((0.5, -0.4, 0.5, -0.4, 0.4), shape, strict=True)]


def test_an_effect_that_the_others_make_needless_goes() -> None:
    first, second, proxy = proxy_of_two()
    problem = CurveProblem(effects=(first, second, proxy), truth=((first, (0.3,)), (second, (0.3,))))
    # pairs would find the two at once
    result = found(problem, pairs=0)
    assert result.depths[0].adopted is not None and result.depths[0].adopted.names == {"proxy"}
    assert result.best.names == {"first", "second"} and result.best.at_floor


def test_an_effect_gives_its_place_to_a_better_one() -> None:
    first, second, proxy = proxy_of_two()
    problem = CurveProblem(effects=(first, second, proxy), truth=((first, (0.3,)), (second, (0.3,))))
    # two effects at most: none can be added beside the proxy and the one that is found next
    assert found(problem, pairs=0, depth=2).best.names == {"first", "second"}


def test_an_effect_of_which_each_test_says_otherwise_is_none() -> None:
    shape = columns(4)
    varies, same = linear("varies", varying(shape)), positive("same", shape)
    result = found(CurveProblem(effects=(same,), truth=((varies, (1.0,)),)))
    (tried,) = result.depths[0].tried
    assert tried.difference.total > 4.0 and result.best.effects == ()


def test_the_best_model_may_be_unsure_and_another_one_sure() -> None:
    shape = columns(4)
    varies, same, small = linear("varies", varying(shape)), positive("same", shape), linear("small", columns(5))
    problem = CurveProblem(effects=(same, small), truth=((varies, (1.0,)), (small, (0.1,))))
    result = found(problem)
    first, *others = result.depths[0].tried
    assert "same" in first.model.names and not first.difference.sure
    assert result.best.names == {"small"} and "small.x" in [one.model.label for one in others]


def test_a_size_that_two_tests_do_not_separate_from_nothing_is_none() -> None:
    """0.05 and 0.21: Student's t of three degrees of freedom (halves of tests) has 95 % at 3.2 standard errors."""
    shape = columns(6)
    truth = linear("x", [a * x for a, x in zip((0.05, 0.21), shape, strict=False)])
    alike = linear("x", [a * x for a, x in zip((0.129, 0.131), shape, strict=False)])
    one = linear("x", shape)
    assert found(CurveProblem(effects=(one,), truth=((alike, (1.0,)),), tests=2)).best.names == {"x"}
    assert found(CurveProblem(effects=(one,), truth=((truth, (1.0,)),), tests=2)).best.effects == ()


def test_a_shape_far_from_its_start_is_fitted_to_the_end() -> None:
    far = effect("friction", "tanh", lambda p, i, u, v: p[0] * np.tanh(v / p[1]), [(1.0, (5.0,))])
    result = found(CurveProblem(effects=(far, DRAG), truth=((far, (0.2, 0.05)),)))
    assert result.best.label == "friction.tanh" and result.best.at_floor
    assert result.best.fit.values[2:] == pytest.approx((0.2, 0.05), rel=0.1)  # 1500 samples with 5 % noise


def test_models_are_put_in_order_after_a_rough_fit() -> None:
    """Five effects are better than the true one at its start, none where it fits."""
    truth = effect("saw", "x", lambda p, i, u, v: p[0] * np.sin(2.0 * np.pi * p[1] * u), [(1.0, (1.0,))])
    problem = CurveProblem(effects=(), truth=((truth, (0.2, 1.3)),), noise=0.002)
    motion = [np.sin(2.0 * np.pi * 1.3 * u) for u, _ in problem.motions]
    others = [
        linear(f"like_{k}", [m + 0.7 * c for m, c in zip(motion, columns(10 + k), strict=True)]) for k in range(5)
    ]
    assert found(replace(problem, effects=(truth, *others)), pairs=0).best.names == {"saw"}


def test_two_forms_of_an_effect_are_tried_before_another_effect_is_taken() -> None:
    """The first form seems best and is not; another effect fits better than it, the second form better than all."""
    near = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    free = effect("hardening", "power", lambda p, i, u, v: p[0] * np.abs(u) ** p[1] * np.sign(u), [(3.0, (12.0,))])
    bend = effect("bend", "fourth", lambda p, i, u, v: p[0] * u**3 * np.abs(u))
    problem = CurveProblem(effects=(near, free, bend), truth=((free, (0.5, 5.0)),), noise=0.002)
    # one effect at most: none can be added and make the other needless
    result = found(problem, depth=1)
    singles = [start.effect.label for start, _ in result.depths[0].screening.singles]
    assert singles == ["bend.fourth", "hardening.cubic", "hardening.power"]
    assert result.best.label == "hardening.power"


def test_an_equation_that_is_better_where_it_fits_takes_the_place_of_the_one_that_was_found() -> None:
    rough = [effect("hardening", f"power_{n}", lambda p, i, u, v, n=n: p[0] * np.abs(u) ** n * u) for n in (2, 3, 5)]
    free = effect("hardening", "power", lambda p, i, u, v: p[0] * np.abs(u) ** p[1] * np.sign(u), [(3.0, (12.0,))])
    problem = CurveProblem(effects=(*rough, free, DRAG), truth=((free, (0.5, 4.5)),), noise=0.002)
    result = found(problem)
    assert [start.effect.label for start, _ in result.depths[0].screening.singles].index("hardening.power") > 1
    assert result.best.label == "hardening.power" and result.best.at_floor


def test_an_effect_is_judged_by_its_best_equation() -> None:
    """Two equations of the true effect are screened before the true one, and another effect is better than both."""
    true = effect("saw", "true", lambda p, i, u, v: p[0] * np.sin(2.0 * np.pi * p[1] * u), [(1.0, (1.0,))])
    problem = CurveProblem(effects=(), truth=((true, (0.2, 1.3)),), noise=0.002)
    motion = [np.sin(2.0 * np.pi * 1.3 * u) for u, _ in problem.motions]

    def like(name: str, form: str, apart: float, seed: int) -> Effect:
        return linear(name, [m + apart * c for m, c in zip(motion, columns(seed), strict=True)], form)

    near = like("saw", "a", 0.6, 31), like("saw", "b", 0.6, 32), like("other", "x", 0.4, 33)
    result = found(replace(problem, effects=(true, *near)), depth=1, pairs=0)
    singles = [start.effect.label for start, _ in result.depths[0].screening.singles]
    assert singles[0] == "other.x" and singles[-1] == "saw.true"
    assert result.best.label == "saw.true"


@pytest.mark.parametrize(("gate", "names"), [("not_needed", {"left", "right"}), ("small", set())])
def test_errors_of_an_equation_excuse_nothing_where_that_is_not_known(
    monkeypatch: pytest.MonkeyPatch, gate: str, names: set[str]
) -> None:
    """Two effects that nearly take each other off: alone neither is anything, and each would be excused by the other.
    What instruments do not see is none, whatever falls with it."""
    common = columns(21)
    left, right = ([a + 0.1 * b for a, b in zip(common, columns(seed), strict=True)] for seed in (22, 23))
    one, other = linear("left", left), linear("right", right)
    problem = CurveProblem(effects=(one, other), truth=((one, (1.0,)), (other, (-1.0,))))
    judged = Adoption._gate

    def excused(self, model, index, *more):
        return gate if model.effects[index].name == "right" else judged(self, model, index, *more)

    monkeypatch.setattr(Adoption, "_gate", excused)
    assert found(problem).best.names == names


def test_what_is_right_by_what_it_is_hides_nothing_small() -> None:
    """A zero of the load cell is a constant. Were it wrong by a tenth, that would be more than what is hidden."""
    zero = effect("zero", "constant", lambda p, i, u, v: p[0] + 0.0 * u)
    like = effect("bulge", "cubic", lambda p, i, u, v: p[0] * (u**3 + 0.02 * u**5))
    hidden = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    problem = CurveProblem(effects=(zero, hidden, like), truth=((zero, (3.0,)), (hidden, (0.2,))), noise=0.01)
    assert found(problem).best.names == {"zero"}
    names = found(replace(problem, effects=(replace(zero, exact=True), hidden, like))).best.names
    assert names in ({"zero", "hardening"}, {"zero", "bulge"})


def test_an_effect_at_the_bound_of_its_size_is_another_one() -> None:
    """Half of what was measured is asked for by a size that may be a tenth."""
    shape = columns(7)
    size = Parameter("a", "", 0.0, 0.1, 0.05, 0.05)
    small = Effect("small", "x", "damper", (size,), ((0.05,),), False, False, lambda p, i, u, v: p[0] * shape[i])
    assert found(CurveProblem(effects=(small,), truth=((linear("large", shape), (0.5,)),))).best.effects == ()
    assert found(CurveProblem(effects=(small,), truth=((linear("large", shape), (0.08,)),))).best.names == {"small"}


@pytest.mark.parametrize(("whole", "names"), [(True, {"part"}), (False, set())], ids=["share", "size"])
def test_a_share_may_be_all_of_it(whole: bool, names: set[str]) -> None:
    """Noise makes a little more than the whole of what was measured."""
    shape = columns(7)
    size = Parameter("share", "", 0.0, 1.0, 0.5, 0.5, whole=whole)
    part = Effect("part", "x", "damper", (size,), ((0.5,),), False, False, lambda p, i, u, v: p[0] * shape[i])
    model = found(CurveProblem(effects=(part,), truth=((linear("whole", shape), (1.01,)),))).best
    assert model.names == names


def test_what_is_less_than_instruments_see_is_no_effect() -> None:
    shape = columns(7)
    one = linear("small", shape)

    def names(share: float) -> frozenset[str]:
        problem = CurveProblem(effects=(one,), noise=1e-4)
        rms = float(np.sqrt(np.mean(np.concatenate(problem.measured) ** 2)))
        return found(replace(problem, truth=((one, (share * rms,)),))).best.names

    assert names(0.0015) == frozenset() and names(0.003) == {"small"}  # of shapes with a root mean square of 1


def test_an_effect_that_swallows_noise_of_the_motion_is_none() -> None:
    """It explains 1 % of the rms, and noise of the motion is set to make half or twice as much."""
    shape = columns(7)
    one = linear("clearance", shape)
    problem = CurveProblem(effects=(one,), noise=1e-3)
    rms = float(np.sqrt(np.mean(np.concatenate(problem.measured) ** 2)))
    problem = replace(problem, truth=((one, (0.01 * rms,)),))
    assert found(replace(problem, input_noise=0.005**2)).best.names == {"clearance"}
    assert found(replace(problem, input_noise=0.02**2)).best.names == frozenset()


def test_an_equation_may_be_wrong_in_a_way_that_no_other_one_of_it_is() -> None:
    cubic = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    truth = effect("hardening", "truth", lambda p, i, u, v: p[0] * (u**3 + 0.04 * np.sin(2.0 * np.pi * u) * u**2))
    bend = effect("bend", "sine", lambda p, i, u, v: p[0] * np.sin(2.0 * np.pi * u) * u**2)
    problem = CurveProblem(effects=(cubic, bend), truth=((truth, (1.0,)),), noise=0.005)
    assert found(problem).best.names == {"hardening"}
    assert found(problem, own_discrepancy=0.0).best.names == {"hardening", "bend"}


def small_beside_a_large_one(apart: float = 0.003) -> tuple[CurveProblem, Effect]:
    """An effect of a third of the force, and 6 % of it that two other effects explain nearly as well.

    Args:
        apart: by which each of them is off, beside 0.01 that it explains.
    """
    cubic = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    error = [0.01 * c for c in columns(51)]
    truth = effect("hardening", "truth", lambda p, i, u, v: p[0] * u**3 + error[i])

    def like(name: str, seed: int) -> Effect:
        return linear(name, [m + apart * c for m, c in zip(error, columns(seed), strict=True)])

    one, other = like("one", 52), like("other", 53)
    return CurveProblem(effects=(cubic, one, other), truth=((truth, (0.5,)),), noise=0.002), one


def test_a_small_effect_that_another_one_explains_as_well_is_an_error_of_the_large_one() -> None:
    problem, one = small_beside_a_large_one()
    assert found(problem).best.names == {"hardening"}
    cubic = problem.effects[0]
    assert found(replace(problem, effects=(cubic, one))).best.names == {"hardening", "one"}


def test_what_is_explained_nearly_whole_is_no_error_of_the_large_effect() -> None:
    """Another equation of an effect leaves 21 % of it in the median; these leave 6 % and 30 % of what is missing."""
    names = [found(replace(small_beside_a_large_one(apart)[0], noise=0.0005)).best.names for apart in (0.0003, 0.003)]
    assert names[0] in ({"hardening", "one"}, {"hardening", "other"}) and names[1] == {"hardening"}


def test_a_small_effect_that_came_in_a_pair_needs_to_be_separated_from_others_too() -> None:
    """Only the best model is fitted to the end, so that no rival of it is at hand."""
    problem, _ = small_beside_a_large_one()
    result = found(problem, beam=1)
    assert [tried.model.label for tried in result.depths[0].tried] == ["hardening.cubic + other.x"]
    assert result.best.names == {"hardening"}


def test_a_small_pair_that_another_pair_explains_as_well_is_an_error_of_the_large_effect() -> None:
    """Of each pair the difference is what is missing, and no effect of one pair does without the other of it.

    Noise is 30 % of what is missing: more than an equation may leave of it."""
    cubic = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    error = [0.01 * c for c in columns(51)]
    truth = effect("hardening", "truth", lambda p, i, u, v: p[0] * u**3 + error[i])

    def pair(one: str, other: str, seed: int) -> tuple[Effect, Effect]:
        apart = [0.1 * c for c in columns(seed)]
        return linear(one, [m + c for m, c in zip(error, apart, strict=True)]), linear(other, apart)

    first, second = pair("first", "second", 52), pair("third", "fourth", 53)
    problem = CurveProblem(effects=(cubic, *first), truth=((truth, (0.5,)),), noise=0.003)
    assert found(problem).best.names == {"hardening", "first", "second"}
    assert found(replace(problem, effects=(cubic, *first, *second))).best.names == {"hardening"}


def test_effects_are_screened_beside_what_is_each_tests_own() -> None:
    """What the second effect does is a constant mostly, of which each test has one of its own."""
    lifted = effect("lifted", "x", lambda p, i, u, v: p[0] * (20.0 + np.sin(7.0 * u)))
    problem = CurveProblem(effects=(OWN, lifted), truth=((lifted, (0.03,)),), zeros=2.0)
    assert found(problem).best.names == {"zero", "lifted"}


def test_what_is_slow_and_each_tests_own_is_seen_behind_better_guesses() -> None:
    """Under slow noise two lines are no evidence; noise by what all effects together leave shows them."""
    line = effect("line", "own", lambda p, i, u, v: 40.0 * np.linspace(0.0, 1.0, u.size)[:, np.newaxis], nuisance=True)
    up = effect("up", "x", lambda p, i, u, v: p[0] * (-1.0) ** i * np.linspace(0.0, 1.0, u.size))
    others = [linear(f"guess_{k}", columns(20 + k)) for k in range(3)]
    problem = CurveProblem(effects=(line, *others), truth=((up, (2.0,)),), tests=2)
    assert found(problem, singles=1, pairs=0).best.names == {"line"}


def test_effects_are_screened_beside_another_reading_of_the_base() -> None:
    """Beside the reading at hand a guess comes before the effect, which is the first one beside the right reading."""
    course = columns(61)
    reading = Effect("reading", "x", "damper", (), ((),), False, False, lambda p, i, u, v: course[i])
    guesses = [
        linear(f"guess_{k}", [m + 0.5 * c for m, c in zip(course, columns(62 + k), strict=True)]) for k in range(3)
    ]
    effects = (*guesses, DRAG, reading)
    problem = CurveProblem(effects=effects, truth=((reading, ()), (DRAG, (0.1,))))
    result = found(problem, singles=1, pairs=0, depth=2)
    assert result.depths[0].best.names == {"reading"} and result.best.names == {"reading", "drag"}
    assert "reading" not in found(replace(problem, truth=((DRAG, (0.1,)),))).best.names


def test_what_is_each_tests_own_is_screened_in_pairs() -> None:
    """Beside its own constant each test shows the second effect; neither is better alone than the other guesses."""
    lifted = effect("lifted", "x", lambda p, i, u, v: p[0] * (20.0 + np.sin(7.0 * u)))
    problem = CurveProblem(effects=(OWN, lifted, DRAG), truth=((lifted, (0.03,)),), zeros=2.0)
    pairs = found(problem).depths[0].screening.pairs
    assert {start.effect.name for start in pairs[0][0]} == {"zero", "lifted"}


def test_models_are_fitted_again_without_a_test_that_moves_them_far() -> None:
    """One test alone goes far enough to determine size and exponent."""
    power = effect(
        "hardening", "power", lambda p, i, u, v: p[0] * np.abs(u) ** p[1] * np.sign(u), [(3.0, (4.0,))], spread=0.1
    )
    problem = CurveProblem(effects=(power,), truth=((power, (0.3, 6.0)),), tests=4)
    sizes = (0.45, 0.5, 0.4, 1.2)
    problem.__dict__["motions"] = [
        (a * u / np.max(np.abs(u)), a * v / np.max(np.abs(u))) for a, (u, v) in zip(sizes, problem.motions, strict=True)
    ]
    fitter, noise = Fitter(problem, SETTINGS), Noise.white(problem.deviations)
    model = fitter.fit((power,), np.array([1.0, 0.3, 0.3, 6.0]), noise)
    assert model is not None
    without = fitter.fit((power,), model.fit, noise.without(3))
    assert without is not None
    assert np.max(np.abs(without.fit.z - model.fit.z)) > 1.0  # standard deviation of a prior
    rough, sure = (fitter.score(model, noise, roughly=one) for one in (True, False))
    assert sure.total == score(model.fit, noise, refits=True).total != rough.total


def test_a_search_comes_to_its_end() -> None:
    """One effect is better than the other by the score, and of a size that may be nothing."""
    shape = columns(4)
    varies = linear("varies", [a * x for a, x in zip((0.5, -0.2, 0.6, -0.2, 0.45), shape, strict=True)])
    same, small = linear("same", shape), linear("small", columns(5))
    problem = CurveProblem(effects=(same, small), truth=((varies, (1.0,)), (small, (0.1,))))
    result = found(problem, effort=600.0)
    assert result.ending == "complete"
    adopted = [depth.adopted.names for depth in result.depths if depth.adopted is not None]
    assert len(set(adopted)) == len(adopted) and result.best.names in adopted


def test_a_delay_is_no_mass_that_comes_near_to_it() -> None:
    """A third equation of a lag is in the data; a mass leaves noise too, and the two that are screened first do not."""

    def beside(part: float, smooth: float) -> Change:
        return lambda p, i, u, v: p[0] * (u**3 + part * np.tanh(v / smooth))

    delay = effect("lag", "delay", lambda p, i, u, v: p[0] * (u**3 + 0.6 * np.tanh(v / p[1])), [(1.0, (3.0,))])
    others = (effect("lag", "filter", beside(0.3, 1e-3)), effect("lag", "second_order", beside(0.28, 1e-3)))
    mass = effect("inertia", "mass", beside(0.6, 0.052))
    search = found(CurveProblem(effects=(mass, *others, delay), truth=((delay, (0.5, 0.05)),)))
    assert "lag.delay" in {model.label for model in search.models}


def better_than_all(monkeypatch: pytest.MonkeyPatch) -> CurveProblem:
    """Whatever is compared is better than the other, by the rule. Of two effects the first is the true one."""
    asked = itertools.count()

    def difference(*_: object) -> Difference:
        assert next(asked) < 1000
        return Difference(100.0, 0.0)

    monkeypatch.setattr(Fitter, "difference", difference)
    monkeypatch.setattr(Fitter, "behind", lambda *_: False)
    first, second = columns(1), columns(2)
    both = [a + 0.8 * b for a, b in zip(first, second, strict=True)]
    return CurveProblem(effects=(linear("one", first), linear("other", both)), truth=((linear("x", first), (0.3,)),))


def test_a_set_of_effects_is_taken_once(monkeypatch: pytest.MonkeyPatch) -> None:
    problem = better_than_all(monkeypatch)
    monkeypatch.setattr(Adoption, "_predicts_as_well", lambda *_: True)
    monkeypatch.setattr(Adoption, "insignificant", lambda *_: False)
    assert found(problem, depth=1, pairs=0).ending == "complete"


def test_what_takes_the_place_of_an_effect_predicts_as_well_under_its_noise(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert found(better_than_all(monkeypatch), depth=1, pairs=0).best.names == {"one"}


def test_an_effect_that_takes_the_place_of_another_has_its_best_equation() -> None:
    """Depth two is reached with the third effect, so that no further round of the search chooses equations."""
    first, _, proxy = proxy_of_two()
    base, beside = columns(2), columns(8)
    near = linear("second", [a + 0.3 * b for a, b in zip(base, beside, strict=True)], "near")
    free = effect("second", "free", lambda p, i, u, v: p[0] * (base[i] + p[1] * beside[i]), [(0.3, (30.0,))])
    problem = CurveProblem(effects=(first, near, free, proxy), truth=((first, (0.3,)), (free, (0.25, 0.1))))
    result = found(problem, pairs=0, depth=2)
    assert result.depths[-1].adopted is not None and result.depths[-1].adopted.names == {"proxy", "first"}
    assert {effect.label for effect in result.best.effects} == {"first.x", "second.free"}


def test_forms_with_shares_of_each_test_are_tried_beside_all_others() -> None:
    """Two forms of one size are screened before the one whose shape shows only where it is fitted."""
    shape = Parameter("s", "", 1e-3, 1e3, 1.0, 1.5, True)

    def waves(p: np.ndarray, i: int, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return (1.0 + 20.0 * (p[0] - 0.3) * u)[:, np.newaxis]

    own = Effect("zero", "own", "instrument", (shape,), ((3.0,),), False, True, waves)
    others = [effect("zero", f"form_{k}", lambda p, i, u, v, k=k: p[0] * (1.0 + k * u)) for k in (0.0, 0.2)]
    result = found(CurveProblem(effects=(*others, own), zeros=2.0, seed=4))
    assert [start.effect.label for start, _ in result.depths[0].screening.singles][-1] == "zero.own"
    assert result.best.label == "zero.own"


def test_no_model_of_the_beam_has_an_effect_that_it_does_not_need() -> None:
    true, idle = linear("true", columns(1)), [linear(f"idle_{k}", columns(20 + k)) for k in range(3)]
    result = found(CurveProblem(effects=(true, *idle), truth=((true, (0.3,)),)))
    assert [one.model.label for one in result.depths[0].tried][0] == "true.x"
    assert all(len(one.model.effects) == 1 for one in result.depths[0].tried)


def test_an_effect_is_needed_beside_the_best_equations_of_the_others() -> None:
    """A cubic and a bend make what one power does, whose equation is screened far from where it fits."""
    cubic = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    truth = effect("hardening", "power", lambda p, i, u, v: p[0] * np.abs(u) ** p[1] * np.sign(u), [(3.0, (20.0,))])
    bend = effect("bend", "x", lambda p, i, u, v: p[0] * (np.abs(u) ** 4.4 * np.sign(u) - 0.8 * u**3))
    problem = CurveProblem(effects=(cubic, truth, bend), truth=((truth, (0.5, 4.4)),), noise=0.002)
    assert found(problem, beam=1, others=0).best.label == "hardening.power"


def test_of_equations_that_predict_alike_the_plainest_is_taken() -> None:
    cubic = effect("hardening", "cubic", lambda p, i, u, v: p[0] * u**3)
    power = effect("hardening", "power", lambda p, i, u, v: p[0] * np.abs(u) ** p[1] * np.sign(u), [(3.0, (3.0,))])
    labels = [
        found(CurveProblem(effects=(cubic, power), truth=((cubic, (0.3,)),), seed=seed)).best.label for seed in range(6)
    ]
    assert labels == ["hardening.cubic"] * 6


@pytest.mark.parametrize("seed", range(4))
def test_an_effect_of_no_size_does_not_take_the_place_of_another(seed: int) -> None:
    """A rig with play, and no play in it, is a flexible rig. The two come in as a pair."""
    stretch, clearance = columns(1), columns(2)
    play = Parameter("play", "", 0.0, 10.0, 0.1, 0.1)
    stiffness = Parameter("stiffness", "", 1e-3, 1e3, 0.3, 2.0, True)
    flexible = linear("flexible", stretch)
    loose = Effect(
        *("loose", "x", "rig", (play, stiffness), ((0.02, 0.3),), False, False),
        lambda p, i, u, v: p[1] * stretch[i] + p[0] * clearance[i],
    )
    # 1.5 standard errors of play: better by the score, and it may be nothing
    chance = linear("chance", clearance)
    problem = CurveProblem(effects=(loose, flexible), truth=((flexible, (0.3,)), (chance, (4e-4,))), seed=seed)
    assert found(problem, singles=0).best.names == {"flexible"}


def test_of_effects_that_come_together_the_one_that_explains_more_stands_first() -> None:
    large, small = linear("large", columns(1)), linear("small", columns(2))
    for effects in ((large, small), (small, large)):
        problem = CurveProblem(effects=effects, truth=((large, (0.3,)), (small, (0.1,))))
        assert found(problem, singles=0).best.label == "large.x + small.x"
