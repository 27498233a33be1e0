"""Incremental dynamic analysis: a response measure of each record at each intensity, and what follows from it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.archive.dataset import Group
from edesign.assess.measures import located_measure
from edesign.assess.statistics import counted_percentile

FRACTILES = (0.16, 0.50, 0.84)
COLLAPSE = float("inf")
"""The limit that only a collapse passes."""


@dataclass(frozen=True)
class Stripes:
    """A response measure of one variant under records that are scaled step by step.

    Attributes:
        incremental, variant, measure: what it is of.
        records: (r,) references.
        intensity: (n,) ascending, greater than zero.
        values: (r, n) of the measure in SI, of a building the worst one over angles of the record and places of the
            masses; infinite where the frame collapsed, at that intensity or a lower one; NaN where a result is missing.
    """

    incremental: str
    variant: str
    measure: str
    records: tuple[str, ...]
    intensity: np.ndarray
    values: np.ndarray

    @property
    def missing(self) -> tuple[tuple[str, float], ...]:
        """Record and intensity of each analysis without a result."""
        return tuple((self.records[i], float(self.intensity[j])) for i, j in np.argwhere(np.isnan(self.values)))


def collect_stripes(
    groups: Mapping[str, Group], incremental: str, variant: str, measures: Sequence[str]
) -> dict[str, Stripes]:
    """Collect the results of an incremental study.

    Args:
        groups: results by name of the analysis, as archived; those of other studies and variants do not count.
        variant: of the frame.
        measures: names of response measures.

    Returns:
        Stripes by measure.

    Raises:
        KeyError: there is no such study of this variant.
    """
    mine = [
        group
        for group in groups.values()
        if group.attributes.get("incremental") == incremental and group.attributes.get("variant") == variant
    ]
    if not mine:
        raise KeyError(f"{incremental} of {variant}")
    records = tuple(dict.fromkeys(str(group.attributes["record"]) for group in mine))
    intensity = np.array(sorted({float(group.attributes["intensity"]) for group in mine}))
    values = {measure: np.full((len(records), intensity.size), -np.inf) for measure in measures}
    for group in mine:
        row = records.index(str(group.attributes["record"]))
        column = int(np.searchsorted(intensity, float(group.attributes["intensity"])))
        for measure in measures:
            values[measure][row, column] = np.maximum(values[measure][row, column], _value(group, measure))
    found = {measure: np.where(np.isneginf(of), np.nan, of) for measure, of in values.items()}
    return {measure: Stripes(incremental, variant, measure, records, intensity, of) for measure, of in found.items()}


def stripe_counts(stripes: Stripes, limit: float) -> tuple[np.ndarray, np.ndarray]:
    """Count analyses at each intensity, and those that reach a limit.

    Args:
        limit: of the measure; COLLAPSE counts collapses only.

    Returns:
        Analyses with a result (n,), and how many of them reach the limit (n,).
    """
    there = ~np.isnan(stripes.values)
    return there.sum(axis=0), (there & (stripes.values >= limit)).sum(axis=0)


def capacities(stripes: Stripes, limit: ArrayLike) -> np.ndarray:
    """Return the intensity at which each record first reaches a limit.

    The curve of a record is linear between its intensities and begins at zero. Between the last intensity without
    collapse and the first with one it rises without bound half way.

    Args:
        limit: (m,) or a single value of the measure; COLLAPSE gives the intensity of collapse.

    Returns:
        (r, m), or (r,) for a single limit; infinite where a record does not reach it, NaN where it has no results.

    Source: Vamvatsikos & Cornell (2002), Earthquake Engineering and Structural Dynamics 31, 491-514.
    """
    limits = np.atleast_1d(np.asarray(limit, dtype=float))
    found = np.array([_first_reached(stripes.intensity, values, limits) for values in stripes.values])
    return found if np.ndim(limit) else found[:, 0]


def last_intensities(stripes: Stripes) -> np.ndarray:
    """Return the highest intensity at which each record has a result, (r,); NaN where it has none.

    A capacity that is not reached is only known to lie beyond it.
    """
    there = ~np.isnan(stripes.values)
    return np.where(there.any(axis=1), np.where(there, stripes.intensity, -np.inf).max(axis=1), np.nan)


def fractile_curves(stripes: Stripes, values: ArrayLike, fractions: Sequence[float] = FRACTILES) -> np.ndarray:
    """Return the intensities that fractions of the records need to reach values of the measure.

    Args:
        values: (m,) of the measure.
        fractions: of the records, counted.

    Returns:
        (fractions, m); NaN where too few records reach the value.
    """
    needed = capacities(stripes, np.atleast_1d(np.asarray(values, dtype=float)))
    needed = needed[~np.isnan(needed[:, 0])]
    if needed.size == 0:
        return np.full((len(fractions), needed.shape[1]), np.nan)
    curves = np.array([[counted_percentile(list(column), fraction) for column in needed.T] for fraction in fractions])
    return np.where(np.isfinite(curves), curves, np.nan)


def _value(group: Group, measure: str) -> float:
    if group.attributes.get("collapsed") or group.attributes.get("status") == "skipped":
        return COLLAPSE
    if group.attributes.get("status") != "completed":
        return float("nan")
    found = located_measure(group, measure)
    return float("nan") if found is None else found.value


def _first_reached(intensity: np.ndarray, values: np.ndarray, limits: np.ndarray) -> np.ndarray:
    there = ~np.isnan(values)
    if not there.any():
        return np.full(limits.size, np.nan)
    x, y = np.concatenate(([0.0], intensity[there])), np.concatenate(([0.0], values[there]))
    found = np.full(limits.size, np.inf)
    for i, limit in enumerate(limits):
        reached = np.flatnonzero(y >= limit)
        if reached.size:
            at = max(int(reached[0]), 1)
            share = (limit - y[at - 1]) / (y[at] - y[at - 1]) if np.isfinite(y[at]) else 0.5
            found[i] = x[at - 1] + share * (x[at] - x[at - 1])
    return found
