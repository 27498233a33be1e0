"""Tables of a rig that was identified from a record."""

from __future__ import annotations

from typing import NamedTuple

from edesign.report.substructure.tables import MICRO_S2
from edesign.report.tables.cell import Quantity
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import HZ, MS, ONE, PERCENT, Unit
from edesign.substructure.compensation.alpha_fit import CUTOFF, filtered
from edesign.substructure.rig.identify import IdentifiedRig
from edesign.substructure.rig.rig_fit import RigFit, RigParameter

_UNITS = {"s": MS, "Hz": HZ, "": Unit("-")}
MICROMETRE = Unit("um", 1e-6)


class _Order(NamedTuple):
    fit: RigFit
    criterion: float


PARAMETERS = TableSpec[Row](
    "identified_rig",
    "Rig of {source}",
    (text("parameter"), col("value", ONE), col("std. error", ONE), text("unit")),
    named_by_title=True,
)
ORDERS = TableSpec[_Order](
    "orders_tried",
    "Orders that were tried",
    (
        count("order", "fit.order"),
        col("delay of slow motions", MS, "fit.low_frequency_delay.value"),
        col("error", PERCENT, "fit.left", 3),
        col("independent", PERCENT, "fit.independent", 3),
        col("criterion", ONE, form=".0f"),
    ),
    notes=wrapped(
        "error: root of squared error over squared displacement; independent: share of white noise in it; criterion: "
        "Bayesian information criterion (BIC) less that of the best order"
    ),
)
ALPHAS = TableSpec[Row](
    "inverse_rig_coefficients",
    "Coefficients of the inverse rig",
    (text("from"), col("alpha_0", ONE, digits=5), col("alpha_1", MS), col("alpha_2", MICRO_S2, digits=3)),
)


def identified_rig_tables(found: IdentifiedRig) -> list[Table]:
    """Return the parameters of the rig, the orders that were tried, and its alphas."""
    return [_parameters(found), ORDERS.of(map(_Order, found.tried, found.criteria)), _alphas(found)]


def _parameters(found: IdentifiedRig) -> Table:
    fit = found.chosen
    rows = [_row(name.replace("_", " "), one) for name, one in fit.parameters.items()]
    rows.append(_row("delay of slow motions", fit.low_frequency_delay))
    rows.append(("noise of the encoder", Quantity(fit.noise, MICROMETRE, 3, beside=True), None, MICROMETRE.name))
    notes = [line for text in (found.why, *found.notes) for line in wrapped(text)]
    return PARAMETERS.of(rows, notes=notes, source=found.source.name)


def _row(name: str, one: RigParameter) -> Row:
    unit = _UNITS[one.unit]
    value, error = Quantity(one.value, unit, 5, beside=True), Quantity(one.standard_error, unit, 2, beside=True)
    return (name, value, error, unit.name)


def _alphas(found: IdentifiedRig) -> Table:
    rows = [("the record, by least squares", *found.alpha), ("the rig, by its series", *found.alpha_of_rig)]
    how = (
        f"filtered at {CUTOFF:g} Hz" if filtered(found.step) else f"not filtered, sampled at {1.0 / found.step:.3g} Hz"
    )
    notes = wrapped(
        f"least squares: {how}, backward differences, which make alpha_2 larger by half a sample "
        "times alpha_1; the terms that a series of three leaves out make alpha_1 smaller for fast motions"
    )
    return ALPHAS.of(rows, notes=notes)
