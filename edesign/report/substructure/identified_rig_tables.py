"""Tables of a rig that was identified from a record."""

from __future__ import annotations

from edesign.report.tables.table import Table, formatted, number, whole
from edesign.report.tables.text import wrapped
from edesign.substructure.compensation.alpha_fit import CUTOFF, filtered
from edesign.substructure.rig.identify import IdentifiedRig
from edesign.substructure.rig.rig_fit import RigFit, RigParameter

_UNITS = {"s": ("ms", 1e-3), "Hz": ("Hz", 1.0), "": ("-", 1.0)}


def identified_rig_tables(found: IdentifiedRig) -> list[Table]:
    """Return the parameters of the rig, the orders that were tried, and its alphas."""
    return [_parameters(found), _orders(found), _alphas(found)]


def _parameters(found: IdentifiedRig) -> Table:
    fit = found.chosen
    table = Table(f"Rig of {found.source.name}", ("parameter", "value", "std. error", "unit"))
    for name, one in fit.parameters.items():
        table.rows.append(_row(name.replace("_", " "), one))
    table.rows.append(_row("delay of slow motions", fit.low_frequency_delay))
    table.rows.append(["noise of the encoder", number(fit.noise, 3, 1e-6), "-", "um"])
    table.notes += [line for text in (found.why, *found.notes) for line in wrapped(text)]
    return table


def _row(name: str, one: RigParameter) -> list[str]:
    unit, scale = _UNITS[one.unit]
    return [name, number(one.value, 5, scale), number(one.standard_error, 2, scale), unit]


def _orders(found: IdentifiedRig) -> Table:
    columns = ("order", "delay of slow motions [ms]", "error [%]", "independent [%]", "criterion")
    table = Table("Orders that were tried", columns, name="orders_tried")
    for fit, value in zip(found.tried, found.criteria, strict=True):
        table.rows.append(_order_row(fit, value))
    table.notes += wrapped(
        "error: root of squared error over squared displacement; independent: share of white noise in it; criterion: "
        "Bayesian information criterion (BIC) less that of the best order"
    )
    return table


def _order_row(fit: RigFit, criterion: float) -> list[str]:
    shares = [number(100.0 * fit.left, 3), number(100.0 * fit.independent, 3)]
    return [whole(fit.order), number(fit.low_frequency_delay.value, 4, 1e-3), *shares, formatted(criterion, ".0f")]


def _alphas(found: IdentifiedRig) -> Table:
    table = Table(
        "Coefficients of the inverse rig",
        ("from", "alpha_0", "alpha_1 [ms]", "alpha_2 [1e-6 s2]"),
        name="inverse_rig_coefficients",
    )
    for name, (a0, a1, a2) in (
        ("the record, by least squares", found.alpha),
        ("the rig, by its series", found.alpha_of_rig),
    ):
        table.rows.append([name, number(a0, 5), number(a1, 4, 1e-3), number(a2, 3, 1e-6)])
    how = (
        f"filtered at {CUTOFF:g} Hz" if filtered(found.step) else f"not filtered, sampled at {1.0 / found.step:.3g} Hz"
    )
    table.notes += wrapped(
        f"least squares: {how}, backward differences, which make alpha_2 larger by half a sample "
        "times alpha_1; the terms that a series of three leaves out make alpha_1 smaller for fast motions"
    )
    return table
