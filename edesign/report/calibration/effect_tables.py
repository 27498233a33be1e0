"""The effects that a calibration found, as tables: what each explains, its parameters, what looks like it."""

from __future__ import annotations

import math
from collections.abc import Mapping

from edesign.calibrate.result import Calibration, Effect, Estimate
from edesign.damper.amendment_kinds import kind_if_known
from edesign.damper.law import Parameter
from edesign.report.calibration.units import error_text, interval_text, percent, plus_minus, practical, value_text
from edesign.report.tables.table import Table

REFIT = "refit"
"""Name of a rival that is no effect: the law alone, fitted again."""

NOT_ASKED = "not all others were asked: the search ended before"
"""In the place of look-alikes, where none were found in a search that did not come to its own end."""

_NAMES = {REFIT: "the same model with other parameters"}


def effect_tables(calibration: Calibration) -> list[Table]:
    """Effects adopted, their parameters, and candidates refused; those without rows or notes left out."""
    tables = [
        effects_table(calibration),
        effect_parameters_table(calibration),
        hypotheses_table(calibration),
        refused_table(calibration),
    ]
    return [table for table in tables if table.rows or table.notes]


def effects_table(calibration: Calibration) -> Table:
    """Each effect with its kind, what it removes, and what the tests cannot tell from it; evidence below."""
    columns = ("effect", "name", "kind", "validation NRMS without it [%]", "reduction [%]", "of the excess [%]")
    table = Table("Effects found", (*columns, "cannot be told from"), left=3, name="effects_found")
    with_it = calibration.errors["corrected"].validate
    none = "nothing known" if calibration.ending == "complete" else NOT_ASKED
    for effect in calibration.effects:
        errors = [percent(with_it + effect.delta_validate), percent(effect.delta_validate)]
        alike = ", ".join(effect_name(name) for name in effect.indistinguishable_from)
        name = f"{effect.name}.{effect.form}"
        table.rows.append([effect.title, name, effect.kind, *errors, percent(effect.share), alike or none])
        table.notes.append(f"{effect.name}: {effect.evidence}")
    if calibration.effects:
        table.notes.append(
            f"without it: the other effects fitted again; reduction: by it, to {percent(with_it)} %; excess: error "
            "above the noise floor in tests left out"
        )
    else:
        table.columns = ()
        table.notes.append("none was adopted")
    return table


def effect_parameters_table(calibration: Calibration) -> Table:
    """Return the parameters of the effects with standard errors and 95 % intervals, in practical units.

    A column tells the meaning of each parameter where the form of a law file has one.
    """
    columns = ("effect", "parameter", "value", "std. error", "95 % interval", "unit")
    known = any(_parameters(effect) for effect in calibration.effects)
    table = Table(
        "Parameters of the effects",
        (*columns, "meaning") if known else columns,
        left=2,
        name="parameters_of_the_effects",
    )
    for effect in calibration.effects:
        meanings = _parameters(effect)
        for name, estimate in (dict(effect.parameters) | _fixed(effect)).items():
            shown = practical(estimate, effect.parameters)
            texts = [value_text(shown), error_text(shown), interval_text(shown), shown.unit or "-"]
            meaning = [meanings[name].meaning if name in meanings else "-"] if known else []
            table.rows.append([effect.name, name, *texts, *meaning])
    return table


def hypotheses_table(calibration: Calibration) -> Table:
    """Effects that were found and are no part of the corrected law, with their parameters and the reason."""
    table = Table(
        "Hypotheses: found, no part of the law",
        ("effect", "parameters", "why it is no part"),
        left=3,
        name="hypotheses",
    )
    for one in calibration.hypotheses:
        effect = one.effect
        shown = {name: plus_minus(practical(value, effect.parameters)) for name, value in effect.parameters.items()}
        numbers = ", ".join(f"{name} = {text}" for name, text in shown.items())
        table.rows.append([f"{effect.name}.{effect.form}", numbers or "-", one.why])
        table.notes.append(f"{effect.name}: {effect.evidence}")
    return table


def refused_table(calibration: Calibration) -> Table:
    """Candidates that came nearest to being adopted, and what spoke against them."""
    table = Table("Candidates not adopted", ("effect", "evidence"), left=2, name="candidates_not_adopted")
    table.rows += [[label, evidence] for label, evidence in calibration.refused]
    return table


def effect_name(name: str) -> str:
    """Name of an effect, or of the law alone, in words."""
    return _NAMES.get(name, name.replace("_", " "))


def _parameters(effect: Effect) -> Mapping[str, Parameter]:
    """What law files know of the parameters of a form; nothing of those they cannot carry."""
    kind = kind_if_known(effect.name, effect.form)
    return {parameter.name: parameter for parameter in kind.parameters} if kind is not None else {}


def _fixed(effect: Effect) -> dict[str, Estimate]:
    """Numbers that were not searched, of which the unit is known."""
    known = _parameters(effect)
    return {
        name: Estimate(value, 0.0, known[name].unit)
        for name, value in effect.fixed.items()
        if name in known and math.isfinite(value)
    }
