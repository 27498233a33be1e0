"""The law that a table of moduli corrected, as a law file carries it; readings and rig are no part of it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.calibration.dampers.acts import Amendment as AmendmentAct
from edesign.calibration.dampers.acts import LawParameters
from edesign.calibration.dampers.effect import FormInCampaign
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.properties.from_campaign import EVERY
from edesign.calibration.properties.problem import PropertyProblem
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.residual.series import Stage
from edesign.calibration.results.law_file import carried, own_temperature
from edesign.calibration.results.result import LawFile
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.damper.amendments import Amendment
from edesign.damper.temperature import FerryShift, GammaT
from edesign.estimation.model import PredictionError


def table_law(problem: PropertyProblem, final: FittedModel, refit: FittedModel, withheld: str = "") -> LawFile:
    """Return the corrected law as a law file carries it; the refit, where that predicts rows held out better.

    Args:
        problem: with the cycles of measured tests.
        final: the corrected model.
        refit: the law fitted again, without effects.
        withheld: why the corrected model is the refit already, for people; "" if it is not.
    """
    found = _law(problem, final, "corrected" if final.effects else "refit", withheld)
    if not found.lacking:
        return found
    plain = _law(problem, refit, "refit", "")
    if found.validate <= plain.validate:
        return found
    why = (
        f"law files cannot carry {', '.join(found.lacking)}; without it rows held out are predicted worse "
        f"({100.0 * found.validate:.3g} %) than by the refitted law ({100.0 * plain.validate:.3g} %)"
    )
    return LawFile(**{**vars(plain), "told": found.told, "lacking": found.lacking, "withheld": why})


def _law(problem: PropertyProblem, model: FittedModel, stage: Stage, withheld: str) -> LawFile:
    inner, every = problem.inner, model.fit.values
    printed = {**inner.declared, **dict(zip((one.name for one in inner.base), map(float, every), strict=False))}
    values, amendments = dict(printed), list[Amendment]()
    temperature: GammaT | FerryShift | None = own_temperature(inner)
    told, lacking, left = list[str](), list[str](), list[Effect]()
    numbers = every[: len(inner.base)].tolist()
    for index, effect in enumerate(model.effects):
        own = np.array([every[i] for i in model.places(index)])
        if effect.kind != "damper":
            told.append(f"{effect.label} ({effect.kind}): {effect.data.title}")
        elif effect.name == "arrangement":
            values, beside = _arranged(inner, effect.data, printed, values)
            amendments += beside
        else:
            found = carried(inner, effect, own)
            if found is None:
                lacking.append(effect.label)
                continue
            amendments += found.amendments
            temperature = found.temperature or temperature
        left.append(effect)
        numbers += own.tolist()
    validate = _validate(problem, left, np.array(numbers))
    return LawFile(stage, values, tuple(amendments), temperature, tuple(told), tuple(lacking), validate, withheld)


def _arranged(
    inner: DamperProblem, of: FormInCampaign, printed: Mapping[str, float], values: dict[str, float]
) -> tuple[dict[str, float], list[Amendment]]:
    """Return the parameters of another arrangement, and what stands beside the Maxwell branch in it."""
    beside = []
    for act in of.form.acts:
        if isinstance(act, LawParameters):
            values = act.change(printed, inner.experiments[0], inner.law, values)
        elif isinstance(act, AmendmentAct) and act.more is not None:
            name, _, form = act.equation.partition(".")
            beside.append(Amendment(name, form, dict(act.more(printed))))
    return values, beside


def _validate(problem: PropertyProblem, effects: list[Effect], values: np.ndarray) -> float:
    """Return the mean square of the relative errors of rows held out; infinite: there is no prediction."""
    try:
        rows = problem.model(effects, EVERY).properties(values)
    except PredictionError:
        return float("inf")
    held = np.concatenate([problem.groups[i].rows for i in problem.used_for("validate")])
    pairs = [(getattr(rows, name)[held], getattr(problem.table, name)[held]) for name in QUANTITIES]
    return float(np.mean([(f / y - 1.0) ** 2 for f, y in pairs]))
