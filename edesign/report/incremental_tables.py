"""Tables of incremental dynamic analysis: fragilities, and intensities that fractions of the records stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.assess.incremental import FRACTILES, Stripes, fractile_curves
from edesign.assess.limit_fragility import LimitFragility
from edesign.project.units import STANDARD_GRAVITY
from edesign.report.table import Table, number, whole

UNITS = {"m/s^2": ("g", STANDARD_GRAVITY), "1": ("1", 1.0)}
"""Unit of an intensity measure in the archive: how it is shown, and that in SI."""


def fragility_table(fragilities: Sequence[LimitFragility], unit: str = "m/s^2", level: str = "") -> Table:
    """Return medians, dispersions, their standard errors and margins; what could not be fitted stands below.

    Args:
        fragilities: a row each.
        unit: of the intensities, a key of UNITS.
        level: name of the hazard level of the margins, "" without margins.
    """
    shown, scale = UNITS[unit]
    columns = [
        "variant",
        "limit",
        "fit to",
        "records",
        "analyses",
        f"theta [{shown}]",
        "s.e.",
        "beta",
        "s.e.",
        "D",
        "p",
    ]
    table = Table("Fragility", columns + ([f"theta / {level}"] if level else []), left=3)
    for one in fragilities:
        fit = one.fit
        cells = [one.variant, one.limit, one.method, whole(one.records), whole(int(one.analyses.sum()))]
        if fit is None:
            cells += ["-"] * 6
        else:
            cells += [number(fit.theta, 3, scale), number(fit.theta_se, 2, scale), number(fit.beta, 3)]
            cells += [number(fit.beta_se, 2), number(fit.largest_difference, 2), number(fit.p_value, 2)]
        table.rows.append(cells + ([number(one.margin, 3)] if level else []))
    table.notes += [f"{one.variant}, {one.limit}, {one.method}: {one.reason}" for one in fragilities if one.reason]
    lost = {one.variant: one.missing for one in fragilities if one.missing}
    table.notes += [f"{name}: {count} analyses without a result are left out" for name, count in lost.items()]
    table.notes.append("D: largest difference from the observed fractions; p: of the deviance from them")
    if any(one.method == "counts" for one in fragilities):
        table.notes.append("standard errors of counts take all analyses as independent, also those of one record")
    return table


def fractile_table(stripes: Sequence[Stripes], limits: Mapping[str, float], unit: str = "m/s^2") -> Table:
    """Return the intensities that 16, 50 and 84 % of the records need to reach limits of the measure of the stripes.

    Args:
        stripes: of one measure, a row for each of them and each limit.
        limits: values of the measure in SI by name; infinite for collapse.
        unit: of the intensities, a key of UNITS.
    """
    shown, scale = UNITS[unit]
    table = Table("Intensity needed", ["variant", "limit", *(f"{100 * f:.0f} % [{shown}]" for f in FRACTILES)], left=2)
    for one in stripes:
        curves = fractile_curves(one, list(limits.values()))
        for name, column in zip(limits, curves.T, strict=True):
            cells = [number(float(value), 3, scale) if value == value else "not reached" for value in column]
            table.rows.append([one.variant, name, *cells])
    return table
