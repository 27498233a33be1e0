"""The estimator against closed forms: normal and flat priors, bounds, shares of each test, predictions that fail."""

from __future__ import annotations

import numpy as np
import pytest
from estimation_models import FormulaModel, free, linear, normal
from scipy.optimize import lsq_linear

from edesign.estimation.least_squares import Settings, _Search, fit
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter, coordinates_of
from edesign.estimation.uncertainty import at_bounds, uncertainty

TIGHT = Settings(enough=1e-12, steps=100)


def campaign(seed: int, tests: int = 5, samples: int = 40, p: int = 4) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Matrices and measured values of linear models."""
    generator = np.random.default_rng(seed)
    matrices = [generator.standard_normal((samples + i, p)) for i in range(tests)]
    truth = generator.standard_normal(p)
    return matrices, [x @ truth + 0.5 * generator.standard_normal(len(x)) for x in matrices]


def test_a_linear_model_has_the_posterior_in_closed_form() -> None:
    """Mean and covariance of the conjugate normal model; differences of a linear model are exact but for rounding."""
    matrices, measured = campaign(1)
    parameters = (*normal("ab", 2.0, 0.3), *normal("cd", 0.1))
    deviations = [0.4, 0.5, 0.6, 0.7, 0.8]
    found = fit(linear(matrices, measured, parameters), Noise.white(deviations), settings=TIGHT)
    precision = np.diag([1 / 4.0, 1 / 4.0, 100.0, 100.0])
    right = precision @ [0.3, 0.3, 0.0, 0.0]
    for x, y, deviation in zip(matrices, measured, deviations, strict=True):
        precision, right = precision + x.T @ x / deviation**2, right + x.T @ y / deviation**2
    np.testing.assert_allclose(found.values, np.linalg.solve(precision, right), rtol=1e-8)
    reported, n = uncertainty(found), sum(len(y) for y in measured)
    size, middle = np.array([one.spread for one in parameters]), np.diag([1 / 4.0, 1 / 4.0, 100.0, 100.0])
    for x, r, deviation in zip(matrices, found.left, deviations, strict=True):  # each test has a variance of its own
        middle += x.T @ x / deviation**2 * np.mean(r**2) / deviation**2 * n / reported.freedom
    inverse = np.linalg.inv(precision)
    assert reported.freedom == pytest.approx(n - np.trace(inverse @ (precision - np.diag([0.25, 0.25, 100.0, 100.0]))))
    np.testing.assert_allclose(reported.within * np.outer(size, size), inverse @ middle @ inverse, rtol=1e-7)


@pytest.mark.parametrize("seed", range(20))
def test_bounds_hold_as_in_bounded_linear_least_squares(seed: int) -> None:
    """Reference: scipy's lsq_linear by another method; nearly collinear columns, so that parameters push each other."""
    generator = np.random.default_rng(seed)
    x = generator.standard_normal((30, 6)) + 3.0 * generator.standard_normal((30, 1))
    y = 3.0 * generator.standard_normal(30)
    model = linear([x], [y], free("abcdef", 0.5, -0.2, 0.3))
    found = fit(model, Noise.white([1.0]), settings=TIGHT)
    expected = lsq_linear(x, y, (-0.2, 0.3), method="trf", tol=1e-14, lsmr_tol="auto")
    assert found.left[0] @ found.left[0] <= 2.0 * expected.cost * (1.0 + 1e-9)
    np.testing.assert_allclose(found.values, expected.x, atol=1e-4)  # an interior method ends before its bounds
    stands = at_bounds(found)
    for value, where in zip(found.values, stands, strict=True):
        assert where == ("lower" if value < -0.2 + 1e-9 else "upper" if value > 0.3 - 1e-9 else "")


