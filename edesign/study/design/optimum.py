"""The size of dampers for which histories answer least: a scan of a range, then golden sections about its least."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from edesign.errors import AnalysisError
from edesign.study.design.loop import Round, RoundOutcome, S, Search

SCAN = 5
"""Sizes of the scan, in geometric steps from end to end; a curve with two valleys shows in fewer only by luck."""
_GOLDEN = 0.5 * (3.0 - math.sqrt(5.0))  # share of an interval that a golden section cuts off

Least = Literal["worst", "mean"]


def objective(outcome: RoundOutcome, least: Least) -> float:
    """Return the objective of a round: its worst or its mean ratio of demand to limit.

    It is infinite where a criterion has no value or a history was not completed: such dampers are no optimum.

    Args:
        least: the ratio that is minimised, `worst` or `mean`.
    """
    if outcome.failed or not outcome.verdicts:
        return math.inf
    ratios = [verdict.demand for verdict in outcome.verdicts]
    found = max(ratios) if least == "worst" else sum(ratios) / len(ratios)
    return found if math.isfinite(found) else math.inf


def search_optimum(
    make: Callable[[float], S],
    verify: Callable[[S, int, float], RoundOutcome],
    ends: tuple[float, float],
    least: Least,
    most_rounds: int,
    precision: float,
    kept: Callable[[Sequence[Round[S]]], None] = lambda rounds: None,
) -> Search[S]:
    """Find the value whose histories have the least objective.

    Args:
        make: sizes the dampers for a value.
        verify: returns the outcome of a sizing, of its round from 1, and of its value.
        ends: least and largest value.
        least: what is minimised (see `objective`).
        most_rounds: how many may be tried.
        precision: relative width of the bracket at which the search is over.
        kept: called with all rounds after each.

    Returns:
        The search; the chosen round is that of the least objective. Values without sizing are left out.

    Raises:
        AnalysisError: there is no sizing of any value of the scan.

    Source: Kiefer (1953), Proceedings of the American Mathematical Society 4.
    """
    rounds: list[Round[S]] = []
    wrong: AnalysisError | None = None
    waiting = np.geomspace(*ends, min(SCAN, most_rounds)).tolist()
    scanned = False
    while len(rounds) < most_rounds:
        if not waiting:
            scanned = True
            following = _next(rounds, least, precision) if rounds else None
            if following is None:
                break
            waiting = [following]
        value, number = waiting.pop(0), len(rounds) + 1
        try:
            sizing = make(value)
        except AnalysisError as error:  # of the first mode, which says nothing of histories with other values
            wrong = error
            if scanned:
                break
            continue
        rounds.append(Round(number, value, sizing, verify(sizing, number, value)))
        kept(rounds)
    if not rounds:
        assert wrong is not None
        raise wrong
    chosen = min(rounds, key=lambda r: _of(r, least))
    reason = "" if math.isfinite(_of(chosen, least)) else "no round has a value of each criterion from its histories"
    return Search(tuple(rounds), chosen, reason)


def optimum_warnings(
    rounds: Sequence[Round[S]], ends: tuple[float, float], least: Least, precision: float
) -> list[str]:
    """Return the warnings about an optimum: it lies at an end, is flat, has several valleys, or misses criteria.

    Args:
        rounds: all rounds of the search.
        ends: least and largest value of the search.
        least: what is minimised (see `objective`).
        precision: relative width of the bracket at which the search ended.

    Returns:
        One sentence for each warning.
    """
    ordered = sorted(rounds, key=lambda r: r.changed)
    values = [_of(r, least) for r in ordered]
    lowest = min(values)
    if not math.isfinite(lowest):
        return []
    best, found = ordered[values.index(lowest)], []
    if best.changed in ends:
        end = "lower" if best.changed == min(ends) else "upper"
        found.append(f"the least lies at the {end} end of the range, {best.changed:.4g}: beyond it there may be less")
    if max(values) <= lowest * (1.0 + precision):
        found.append(f"the curve is flat: from {lowest:.4g} to {max(values):.4g} over the whole range")
    else:
        near = [r.changed for r, value in zip(ordered, values, strict=True) if value <= lowest * (1.0 + precision)]
        if len(near) > 1:
            text = f"within {100.0 * precision:.3g} % of the least are all tried from {near[0]:.4g} to {near[-1]:.4g}"
            found.append(text)
    inner = [b for a, b, c in zip(values, values[1:], values[2:], strict=False) if b < min(a, c)]
    if len(inner) > 1:
        found.append(f"the curve has {len(inner)} valleys among what was tried; another may be lower than it shows")
    outcome = best.outcome
    if outcome is not None and not outcome.met:
        missed = ", ".join(verdict.name for verdict in outcome.verdicts if not verdict.met)
        found.append(f"criteria that are not met even at the least: {missed}")
    return found


def _next(rounds: Sequence[Round[S]], least: Least, precision: float) -> float | None:
    """The golden section of the wider side of the bracket about the least, in logarithms; None: it is narrow enough."""
    ordered = sorted(rounds, key=lambda r: r.changed)
    values = [_of(r, least) for r in ordered]
    i = values.index(min(values))
    x = [math.log(r.changed) for r in ordered]
    low, high = x[max(i - 1, 0)], x[min(i + 1, len(x) - 1)]
    if not math.isfinite(min(values)) or high - low <= math.log1p(precision):
        return None
    wider_above = high - x[i] >= x[i] - low
    return math.exp(x[i] + _GOLDEN * ((high if wider_above else low) - x[i]))


def _of(found: Round[S], least: Least) -> float:
    assert found.outcome is not None
    return objective(found.outcome, least)
