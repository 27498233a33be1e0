"""What a law file carries of a model: parameters and effects of the damper exactly as they were found.

Effects of rig and instruments are no part of a damper; they stand in comments. A law file that lacks an effect of the
damper, as it has no such form, says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
import yaml

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects.condition import CONDITION
from edesign.calibration.dampers.effects.temperature_law import lost
from edesign.calibration.dampers.mechanisms import (
    CoreEffect,
    LastingExtremes,
    LawParameters,
    Mechanism,
    Rest,
    Rig,
    RigValues,
)
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.form import FormInCampaign
from edesign.calibration.residual.series import Stage
from edesign.calibration.results.predictions import validation_error
from edesign.calibration.results.result import Calibration, LawFile
from edesign.calibration.results.result import Effect as FoundEffect
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.damper.effect_forms import LawEffectForm, form_if_known
from edesign.damper.effects import LawEffect
from edesign.damper.effects_file import write_effects
from edesign.damper.law import Parameter
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import write_parameters
from edesign.damper.temperature import LINEAR_LAWS, REFERENCE_C, FerryShift, GammaT
from edesign.damper.testing.campaign import Campaign
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError

_STRAIGHT = 1e9  # K: p2 of Ferry's shift, beside which any difference of temperatures is nothing
_APART = 2.5  # K between rows of a table of gamma_T, beside those at the temperatures of the tests
_CONSTANT = "constant"
LAW = "law.yaml"
"""Name of the file of a corrected law."""
ARRANGEMENT = "arrangement"
"""Name of the effect that tables of moduli may show: other arrangements of the law's elements."""


@dataclass(frozen=True)
class Carried:
    """How a law file carries an effect.

    Attributes:
        effects: of the law.
        temperature: in the place of the law's own; None: that stays.
        brace: what stands in series with all of it, which no law file has, but a project; None: nothing.
    """

    effects: tuple[LawEffect, ...] = ()
    temperature: GammaT | FerryShift | None = None
    brace: RigValues | None = None


def form_in_law_files(form: EffectForm) -> bool:
    """Return whether law files carry a form of an effect, of some law at least, if it is of the damper."""
    form = form.twin or form
    mechanisms = _left_in_files(form)
    if form.kind != "damper" or not mechanisms:
        return False
    if any(isinstance(mechanism, LawParameters) for mechanism in mechanisms):
        return form.name == "temperature_law"
    return all(isinstance(mechanism, CoreEffect) and _kind(form, mechanism) is not None for mechanism in mechanisms)


def _left_in_files(form: EffectForm) -> list[Mechanism]:
    """Mechanisms without those that act between tests alone, or that are nothing at the mean of a condition."""
    mechanisms = [one for one in form.mechanisms if not isinstance(one, Rest | LastingExtremes)]
    return [one for one in mechanisms if form.name != CONDITION or isinstance(one, CoreEffect) and one.own is not None]


def parameters_in_law_files(form: EffectForm) -> dict[str, Parameter]:
    """Return the parameters that law files have of a form, by name."""
    kinds = [kind for mechanism in form.core_effects if (kind := _kind(form, mechanism)) is not None]
    return {one.name: one for kind in kinds for one in kind.parameters}


def carried(problem: DamperProblem, effect: Effect, values: np.ndarray) -> Carried | None:
    """Return how a law file carries an effect of the damper; None: it has no such form.

    What ages is as it was in the last test, what softens or wears with use as in a virgin damper, what depends on a
    condition of the tests as at its mean in those fitted to, where most of these effects do nothing.

    Args:
        values: of its parameters, SI.
    """
    of: FormInCampaign = effect.data
    p, mechanisms = of.values(values), _left_in_files(of.form)
    if any(isinstance(mechanism, LawParameters) for mechanism in mechanisms):
        return _in_temperature_law(problem, of, p)
    for rig in (mechanism.values(p) for mechanism in mechanisms if isinstance(mechanism, Rig)):
        return Carried(brace=rig) if rig == RigValues(rig.stiffness, rig.play) else None
    found = []
    for mechanism in mechanisms:
        one = _law_effect(problem, of, mechanism, p) if isinstance(mechanism, CoreEffect) else None
        if one is None:
            return None
        found.append(one)
    return Carried(tuple(found))