def test_flat_priors_are_plain_least_squares_at_any_scale() -> None:
    matrices, measured = campaign(2, p=3)
    size = np.array([1e-9, 1.0, 1e9])
    parameters = tuple(
        Parameter(n, "", -np.inf, np.inf, 0.0, 3.0 * s, flat=True) for n, s in zip("abc", size, strict=True)
    )
    found = fit(linear([x / size for x in matrices], measured, parameters), Noise.white([1.0] * 5), settings=TIGHT)
    expected = np.linalg.lstsq(np.vstack(matrices), np.concatenate(measured))[0] * size
    np.testing.assert_allclose(found.values, expected, rtol=1e-7)


def test_huge_priors_shorten_differences() -> None:
    """A prior of 1e4 about a rate of 2: a thousandth of it leads far beyond where the model is like its slope."""
    time = np.linspace(0.0, 2.0, 50)
    model = FormulaModel(normal("ab", 1e4), (3.0 * np.exp(-2.0 * time),), lambda v: [v[0] * np.exp(-v[1] * time)])
    start = coordinates_of(model.parameters, [2.0, 1.0])
    with np.errstate(over="ignore"):
        found = fit(model, Noise.white([0.01]), start, settings=Settings(enough=1e-6, steps=60))
    assert found.values == pytest.approx([3.0, 2.0], rel=1e-4)


def test_a_logarithm_is_searched_ten_deviations_about_its_prior() -> None:
    one = Parameter("k", "N/m", 0.0, np.inf, 1e6, 0.5, logarithmic=True)
    assert one.range == (-10.0, 10.0)
    assert one.coordinate(0.0) == -10.0 and one.value(one.coordinate(2e6)) == pytest.approx(2e6, rel=1e-14)
    beyond = Parameter("k", "N/m", 1e9, 1e12, 1e6, 0.5, logarithmic=True)  # all of it far out: still a range
    assert beyond.range[0] == pytest.approx(np.log(1e3) / 0.5) and beyond.range[0] < beyond.range[1]
    with pytest.raises(ValueError, match="k: bounds 1 to 1"):
        Parameter("k", "", 1.0, 1.0, 1.0, 1.0)
    with pytest.raises(ValueError, match="spread inf"):
        Parameter("k", "", 0.0, 1.0, 1.0, np.inf)


def test_shares_of_a_test_are_explicit_parameters_with_standard_normal_priors() -> None:
    matrices, measured = campaign(3, p=2)
    columns = [np.column_stack((np.ones(len(x)), np.linspace(-1.0, 1.0, len(x)))) * 2.0 for x in matrices]
    measured = [y + c @ [0.7, -0.4] for y, c in zip(measured, columns, strict=True)]
    noise = Noise.white([0.5] * 5)
    model = linear(matrices, measured, normal("ab"))
    model.columns = lambda values: columns
    own = fit(model, noise, settings=TIGHT)
    wide = []
    for i, (x, c) in enumerate(zip(matrices, columns, strict=True)):
        wide.append(np.hstack((x, np.zeros((len(x), 10)))))
        wide[-1][:, 2 + 2 * i : 4 + 2 * i] = c
    explicit = fit(linear(wide, measured, normal("abcdefghijkl")), noise, settings=TIGHT)
    np.testing.assert_allclose(own.values, explicit.values[:2], rtol=1e-7)
    np.testing.assert_allclose(np.concatenate(own.weighted().amplitudes), explicit.values[2:], rtol=1e-6)
    errors = [np.sqrt(np.diag(uncertainty(one).within))[:2] for one in (own, explicit)]
    np.testing.assert_allclose(*errors, rtol=0.02)  # degrees of freedom: 10 of 210 differ
    assert own.evaluations < explicit.evaluations


