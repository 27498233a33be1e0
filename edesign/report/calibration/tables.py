"""What a calibration found: a verdict in words, and tables for the terminal and the page."""

from __future__ import annotations

import math

import numpy as np

from edesign.calibrate.dampers.trial import APART
from edesign.calibrate.evidence import MOST
from edesign.calibrate.result import Calibration, CarriedLaw, Effect, Hypothesis, Series, Stage, Subject, Worst
from edesign.damper.laws import LAWS
from edesign.report.calibration.effect_tables import effect_name, effect_tables
from edesign.report.calibration.units import Calibrated, error_text, percent, plus_minus, practical, value_text
from edesign.report.tables.table import Table, formatted

STAGES: dict[Stage, str] = {"declared": "as declared", "refit": "refitted", "corrected": "corrected"}
"""Of a law, in words."""

MODELS: dict[Subject, str] = {"damper": "law", "structure": "building"}
"""What is calibrated, in a word."""

NRMS_NOTES: dict[Subject, str] = {
    "damper": "NRMS: sum of squared errors over sum of squared measured forces, no root",
    "structure": "NRMS: sum of squared errors over sum of squared measured values, no root; of several channels each "
    "over the root mean square of its kind (accelerations, displacements) in the fitted tests",
}

_ENDED = {"interrupted": "was interrupted", "out_of_time": "ended with its time (--seconds)"}

NOT_SEARCHED = "Not searched: something is missing, and the search ended before all effects known here were tried."
"""Of a search that ended before it found anything, and before it had looked everywhere."""

_TOLD = 2  # parameters of an effect in a sentence
_CHANGED = 1.05  # ratio of errors that is worth telling


def tables_of(calibration: Calibration) -> list[Table]:
    """All tables, in the order of a report on a terminal."""
    return [
        errors_table(calibration),
        each_test_table(calibration),
        *(table for table in (starts_table(calibration),) if table.rows),
        *effect_tables(calibration),
        law_parameters_table(calibration),
    ]


def errors_table(calibration: Calibrated) -> Table:
    """Errors of the law before and after, and the noise floor."""
    table = Table(
        "Errors", (MODELS[calibration.subject], "fitted tests: NRMS [%]", "validation tests: NRMS [%]"), name="errors"
    )
    for stage, label in STAGES.items():
        errors = calibration.errors[stage]
        table.rows.append([label, percent(errors.fit), percent(errors.validate)])
    table.rows.append(["noise floor", percent(calibration.noise_floor_fit), percent(calibration.noise_floor)])
    table.notes.append(NRMS_NOTES[calibration.subject])
    if calibration.fitted_first:
        table.notes.append("as declared: the campaign names no parameters, so the law was fitted to the tests first")
    return table


def each_test_table(calibration: Calibrated) -> Table:
    """Errors of each test in the order in which they were made."""
    columns = ("test", "use", *(f"{label} [%]" for label in STAGES.values()), "noise floor [%]")
    table = Table(
        "NRMS of each channel" if calibration.subject == "structure" else "NRMS of each test", columns, left=2
    )
    for series in calibration.series:
        errors = [percent(calibration.errors[stage].of(series)) for stage in STAGES]
        table.rows.append([label_of(series), series.use, *errors, percent(noise_of(series))])
    return table


def label_of(series: Series) -> str:
    """Name of a test, or of a channel, and the title of the test, if it has one."""
    if series.test:
        return series.name
    return f"{series.name}: {series.title}" if series.title and series.title != series.name else series.name


def noise_of(series: Series) -> float:
    """NRMS of the noise of a test, over the samples that are judged."""
    power = float(np.mean(series.measured[series.judged] ** 2))
    return series.noise**2 / power if power > 0.0 else math.nan


def starts_table(calibration: Calibrated) -> Table:
    """Tests that start away from rest; no rows if all start at rest."""
    table = Table(
        "Tests that start away from rest",
        ("test", "first sample [mm]", "[mm/s]", "judged from [s]", "before: largest [mm]", "largest [mm/s]"),
        name="displaced_starts",
    )
    started = [(series.name, series.start) for series in calibration.series if series.start is not None]
    for name, start in started:
        softened = [formatted(1e3 * value, ".3g") if value else "-" for value in start.before]
        from_then = formatted(start.judged_from, ".3g") + ("" if start.dies_away else " (matters longer)")
        table.rows.append(
            [
                name,
                formatted(1e3 * start.displacement, ".3g"),
                formatted(1e3 * start.velocity, ".3g"),
                from_then,
                *softened,
            ]
        )
    if started:
        table.notes.append(
            "judged from: samples before depend on how the specimen came to the first one (campaign key `start`)"
        )
        table.notes.append(
            "before: what had softened the law by then: at least so much, found from the force of each test; or as "
            "`start: at_rest` has it; -: no more than the test itself shows"
        )
    return table


