"""Tables of incremental dynamic analysis: fragilities, and intensities that fractions of the records stand."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.incremental import FRACTILES, Stripes, fractile_curves
from edesign.assess.limit_fragility import LimitFragility
from edesign.report.assessment.measure_columns import measure_title
from edesign.report.capacity.incremental_results import UNITS, IncrementalResults, LifeCycle, read_incremental
from edesign.report.tables.cell import Marked, Value
from edesign.report.tables.column import col, count, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import ONE, PERCENT, YEARS, Unit

_FRACTIONS = [f"{100 * fraction:.0f} %" for fraction in FRACTILES]
_Row = dict[str, Value]
OUTSIDE = 0.2
"""Share of a rate that comes from outside of the points of a hazard curve, from which on a note says so."""


def _fit(name: str) -> Callable[[LimitFragility], float | None]:
    return lambda one: None if one.fit is None else getattr(one.fit, name)


def _loss(name: str) -> Callable[[LifeCycle], Marked]:
    """An expected loss, with a sign where that of some limits is not counted."""
    return lambda one: Marked(getattr(one.loss, name), before=">= " if one.uncounted else "")


def _share(limit: str) -> Callable[[LifeCycle], float | None]:
    return lambda one: None if one.loss is None else one.loss.shares.get(limit)


EXCEEDANCE = TableSpec[_Row](
    "limit_exceedance",
    "{whose}: exceedance of limits",
    (
        text("variant"),
        text("limit"),
        col("rate", Unit("1/year"), form=".2e"),
        col("return period", YEARS, digits=3),
        col("P in {years} years", PERCENT, "probability", 3),
    ),
    keys=2,
    each="Exceedance of limits",
)
LOSS = TableSpec[LifeCycle](
    "expected_loss",
    "{whose}: expected loss, of the value of the building",
    (
        text("variant"),
        col("loss a year", PERCENT, _loss("annual"), 3, as_shown=True),
        col("in {years} years, at present", PERCENT, _loss("present_value"), 3, as_shown=True),
    ),  # and of which each limit
    each="Expected loss, of the value of the building",
)
FRAGILITY = TableSpec[LimitFragility](
    "fragility",
    "{title}",
    (
        text("variant"),
        text("limit"),
        text("fit to", "method"),
        count("records"),
        count("analyses", lambda one: one.analyses.sum()),
        col("theta", "intensity", _fit("theta"), 3),
        col("s.e.", "its error", _fit("theta_se"), 2),
        col("beta", ONE, _fit("beta"), 3),
        col("s.e.", ONE, _fit("beta_se"), 2),
        col("D", ONE, _fit("largest_difference"), 2),
        col("p", ONE, _fit("p_value"), 2),
        col("theta / {level}", ONE, "margin", 3),
    ),
    keys=3,
    named_by_title=True,
)
FRACTILES_NEEDED = TableSpec[_Row](
    "intensity_needed",
    "{title}",
    (text("variant"), text("limit"), *(col(fraction, "intensity", digits=3) for fraction in _FRACTIONS)),
    keys=2,
    named_by_title=True,
)


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
    years, dispersion = results.life_cycle[0].years, results.life_cycle[0].dispersion
    rows: list[_Row] = []
    notes = []
    for one in results.life_cycle:
        for limit, found in one.exceedances.items():
            values = {"rate": found.rate, "return period": found.return_period, "probability": found.probability(years)}
            rows.append({"variant": one.variant, "limit": limit, **values})
            outside = {"below the first": found.below, "beyond the last": found.beyond}
            for where, share in outside.items():
                if share > OUTSIDE:
                    message = f"{100.0 * share:.0f} % of the rate come from {where} point of the hazard curve"
                    notes.append(f"{one.variant}, {limit}: {message}")
        if one.reason:
            notes.append(f"{one.variant}: {one.reason}")
    if dispersion > 0.0:
        notes.append(f"a dispersion of {significant(dispersion, 2)} for modelling is added to that of the records")
    return EXCEEDANCE.of(rows, notes=notes, whose=results.name, years=significant(years, 3))


def loss_tables(results: IncrementalResults) -> list[Table]:
    """Return the expected losses of all variants, in per cent of the value of the building; [] without losses."""
    having = [one for one in results.life_cycle if one.loss is not None]
    if not having:
        return []
    notes = []
    for one in having:
        if one.uncounted:
            notes += wrapped(
                f"{one.variant}: a lower bound, without a loss of {', '.join(one.uncounted)}: too few records reach it "
                "for a fragility. Give larger intensities."
            )
    limits = dict.fromkeys(limit for one in having if one.loss is not None for limit in one.loss.shares)
    shares = [col(f"of which {limit}", PERCENT, _share(limit), 3) for limit in limits]
    years = significant(having[0].years, 3)
    return [LOSS.of(having, more=shares, notes=notes, whose=results.name, years=years)]


def fragility_table(fragilities: Sequence[LimitFragility], unit: str = "m/s^2", level: str = "") -> Table:
    """Return medians, dispersions, their standard errors and margins; failed fits are named below.

    Args:
        unit: of the intensities, a key of UNITS.
        level: name of the hazard level of the margins, "" without margins.
    """
    counted = any(one.method == "counts" for one in fragilities)
    notes = [f"{one.variant}, {one.limit}, {one.method}: {one.reason}" for one in fragilities if one.reason]
    lost = {one.variant: one.missing for one in fragilities if one.missing}
    notes += [f"{name}: {number} analyses without a result are left out" for name, number in lost.items()]
    notes.append("theta: median; beta: dispersion; s.e.: standard errors; D: largest difference from fractions")
    if level:
        notes.append(f"theta / {level}: margin; of collapse the collapse margin ratio, without spectral shape")
    if counted:
        notes.append("p: of the deviance from the observed fractions")
        notes.append("standard errors of counts take all analyses as independent, also those of one record")
    title = f"{fragilities[0].incremental}: fragility" if fragilities else "Fragility"
    without = [*([] if counted else ["p"]), *([] if level else ["theta / {level}"])]
    shown, scale = UNITS[unit]
    units = {"intensity": Unit(shown, scale), "its error": Unit("", scale)}
    return FRAGILITY.of(fragilities, without=without, units=units, notes=notes, title=title, level=level)


def fractile_table(stripes: Sequence[Stripes], limits: Mapping[str, float], unit: str = "m/s^2") -> Table:
    """Return the intensities that 16, 50 and 84 % of the records need to reach limits of the measure of the stripes.

    Args:
        stripes: of one measure, a row for each of them and each limit.
        limits: values of the measure in SI by name; infinite for collapse.
        unit: of the intensities, a key of UNITS.
    """
    about = f"{stripes[0].incremental}: intensity needed, {measure_title(stripes[0].measure)[0]}" if stripes else ""
    rows: list[_Row] = []
    for one in stripes:
        curves = fractile_curves(one, list(limits.values()))
        for name, column in zip(limits, curves.T, strict=True):
            needed = (float(value) if value == value else "not reached" for value in column)
            rows.append({"variant": one.variant, "limit": name, **dict(zip(_FRACTIONS, needed, strict=True))})
    return FRACTILES_NEEDED.of(rows, units={"intensity": Unit(*UNITS[unit])}, title=about)
