"""Fragilities of limits, from the results of an incremental study."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from edesign.assess.fragility import Fragility, collapse_margin_ratio, fit_capacities, fit_counts
from edesign.assess.incremental import COLLAPSE, Stripes, capacities, last_intensities, stripe_counts
from edesign.errors import AnalysisError

Method = Literal["counts", "capacities"]


@dataclass(frozen=True)
class LimitFragility:
    """The fragility of a variant for one limit, with what it was fitted to.

    Attributes:
        incremental, variant: what it is of.
        limit: name of the limit.
        measure: name of the response measure, "" for collapse.
        value: of the measure in SI; infinite for collapse.
        method: fitted to counts at each intensity, or to the capacity of each record.
        records: number of records.
        intensity: (n,) of the study.
        analyses: (n,) with a result at each.
        passed: (n,) of these beyond the limit.
        missing: analyses without a result.
        fit: None where there is none.
        reason: why there is none, "" otherwise.
        margin: median / intensity of a hazard level; None without a fit or a level.
    """

    incremental: str
    variant: str
    limit: str
    measure: str
    value: float
    method: Method
    records: int
    intensity: np.ndarray
    analyses: np.ndarray
    passed: np.ndarray
    missing: int
    fit: Fragility | None
    reason: str = ""
    margin: float | None = None


def limit_fragility(
    stripes: Stripes, limit: str, value: float, method: Method = "counts", level_intensity: float | None = None
) -> LimitFragility:
    """Fit the fragility of a limit, or say why it cannot be fitted.

    Args:
        stripes: of the measure that is limited; of any for collapse.
        value: of the measure in SI; COLLAPSE for collapse.
        method: "counts" takes the analyses as independent, as those of different records at each intensity are;
            "capacities" takes the records as independent, as those are that are scaled to all intensities.
        level_intensity: intensity of a hazard level, for the margin.
    """
    analyses, passed = stripe_counts(stripes, value)
    fit, reason = None, ""
    try:
        if method == "counts":
            fit = fit_counts(stripes.intensity, analyses, passed)
        else:
            needed, last = capacities(stripes, value), last_intensities(stripes)
            there = ~np.isnan(needed)
            fit = fit_capacities(needed[there], last[there])
    except AnalysisError as error:
        reason = str(error)
    margin = None if fit is None or level_intensity is None else collapse_margin_ratio(fit.theta, level_intensity)
    return LimitFragility(
        incremental=stripes.incremental,
        variant=stripes.variant,
        limit=limit,
        measure="" if value == COLLAPSE else stripes.measure,
        value=value,
        method=method,
        records=len(stripes.records),
        intensity=stripes.intensity,
        analyses=analyses,
        passed=passed,
        missing=len(stripes.missing),
        fit=fit,
        reason=reason,
        margin=margin,
    )
