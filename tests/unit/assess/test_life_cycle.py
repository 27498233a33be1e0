"""Rates of exceedance and expected losses against quadrature, closed forms and simulation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from edesign.assess.fragility import Fragility
from edesign.assess.life_cycle import HazardCurve, exceedance, expected_loss
from edesign.codes.interpolation import log_log
from edesign.errors import InputError

BENT = HazardCurve(np.array([0.05, 0.2, 0.6, 1.5]), np.array([0.05, 0.01, 1e-3, 5e-5]))


def fragility(theta: float, beta: float) -> Fragility:
    return Fragility(theta, beta, 0.0, 0.0, 20, 0, 0.0)


@pytest.mark.parametrize("beta", [0.2, 0.6])
def test_a_straight_hazard_curve_has_the_closed_form(beta: float) -> None:
    """H(theta) exp(k^2 beta^2 / 2), Cornell, Jalayer, Hamburger & Foutch (2002), Eq. 18."""
    k, theta = 2.7, 0.4
    im = np.array([0.1, 1.0])
    curve = HazardCurve(im, im**-k / 475.0)
    found = exceedance(fragility(theta, beta), curve)
    assert found.rate == pytest.approx(theta**-k / 475.0 * math.exp(0.5 * (k * beta) ** 2), rel=1e-12)
    assert found.return_period == 1.0 / found.rate
    assert found.probability(50.0) == pytest.approx(1.0 - math.exp(-50.0 * found.rate), rel=1e-12)


@pytest.mark.parametrize(("theta", "beta", "dispersion"), [(0.3, 0.4, 0.0), (0.8, 0.3, 0.35), (3.0, 0.5, 0.0)])
def test_a_bent_hazard_curve_by_quadrature(theta: float, beta: float, dispersion: float) -> None:
    whole = math.hypot(beta, dispersion)

    def integrand(x: float) -> float:
        rate = float(log_log(np.array(theta * math.exp(x)), BENT.intensity, BENT.rate))
        return rate * norm.pdf(x / whole) / whole

    corners = np.log(BENT.intensity / theta)
    pieces = np.concatenate(([-12.0], corners[np.abs(corners) < 12.0], [12.0]))
    parts = [quad(integrand, a, b, epsrel=1e-11)[0] for a, b in zip(pieces[:-1], pieces[1:], strict=True)]
    found = exceedance(fragility(theta, beta), BENT, dispersion)
    assert found.rate == pytest.approx(sum(parts), rel=1e-8)
    assert found.below == pytest.approx(parts[0] / sum(parts), abs=1e-8)
    assert found.beyond == pytest.approx(parts[-1] / sum(parts), abs=1e-8)


@pytest.mark.parametrize("theta", [0.05, 0.0999, 0.1, 0.3])
def test_a_steep_line_between_others_is_the_step_that_it_nearly_is(theta: float) -> None:
    """With k = 1e7 on the second line, H falls from 1e-2 to 1e-6 at 0.1; the first and third line have k = 1."""
    top = 0.1 * 1e4**1e-7
    curve = HazardCurve(np.array([0.01, 0.1, top, 1.0]), np.array([0.1, 1e-2, 1e-6, 1e-7]))
    assert curve.exponents == pytest.approx([1.0, 1e7, 1.0], rel=1e-6)
    beta, x = 0.4, math.log(0.1 / theta) / 0.4
    below, beyond = (r * 0.1 / theta * math.exp(beta**2 / 2.0) for r in (1e-2, 1e-6))
    expected = below * norm.cdf(x + beta) + beyond * norm.sf(x + beta)
    found = exceedance(fragility(theta, beta), curve)
    assert found.rate == pytest.approx(expected, rel=2e-5)
    assert 0.0 <= found.below <= 1.0 and 0.0 <= found.beyond <= 1.0


@pytest.mark.parametrize("top", [1.000001, 1.2])
def test_a_steep_first_line_is_refused(top: float) -> None:
    with pytest.raises(InputError, match="E-CURVE-06"):
        exceedance(fragility(0.8, 0.4), HazardCurve(np.array([0.1, 0.1 * top]), np.array([0.02, 1e-300])))


@pytest.mark.parametrize(
    ("intensity", "rate"), [([0.1], [0.01]), ([0.2, 0.1], [0.01, 0.001]), ([0.1, 0.2], [0.01, 0.01])]
)
def test_wrong_curves(intensity: list[float], rate: list[float]) -> None:
    with pytest.raises(InputError, match="E-CURVE-06"):
        HazardCurve(np.array(intensity), np.array(rate))


def test_expected_loss_is_the_mean_of_simulated_lives() -> None:
    """Poisson arrivals of each state over 50 years, losses discounted to the present; 3 standard errors."""
    rates, losses = {"LS": 0.01, "CP": 0.003, "collapse": 0.0008}, {"collapse": 1.0, "LS": 0.2, "CP": 0.6}
    years, discount = 50.0, 0.04
    found = expected_loss(rates, losses, years, discount)
    assert found.annual == pytest.approx(0.01 * 0.2 + 0.003 * 0.4 + 0.0008 * 0.4, rel=1e-12)
    assert sum(found.shares.values()) == pytest.approx(1.0)
    rng = np.random.default_rng(5)
    lives = np.zeros(200_000)
    exactly = {"LS": 0.007, "CP": 0.0022, "collapse": 0.0008}  # in this state and no worse one
    for state, rate in exactly.items():
        number = rng.poisson(rate * years, lives.size)
        life = np.repeat(np.arange(lives.size), number)
        when = rng.uniform(0.0, years, life.size)
        lives += np.bincount(life, losses[state] * np.exp(-discount * when), lives.size)
    error = 3.0 * lives.std() / math.sqrt(lives.size)
    assert abs(found.present_value - lives.mean()) < error
    assert expected_loss(rates, losses, years).present_value == pytest.approx(years * found.annual)