def test_a_parameter_that_acts_through_the_shares_alone_is_found() -> None:
    """Hum: a tone of unknown frequency, its phase and size of each test."""
    generator, time = np.random.default_rng(5), np.arange(0.0, 4.0, 0.01)
    tones = lambda v: [np.column_stack((np.cos(2 * np.pi * v[1] * time), np.sin(2 * np.pi * v[1] * time)))] * 3  # noqa: E731
    truth = np.array([1.5, 3.1])
    force = [truth[0] * np.sin(time + i) for i in range(3)]
    measured = [
        f + tones(truth)[0] @ generator.standard_normal(2) + 0.1 * generator.standard_normal(400) for f in force
    ]
    parameters = (*normal("a"), Parameter("frequency", "Hz", 1.0, 5.0, 3.0, 0.3))
    model = FormulaModel(parameters, tuple(measured), lambda v: [v[0] * f / truth[0] for f in force], tones)
    found = fit(model, Noise.white([0.1] * 3), settings=TIGHT)
    reported = uncertainty(found)
    for i in range(2):  # four standard errors
        assert abs(found.values[i] - truth[i]) < 4.0 * np.sqrt(reported.within[i, i]) * parameters[i].spread
    assert np.sqrt(reported.within[1, 1]) * 0.3 < 0.01


@pytest.mark.parametrize("bad", [np.nan, np.inf, None])
def test_predictions_that_fail_are_walls(bad: float | None) -> None:
    """No prediction beyond 2, where the least squares of all would be: the fit ends before it."""
    time = np.linspace(0.1, 1.0, 20)

    def formula(v: np.ndarray) -> list[np.ndarray] | PredictionError:
        if v[0] > 2.0:
            return PredictionError("beyond") if bad is None else [np.full(20, bad)]
        return [v[0] * time + v[1]]

    model = FormulaModel(free("ab"), (3.0 * time + 1.0,), formula)
    found = fit(model, Noise.white([0.1]), np.array([1.0, 0.0]), settings=TIGHT)
    assert 1.9 < found.values[0] <= 2.0
    with pytest.raises(PredictionError):
        fit(model, Noise.white([0.1]), np.array([3.0, 0.0]))


def test_nothing_to_fit_and_what_does_nothing() -> None:
    model = linear([np.ones((3, 0))], [np.ones(3)], ())
    assert fit(model, Noise.white([1.0])).converged
    dead = linear([np.column_stack((np.ones(5), np.zeros(5)))], [np.ones(5)], free("ab"))
    found = fit(dead, Noise.white([1.0]), settings=TIGHT)
    assert found.values == pytest.approx([1.0, 0.0], abs=1e-6)
    reported = uncertainty(found)
    assert reported.loose == pytest.approx([0.0, 1.0], abs=1e-9) and not reported.determined(1)


def test_batches_do_not_matter() -> None:
    time = np.linspace(0.0, 2.0, 50)
    formula = lambda v: [v[0] * np.exp(-v[1] * time) + v[2]]  # noqa: E731
    measured = (formula([3.0, 2.0, 0.5])[0] + 0.01 * np.sin(20.0 * time),)

    class OneByOne(FormulaModel):
        def predict(self, values: np.ndarray):
            return [FormulaModel.predict(self, one[np.newaxis])[0] for one in values]

    one, many = (kind(normal("abc", 1.0, 1.0), measured, formula) for kind in (OneByOne, FormulaModel))
    ends = [fit(model, Noise.white([0.01]), settings=TIGHT) for model in (one, many)]
    assert np.array_equal(ends[0].z, ends[1].z) and ends[0].evaluations == ends[1].evaluations
    assert max(one.batches) == 1 and max(many.batches) == 3


def test_noise_is_never_nothing() -> None:
    noise = Noise.left_by([np.zeros(10), np.zeros(10)], [0.0, 0.0], [2.0, 0.0])
    assert all(value > 0.0 for value in noise.variance)
    with pytest.raises(ValueError, match="must be positive"):
        Noise.white([1.0, 0.0])


def test_differences_that_are_too_long_however_short_come_to_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where predictions jump: play that closes, a test that the law cannot follow."""
    matrices, measured = campaign(5, p=2)
    monkeypatch.setattr(_Search, "too_long", lambda *_: True)
    assert fit(linear(matrices, measured, free("ab")), Noise.white([1.0] * 5)).evaluations < 100
