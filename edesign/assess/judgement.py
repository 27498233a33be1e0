"""Whether a statistic over histories keeps within limits when some of the histories have no result."""

from __future__ import annotations

import math
from collections.abc import Mapping

from edesign.assess.statistics import statistic

_ROUNDING = 1e-9  # of a share times a number of histories, 0.7 * 10 = 7.000000000000001


def statistic_of(name: str, values: Mapping[str, float | None], failed: float) -> float | None:
    """Return a statistic in which histories without a value count as `failed`, infinite on the side that fails.

    Order statistics stay finite as long as few enough histories failed: the median while less than half of them did.

    Args:
        name: of the statistic, see `statistic`.
        values: by history.
        failed: infinity for a limit from above, minus infinity for one from below.

    Returns:
        The statistic, None if no history has a value.
    """
    if all(value is None for value in values.values()):
        return None
    return statistic(name, {key: failed if value is None else value for key, value in values.items()})


def within(
    name: str, values: Mapping[str, float | None], not_run: tuple[str, ...], most: float | None, least: float | None
) -> bool | None:
    """Say whether a statistic is at most `most`, or without `most` at least `least`.

    A history that failed counts as infinitely far on the side that fails, so a mean or a maximum over it is not met.
    One that has not run yet may still turn out either way: the answer is None while it depends on it.

    Args:
        name: of the statistic, see `statistic`.
        values: by history; None: failed, or not run.
        most: upper limit in the unit of the values; None: `least` is the limit.
        least: lower limit in the unit of the values.

    Returns:
        True, False, or None: not known yet, or no history has a value.
    """
    if all(value is None for value in values.values()):
        return None if all(key in not_run for key in values) else False
    bad = math.inf if most is not None else -math.inf
    answers = []
    for open_value in (bad, -bad):
        filled = {
            key: (open_value if key in not_run else bad) if value is None else value for key, value in values.items()
        }
        answers.append(_holds(name, filled, bad, most, least))
    return answers[0] if answers[0] == answers[1] else None


def _met_by(value: float, most: float | None, least: float | None) -> bool:
    """Say whether a value is at most `most`, or without `most` at least `least`.

    Args:
        value: of the statistic.
        most: upper limit in its unit; None: `least` is the limit.
        least: lower limit in its unit.
    """
    if most is not None:
        return value <= most
    return least is None or value >= least


def share_met(
    share: float, values: Mapping[str, float | None], not_run: tuple[str, ...], most: float | None, least: float | None
) -> tuple[float | None, bool | None]:
    """Return the share of the histories that ended and met the limit, and whether it is at least `share` of all.

    A failed history does not meet it. The answer is None while it depends on histories that have not run, and the
    share is None before the first has ended. Other arguments as `within`.

    A failed history counts among those that do not meet the limit.

    Args:
        share: of the histories that must meet the limit, 0 to 1.
        values: by history; None: failed, or not run.
        most: upper limit in the unit of the values.
        least: lower limit in the unit of the values.

    Returns:
        The share, 0 to 1, and the answer.
    """
    ended = [value for key, value in values.items() if key not in not_run]
    met = sum(value is not None and _met_by(value, most, least) for value in ended)
    total, needed = len(values), share * len(values) * (1.0 - _ROUNDING)
    answer = True if met >= needed else False if met + (total - len(ended)) < needed else None
    return (met / len(ended), answer) if ended else (None, None)


def _holds(name: str, filled: Mapping[str, float], bad: float, most: float | None, least: float | None) -> bool:
    if name == "mean" and bad in filled.values():
        return False  # and not the mean of plus and minus infinity
    value = statistic(name, filled)
    return value is not None and _met_by(value, most, least)