def law_parameters_table(calibration: Calibration) -> Table:
    """Parameters of the law at each stage with standard errors."""
    law = LAWS.get(calibration.law)
    title = f"Law {calibration.law}: {law.title}" if law is not None else f"Law {calibration.law}"
    if calibration.subject == "structure":
        title = f"Building, and {title}" if calibration.law else "Building"
    columns = ("parameter", "unit", "declared", "refitted", "std. error", "corrected", "std. error")
    table = Table(title, columns)
    stages = {stage: calibration.parameters[stage] for stage in STAGES}
    for name in stages["declared"]:
        shown = {stage: practical(found[name], found) for stage, found in stages.items() if name in found}
        row = [name, shown["declared"].unit or "-", formatted(shown["declared"].value, ".4g")]
        for stage in ("refit", "corrected"):
            one = shown.get(stage)
            row += ["-", "-"] if one is None else [value_text(one), error_text(one)]
        table.rows.append(row)
    if calibration.subject == "structure":
        table.notes.append("storey_stiffness, storey_damping: factors of what is declared")
    if calibration.law_held:
        table.notes.append("corrected: the declared parameters were kept; fitting them too explains nothing more")
    table.notes += [f"{name} is held as declared: {why}" for name, why in calibration.held.items()]
    if calibration.carried is not None and calibration.carried.replaced:
        table.notes.append(_carried(calibration.carried))
    return table


def _carried(law: CarriedLaw) -> str:
    lost = ", ".join(law.replaced)
    if law.withheld:
        return (
            f"law file: the refitted law without {lost}, {percent(law.validate)} %; in forms of law files these "
            "predict the validation tests worse"
        )
    forms = ", ".join(f"{effect.name}.{effect.form}" for effect in law.effects)
    instead = f"with {forms}" if forms else "without effects"
    return f"law file: it cannot carry {lost}; {instead}, fitted again, it leaves {percent(law.validate)} %"


def verdict_text(calibration: Calibration) -> str:
    """The verdict in a plain paragraph, with its governing numbers."""
    first = law_kind_text(calibration)
    return " ".join((*((first,) if first else ()), _found(calibration), _errors(calibration), *_doubts(calibration)))


def law_kind_text(calibration: Calibration) -> str:
    """What must be said before all else of a law of the wrong kind; "" if nothing shows that."""
    kind = calibration.kind
    if kind is None:
        return ""
    signs = "".join(f"; {sign}" for sign in kind.signs)
    blamed = [effect for effect in calibration.effects if effect.kind != "damper"]
    texts = [
        f"The law {calibration.law} is of the wrong kind: fitted to the tests, it misses {percent(kind.left)} % of the "
        f"force (rms){signs}.",
        f"{kind.rival} ({kind.title.split(': ')[-1]}) misses {percent(kind.rival_left)} % without any effect; of the "
        f"excess over noise in the validation tests it removes {100.0 * kind.share:.3g} % (BIC falls by "
        f"{kind.bic:.0f}).",
        f"Calibrate with `law: {{type: {kind.rival}}}`, and judge effects of rig and instruments beside that law.",
    ]
    if blamed:
        named = " and ".join(f"{effect.title} ({effect.kind})" for effect in blamed)
        texts.append(f"What follows blames {named}: that may only make up for the law.")
    return " ".join(texts)


def _found(calibration: Calibration) -> str:
    effects = "; and ".join(effect_text(effect) for effect in calibration.effects)
    return {
        "none": f"None: no effect is missing from {_model(calibration)}{_again(calibration)}.",
        "explained": f"Explained: {effects}.",
        "partly_explained": f"Partly explained: {effects}.",
        "unexplained": "Unexplained: something is missing, and no effect known here explains it.",
        "not_searched": NOT_SEARCHED,
    }[calibration.verdict]


def _model(calibration: Calibration) -> str:
    return "the building" if calibration.subject == "structure" else f"the law {calibration.law}"


def _again(calibration: Calibration) -> str:
    return "" if calibration.law_held else " once its parameters are fitted again"


def ended(calibration: Calibration) -> list[str]:
    """What is to be said of a search that did not come to its end: what it has looked at, and what not."""
    if calibration.ending == "complete":
        return []
    coverage, how = calibration.coverage, _ENDED[calibration.ending]
    if calibration.effects:
        texts = [
            f"The search {how}: there may be more effects, and others like these.",
            f"Beside those found {coverage.text}.",
        ]
    else:
        texts = [f"The search {how}: {coverage.text}."]
    left = dict.fromkeys(effect_name(label.split(".")[0]) for label in coverage.not_screened)
    if left:
        texts.append(f"Not screened, or not in all forms: {', '.join(left)}.")
    return texts


def hypothesis_text(one: Hypothesis) -> str:
    """An effect that is no part of the corrected law, in words."""
    return f"A hypothesis, no part of the law: {effect_text(one.effect)}; {one.why}."


def effect_text(effect: Effect) -> str:
    """An effect in words, with its first parameters."""
    estimates = list(effect.parameters.items())[:_TOLD]
    shown = {name: plus_minus(practical(estimate, effect.parameters)) for name, estimate in estimates}
    numbers = ", ".join(f"{name} = {text}" for name, text in shown.items())
    return f"{effect.title} ({effect.kind}{', ' + numbers if numbers else ''})"


