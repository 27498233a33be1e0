"""How often limits are passed in the life of a building, and what that costs: fragilities over a hazard curve."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy

from edesign.assess.fragility import Fragility
from edesign.codes.interpolation import exponents
from edesign.codes.motion_sets import STATIONARY_DURATION
from edesign.errors import InputError

SQRT_2 = math.sqrt(2.0)
LARGEST_EXPONENT = math.log(np.finfo(float).max)
MOST_A_YEAR = 365.25 * 86400.0 / STATIONARY_DURATION
"""Once in 10 s, the least duration of the stationary part of a motion (EN 1998-1, 3.2.3.1.2(3)). Motions that come
more often overlap, and are no events of a Poisson process; such rates come from lines that are too steep to go on."""


@dataclass(frozen=True)
class HazardCurve:
    """Annual rate at which an intensity is exceeded: straight lines between points in logarithms of both.

    Beyond the first and last point the outermost lines go on.

    Attributes:
        intensity: (n,) ascending, greater than zero.
        rate: (n,) a year, falling.
    """

    intensity: np.ndarray
    rate: np.ndarray

    def __post_init__(self) -> None:
        if self.intensity.size < 2 or self.intensity.shape != self.rate.shape:
            raise InputError("a hazard curve needs two points or more, each an intensity and its rate [E-CURVE-06]")
        if np.any(self.intensity <= 0.0) or np.any(np.diff(self.intensity) <= 0.0):
            raise InputError("the intensities of a hazard curve must be greater than zero and ascend [E-CURVE-06]")
        if np.any(self.rate <= 0.0) or np.any(np.diff(self.rate) >= 0.0):
            raise InputError("the larger an intensity, the longer must be its return period [E-CURVE-06]")

    @property
    def exponents(self) -> np.ndarray:
        """Exponents k of each line, (n - 1,): H = k0 im^-k, as in EN 1998-1, 2.1(4)."""
        return -exponents(self.intensity, self.rate)


@dataclass(frozen=True)
class Exceedance:
    """Rate at which a limit is passed.

    Attributes:
        rate: a year.
        below, beyond: shares of the rate that come from below the first and beyond the last point of the hazard curve.
    """

    rate: float
    below: float
    beyond: float

    @property
    def return_period(self) -> float:
        """Mean years between two exceedances; infinite if there are none."""
        return 1.0 / self.rate if self.rate > 0.0 else math.inf

    def probability(self, years: float) -> float:
        """Return the probability of at least one exceedance in some years, of a Poisson process.

        Args:
            years: length of the period of time.

        Returns:
            0 to 1.
        """
        return -math.expm1(-self.rate * years)


def exceedance(fragility: Fragility, curve: HazardCurve, dispersion: float = 0.0) -> Exceedance:
    """Integrate a fragility over a hazard curve: the integral of H(im) dP(im).

    Exact for the lognormal fragility and the lines of the curve: over one of them, H = k0 im^-k from a to b, it is
    H(theta) exp(k^2 beta^2 / 2) (Phi(ln(b/theta)/beta + k beta) - Phi(ln(a/theta)/beta + k beta)).

    Args:
        fragility: of the limit.
        dispersion: of modelling, added to that of the records by the root of the sum of squares.

    Raises:
        InputError: the first line of the curve is so steep that the rate is more than one in 10 s.

    Source: Cornell, Jalayer, Hamburger & Foutch (2002), Journal of Structural Engineering 128(4), Eq. 18 for one line;
    FEMA P-58-1, 7.6 (time-based assessment).
    """
    beta = math.hypot(fragility.beta, dispersion)
    lines = curve.exponents.size
    edges = np.concatenate(([0.0], curve.intensity[1:-1], [np.inf]))
    rate = sum(_over_line(curve, i, edges[i], edges[i + 1], fragility.theta, beta) for i in range(lines))
    if not rate <= MOST_A_YEAR:
        raise InputError(
            f"the first line of the hazard curve, k = {curve.exponents[0]:.4g}, is too steep to go on below its first "
            f"point with a dispersion of {beta:.3g}; codes have k of the order of 3 [E-CURVE-06]"
        )
    below = _over_line(curve, 0, 0.0, curve.intensity[0], fragility.theta, beta)
    beyond = _over_line(curve, lines - 1, curve.intensity[-1], np.inf, fragility.theta, beta)
    return Exceedance(rate, below / rate if rate > 0.0 else 0.0, beyond / rate if rate > 0.0 else 0.0)


def _over_line(curve: HazardCurve, i: int, low: float, high: float, theta: float, beta: float) -> float:
    """The integral over a part of a line of the curve, from `low` to `high`; infinite where it is beyond numbers.

    With x = ln(a/theta)/beta, H(theta) exp(k^2 beta^2 / 2) Phi(-x - k beta) is H(a) exp(-x^2 / 2) erfcx((x + k beta) /
    sqrt(2)) / 2, in which nothing is large, whatever k is.
    """
    k = float(curve.exponents[i])

    def log_rate(im: float) -> float:
        return math.log(curve.rate[i]) - k * math.log(im / curve.intensity[i])

    def place(im: float) -> float:
        return -math.inf if im == 0.0 else math.log(im / theta) / beta if im < math.inf else math.inf

    def tail(im: float, side: float) -> float:
        """What is beyond (1) or before (-1) an intensity that is beyond or before the largest of the integrand."""
        x = place(im)
        if math.isinf(x):
            return 0.0
        return math.exp(log_rate(im) - 0.5 * x * x) * float(scipy.special.erfcx(side * (x + k * beta) / SQRT_2)) / 2.0

    if place(low) + k * beta >= 0.0:
        return tail(low, 1.0) - tail(high, 1.0)
    if place(high) + k * beta <= 0.0:
        return tail(high, -1.0) - tail(low, -1.0)
    exponent = log_rate(theta) + 0.5 * (k * beta) ** 2
    whole = math.exp(exponent) if exponent < LARGEST_EXPONENT else math.inf
    return whole - tail(low, -1.0) - tail(high, 1.0)


@dataclass(frozen=True)
class Loss:
    """Loss when limits are passed, as shares of the value of the building.

    Attributes:
        annual: expected loss a year.
        present_value: of all losses in the years looked at.
        shares: of the annual loss by limit, each beyond the limit of the next smaller loss.
    """

    annual: float
    present_value: float
    shares: Mapping[str, float]


def expected_loss(rates: Mapping[str, float], losses: Mapping[str, float], years: float, discount: float = 0.0) -> Loss:
    """Return the expected loss from annual rates of exceedance.

    A motion that passes a limit costs its loss; the annual loss is the sum of rate times what the loss of a limit is
    beyond that of the next smaller one. The building is repaired each time.

    Args:
        rates: a year, by limit.
        losses: shares of the value, of limits that have a rate.
        years: looked at.
        discount: rate a year; money of a year t counts exp(-discount t).

    Source: Ramirez & Miranda (2012), Eq. 1, for losses by damage states; Wen & Kang (2001), Eq. 3, for the present
    value.
    """
    before, parts = 0.0, {}
    for name, loss in sorted(losses.items(), key=lambda item: item[1]):
        parts[name] = rates[name] * (loss - before)
        before = loss
    annual = sum(parts.values())
    lasting = -math.expm1(-discount * years) / discount if discount > 0.0 else years
    return Loss(
        annual, annual * lasting, {name: part / annual if annual > 0.0 else 0.0 for name, part in parts.items()}
    )
