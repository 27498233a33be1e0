"""The verdict of a calibration in plain words: what was found, how good the model is, what is open."""

from __future__ import annotations

import math

import numpy as np

from edesign.calibration.dampers.sizes import APART
from edesign.calibration.residual.series import STAGES
from edesign.calibration.results.evidence import NEXT_TEST
from edesign.calibration.results.result import Calibration, Effect, Subject
from edesign.damper.testing.measured_histories import gaps
from edesign.report.calibration.error_tables import LAW_FILES, MODELS
from edesign.report.calibration.units import percent
from edesign.report.calibration.words import effect_text, name_of, outlying_text, probability_text, searched

_AT = "at its"  # bound: as an estimate says why it is not determined
_NAMED = 2  # effects confounded with one, in a sentence
_CHANGED = 1.05  # ratio of errors that is worth a word
_ANOTHER = 2.5  # times: three standard deviations, 0.3 of the logarithm, of a declared parameter
_WHOLE = 1e3  # from here on numbers in sentences are whole
_CLOSE = 0.05  # probability beside an effect of another one that is named in one sentence with it
_TESTS: dict[Subject, str] = {"damper": "tests", "structure": "tests", "table": "rows"}
_MEASURED: dict[Subject, str] = {"damper": "force", "structure": "motion", "table": "moduli"}


def verdict_text(calibration: Calibration) -> str:
    """Return the verdict in plain paragraphs, one a line."""
    return "\n".join(verdict_paragraphs(calibration))


def verdict_paragraphs(calibration: Calibration) -> tuple[str, ...]:
    """Return what a reader should know who reads nothing else: what was found, how good the law is, what is open."""
    parts = [
        [other_law_text(calibration)],
        [_found(calibration), *ended(calibration)],
        [_errors(calibration), *_worst(calibration)],
        [outlying_text(one) for one in calibration.outlying],
        _warnings(calibration),
        [_file(calibration)],
        [
            f"A hypothesis, no part of the {MODELS[calibration.subject]}: {effect_text(one.effect)}; {one.why}."
            for one in calibration.hypotheses
        ],
        _open(calibration),
        _conditions(calibration),
        [f"Left out: {what} failed: {why}." for what, why in calibration.failed.items()],
    ]
    return tuple(text for part in parts if (text := " ".join(filter(None, part))))


def other_law_text(calibration: Calibration) -> str:
    """Return what must be said before all else where another law does better; "" if none does."""
    other = calibration.other_law
    if other is None:
        return ""
    blamed = [effect for effect in calibration.effects if effect.kind != "damper"]
    how = "fixed as declared" if calibration.law_fixed else "fitted again"
    advice = f"Calibrate with `law: {{type: {other.law}}}`, and judge effects beside that law."
    if calibration.law_fixed:
        advice = f"Calibrate without `refit: false` first: {calibration.law} with other parameters may do as well."
    texts = [
        f"Another law {'does' if other.sure else 'may do'} better: {other.law} ({other.title}), without any effect, "
        "leaves an NRMS of "
        f"{percent(other.validate)} % of the validation tests, the law {calibration.law} {how} "
        f"{percent(other.own_validate)} %.",
        f"It predicts tests left out better by {other.gain:.0f} ± {other.error:.0f} (log density)"
        + ("." if other.sure else ", which is not sure."),
        advice,
    ]
    if blamed:
        named = " and ".join(f"{effect.title} ({effect.kind})" for effect in blamed)
        texts.append(f"What follows blames {named}: that may only make up for the law.")
    return " ".join(texts)


def ended(calibration: Calibration) -> list[str]:
    """Return what is to be said of a search that did not come to its end."""
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
    kept = calibration.law_fixed or calibration.as_declared
    again = "" if kept else " once its parameters are fitted again"
    if calibration.doubtful:
        found = f"the {tests} show {effects}" if effects else "no effect known here passes all gates of adoption"
        verdict = "Partly explained" if effects else "Nothing found"
        return f"{verdict}: {found}. Whether more than noise is left cannot be said: {calibration.doubtful}."
    return {
        "none": f"None: no effect is missing from {_model(calibration)}{again}.",
        "explained": f"Explained: the {tests} show {effects}. Only noise is left.",
        "partly_explained": f"Partly explained: the {tests} show {effects}. More than noise is left.",
        "nothing_found": "Nothing found: something is missing, and no effect known here passes the gates of adoption.",
        "not_searched": "Not searched: something is missing, and the search ended before all effects were tried.",
    }[calibration.verdict]