def _errors(calibration: Calibration) -> str:
    declared, refit, corrected = (calibration.errors[stage].validate for stage in STAGES)
    floor = f"noise floor of {percent(calibration.noise_floor)} %"
    fallen = declared > _CHANGED * corrected
    model = MODELS[calibration.subject]
    if fallen:
        alone = f" ({percent(refit)} % if the {model} alone is fitted again)" if refit > _CHANGED * corrected else ""
        how = "" if calibration.effects else f" with the {model} fitted again"
        text = (
            f"The validation error (NRMS) falls from {percent(declared)} % as declared to {percent(corrected)} %"
            f"{how}{alone}"
        )
    else:
        text = f"The validation error (NRMS) is {percent(corrected)} %"
    above = corrected > MOST[bool(calibration.effects)] * calibration.noise_floor
    return f"{text}, above the {floor}." if above else f"{text}, at the {floor}."


def worst_text(worst: Worst | None) -> list[str]:
    """Which test keeps a verdict from being better."""
    if worst is None:
        return []
    return [
        f"{worst.name} leaves most over its noise: an NRMS of {percent(worst.error)} %, {worst.times:.3g} times its "
        f"noise floor of {percent(worst.floor)} %."
    ]


def _starts(calibration: Calibration) -> list[str]:
    """Which tests start away from rest, and what of them is not judged."""
    started = {series.name: series.start for series in calibration.series if series.start is not None}
    if not started:
        return []
    longest = max(start.judged_from for start in started.values())
    start = "starts" if len(started) == 1 else "start"
    texts = [
        f"{', '.join(started)} {start} away from rest: the force of the first {longest:.2g} s depends on what went "
        "before, and is not judged."
    ]
    own = [name for name, one in started.items() if any(one.before) and not one.known]
    if own:
        texts.append(
            f"The law was softened before {', '.join(own)} by more than the record shows; how much is each test's own, "
            "found from its force."
        )
    lasting = [name for name, one in started.items() if not one.dies_away]
    if lasting:
        texts.append(f"In {', '.join(lasting)} what went before matters longer than half of the test.")
    return texts


def _doubts(calibration: Calibration) -> list[str]:
    texts = [*worst_text(calibration.worst), *_starts(calibration), *ended(calibration)]
    texts += map(hypothesis_text, calibration.hypotheses)
    if calibration.lasting:
        texts.append(
            "The softening of the law by its largest deformation and velocity lasts from test to test: so it predicts "
            "them better than with a fresh specimen in each, or the campaign says so."
        )
    if calibration.gamma_of != "parameters":
        what = "the force alone" if calibration.gamma_of == "force" else "k_mod twice, by the letter of its equation"
        texts.append(
            f"gamma_T multiplies {what}: so the law predicts the tests better than with all parameters at one rate "
            "or the campaign says so."
        )
    if calibration.verdict in ("partly_explained", "unexplained", "not_searched"):
        share, model = percent(calibration.unexplained_share, 2), MODELS[calibration.subject]
        texts.append(
            f"Of the error of the refitted {model} above noise {share} % is left in the validation tests: "
            f"{calibration.unexplained_shape}"
        )
        texts += _reaches(calibration)
    for effect in calibration.effects:
        if effect.indistinguishable_from:
            alike = " or ".join(effect_name(name) for name in effect.indistinguishable_from)
            texts.append(f"These tests cannot tell {effect_name(effect.name)} from {alike}.")
    if calibration.next_test is not None:
        names = " from ".join(effect_name(name) for name in calibration.next_test.separates)
        texts.append(f"To tell {names}: {calibration.next_test.text}.")
    return texts


def _reaches(calibration: Calibration) -> list[str]:
    """What the corrected model says wrongly about tests that it was not fitted to."""
    texts, model = [], MODELS[calibration.subject]
    refit, corrected = calibration.errors["refit"], calibration.errors["corrected"]
    if corrected.validate > _CHANGED * refit.validate:
        texts.append(
            f"The corrected {model} predicts the validation tests worse ({percent(corrected.validate)} %) than the "
            f"{model} alone fitted again ({percent(refit.validate)} %), by no more than noise may make."
        )
    texts += [
        f"Without {effect_name(effect.name)} the validation tests are predicted better "
        f"({percent(corrected.validate + effect.delta_validate)} %): it holds in the tests fitted to."
        for effect in calibration.effects
        if _CHANGED * (corrected.validate + effect.delta_validate) < corrected.validate
    ]
    beyond = _at_other_temperatures(calibration)
    if beyond:
        texts.append(
            f"No test fitted to is within {APART:g} K of {', '.join(beyond)}: what the law does there is read from "
            "other temperatures."
        )
    return texts


def _at_other_temperatures(calibration: Calibration) -> list[str]:
    """Validation tests at temperatures that no fitted one has."""
    if calibration.subject == "structure":
        return []
    degrees = {one.of_test: (one.use, float(np.mean(one.temperature))) for one in calibration.tests}
    fitted = [warm for use, warm in degrees.values() if use == "fit"]
    return [
        f"{name} ({warm:.3g} degC)"
        for name, (use, warm) in degrees.items()
        if use == "validate" and all(abs(warm - other) >= APART for other in fitted)
    ]
