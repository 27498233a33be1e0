"""Tables of what a calibration found, of dampers, buildings and property tables, for the terminal and the page."""

from __future__ import annotations

import math
from collections.abc import Mapping

from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.law_file import parameters_in_law_files
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Calibration, Effect, Estimate
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.report.calibration.error_tables import MODELS, each_test_table, errors_table, starts_table
from edesign.report.calibration.properties import each_group_table, property_errors_table
from edesign.report.calibration.units import UNKNOWN, interval_text, percent, value_text
from edesign.report.calibration.words import name_of, numbers_text, probability_text, searched
from edesign.report.tables.table import Table, formatted

_NOTHING = "nothing known"


def tables_of(calibration: Calibration) -> list[Table]:
    """Return all tables, in the order of a report on a terminal.

    Args:
        calibration: what was found.
    """
    if isinstance(calibration, PropertyCalibration):
        first = [property_errors_table(calibration), each_group_table(calibration)]
    else:
        first = [errors_table(calibration), each_test_table(calibration), starts_table(calibration)]
    tables = [*first, *effect_tables(calibration), law_table(calibration)]
    return [table for table in tables if table.rows]


def effect_tables(calibration: Calibration) -> list[Table]:
    """Return effects, their parameters, hypotheses and the models that were compared; those without rows left out.

    Args:
        calibration: what was found.
    """
    makers = effects_table, effect_parameters_table, hypotheses_table, models_table
    return [table for make in makers if (table := make(calibration)).rows]


def effects_table(calibration: Calibration) -> Table:
    """Return each effect with its kind, what it does for the prediction, and what the tests cannot tell from it.

    Args:
        calibration: what was found.
    """
    columns = ("effect", "name", "kind", "without it [%]", "gain", "probability", "cannot be told from")
    table = Table("Effects found", columns, left=3, name="effects_found", sentences=(0, 6))
    with_it = calibration.errors["corrected"].validate
    for one in calibration.effects:
        alike = ", ".join(f"{name_of(name)} ({probability_text(p)})" for name, p in one.indistinguishable_from.items())
        gain = f"{one.gain:.1f} ± {one.gain_error:.1f}" if math.isfinite(one.gain) else "-"
        without = percent(with_it + one.delta_validate)
        row = [one.title, one.label, one.kind, without, gain, probability_text(one.probability), alike or _NOTHING]
        table.rows.append(row)
        table.notes.append(f"{name_of(one.name)} shows as: {one.signature}")
    if table.rows:
        table.notes += [
            f"without it: NRMS of the validation tests, the others fitted again; with it {percent(with_it)} %",
            "gain: log density of tests left out of the fit, with its standard error; an effect is adopted if it is "
            "more than 4 and than twice its error",
            "probability: of the effect among all models that the search compared, whatever stands beside it",
        ]
    if any(one.indistinguishable_from for one in calibration.effects):
        table.notes.append("cannot be told from: with the probability of the other one, if it is one of the two")
    return table


def effect_parameters_table(calibration: Calibration) -> Table:
    """Return the parameters of the effects with 95 % intervals, in practical units.

    Args:
        calibration: what was found.
    """
    columns = ("effect", "parameter", "value", "95 % interval", "unit", "meaning")
    table = Table(
        "Parameters of the effects", columns, left=2, sentences=len(columns) - 1, name="parameters_of_the_effects"
    )
    for effect in calibration.effects:
        known, own = _known(effect), _parameters(effect)
        for name, estimate in own.items():
            shown = practical(estimate, own)
            meaning = known[name].meaning if name in known else effect.meanings.get(name, "-")
            table.rows.append([effect.label, name, value_text(shown), _interval(shown), shown.unit or "-", meaning])
        table.notes += _untold(own, f"{effect.label}: ")
    return table


