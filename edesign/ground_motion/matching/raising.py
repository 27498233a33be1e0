"""One factor on a whole suite of matched records, so that their mean satisfies the code."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from edesign.codes.motion_sets import DAMPING
from edesign.codes.spectrum import Spectrum
from edesign.ground_motion.intensity import measures
from edesign.ground_motion.matching.result import Match, misfit
from edesign.ground_motion.response_spectrum import psa

MOST = 1.5
"""Largest factor; a suite that needs more does not fit its target, and its criteria say so."""
_MARGIN = 1.0 + 1e-9  # rounding must not undo a criterion


def suite_factor(matches: Sequence[Match], target: Spectrum, first_periods: Sequence[float] | None) -> float:
    """Return the least factor, at least 1 and at most `MOST`, with which the mean satisfies the code.

    Args:
        matches: the records of the suite.
        target: elastic spectrum of 5 % damping.
        first_periods: T1 of the structure by direction, s; None: only the zero-period value counts, if at all.

    Source: the rules of the target's code for a set: EN 1998-1:2004, 3.2.3.1.2(4)b and c, of its own spectra.
    """
    rules, needed = target.set_rules.of(matched=matches[0].method != "scale"), [1.0]
    if rules.has_zero_period:
        needed.append(target.zero_period / float(np.mean([match.matched.pga for match in matches])))
    T_1 = None
    if first_periods is not None:
        rules, T_1 = rules.over(first_periods)
    if T_1 is not None and not rules.missing(target, T_1):
        periods = rules.check_periods(T_1)
        mean = np.mean([psa(m.matched.acceleration, m.matched.time_step, periods, DAMPING) for m in matches], axis=0)
        needed.append(float(np.max(rules.least_ratio * target.acceleration(periods) / mean)))
    return least_factor(needed)


def least_factor(needed: Sequence[float]) -> float:
    """Return the least factor that satisfies all rules, at least 1 and at most `MOST`.

    Args:
        needed: the factor that each rule asks for.
    """
    largest = max(needed, default=1.0)
    return 1.0 if largest <= 1.0 else min(largest * _MARGIN, MOST)


def raised(match: Match, factor: float) -> Match:
    """Return a match whose result, and all that is said about it, is that of the matched record times a factor.

    Args:
        factor: dimensionless.
    """
    if factor == 1.0:
        return match
    matched = match.matched.scaled(factor)
    after = factor * match.psa_after
    shape = replace(match.shape, arias_ratio=factor**2 * match.shape.arias_ratio)
    return replace(
        match,
        matched=matched,
        psa_after=after,
        misfit_after=misfit(after, match.target, match.periods),
        after=measures(matched),
        shape=shape,
        suite_factor=factor * match.suite_factor,
    )
