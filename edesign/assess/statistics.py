"""Statistics of a response measure over the histories of one variant and hazard level."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from statistics import median

import numpy as np

from edesign.codes.motion_sets import SetRules
from edesign.codes.registry import Code, find_code
from edesign.project.criteria.criteria import CODE_IN_FORCE

CODES: Mapping[str, Code] = {
    "ec8": find_code("ec8-2004"),
    "ntc2018": find_code("ntc-2018"),
    "asce7": find_code("asce7-22"),
}
"""Statistics that leave the choice to a code: its rules for a set say of how many motions the mean counts."""
FRACTION = 0.84
"""The percentile beside the median: about one standard deviation above it if the logarithms are normal."""


@dataclass(frozen=True)
class Statistics:
    """Statistics over the histories that have a value.

    Attributes:
        count: how many have one; all statistics are None if there is none.
        median: the middle value, the mean of the two middle ones of an even count.
        dispersion: sample standard deviation of the natural logarithms; None below two values, or if one is not
            greater than zero.
        percentile_84: counted 84 % percentile, see `counted_percentile`.
        governing: the history with the maximum, "" if none has a value.
        missing: histories without a value.
    """

    count: int
    mean: float | None
    maximum: float | None
    minimum: float | None
    median: float | None
    dispersion: float | None
    percentile_84: float | None
    governing: str
    missing: tuple[str, ...]


STATISTICS: dict[str, Callable[[Statistics], float | None]] = {
    "mean": lambda found: found.mean,
    "maximum": lambda found: found.maximum,
    "median": lambda found: found.median,
    "84%": lambda found: found.percentile_84,
}
"""The statistics that criteria and tables name, and how each is taken."""


def statistics(values: Mapping[str, float | None]) -> Statistics:
    """Return the statistics of a measure.

    Args:
        values: the measure of each history by its name; None where it has none. An infinite value counts as one, so
            that order statistics may be finite beside it.
    """
    there = {name: float(value) for name, value in values.items() if value is not None}
    missing = tuple(name for name in values if name not in there)
    if not there:
        return Statistics(0, None, None, None, None, None, None, "", missing)
    ordered = sorted(there.values())
    return Statistics(
        count=len(ordered),
        mean=math.nan if -ordered[0] == ordered[-1] == math.inf else math.fsum(ordered) / len(ordered),
        maximum=ordered[-1],
        minimum=ordered[0],
        median=median(ordered),
        dispersion=dispersion(ordered),
        percentile_84=counted_percentile(ordered, FRACTION),
        governing=max(there, key=lambda name: there[name]),
        missing=missing,
    )


def statistic(name: str, values: Mapping[str, float]) -> float | None:
    """Return a statistic by the name that criteria give it; None of no values.

    Args:
        name: of `STATISTICS`, "minimum", or a percentile such as "90%", counted as `counted_percentile` does.
        values: of each history by its name.

    Returns:
        The statistic in the unit of the values.
    """
    if name in STATISTICS or not values:
        return STATISTICS[name](statistics(values)) if values else None
    if name == "minimum":
        return min(values.values())
    return counted_percentile(list(values.values()), float(name.removesuffix("%")) / 100.0)


def code_statistic(name: str, count: int, rules: SetRules, from_below: bool = False) -> str:
    """Return the statistic that a code takes of so many motions, other names as they are.

    The mean of enough motions, else the most unfavourable value: EN 1998-1, 4.3.3.4.3(3), NTC 2018, 7.3.5, and
    FEMA 356, 3.3.2.2.4, from seven on. ASCE/SEI 7 takes the mean (16.4) and has no rule for fewer than eleven (16.2.2).

    Args:
        name: "code", "ec8", "ntc2018", "asce7", or a statistic.
        rules: of the code in force, which "code" means.
        from_below: the value must not be less than its limit, so that the smallest one is the most unfavourable.
    """
    known = {CODE_IN_FORCE: rules, **{key: code.set_rules for key, code in CODES.items()}}
    if name not in known:
        return name
    if count >= known[name].number_for_mean:
        return "mean"
    return "minimum" if from_below else "maximum"


def counted_percentile(values: list[float], fraction: float) -> float:
    """Return the smallest value that at least a fraction of all values does not exceed.

    It is always one of the values, the k-th from below with k = ceil(fraction n); of 20 values the 17th for 84 %.

    Args:
        values: at least one, in any order.
        fraction: greater than 0, at most 1.

    Source: inverse of the empirical distribution function; Hyndman & Fan (1996), "Sample quantiles in statistical
        packages", definition 1.
    """
    rank = math.ceil(fraction * len(values) - 1e-9)  # 0.84 * 25 is 21, not the 22nd
    return sorted(values)[max(rank, 1) - 1]


def dispersion(values: list[float]) -> float | None:
    """Return the sample standard deviation of the natural logarithms, None if there is none (see `Statistics`).

    Returns:
        Dimensionless, or None.
    """
    if len(values) < 2 or min(values) <= 0.0 or math.isinf(max(values)):
        return None
    return float(np.std(np.log(values), ddof=1))