def hypotheses_table(calibration: Calibration) -> Table:
    """Return effects that were found and are no part of the corrected law, with the reason.

    Args:
        calibration: what was found.
    """
    table = Table(
        f"Hypotheses: found, no part of the {MODELS[calibration.subject]}",
        ("effect", "parameters", "why"),
        left=3,
        name="hypotheses",
    )
    for one in calibration.hypotheses:
        table.rows.append([f"{one.effect.title} ({one.effect.label})", numbers_text(one.effect, 9) or "-", one.why])
    return table


def models_table(calibration: Calibration) -> Table:
    """Return the models that the search compared, the most probable first.

    Args:
        calibration: what was found.
    """
    columns = ("effects of the model", "fitted tests: NRMS [%]", "behind", "probability")
    table, model = Table("Models that were compared", columns, left=1, name="models"), MODELS[calibration.subject]
    alone = len(calibration.models) == 1 and not calibration.depths
    for one in () if alone else calibration.models:
        behind = "-" if one.behind == one.error == 0.0 else f"{one.behind:.1f} ± {one.error:.1f}"
        table.rows.append(
            [
                " + ".join(one.effects) or f"the {model} alone",
                percent(one.nrms),
                behind,
                probability_text(one.probability),
            ]
        )
    if table.rows:
        table.notes += [
            "behind: log density of tests left out by which the corrected model is ahead, with its standard error",
            searched(calibration),
        ]
    if any(one.behind < 0.0 for one in calibration.models):
        table.notes.append(
            "a model that is ahead was not adopted where its lead in the search was not sure: more than 4, and than "
            "twice its error"
        )
    return table


def law_table(calibration: Calibration) -> Table:
    """Return the parameters of the law or the building at each stage with 95 % intervals.

    Args:
        calibration: what was found.
    """
    law, structure = LAWS.get(calibration.law), calibration.subject == "structure"
    titles = ["Building"] if structure else []
    titles += [f"Law {calibration.law}: {law.title}"] if law is not None else []
    columns = ("parameter", "unit", "declared", "refitted", "95 % interval", "corrected", "95 % interval")
    table = Table(", and ".join(titles), columns)
    stages = {stage: calibration.parameters[stage] for stage in STAGES}
    for name in stages["declared"]:
        size = stages["declared"][name].value
        shown = {stage: practical(found[name], found, size) for stage, found in stages.items()}
        row = [name, shown["declared"].unit or "-", formatted(shown["declared"].value, ".4g")]
        for one in (shown["refit"], shown["corrected"]):
            row += [value_text(one), _interval(one)]
        table.rows.append(row)
    if "storey_stiffness" in stages["declared"]:
        table.notes.append("storey_stiffness, storey_damping: factors of what is declared")
    for stage, label in (("refit", "refitted"), ("corrected", "corrected")):
        table.notes += _untold(stages[stage], f"{label}: ")  # type: ignore[index]
    if calibration.law_held:
        table.notes.append("the campaign has the declared parameters held (`refit: false`)")
    table.notes += [f"{name} is held as declared: {why}" for name, why in calibration.held.items()]
    return table


def _interval(estimate: Estimate) -> str:
    """The 95 % interval; why there is none stands below the table."""
    return UNKNOWN if estimate.not_determined else interval_text(estimate)


def _untold(estimates: Mapping[str, Estimate], of: str) -> list[str]:
    """Why the tests do not determine parameters, one line for each reason."""
    reasons: dict[str, list[str]] = {}
    for name, one in estimates.items():
        if one.not_determined:
            reasons.setdefault(one.not_determined, []).append(name)
    return [f"{of}{', '.join(names)} not determined, {why}" for why, names in reasons.items()]


def _known(effect: Effect) -> Mapping[str, Parameter]:
    """What law files know of the parameters of a form."""
    forms = (form for table in TABLES for form in table.FORMS if form.label == effect.label)
    return next((parameters_in_law_files(form) for form in forms), {})


def _parameters(effect: Effect) -> dict[str, Estimate]:
    """All numbers of an effect; those that the campaign fixes where their unit is known."""
    known = _known(effect)
    fixed = {name: Estimate.held(value, known[name].unit) for name, value in effect.fixed.items() if name in known}
    return {**effect.parameters, **fixed}