def _or_others(effect: Effect) -> str:
    """Return other effects that may as well stand in the place of one, for a sentence."""
    close = [effect.titles.get(name, name_of(name)) for name, p in effect.indistinguishable_from.items() if p >= _CLOSE]
    if len(close) > _NAMED:
        close = [*close[:_NAMED], "others"]
    return f", or {', or '.join(close)} in its place" if close else ""


def _errors(calibration: Calibration) -> str:
    declared, refit, corrected = (calibration.errors[stage].validate for stage in STAGES)
    name = MODELS[calibration.subject]
    model = (
        f"the corrected {name}"
        if calibration.effects
        else f"the {name}"
        if calibration.law_fixed
        else f"the {name} as declared"
        if calibration.as_declared
        else f"the {name} fitted again"
    )
    texts = [
        f"In {_TESTS[calibration.subject]} that nothing was fitted to, {model} leaves an NRMS of "
        f"{percent(corrected)} % of the {_MEASURED[calibration.subject]} ({percent(math.sqrt(corrected), 2)} % in rms)"
    ]
    if calibration.effects or not (calibration.as_declared or calibration.law_fixed):
        texts.append(f", as declared it leaves {percent(declared)} %")
    if calibration.effects and not calibration.law_fixed:
        texts.append(f", fitted again without effects {percent(refit)} %")
    texts.append(f"; what no model can predict is {percent(calibration.noise_floor)} %")
    if 2.0 * calibration.interpolation > calibration.noise_floor:
        texts.append(
            f", of which {percent(calibration.interpolation)} % is the motion between samples, which is not known: "
            "sample faster"
        )
    texts.append(".")
    if calibration.as_declared:
        fitted = "" if calibration.effects else f": fitted ones leave {percent(refit)} %"
        texts.append(f" Its parameters are kept as declared{fitted}.")
    if calibration.fitted_first:
        texts.append(" The campaign names no parameters: those called declared were fitted to the tests first.")
    texts.append(_weights(calibration))
    if calibration.more_is_left:
        share = percent(calibration.unexplained_share, 2)
        texts.append(
            f" Of what the {name} alone leaves beyond that, {share} % is left. {calibration.unexplained_shape}"
        )
    return "".join(texts)


def _weights(calibration: Calibration) -> str:
    """Return why a fit may make the error of the tests fitted to larger; "" if it does not in the digits shown."""
    declared, refit = calibration.errors["declared"], calibration.errors["refit"]
    names = [one.name for one in calibration.tests if one.use == "fit" and one.name in declared.tests]
    if refit.fit <= declared.fit or percent(refit.fit) == percent(declared.fit) or not names:
        return ""
    means = [sum(one.tests[name] for name in names) / len(names) for one in (declared, refit)]
    return (
        f" A fit weighs each test by its own size: the mean NRMS of the tests fitted to goes from {percent(means[0])} "
        f"to {percent(means[1])} %, that of all their forces together from {percent(declared.fit)} to "
        f"{percent(refit.fit)} %."
    )


def _worst(calibration: Calibration) -> list[str]:
    worst = calibration.worst
    if worst is None:
        return []
    return [
        f"{worst.name} leaves most: an NRMS of {percent(worst.error)} %, {_rounded(worst.times)} times its noise "
        f"floor of {percent(worst.floor)} %."
    ]


