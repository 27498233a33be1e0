"""Tables of incremental dynamic analysis: fragilities, and intensities that fractions of the records stand."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.incremental import FRACTILES, Stripes, fractile_curves
from edesign.assess.limit_fragility import LimitFragility
from edesign.report.assessment.measure_columns import measure_title
from edesign.report.capacity.incremental_results import UNITS, IncrementalResults, read_incremental
from edesign.report.tables.table import Table, formatted, number, whole
from edesign.report.tables.text import wrapped

OUTSIDE = 0.2
"""Share of a rate that comes from outside of the points of a hazard curve, from which on a note tells it."""


def incremental_tables(archive: Archive, groups: Mapping[str, Group] | None = None) -> list[Table]:
    """Return fragilities, and intensities that fractions of the records need, of each incremental study of an archive.

    Args:
        archive: complete or partial.
        groups: all its analyses by name, if they have been read already.
    """
    return [table for one in read_incremental(archive, groups) for table in results_tables(one)]


def results_tables(results: IncrementalResults) -> list[Table]:
    """Return the tables of one incremental study; see `incremental_tables`."""
    tables = [fragility_table(results.fragilities, results.unit, results.level)]
    for measure in results.measures:
        limits, stripes = results.limits_of(measure), results.stripes_of(measure)
        if limits and stripes:
            tables.append(fractile_table(stripes, limits, results.unit))
    if results.life_cycle:
        tables += [exceedance_table(results), *loss_tables(results)]
    return tables


def exceedance_table(results: IncrementalResults) -> Table:
    """Return the rate at which each limit is exceeded, and its probability in the years of the study."""
    years = results.life_cycle[0].years
    columns = ["variant", "limit", "rate [1/year]", "return period [years]", f"P in {number(years, 3)} years [%]"]
    table = Table(f"{results.name}: exceedance of limits", columns, left=2)
    table.each = ("Exceedance of limits", results.name)
    table.name = "limit_exceedance"
    for one in results.life_cycle:
        for limit, found in one.exceedances.items():
            cells = [
                formatted(found.rate, ".2e"),
                number(found.return_period, 3),
                number(100.0 * found.probability(years), 3),
            ]
            table.rows.append([one.variant, limit, *cells])
            outside = {"below the first": found.below, "beyond the last": found.beyond}
            for where, share in outside.items():
                if share > OUTSIDE:
                    message = f"{100.0 * share:.0f} % of the rate come from {where} point of the hazard curve"
                    table.notes.append(f"{one.variant}, {limit}: {message}")
        if one.reason:
            table.notes.append(f"{one.variant}: {one.reason}")
    dispersion = results.life_cycle[0].dispersion
    if dispersion > 0.0:
        table.notes.append(f"a dispersion of {number(dispersion, 2)} for modelling is added to that of the records")
    return table


def loss_tables(results: IncrementalResults) -> list[Table]:
    """Return the expected losses of all variants, in per cent of the value of the building; [] without losses."""
    having = [one for one in results.life_cycle if one.loss is not None]
    if not having:
        return []
    years = having[0].years
    limits = list(dict.fromkeys(limit for one in having if one.loss is not None for limit in one.loss.shares))
    columns = ["variant", "loss a year [%]", f"in {number(years, 3)} years, at present [%]"]
    columns += [f"of which {limit} [%]" for limit in limits]
    table = Table(f"{results.name}: expected loss, of the value of the building", columns)
    table.each = ("Expected loss, of the value of the building", results.name)
    table.name = "expected_loss"
    for one in having:
        loss = one.loss
        assert loss is not None
        least = ">= " if one.uncounted else ""
        cells = [f"{least}{number(100.0 * part, 3)}" for part in (loss.annual, loss.present_value)]
        shares = (number(100.0 * loss.shares[limit], 3) if limit in loss.shares else "-" for limit in limits)
        table.rows.append([one.variant, *cells, *shares])
        if one.uncounted:
            table.notes += wrapped(
                f"{one.variant}: a lower bound, without a loss of {', '.join(one.uncounted)}: too few records reach it "
                "for a fragility. Give larger intensities."
            )
    return [table]


def fragility_table(fragilities: Sequence[LimitFragility], unit: str = "m/s^2", level: str = "") -> Table:
    """Return medians, dispersions, their standard errors and margins; failed fits are named below.

    Args:
        fragilities: a row each.
        unit: of the intensities, a key of UNITS.
        level: name of the hazard level of the margins, "" without margins.
    """
    shown, scale = UNITS[unit]
    counted = any(one.method == "counts" for one in fragilities)
    columns = ["variant", "limit", "fit to", "records", "analyses", f"theta [{shown}]", "s.e.", "beta", "s.e.", "D"]
    columns += [*(["p"] if counted else []), *([f"theta / {level}"] if level else [])]
    title = f"{fragilities[0].incremental}: fragility" if fragilities else "Fragility"
    table = Table(title, columns, left=3)
    for one in fragilities:
        fit = one.fit
        cells = [one.variant, one.limit, one.method, whole(one.records), whole(int(one.analyses.sum()))]
        if fit is None:
            cells += ["-"] * 5
        else:
            cells += [number(fit.theta, 3, scale), number(fit.theta_se, 2, scale), number(fit.beta, 3)]
            cells += [number(fit.beta_se, 2), number(fit.largest_difference, 2)]
        cells += [number(fit.p_value if fit is not None else None, 2)] if counted else []
        table.rows.append(cells + ([number(one.margin, 3)] if level else []))
    table.notes += [f"{one.variant}, {one.limit}, {one.method}: {one.reason}" for one in fragilities if one.reason]
    lost = {one.variant: one.missing for one in fragilities if one.missing}
    table.notes += [f"{name}: {count} analyses without a result are left out" for name, count in lost.items()]
    table.notes.append("theta: median; beta: dispersion; s.e.: standard errors; D: largest difference from fractions")
    if level:
        table.notes.append(f"theta / {level}: margin; of collapse the collapse margin ratio, without spectral shape")
    if counted:
        table.notes.append("p: of the deviance from the observed fractions")
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
    about = f"{stripes[0].incremental}: intensity needed, {measure_title(stripes[0].measure)[0]}" if stripes else ""
    table = Table(about, ["variant", "limit", *(f"{100 * f:.0f} % [{shown}]" for f in FRACTILES)], left=2)
    for one in stripes:
        curves = fractile_curves(one, list(limits.values()))
        for name, column in zip(limits, curves.T, strict=True):
            cells = [number(float(value), 3, scale) if value == value else "not reached" for value in column]
            table.rows.append([one.variant, name, *cells])
    return table
