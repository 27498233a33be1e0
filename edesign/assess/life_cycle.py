"""How often limits are passed in the life of a building, and what that costs: fragilities over a hazard curve."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import ArrayLike

from edesign.assess.fragility import Fragility
from edesign.errors import InputError


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
            raise InputError("a hazard curve needs two points or more, each an intensity and its rate")
        if np.any(self.intensity <= 0.0) or np.any(np.diff(self.intensity) <= 0.0):
            raise InputError("the intensities of a hazard curve must be greater than zero and ascend")
        if np.any(self.rate <= 0.0) or np.any(np.diff(self.rate) >= 0.0):
            raise InputError("the larger an intensity, the longer must be its return period")

    @property
    def exponents(self) -> np.ndarray:
        """k of each line, (n - 1,): H = k0 im^-k, as in EN 1998-1, 2.1(4)."""
        return -np.diff(np.log(self.rate)) / np.diff(np.log(self.intensity))

    def rate_of(self, intensity: ArrayLike) -> np.ndarray:
        """Return the annual rate of exceedance of intensities."""
        im = np.asarray(intensity, dtype=float)
        line = np.clip(np.searchsorted(self.intensity, im) - 1, 0, self.intensity.size - 2)
        return np.asarray(self.rate[line] * (im / self.intensity[line]) ** -self.exponents[line])


@dataclass(frozen=True)
class Exceedance:
    """How often a limit is passed.

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
        """Return the probability of at least one exceedance in some years, of a Poisson process."""
        return -math.expm1(-self.rate * years)


def exceedance(fragility: Fragility, curve: HazardCurve, dispersion: float = 0.0) -> Exceedance:
    """Integrate a fragility over a hazard curve: the integral of H(im) dP(im).

    Exact for the lognormal fragility and the lines of the curve: over one of them, H = k0 im^-k from a to b, it is
    H(theta) exp(k^2 beta^2 / 2) (Phi(ln(b/theta)/beta + k beta) - Phi(ln(a/theta)/beta + k beta)).

    Args:
        fragility: of the limit.
        curve: in the unit of the fragility.
        dispersion: of modelling, added to that of the records by the root of the sum of squares.

    Source: Cornell, Jalayer, Hamburger & Foutch (2002), Journal of Structural Engineering 128(4), Eq. 18 for one line;
    FEMA P-58-1, 7.6 (time-based assessment).
    """
    beta = math.hypot(fragility.beta, dispersion)
    edges = np.concatenate(([0.0], curve.intensity[1:-1], [np.inf]))
    k = curve.exponents
    at_median = curve.rate[:-1] * (fragility.theta / curve.intensity[:-1]) ** -k
    with np.errstate(divide="ignore"):
        z = np.log(edges / fragility.theta) / beta

    def part(k: np.ndarray | float, at_median: np.ndarray | float, low: ArrayLike, high: ArrayLike) -> np.ndarray:
        inside = scipy.special.ndtr(np.asarray(high) + k * beta) - scipy.special.ndtr(np.asarray(low) + k * beta)
        return np.asarray(at_median * np.exp(0.5 * (k * beta) ** 2) * inside)

    rate = float(np.sum(part(k, at_median, z[:-1], z[1:])))
    first, last = np.log(curve.intensity[[0, -1]] / fragility.theta) / beta
    below = float(part(k[0], at_median[0], -np.inf, first))
    beyond = float(part(k[-1], at_median[-1], last, np.inf))
    return Exceedance(rate, below / rate if rate > 0.0 else 0.0, beyond / rate if rate > 0.0 else 0.0)


@dataclass(frozen=True)
class Loss:
    """What passing limits costs, as shares of the value of the building.

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
