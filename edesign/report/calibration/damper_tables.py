"""What a calibration found: a verdict in words, and tables for the terminal and the page."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.dampers.sizes import APART
from edesign.calibration.residual.series import STAGES as EVERY_STAGE
from edesign.calibration.results.law_file import parameters_in_law_files
from edesign.calibration.results.practical_units import practical
from edesign.calibration.results.result import Calibration, Effect, Estimate, Subject
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS
from edesign.report.calibration.tables import MODELS, each_test_table, errors_table, starts_table
from edesign.report.calibration.units import UNKNOWN, interval_text, percent, plus_minus, value_text
from edesign.report.tables.table import Table, formatted

_TOLD = 2  # parameters of an effect, and look-alikes of it, in a sentence
_CHANGED = 1.05  # ratio of errors that is worth telling
_ANOTHER = 2.5  # times: three standard deviations, 0.3 of the logarithm, of a declared parameter
_WHOLE = 1e3  # from here on numbers in sentences are whole
_LEAST = 1e-4  # probability that is told as a number
_CLOSE = 0.05  # probability beside an effect of another one that is told in a breath with it
_NOTHING = "nothing known"
_TESTS: dict[Subject, str] = {"damper": "tests", "structure": "tests", "table": "rows"}
_MEASURED: dict[Subject, str] = {"damper": "force", "structure": "motion", "table": "moduli"}


def tables_of(calibration: Calibration) -> list[Table]:
    """Return all tables, in the order of a report on a terminal.

    Args:
        calibration: what was found.
    """
    tables = [
        errors_table(calibration),
        each_test_table(calibration),
        starts_table(calibration),
        effects_table(calibration),
        effect_parameters_table(calibration),
        hypotheses_table(calibration),
        models_table(calibration),
        law_table(calibration),
    ]
    return [table for table in tables if table.rows]


def effects_table(calibration: Calibration) -> Table:
    """Return each effect with its kind, what it does for the prediction, and what the tests cannot tell from it.

    Args:
        calibration: what was found.
    """
    columns = ("effect", "name", "kind", "without it [%]", "gain", "probability", "cannot be told from")
    table = Table("Effects found", columns, left=3, name="effects_found", sentences=(0, 6))
    with_it = calibration.errors["corrected"].validate
    for one in calibration.effects:
        alike = ", ".join(f"{name_of(name)} ({_probability(p)})" for name, p in one.indistinguishable_from.items())
        gain = f"{one.gain:.1f} ± {one.gain_error:.1f}" if math.isfinite(one.gain) else "-"
        without = percent(with_it + one.delta_validate)
        row = [one.title, one.label, one.kind, without, gain, _probability(one.probability), alike or _NOTHING]
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
    told = any(_known(effect) for effect in calibration.effects)
    heads = columns if told else columns[:-1]
    table = Table(
        "Parameters of the effects", heads, left=2, sentences=len(columns) - 1, name="parameters_of_the_effects"
    )
    for effect in calibration.effects:
        known, own = _known(effect), _parameters(effect)
        for name, estimate in own.items():
            shown = practical(estimate, own)
            meaning = known[name].meaning if name in known else "-"
            row = [effect.label, name, value_text(shown), _interval(shown), shown.unit or "-", meaning]
            table.rows.append(row if told else row[:-1])
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
        table.rows.append([f"{one.effect.title} ({one.effect.label})", _numbers(one.effect, 9) or "-", one.why])
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
            [" + ".join(one.effects) or f"the {model} alone", percent(one.nrms), behind, _probability(one.probability)]
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
    stages = {stage: calibration.parameters[stage] for stage in EVERY_STAGE}
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


def searched(calibration: Calibration) -> str:
    """Return how far the search looked.

    Args:
        calibration: what was found.
    """
    depths = calibration.depths
    if not depths and calibration.ending == "complete":
        model = MODELS[calibration.subject]
        return (
            f"no effect was screened, as the {model} alone leaves noise at the sampling of the search; effort "
            f"{calibration.effort:.0f} of {calibration.most_effort:g}"
        )
    if not depths:
        return f"no effect was screened to the end; effort {calibration.effort:.0f} of {calibration.most_effort:g}"
    screened, fitted = max((one.screened for one in depths), default=0), sum(one.fitted for one in depths)
    return (
        f"{len(depths)} round{'' if len(depths) == 1 else 's'} over up to {screened} of {calibration.forms} forms of "
        f"effects, {fitted} models fitted; effort {calibration.effort:.0f} of {calibration.most_effort:g}"
    )


def verdict_text(calibration: Calibration) -> str:
    """Return the verdict in plain paragraphs, one a line.

    Args:
        calibration: what was found.
    """
    return "\n".join(verdict_paragraphs(calibration))


def verdict_paragraphs(calibration: Calibration) -> tuple[str, ...]:
    """Return what a reader should know who reads nothing else: what was found, how good the law is, what is open.

    Args:
        calibration: what was found.
    """
    parts = [
        [other_law_text(calibration)],
        [_found(calibration), *ended(calibration)],
        [_errors(calibration), *_worst(calibration)],
        _doubts(calibration),
        [_file(calibration)],
        [
            f"A hypothesis, no part of the {MODELS[calibration.subject]}: {effect_text(one.effect)}; {one.why}."
            for one in calibration.hypotheses
        ],
        _open(calibration),
        _conditions(calibration),
    ]
    return tuple(text for part in parts if (text := " ".join(filter(None, part))))


def other_law_text(calibration: Calibration) -> str:
    """Return what must be said before all else where another law does better; "" if none does.

    Args:
        calibration: what was found.
    """
    other = calibration.other_law
    if other is None:
        return ""
    blamed = [effect for effect in calibration.effects if effect.kind != "damper"]
    how = "held as declared" if calibration.law_held else "fitted again"
    advice = f"Calibrate with `law: {{type: {other.law}}}`, and judge effects beside that law."
    if calibration.law_held:
        advice = f"Calibrate without `refit: false` first: {calibration.law} with other parameters may do as well."
    texts = [
        f"Another law does better: {other.law} ({other.title}), without any effect, leaves an NRMS of "
        f"{percent(other.validate)} % of the validation tests, the law {calibration.law} {how} "
        f"{percent(other.own_validate)} %.",
        f"It predicts tests left out better by {other.gain:.0f} ± {other.error:.0f} (log density).",
        advice,
    ]
    if blamed:
        named = " and ".join(f"{effect.title} ({effect.kind})" for effect in blamed)
        texts.append(f"What follows blames {named}: that may only make up for the law.")
    return " ".join(texts)


def effect_text(effect: Effect) -> str:
    """Return an effect in words, with its first parameters.

    Args:
        effect: that was found.
    """
    numbers = _numbers(effect, _TOLD)
    return f"{effect.title} ({effect.kind}{', ' + numbers if numbers else ''})"


def name_of(name: str) -> str:
    """Return the name of an effect, or of a model by its label, in words.

    Args:
        name: of the effect, or label.
    """
    return "the model alone" if name == "none" else name if "." in name else name.replace("_", " ")


def ended(calibration: Calibration) -> list[str]:
    """Return what is to be said of a search that did not come to its end.

    Args:
        calibration: what was found.
    """
    if calibration.ending == "complete":
        return []
    how = {
        "interrupted": "was interrupted",
        "effort_spent": f"ended with its effort of {calibration.most_effort:g} (--effort)",
    }[calibration.ending]
    more = "there may be more effects, and others like these" if calibration.effects else "effects may have been missed"
    return [f"The search {how}: {more}. So far: {searched(calibration)}."]


def _found(calibration: Calibration) -> str:
    effects = "; and ".join(effect_text(effect) + _or_others(effect) for effect in calibration.effects)
    tests = _TESTS[calibration.subject]
    again = "" if calibration.law_held else " once its parameters are fitted again"
    return {
        "none": f"None: no effect is missing from {_model(calibration)}{again}.",
        "explained": f"Explained: the {tests} show {effects}. Only noise is left.",
        "partly_explained": f"Partly explained: the {tests} show {effects}. More than noise is left.",
        "nothing_found": "Nothing found: something is missing, and no effect known here passes the rule of adoption.",
        "not_searched": "Not searched: something is missing, and the search ended before all effects were tried.",
    }[calibration.verdict]


def _or_others(effect: Effect) -> str:
    """Return other effects that may as well stand in the place of one, for a sentence."""
    close = [name_of(name) for name, p in effect.indistinguishable_from.items() if p >= _CLOSE]
    if len(close) > _TOLD:
        close = [*close[:_TOLD], "others"]
    return f", or {', or '.join(close)} in its place" if close else ""


def _errors(calibration: Calibration) -> str:
    declared, refit, corrected = (calibration.errors[stage].validate for stage in EVERY_STAGE)
    name = MODELS[calibration.subject]
    model = (
        f"the corrected {name}"
        if calibration.effects
        else f"the {name}"
        if calibration.law_held
        else f"the {name} fitted again"
    )
    texts = [
        f"In {_TESTS[calibration.subject]} that nothing was fitted to, {model} misses "
        f"{percent(math.sqrt(corrected), 2)} % of the {_MEASURED[calibration.subject]} (rms; "
        f"NRMS {percent(corrected)} %), as declared it misses {percent(math.sqrt(declared), 2)} %"
    ]
    if calibration.effects and not calibration.law_held:
        texts.append(f", fitted again without effects {percent(math.sqrt(refit), 2)} %")
    texts.append(f"; what no model can predict is {percent(math.sqrt(calibration.noise_floor), 2)} %.")
    if not calibration.effects and declared * _CHANGED < refit:
        texts.append(" The declared parameters predict these tests better than fitted ones do.")
    if calibration.more_is_left:
        share = percent(calibration.unexplained_share, 2)
        texts.append(
            f" Of what the refitted {name} misses beyond that, {share} % is left. {calibration.unexplained_shape}"
        )
    return "".join(texts)


def _worst(calibration: Calibration) -> list[str]:
    worst = calibration.worst
    if worst is None:
        return []
    return [
        f"{worst.name} leaves most: an NRMS of {percent(worst.error)} %, {_rounded(worst.times)} times its noise "
        f"floor of {percent(worst.floor)} %."
    ]


def _doubts(calibration: Calibration) -> list[str]:
    """What makes effects doubtful that predict well: numbers at their bounds, a law that is another one beside them."""
    texts = []
    for effect in calibration.effects:
        at = [name for name, one in effect.parameters.items() if one.untold.startswith("at its")]
        if at:
            texts.append(
                f"{', '.join(at)} of {effect.label} {'is' if len(at) == 1 else 'are'} at the end of what is likely: a "
                "simpler form would do, or it stands for something that is not known here."
            )
    if calibration.effects:
        own, alone = (calibration.parameters[stage] for stage in ("corrected", "refit"))
        far = {
            name: own[name].value / alone[name].value
            for name in own
            if own[name].value * alone[name].value > 0.0 and own[name].standard_error and not own[name].untold
        }
        moved = [f"{name} is {_times(x)}" for name, x in far.items() if max(x, 1.0 / x) > _ANOTHER]
        if moved:
            texts.append(
                f"With the effects the {MODELS[calibration.subject]} is another one: {', '.join(moved)} that of the "
                "one fitted alone. Check that against what is known of it, before the effects are believed."
            )
    return texts


def _times(ratio: float) -> str:
    return f"{ratio:.2g} times"


def _file(calibration: Calibration) -> str:
    """What law.yaml has; of a structure what structure.yaml and law.yaml lack."""
    if calibration.subject == "structure":
        return _structure_file(calibration)
    file = calibration.law_file
    carried = " and ".join(one.label for one in file.amendments)
    what = {"corrected": "the corrected law", "refit": "the refitted law", "declared": "the declared law"}[file.stage]
    if calibration.law_held and file.stage == "refit":
        what = "the law as declared"
    text = f"law.yaml has {what}"
    if carried:
        text += f" with {carried}"
    if file.withheld:
        text += f": {file.withheld}"
    elif file.lacking:
        text += f", but lacks {', '.join(file.lacking)}, which law files cannot carry"
    if file.told:
        text += "; what the rig and the instruments did is no part of it"
    return f"{text}."


def _structure_file(calibration: Calibration) -> str:
    """What structure.yaml has, and what stands in comments of it."""
    lacking = calibration.law_file.lacking
    text = "structure.yaml has the building as " + ("corrected" if calibration.effects else "fitted again")
    if calibration.law_held and not calibration.effects:
        text = "structure.yaml has the building as declared"
    if lacking:
        text += f", but no key of it, or of a law, carries {', '.join(lacking)}: comments tell"
    if calibration.law_file.told:
        text += "; what the instruments did is no part of it"
    return f"{text}."


def _model(calibration: Calibration) -> str:
    return "the building" if calibration.subject == "structure" else f"the law {calibration.law}"


def _open(calibration: Calibration) -> list[str]:
    """Look-alikes, the next test, and effects that held-out tests do not bear out."""
    texts = []
    for effect in calibration.effects:
        if effect.indistinguishable_from:
            alike = " or ".join(
                f"{name_of(name)} ({_probability(p)}, if it is one of the two)"
                for name, p in effect.indistinguishable_from.items()
            )
            texts.append(f"These {_TESTS[calibration.subject]} cannot tell {name_of(effect.name)} from {alike}.")
    with_it = calibration.errors["corrected"].validate
    texts += [
        f"Without {name_of(effect.name)} the validation tests are predicted better "
        f"({percent(with_it + effect.delta_validate)} %): it holds in the tests fitted to."
        for effect in calibration.effects
        if _CHANGED * (with_it + effect.delta_validate) < with_it
    ]
    if calibration.next_test is not None:
        names = " from ".join(map(name_of, calibration.next_test.separates))
        texts.append(f"The next test, to tell {names}: {calibration.next_test.text}.")
    elif no_next_test(calibration):
        texts.append(f"{no_next_test(calibration)}.")
    return texts


def no_next_test(calibration: Calibration) -> str:
    """Return why no further test is named though effects look alike; "" if one is, if none do, or if none was sought.

    Args:
        calibration: what was found.
    """
    alike = any(effect.indistinguishable_from for effect in calibration.effects)
    if not alike or calibration.next_test or calibration.subject != "damper" or calibration.ending == "interrupted":
        return ""
    return "No test within the amplitudes and frequencies of these would tell them apart better: look at the rig"


def _conditions(calibration: Calibration) -> list[str]:
    """Starts, readings of the law, temperatures without a fitted test."""
    started = {series.name: series.start for series in calibration.series if series.start is not None}
    texts = []
    longest = max((start.judged_from for start in started.values()), default=0.0)
    if longest > 0.0:
        texts.append(
            f"{', '.join(started)} {'starts' if len(started) == 1 else 'start'} away from rest: the force of "
            f"{'the first' if len(started) == 1 else 'up to the first'} {_rounded(longest)} s depends on what went "
            "before, and is not judged."
        )
    lasting = [name for name, one in started.items() if not one.dies_away]
    if lasting:
        texts.append(f"In {', '.join(lasting)} what went before matters longer than half of the test.")
    if calibration.lasting:
        texts.append("The softening of the law by its largest deformation and velocity lasts from test to test.")
    if calibration.subject != "damper":
        return texts
    degrees = {one.name: (one.use, float(np.mean(one.temperature))) for one in calibration.tests}
    fitted = [warm for use, warm in degrees.values() if use == "fit"]
    beyond = [
        f"{name} ({warm:.3g} degC)"
        for name, (use, warm) in degrees.items()
        if use == "validate" and all(abs(warm - other) >= APART for other in fitted)
    ]
    if beyond:
        texts.append(
            f"No test fitted to is within {APART:g} K of {', '.join(beyond)}: what the law does there is read from "
            "other temperatures."
        )
    return texts


def _rounded(number: float) -> str:
    return f"{number:.3g}" if number < _WHOLE else f"{number:.0f}"


def _interval(estimate: Estimate) -> str:
    """The 95 % interval; why there is none stands below the table."""
    return UNKNOWN if estimate.untold else interval_text(estimate)


def _untold(estimates: Mapping[str, Estimate], of: str) -> list[str]:
    """Why the tests do not determine parameters, one line for each reason."""
    reasons: dict[str, list[str]] = {}
    for name, one in estimates.items():
        if one.untold:
            reasons.setdefault(one.untold, []).append(name)
    return [f"{of}{', '.join(names)} not determined, {why}" for why, names in reasons.items()]


def _probability(p: float) -> str:
    if not math.isfinite(p):
        return "-"
    return f"under {percent(_LEAST)} %" if p < _LEAST else f"{percent(p, 3 if p < 0.995 else 4)} %"


def _numbers(effect: Effect, most: int) -> str:
    parameters = dict(list(effect.parameters.items())[:most])
    shown = {name: practical(value, effect.parameters) for name, value in parameters.items()}
    return ", ".join(f"{name} = {_in_text(one)}" for name, one in shown.items())


def _in_text(estimate: Estimate) -> str:
    """A number in a sentence, without its reason if it is not determined."""
    if estimate.untold:
        return f"{value_text(estimate)} {estimate.unit}".rstrip() + f" ({UNKNOWN})"
    return plus_minus(estimate)


def _known(effect: Effect) -> Mapping[str, Parameter]:
    """What law files know of the parameters of a form."""
    forms = (form for table in TABLES for form in table.FORMS if form.label == effect.label)
    return next((parameters_in_law_files(form) for form in forms), {})


def _parameters(effect: Effect) -> dict[str, Estimate]:
    """All numbers of an effect; those that the campaign fixes where their unit is known."""
    known = _known(effect)
    fixed = {name: Estimate.held(value, known[name].unit) for name, value in effect.fixed.items() if name in known}
    return {**effect.parameters, **fixed}
