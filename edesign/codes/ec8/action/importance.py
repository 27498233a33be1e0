"""Importance factor and return periods, EN 1998-1:2004, 2.1 and 4.2.5."""

from __future__ import annotations

import math

from edesign.errors import InputError

NEAR_COLLAPSE = 2475.0
"""Return period of the rarest action, years: EN 1998-3:2005, 2.1(3)P, 2 % in 50 years."""
NEAR_COLLAPSE_CLAUSE = "EN 1998-1, 2.1(4): 2475 years, near collapse of EN 1998-3"

LARGEST_EXPONENT = math.log(1e16)
"""Largest logarithm of gamma_I, either way. Accelerations that are read lie between 1e-10 m/s2, the noise of the best
seismometers, and 1e6 m/s2, of shock tables: no two actions are further apart."""


def factor_of_probability(probability: float, reference: float = 0.10, k: float = 3.0) -> float:
    """Return gamma_I = (P_L / P_LR)^(-1/k), both probabilities of exceedance over the same years.

    Args:
        probability: P_L, e.g. 0.02.
        reference: P_LR of the reference action.
        k: exponent of the hazard curve, generally of the order of 3.

    Raises:
        InputError: a probability is not between 0 and 1, or k is not greater than zero or so small that
            gamma_I is no number.

    Source: EN 1998-1:2004, 2.1(4) Note; thesis Eq. 5.5.
    """
    _probability(probability)
    _probability(reference)
    return _power(probability / reference, k)


def factor_of_return_period(return_period: float, reference: float = 475.0, k: float = 3.0) -> float:
    """Return gamma_I = (T_LR / T_L)^(-1/k) for return periods.

    2.1(4) has years T_L in which the probability of exceedance is the same as in T_LR; for events of a Poisson process
    return periods are proportional to these.

    Args:
        return_period: years.
        reference: of the reference action, years.
        k: exponent of the hazard curve.

    Raises:
        InputError: an argument is not greater than zero, or k is so small that gamma_I is no number.

    Source: EN 1998-1:2004, 2.1(4) Note.
    """
    _years(return_period)
    _years(reference)
    return _power(reference / return_period, k)


def return_period_of(probability: float, years: float = 50.0) -> float:
    """Return T_R = -T_L / ln(1 - P_R), years: 10 % in 50 years is 475 years.

    Args:
        probability: of exceedance, P_R.
        years: T_L.

    Source: EN 1998-1:2004, 2.1(1)P Note 2.
    """
    _probability(probability)
    return -_years(years) / math.log1p(-probability)


def _power(ratio: float, k: float) -> float:
    """The factor between two actions of which one is exceeded `ratio` times as often as the other."""
    exponent = -math.log(ratio) / _exponent(k)
    if not abs(exponent) <= LARGEST_EXPONENT:
        raise InputError(
            f"with the exponent k = {k:g} what is exceeded {ratio:.4g} times as often as the reference action has "
            f"gamma_I = e^{exponent:.4g}, which is no factor; k is generally of the order of 3 (EN 1998-1, 2.1(4) Note)"
            " [E-EC8-03]"
        )
    return float(ratio ** (-1.0 / k))


def _probability(value: float) -> float:
    if not 0.0 < value < 1.0:
        raise InputError(f"a probability of exceedance lies between 0 and 1, not {value:g} [E-VALUE-02]")
    return value


def _years(value: float) -> float:
    if not (math.isfinite(value) and value > 0.0):
        raise InputError(f"a time of more than zero years is needed, not {value:g} [E-VALUE-02]")
    return value


def _exponent(k: float) -> float:
    if not (math.isfinite(k) and k > 0.0):
        raise InputError(f"the exponent k must be greater than zero, not {k:g} [E-VALUE-02]")
    return k