def _law_effect(
    problem: DamperProblem, of: FormInCampaign, mechanism: CoreEffect, p: Mapping[str, float]
) -> LawEffect | None:
    kind = _kind(of.form, mechanism)
    if kind is None:
        return None
    if mechanism.equation == _CONSTANT:
        p = {**p, "T0": REFERENCE_C, "n": float(problem.experiments[-1].order)}
    elif mechanism.more is not None:
        p = {**p, **mechanism.more(p)}
    name, _, form = kind.name.partition(".")
    try:
        values = {one.name: p[one.name] for one in kind.parameters if one.name in p}
        return LawEffect(name, form, values, mechanism.placement.value)
    except InputError:  # a parameter, or a placement, that law files refuse
        return None


def _kind(form: EffectForm, mechanism: CoreEffect) -> LawEffectForm | None:
    """Kind by which law files know what a mechanism does; None: they know none."""
    name, _, equation = mechanism.equation.partition(".")
    if mechanism.equation == _CONSTANT:
        name, equation = form.name, form.form.removesuffix(f"_{mechanism.placement.value}")
    kind = form_if_known(name, equation)
    return kind if kind is not None and kind.constant == (mechanism.equation == _CONSTANT) else None


def _in_temperature_law(problem: DamperProblem, of: FormInCampaign, p: Mapping[str, float]) -> Carried | None:
    form, law = of.form.form, problem.law.name
    b, c = p["b"], p.get("c", 0.0)
    if form in ("shift", "shift_wlf") and law in LINEAR_LAWS and b >= 0.0 and c >= 0.0:
        return Carried(temperature=FerryShift(b * _STRAIGHT, _STRAIGHT) if c == 0.0 else FerryShift(b / c, 1.0 / c))
    table = {"gamma": GammaT(of=problem.gamma_of), "gamma_wlf": GammaT(of=problem.gamma_of)}.get(form)
    in_place = form in ("exponential_in_place", "wlf_in_place")  # a factor of the force alone
    if table is None and not in_place or problem.gamma_of != "parameters":
        return None
    degrees = sorted({REFERENCE_C, *(one.temperature for one in problem.experiments)})
    grid = np.arange(degrees[0], degrees[-1], _APART).tolist() if len(degrees) > 1 else []
    rows = []
    for t in sorted({*degrees, *grid}):
        gamma = math.exp(-lost(p, t))
        rows.append((t, gamma if table is None else gamma * table.gamma(t)))
    return (
        Carried(temperature=GammaT(tuple(rows), "force" if table is None else "parameters")) if len(rows) > 1 else None
    )


Validate = Callable[[list[Effect], np.ndarray], float]
"""NRMS of what was held out, by effects and values, SI, of the law and these; infinite: there is no prediction."""

Arranged = Callable[[Effect, Mapping[str, float]], tuple[dict[str, float], list[LawEffect]]]
"""Parameters of the law, of those fitted, and effects, by which a law file carries another arrangement of it."""


def law_file(
    problem: DamperProblem,
    final: FittedModel,
    plain: FittedModel,
    withheld: str = "",
    validate: Validate | None = None,
    arranged: Arranged | None = None,
    held_out: str = "the validation tests",
) -> LawFile:
    """Return the corrected law as a law file carries it; the law alone, where that predicts what was held out better.

    Args:
        problem: at full rate.
        plain: the law alone, as declared or fitted again.
        withheld: why the corrected model is the law alone already, for people; "" if it is not.
        validate: error of what was held out; None: that of the validation tests of the problem.
        arranged: of effects that are another arrangement of the law.
        held_out: what was, for people.
    """
    validate = validate or partial(validation_error, problem)
    alone: Stage = "refit" if plain.refits else "declared"
    found = _law_file(problem, final, "corrected" if final.effects else alone, validate, arranged)
    if found.lacking:
        without = _law_file(problem, plain, alone, validate, arranged)
        if found.validate > without.validate:
            why = (
                f"law files cannot carry {', '.join(found.lacking)}; without it {held_out} are predicted worse "
                f"({100.0 * found.validate:.3g} %) than by the law alone ({100.0 * without.validate:.3g} %)"
            )
            return replace(without, measurement_effects=found.measurement_effects, lacking=found.lacking, withheld=why)
    return replace(found, withheld=withheld)