def _warnings(calibration: Calibration) -> list[str]:
    """Warnings about numbers at their bounds, and about a law that is another one beside effects that predict well."""
    texts = []
    law = calibration.parameters.get(calibration.law_file.stage, {}) if calibration.subject == "damper" else {}
    limits = [f"{name} {one.not_determined}" for name, one in law.items() if one.not_determined.startswith(_AT)]
    if limits and calibration.verdict not in ("none", "explained"):
        texts.append(
            f"The law {calibration.law} is at the end of what it can do: {', '.join(limits)}. A simpler law would do, "
            "or what the tests ask for is of another kind."
        )
    for effect in calibration.effects:
        at = [name for name, one in effect.parameters.items() if one.not_determined.startswith(_AT)]
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
            if own[name].value * alone[name].value > 0.0 and own[name].standard_error and not own[name].not_determined
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
    carried = " and ".join(one.label for one in file.effects)
    what = LAW_FILES[file.stage]
    if calibration.law_fixed and file.stage == "refit":
        what = "the law as declared"
    text = f"law.yaml has {what}"
    if carried:
        text += f" with {carried}"
    if file.withheld:
        text += f": {file.withheld}"
    elif file.lacking:
        text += f", but lacks {', '.join(file.lacking)}, which law files cannot carry"
    if file.brace:
        text += f"; a project has in series with it `{file.brace}`"
    if file.measurement_effects:
        text += "; what the rig and the instruments did is no part of it"
    if file.otherwise:
        text += f". Comments in it have {' and '.join(file.otherwise)}, in case it is of the damper"
    return f"{text}."


def _structure_file(calibration: Calibration) -> str:
    """What structure.yaml has, and what stands in comments of it."""
    lacking = calibration.law_file.lacking
    text = "structure.yaml has the building as " + ("corrected" if calibration.effects else "fitted again")
    if calibration.law_fixed and not calibration.effects:
        text = "structure.yaml has the building as declared"
    if lacking:
        text += f", but no key of it, or of a law, carries {', '.join(lacking)}: comments have them"
    if calibration.law_file.measurement_effects:
        text += "; what the instruments did is no part of it"
    return f"{text}."


def _model(calibration: Calibration) -> str:
    return "the building" if calibration.subject == "structure" else f"the law {calibration.law}"


def _open(calibration: Calibration) -> list[str]:
    """Confounded effects, the next test, and effects that held-out tests do not bear out."""
    texts = []
    for effect in calibration.effects:
        if effect.indistinguishable_from:
            confounded = " or ".join(
                f"{name_of(name)} ({probability_text(p)}, if it is one of the two)"
                for name, p in effect.indistinguishable_from.items()
            )
            texts.append(
                f"These {_TESTS[calibration.subject]} cannot separate {name_of(effect.name)} from {confounded}."
            )
    with_it = calibration.errors["corrected"].validate
    texts += [f"{asked[0].upper()}{asked[1:]}." for effect in calibration.effects if (asked := effect.question)]
    texts += [
        f"Without {name_of(effect.name)} the validation tests are predicted better "
        f"({percent(with_it + effect.delta_validate)} %): it holds in the tests fitted to."
        for effect in calibration.effects
        if _CHANGED * (with_it + effect.delta_validate) < with_it
    ]
    if calibration.next_test is not None:
        names = " from ".join(map(name_of, calibration.next_test.separates))
        texts.append(f"The next test, to separate {names}: {calibration.next_test.text}.")
    elif no_next_test(calibration):
        texts.append(f"{no_next_test(calibration)}.")
    return texts


def no_next_test(calibration: Calibration) -> str:
    """Return why no further test is named though effects are confounded; "" if one is, none do, or none was sought."""
    confounded = any(effect.indistinguishable_from for effect in calibration.effects)
    asked = calibration.subject == "damper" and calibration.ending != "interrupted"
    if not confounded or calibration.next_test or not asked or NEXT_TEST in calibration.failed:
        return ""
    return "No test within the amplitudes and frequencies of these would separate them better: look at the rig"


def _conditions(calibration: Calibration) -> list[str]:
    """Starts, readings of the law, missing samples, temperatures without a fitted test."""
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
    for one in calibration.tests:
        missing = gaps(one.time)
        if missing.size:
            longest = float(np.max(one.time[missing + 1] - one.time[missing]))
            texts.append(
                f"{one.name} lacks samples, for {_rounded(longest)} s at most: its motion is interpolated there."
            )
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
