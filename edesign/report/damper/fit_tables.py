"""Tables of fitted damper laws."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from edesign.damper.fitting import Comparison, CrossValidation, Fit
from edesign.damper.fitting.fit import FOLLOWS, mean_nrms
from edesign.damper.fitting.write import practical, practical_errors, tested
from edesign.report.tables.table import Table, formatted, number, whole

DIGITS = 4
ERROR_KINDS = {
    "robust": "robust, for errors that hang together within blocks of a test",
    "correlation time": "that of white noise with as many errors as are independent",
}
SHOWN = 0.9  # correlation from which on a pair is listed


def fit_tables(
    fit: Fit, held_out: CrossValidation | None = None, validated: Mapping[str, float] | None = None
) -> list[Table]:
    """Return the parameters with their standard errors, and the errors test by test.

    Args:
        fit: the fit.
        held_out: its cross-validation.
        validated: NRMS (ratio) of tests that are for validation only.
    """
    return [parameter_table(fit), error_table(fit, held_out, validated or {})]


def parameter_table(fit: Fit) -> Table:
    """Return value and standard error of every parameter, with remarks below."""
    columns = ("parameter", "value", "unit", "std. error", "white noise", "of value")
    table = Table(f"{fit.law.name}: {fit.law.title}", columns)
    white = practical_errors(fit, fit.standard_error_white)
    printed = practical_errors(fit, fit.standard_error)
    for name, (value, unit) in practical(fit).items():
        row = [name, f"{value:.{DIGITS}g}", unit]
        if name in fit.standard_error:
            share = fit.standard_error[name] / abs(fit.all_values[name]) if fit.all_values[name] else math.inf
            row += [_bare(printed[name]), _bare(white[name]), f"{100.0 * share:.2g} %"]
        else:
            row += ["at bound" if name in fit.at_bound else "held", "", ""]
        table.rows.append(row)
    table.notes.append(f"std. error: {ERROR_KINDS[fit.error_kind]}; white noise: as if all errors were independent")
    table.notes += [f"held: {name}: {why}" for name, why in fit.held.items() if why != "a choice"]
    for i, first in enumerate(fit.free):
        for other in fit.free[:i]:
            rho = fit.correlation_of(other, first)
            if abs(rho) >= SHOWN:
                table.notes.append(f"correlation of {other} and {first}: {rho:.3f}")
    table.notes += [f"doubt: {doubt}" for doubt in fit.doubts]
    table.notes.append("tested: " + ", ".join(f"{name.replace('_', ' ')} {text}" for name, text in tested(fit).items()))
    table.notes.append(
        f"{fit.same_minimum} of {len(fit.starts)} starts ended at this minimum; {fit.iterations} iterations, "
        f"{fit.evaluations} evaluations, {fit.samples} residuals ({fit.independent:.0f} independent), "
        f"{fit.seconds:.1f} s"
    )
    return table


def error_table(fit: Fit, held_out: CrossValidation | None, validated: Mapping[str, float]) -> Table:
    """Return the errors of every test in per cent.

    Args:
        fit: the fit of a law.
        held_out: errors of tests that a fit left out; None: none was made.
        validated: errors of tests for validation, by name.
    """
    what = "test" if fit.against == "forces" else "property"
    columns = [what, "NRMS [%]", "rms error / peak [%]", "R2", *(["held out: NRMS [%]"] if held_out else [])]
    table = Table(f"{fit.law.name}: errors", columns)
    for name, value in fit.nrms.items():
        row = [name, _percent(value), _percent(fit.peak_error[name]), formatted(fit.determination[name], ".4f")]
        table.rows.append([*row, *([_percent(held_out.nrms[name])] if held_out else [])])
    mean = ["mean", _percent(mean_nrms(fit.nrms)), _percent(mean_nrms(fit.peak_error))]
    mean.append(formatted(mean_nrms(fit.determination), ".4f"))
    table.rows.append([*mean, *([_percent(held_out.mean)] if held_out else [])])
    for name, value in validated.items():
        table.rows.append([f"{name} (validate)", _percent(value), "", "", *([""] if held_out else [])])
    table.notes.append(f"NRMS: sum of squared errors over that of squared measured {fit.against}, no root")
    if held_out:
        name, value = held_out.worst
        table.notes.append(f"held out ({held_out.folds} folds): worst is {name}, {_percent(value)} %")
    return table


def comparison_table(comparison: Comparison) -> Table:
    """Return several laws side by side, and which one suffices."""
    columns = ("law", "fitted", "NRMS [%]", "held out [%]", "worst held out [%]", "AIC", "BIC", "starts at minimum")
    table = Table("Laws compared", columns, name="laws_compared")
    for item in comparison.laws:
        out = item.held_out
        cells = [_percent(out.mean), f"{_percent(out.worst[1])}"] if out else ["-", "-"]
        fit = item.fit
        row = [fit.law.name, whole(item.parameters), _percent(mean_nrms(fit.nrms)), *cells]
        table.rows.append(
            [*row, formatted(item.aic, ".1f"), formatted(item.bic, ".1f"), f"{fit.same_minimum} of {len(fit.starts)}"]
        )
    best = comparison.nearest
    how = "predicts held-out tests nearly as well as the best" if best.held_out else "has the least BIC"
    if comparison.sufficient is None:
        error = best.fit.mean_rms_error if best.held_out is None else math.sqrt(best.held_out.mean)
        table.notes.append(
            f"none of the laws compared follows the tests (rms error at most {100.0 * FOLLOWS:g} % of the rms "
            f"force): {best.fit.law.name}, the nearest, has {_percent(error)} %"
        )
    else:
        table.notes.append(
            f"{best.fit.law.name} suffices: of the laws compared it {how}, with {best.parameters} parameters"
        )
    table.notes.append(f"AIC and BIC above the least, counting {comparison.independent:.0f} independent errors")
    return table


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


def _bare(text: str | float) -> str:
    """Without its unit."""
    return formatted(text, ".3g") if isinstance(text, float) else text.split(" ")[0]


def _percent(value: float) -> str:
    return number(value, DIGITS, 1e-2)