def _law_file(
    problem: DamperProblem,
    model: FittedModel,
    stage: Stage,
    validate: Validate,
    arranged: Arranged | None,
) -> LawFile:
    base, every = len(problem.base), list(model.fit.values)
    fitted = problem.law_values(every)
    values, effects, otherwise, numbers = fitted, list[LawEffect](), dict[str, tuple[LawEffect, ...]](), every[:base]
    temperature: GammaT | FerryShift | None = own_temperature(problem)
    measured, lacking, known, rigs = list[str](), list[str](), list[Effect](), list[RigValues]()
    for index, effect in enumerate(model.effects):
        own = np.array([every[i] for i in model.places(index)])
        if effect.kind != "damper":
            measured.append(f"{effect.label} ({effect.kind}): {effect.data.words(own).title}")
            twin = effect.data.twin
            if twin is not None and (found := carried(problem, replace(effect, data=twin), own)) and found.effects:
                otherwise[effect.label] = found.effects
        elif effect.name == ARRANGEMENT and arranged is not None:
            values, beside = arranged(effect, fitted)
            effects += beside
        elif (found := carried(problem, effect, own)) is not None:
            effects += found.effects
            rigs += [found.brace] if found.brace else []
            temperature = found.temperature or temperature
        else:
            lacking.append(effect.label)
            continue
        known.append(effect)
        numbers += own.tolist()
    error = validate(known, np.array(numbers))
    parts = tuple(effects), temperature, tuple(measured), tuple(lacking), error
    return LawFile(stage, values, *parts, otherwise=otherwise, brace=_brace(RigValues.together(rigs)) if rigs else "")


def _brace(rig: RigValues) -> str:
    """Return what stands in series with a damper as a project has it."""
    play = f", play: {1e3 * rig.play:.6g} mm" if rig.play else ""
    return f"brace: {{stiffness: {1e-6 * rig.stiffness:.6g} kN/mm{play}}}"


def why_not_carried(problem: DamperProblem, model: FittedModel, index: int) -> str:
    """Return why no law file carries an effect of a model, by its index, for people; "" if one does."""
    effect = model.effects[index]
    if effect.kind != "damper":
        return "it is no part of the damper"
    own = np.array([model.fit.values[i] for i in model.places(index)])
    if effect.name == ARRANGEMENT:
        return ""
    found = carried(problem, effect, own)
    if found is None:
        return "law files have no such form"
    return f"a project has it in series with the law: `{_brace(found.brace)}`" if found.brace else ""


def own_temperature(problem: DamperProblem) -> GammaT | None:
    """Return the change with temperature that the law has by itself, as the tests were predicted with it."""
    gamma = GammaT(of=problem.gamma_of)
    away = any(one.temperature != REFERENCE_C for one in problem.experiments)
    return gamma if problem.law.name in gamma.laws and away else None


def law_text(found: Calibration, campaign: Campaign) -> str:
    """Return the law file of tests of a damper."""
    parameters = write_parameters(law_of(found.law), found.law_file.parameters)
    effects = write_effects(found.law_file.effects)
    return law_file_text(found, parameters, effects, campaign.specimen, _tested(found, campaign.specimen), _head(found))


def law_file_text(
    found: Calibration,
    parameters: Mapping[str, object],
    effects: Sequence[Mapping[str, object]],
    specimen: Specimen | None,
    tested: Mapping[str, str],
    head: Sequence[str],
) -> str:
    """Return the law file: parameters, effects of the damper, specimen, what the tests covered.

    Args:
        parameters: of the law as the file has them.
        effects: of the damper as the file has them.
        specimen: what was tested; None: it has no layers.
        tested: ranges, as text.
        head: comments at the top, before what the law lacks.
    """
    file = found.law_file
    law: dict[str, object] = {"type": found.law, "parameters": parameters}
    if effects:
        law["effects"] = effects
    data: dict[str, object] = {}
    if file.temperature is not None:
        data["temperature_law"] = _temperature_block(file.temperature)
    if specimen is not None:
        data["prototype"] = {
            "layers": specimen.layers,
            "layer_area": f"{1e6 * specimen.layer_area:.12g} mm^2",
            "layer_thickness": f"{1e3 * specimen.layer_thickness:.12g} mm",
        }
    data["tested"] = tested
    return _commented(head) + _yaml(law) + _otherwise(file, bool(effects)) + _yaml(data)


def _otherwise(file: LawFile, effects: bool) -> str:
    """Return effects that may be of the damper as comments, which stand where they go on from the lines before."""
    if not file.otherwise:
        return ""
    every = [one for of_effect in file.otherwise.values() for one in of_effect]
    lines = _yaml({"effects": write_effects(every)}).splitlines()
    return _commented(lines[1:] if effects else lines)


def _commented(lines: Iterable[str]) -> str:
    return "".join(f"# {line}\n" for line in lines)


