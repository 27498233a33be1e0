"""Tables of fitted damper laws."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from edesign.damper.fitting import Comparison, CrossValidation, Fit
from edesign.damper.fitting.compare import Compared
from edesign.damper.fitting.fit import FOLLOWS, mean_nrms
from edesign.damper.fitting.write import practical, practical_errors, tested
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import col, count, text
from edesign.report.tables.number import significant
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT

DIGITS = 4
ERROR_KINDS = {
    "robust": "robust, for errors that hang together within blocks of a test",
    "correlation time": "that of white noise with as many errors as are independent",
}
SHOWN = 0.9  # correlation from which on a pair is listed

PARAMETERS = TableSpec[Row](
    "fitted_parameters",
    "{law}: {title}",
    (
        text("parameter"),
        col("value", ONE, form=f".{DIGITS}g"),
        text("unit"),
        col("std. error", ONE, form=".3g"),
        col("white noise", ONE, form=".3g", missing=""),
        col("of value", ONE, missing=""),
    ),
    named_by_title=True,
)
ERRORS = TableSpec[Row](
    "errors_of_fit",
    "{law}: errors",
    (
        text("{what}"),
        col("NRMS", PERCENT),
        col("rms error / peak", PERCENT, missing=""),
        col("R2", ONE, form=".4f", missing=""),
        col("held out: NRMS", PERCENT, missing="", optional=True),
    ),
    named_by_title=True,
)
COMPARED = TableSpec[Compared](
    "laws_compared",
    "Laws compared",
    (
        text("law", "fit.law.name"),
        count("fitted", "parameters"),
        col("NRMS", PERCENT, lambda item: mean_nrms(item.fit.nrms)),
        col("held out", PERCENT, lambda item: item.held_out.mean if item.held_out else None),
        col("worst held out", PERCENT, lambda item: item.held_out.worst[1] if item.held_out else None),
        col("AIC", ONE, "aic", form=".1f"),
        col("BIC", ONE, "bic", form=".1f"),
        col("starts at minimum", ONE, lambda item: f"{item.fit.same_minimum} of {len(item.fit.starts)}"),
    ),
)


def fit_tables(
    fit: Fit, held_out: CrossValidation | None = None, validated: Mapping[str, float] | None = None
) -> list[Table]:
    """Return the parameters with their standard errors, and the errors test by test.

    Args:
        validated: NRMS (ratio) of tests that are for validation only.
    """
    return [parameter_table(fit), error_table(fit, held_out, validated or {})]


def parameter_table(fit: Fit) -> Table:
    """Return value and standard error of every parameter, with remarks below."""
    white = practical_errors(fit, fit.standard_error_white)
    printed = practical_errors(fit, fit.standard_error)
    rows: list[Row] = []
    for name, (value, unit) in practical(fit).items():
        if name in fit.standard_error:
            share = fit.standard_error[name] / abs(fit.all_values[name]) if fit.all_values[name] else math.inf
            errors: Row = (_bare(printed[name]), _bare(white[name]), Quantity(share, PERCENT, form=".2g"))
        else:
            errors = ("at bound" if name in fit.at_bound else "fixed", None, None)
        rows.append((name, value, unit, *errors))
    notes = [f"std. error: {ERROR_KINDS[fit.error_kind]}; white noise: as if all errors were independent"]
    notes += [f"fixed: {name}: {why}" for name, why in fit.fixed.items() if why != "a choice"]
    for i, first in enumerate(fit.free):
        for other in fit.free[:i]:
            rho = fit.correlation_of(other, first)
            if abs(rho) >= SHOWN:
                notes.append(f"correlation of {other} and {first}: {rho:.3f}")
    notes += [f"warning: {warning}" for warning in fit.warnings]
    notes.append("tested: " + ", ".join(f"{name.replace('_', ' ')} {text}" for name, text in tested(fit).items()))
    notes.append(
        f"{fit.same_minimum} of {len(fit.starts)} starts ended at this minimum; {fit.iterations} iterations, "
        f"{fit.evaluations} evaluations, {fit.samples} residuals ({fit.independent:.0f} independent), "
        f"{fit.seconds:.1f} s"
    )
    return PARAMETERS.of(rows, notes=notes, law=fit.law.name, title=fit.law.title)


def error_table(fit: Fit, held_out: CrossValidation | None, validated: Mapping[str, float]) -> Table:
    """Return the errors of every test in per cent.

    Args:
        fit: the fit of a law.
        held_out: errors of tests that a fit left out; None: none was made.
        validated: errors of tests for validation, by name.
    """
    out: Mapping[str, float] = held_out.nrms if held_out else {}
    errors, peaks, fits = fit.nrms, fit.peak_error, fit.determination
    rows: list[Row] = [(name, errors[name], peaks[name], fits[name], out.get(name)) for name in errors]
    mean = held_out.mean if held_out else None
    rows.append(("mean", mean_nrms(errors), mean_nrms(peaks), mean_nrms(fits), mean))
    rows += [(f"{name} (validate)", value, None, None, None) for name, value in validated.items()]
    notes = [f"NRMS: sum of squared errors over that of squared measured {fit.against}, no root"]
    if held_out:
        name, value = held_out.worst
        notes.append(f"held out ({held_out.folds} folds): worst is {name}, {_percent(value)} %")
    what = "test" if fit.against == "forces" else "property"
    return ERRORS.of(rows, notes=notes, law=fit.law.name, what=what)


def comparison_table(comparison: Comparison) -> Table:
    """Return several laws side by side, and which one suffices."""
    best = comparison.nearest
    how = "predicts held-out tests nearly as well as the best" if best.held_out else "has the least BIC"
    notes = []
    if comparison.sufficient is None:
        error = best.fit.mean_rms_error if best.held_out is None else math.sqrt(best.held_out.mean)
        notes.append(
            f"none of the laws compared follows the tests (rms error at most {100.0 * FOLLOWS:g} % of the rms "
            f"force): {best.fit.law.name}, the nearest, has {_percent(error)} %"
        )
    else:
        notes.append(f"{best.fit.law.name} suffices: of the laws compared it {how}, with {best.parameters} parameters")
    notes.append(f"AIC and BIC above the least, counting {comparison.independent:.0f} independent errors")
    return COMPARED.of(comparison.laws, notes=notes)


def tables_of(
    fits: Sequence[Fit], comparison: Comparison | None, validated: Sequence[Mapping[str, float]]
) -> list[Table]:
    """Return all tables of a run.

    Args:
        fits: the fits of all laws.
        comparison: the comparison of several laws; None: there is one law.
        validated: errors of tests for validation by name, of each fit.
    """
    out = {item.fit.law.name: item.held_out for item in comparison.laws} if comparison else {}
    tables = []
    for fit, errors in zip(fits, validated, strict=True):
        tables += fit_tables(fit, out.get(fit.law.name), errors)
    return [*tables, *([comparison_table(comparison)] if comparison and len(fits) > 1 else [])]


def _bare(text: str | float) -> Value:
    """Without its unit."""
    return text if isinstance(text, float) else text.split(" ")[0]


def _percent(value: float) -> str:
    return significant(value / PERCENT.si, DIGITS)
