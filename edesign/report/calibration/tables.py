"""Tables of what a calibration found, of dampers, buildings and property tables, for the terminal and the page."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.properties.outcome import PropertyCalibration
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.law_file import parameters_in_law_files
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Calibration, Effect, Estimate, Hypothesis
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.report.calibration.error_tables import MODELS, each_test_table, errors_table, starts_table
from edesign.report.calibration.nuisance_tables import nuisance_tables
from edesign.report.calibration.properties import each_group_table, property_errors_table
from edesign.report.calibration.units import UNKNOWN, interval_text, percent, value_cell
from edesign.report.calibration.words import name_of, numbers_text, probability_text, searched
from edesign.report.tables.column import bounded, col, text
from edesign.report.tables.number import finite
from edesign.report.tables.table import Row, Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT

_NOTHING = "nothing known"


class _Found(NamedTuple):
    """An effect, and the NRMS of the validation tests without it."""

    effect: Effect
    without: float


def _gain(one: _Found) -> str | None:
    effect = one.effect
    return f"{effect.gain:.1f} ± {effect.gain_error:.1f}" if math.isfinite(effect.gain) else None


def _confounded(one: _Found) -> str:
    effect = one.effect
    others = [f"{name_of(name)} ({probability_text(p)})" for name, p in effect.indistinguishable_from.items()]
    own = [] if effect.other_kind is None else [f"{name_of(effect.name)} of the {effect.other_kind}"]
    return ", ".join(own + others) or _NOTHING


EFFECTS = TableSpec[_Found](
    "effects_found",
    "Effects found",
    (
        text("effect", "effect.title", broken=1),
        text("name", "effect.label"),
        text("kind", "effect.kind"),
        col("without it", PERCENT, bounded("without"), 3),
        col("gain", ONE, _gain),
        col("probability", ONE, lambda one: probability_text(one.effect.probability)),
        text("cannot be separated from", _confounded, broken=2),
    ),
    keys=3,
)
EFFECT_PARAMETERS = TableSpec[Row](
    "parameters_of_the_effects",
    "Parameters of the effects",
    (
        text("effect"),
        text("parameter"),
        col("value", ONE),
        text("95 % interval"),
        text("unit"),
        text("meaning", broken=1),
    ),
    keys=2,
)
HYPOTHESES = TableSpec[Hypothesis](
    "hypotheses",
    "Hypotheses: found, no part of the {model}",
    (
        text("effect", lambda one: f"{one.effect.title} ({one.effect.label})"),
        text("parameters", lambda one: numbers_text(one.effect, 9) or None),
        text("why"),
    ),
    keys=3,
)
COMPARED = TableSpec[Row](
    "models",
    "Models that were compared",
    (
        text("effects of the model"),
        col("fitted tests: NRMS", PERCENT, digits=3),
        col("behind", ONE),
        text("probability"),
        text("why it does not stand"),
    ),
)
LAW = TableSpec[Row](
    "calibrated_law",
    "{title}",
    (
        text("parameter"),
        text("unit"),
        col("declared", ONE, form=".4g"),
        col("refitted", ONE),
        text("95 % interval"),
        col("corrected", ONE),
        text("95 % interval"),
    ),
    named_by_title=True,
)


def tables_of(calibration: Calibration) -> list[Table]:
    """Return all tables, in the order of a report on a terminal."""
    if isinstance(calibration, PropertyCalibration):
        first = [property_errors_table(calibration), each_group_table(calibration)]
    else:
        first = [errors_table(calibration), each_test_table(calibration), starts_table(calibration)]
    tables = [*first, *effect_tables(calibration), *nuisance_tables(calibration), law_table(calibration)]
    return [table for table in tables if table.rows]


def effect_tables(calibration: Calibration) -> list[Table]:
    """Return effects, their parameters, hypotheses and the models that were compared; those without rows left out."""
    makers = effects_table, effect_parameters_table, hypotheses_table, models_table
    return [table for make in makers if (table := make(calibration)).rows]


def effects_table(calibration: Calibration) -> Table:
    """Return each effect with its kind, what it does for the prediction, and what the tests cannot separate from it."""
    with_it = calibration.errors["corrected"].validate
    found = [_Found(one, with_it + one.delta_validate) for one in calibration.effects]
    notes = [f"{name_of(one.name)} shows as: {one.signature}" for one in calibration.effects]
    if found:
        notes += [
            f"without it: NRMS of the validation tests, the others fitted again; with it {percent(with_it)} %",
            "gain: log density of tests left out of the fit, with its standard error; an effect is adopted if it is "
            "more than 4 and than twice its error",
            "probability: of the effect among all models that the search compared, whatever stands beside it",
        ]
    if any(one.indistinguishable_from for one in calibration.effects):
        notes.append("cannot be separated from: with the probability of the other one, if it is one of the two")
    notes += [one.question for one in calibration.effects if one.question]
    return EFFECTS.of(found, notes=notes)


def effect_parameters_table(calibration: Calibration) -> Table:
    """Return the parameters of the effects with 95 % intervals, in practical units."""
    rows: list[Row] = []
    notes: list[str] = []
    for effect in calibration.effects:
        known, own = _known(effect), _parameters(effect)
        for name, estimate in own.items():
            shown = practical(estimate, own)
            meaning = known[name].meaning if name in known else effect.meanings.get(name)
            rows.append((effect.label, name, value_cell(shown), _interval(shown), shown.unit or None, meaning))
        notes += _undetermined(own, f"{effect.label}: ")
    return EFFECT_PARAMETERS.of(rows, notes=notes)


def hypotheses_table(calibration: Calibration) -> Table:
    """Return effects that were found and are no part of the corrected law, with the reason."""
    return HYPOTHESES.of(calibration.hypotheses, model=MODELS[calibration.subject])


def models_table(calibration: Calibration) -> Table:
    """Return the models that the search compared: the one that stands, and the others as they are behind or ahead."""
    model = MODELS[calibration.subject]
    nothing = len(calibration.models) == 1 and not calibration.depths
    rows: list[Row] = []
    for one in () if nothing else calibration.models:
        behind = None if one.behind == one.error == 0.0 else f"{one.behind:.1f} ± {one.error:.1f}"
        based = "" if calibration.law_fixed else " fitted" if one.refit else " as declared"
        effects = " + ".join(one.effects) or f"the {model}{based} alone"
        if one.effects and based == " as declared":
            effects += f", {model} as declared"
        likely = None if one.probability == 0.0 and one.why_not else probability_text(one.probability)
        rows.append((effects, finite(one.nrms), behind, likely, one.why_not or None))
    notes = []
    if rows:
        notes += [
            "behind: log density of tests left out by which the corrected model is ahead, with its standard error",
            searched(calibration),
        ]
    if any(one.why_not for one in calibration.models):
        notes.append("a model that does not pass all gates of adoption has no share in the probabilities")
    return COMPARED.of(rows, notes=notes)


def law_table(calibration: Calibration) -> Table:
    """Return the parameters of the law or the building at each stage with 95 % intervals."""
    law, structure = LAWS.get(calibration.law), calibration.subject == "structure"
    titles = ["Building"] if structure else []
    titles += [f"Law {calibration.law}: {law.title}"] if law is not None else []
    stages = {stage: calibration.parameters[stage] for stage in STAGES}
    rows: list[Row] = []
    for name, declared in stages["declared"].items():
        shown = {stage: practical(found[name], found, declared.value) for stage, found in stages.items()}
        found = [cell for one in (shown["refit"], shown["corrected"]) for cell in (value_cell(one), _interval(one))]
        rows.append((name, shown["declared"].unit or None, shown["declared"].value, *found))
    notes = []
    if "storey_stiffness" in stages["declared"]:
        notes.append("storey_stiffness, storey_damping: factors of what is declared")
    for stage, label in (("refit", "refitted"), ("corrected", "corrected")):
        notes += _undetermined(stages[stage], f"{label}: ")  # type: ignore[index]
    if calibration.law_fixed:
        notes.append("the campaign keeps the declared parameters fixed (`refit: false`)")
    for name, why in calibration.fixed.items():
        moved = len({stage[name].value for stage in stages.values() if name in stage}) > 1
        notes.append(f"{name} is {'not fitted' if moved else 'fixed as declared'}: {why}")
    return LAW.of(rows, notes=notes, title=", and ".join(titles))


def _interval(estimate: Estimate) -> str:
    """The 95 % interval; why there is none stands below the table."""
    return UNKNOWN if estimate.not_determined else interval_text(estimate)


def _undetermined(estimates: Mapping[str, Estimate], of: str) -> list[str]:
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
    fixed = {name: Estimate.fixed(value, known[name].unit) for name, value in effect.fixed.items() if name in known}
    return {**effect.parameters, **fixed}