def _yaml(data: Mapping[str, object]) -> str:
    return str(yaml.safe_dump(dict(data), sort_keys=False, allow_unicode=True, width=1000))


def _head(found: Calibration) -> list[str]:
    file = found.law_file
    title, which = (
        law_of(found.law).title,
        {"corrected": "corrected", "refit": "fitted again", "declared": "as declared"},
    )
    lines = [
        f"{title}, calibrated by {len(found.series)} tests of {found.title}: {found.verdict_words}",
        f"the law {which[file.stage]}: NRMS of the validation tests {100 * file.validate:.3g} %, as declared "
        f"{100 * found.errors['declared'].validate:.3g} %, noise {100 * found.noise_floor:.3g} %",
        *law_lines(found),
    ]
    names = {one.name for one in file.effects}
    if found.lasting or any(one.label == "extremes.lasting" for one in found.effects):
        lines.append("extremes soften it from test to test for good: the parameters are those of a virgin damper")
    if names & {"mullins", "degradation"}:
        lines.append("what softens with use begins as in a virgin damper")
    if "self_heating" in names:
        lines.append("it begins cold: heat that lasts from test to test is no part of it")
    lines += [
        f"as at the mean of the fitted tests, and nowhere else: {one.title}"
        for one in found.effects
        if one.label.startswith(f"{CONDITION}.")
    ]
    if "ageing" in names:
        lines.append("it has aged as much as in the last test")
    return lines


def law_lines(found: Calibration) -> list[str]:
    """Return what a law file says of itself in comments: what it lacks, what is no part of it, what is fixed."""
    file, lines = found.law_file, list[str]()
    if file.withheld:
        lines.append(f"not the corrected law: {file.withheld}")
    elif file.lacking:
        lines.append(
            f"INCOMPLETE: law files cannot carry {', '.join(file.lacking)}; with it the validation NRMS is "
            f"{100 * found.errors['corrected'].validate:.3g} %"
        )
    lines += [f"INCOMPLETE: a project has in series with this law `{file.brace}`"] if file.brace else []
    lines += [f"no part of the damper: {text}" for text in file.measurement_effects]
    lines += [
        f"the tests cannot separate {one.label} ({one.kind}) from {' or '.join(one.indistinguishable_from)}: "
        "it may be either"
        for one in found.effects
        if one.indistinguishable_from
    ]
    lines += [line for one in found.effects if (line := _by_whom(one, file))]
    lines += [f"hypothesis, not in this law: {one.effect.label}: {one.why}" for one in found.hypotheses]
    lines += [f"{name} is fixed: {why}" for name, why in found.fixed.items()]
    return lines


def _by_whom(effect: FoundEffect, file: LawFile) -> str:
    """Return what to change of a law file if an effect is a part of what it was not taken for; "" if that is known."""
    question, then = effect.question, ""
    if effect.label in file.otherwise:
        then = "; if it is the latter, its entry of `effects` stands below as a comment, and nothing else changes"
    elif effect.kind == "damper" and not effect.not_carried and not file.withheld:
        then = "; if it is the latter, take its entry out of `effects`, and nothing else changes"
    return question and f"{effect.label} ({effect.kind}): {question}{then}"


def _temperature_block(law: GammaT | FerryShift) -> dict[str, object]:
    """Return a change with temperature as the block `temperature_law` of a law file."""
    if isinstance(law, FerryShift):
        return {"ferry": {"p1": law.p1, "p2": f"{law.p2:.12g} K", "reference": f"{law.reference:g} degC"}}
    block: dict[str, object] = {"gamma_T": {f"{t:.12g} degC": gamma for t, gamma in law.table}}
    return block if law.of == "parameters" else {**block, "of": law.of}


def _tested(found: Calibration, specimen: Specimen | None) -> dict[str, str]:
    largest = np.array([np.max(np.abs(series.displacement)) for series in found.series])
    name, values, unit = ("deformation", 1e3 * largest, "mm")
    if specimen is not None:
        name, values, unit = ("shear_strain", 100.0 * specimen.strain(largest), "%")
    degrees = [float(np.mean(series.temperature)) for series in found.series]
    return {
        name: _span(float(values.min()), float(values.max()), unit),
        "temperature": _span(min(degrees), max(degrees), "degC"),
    }


def _span(low: float, high: float, unit: str) -> str:
    texts = f"{low:.4g}", f"{high:.4g}"
    return f"{texts[0]} {unit}" if texts[0] == texts[1] else f"{texts[0]} to {texts[1]} {unit}"
