"""The law that a table of moduli corrected, as a law file carries it; readings and rig are no part of it."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

import numpy as np

from edesign.calibration.dampers.mechanisms import CoreEffect, LawParameters
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.form import FormInCampaign
from edesign.calibration.properties.problem import PropertyProblem
from edesign.calibration.properties.repeatability import QUANTITIES
from edesign.calibration.results.law_file import law_file
from edesign.calibration.results.result import LawFile
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.problem import Effect
from edesign.damper.effects import LawEffect
from edesign.damper.testing.measured_histories import USES
from edesign.estimation.model import PredictionError


def table_law(problem: PropertyProblem, final: FittedModel, plain: FittedModel, withheld: str = "") -> LawFile:
    """Return the corrected law as a law file carries it; the law alone, where that predicts rows held out better.

    Args:
        problem: with the cycles of measured tests.
        plain: the law alone, as declared or fitted again.
        withheld: why the corrected model is the law alone already, for people; "" if it is not.
    """
    inner = problem.inner
    arranged, validate = partial(_arranged, inner), partial(_validate, problem)
    return law_file(inner, final, plain, withheld, validate, arranged, "rows held out")


def _arranged(
    inner: DamperProblem, effect: Effect, fitted: Mapping[str, float]
) -> tuple[dict[str, float], list[LawEffect]]:
    """Return the parameters of another arrangement, and what stands beside the Maxwell branch in it."""
    of: FormInCampaign = effect.data
    values, beside = dict(fitted), []
    for mechanism in of.form.mechanisms:
        if isinstance(mechanism, LawParameters):
            values = mechanism.change(fitted, inner.experiments[0], inner.law, values)
        elif isinstance(mechanism, CoreEffect) and mechanism.more is not None:
            name, _, form = mechanism.equation.partition(".")
            beside.append(LawEffect(name, form, dict(mechanism.more(fitted))))
    return values, beside


def _validate(problem: PropertyProblem, effects: list[Effect], values: np.ndarray) -> float:
    """Return the mean square of the relative errors of rows held out; infinite: there is no prediction."""
    try:
        rows = problem.model(effects, USES).properties(values)
    except PredictionError:
        return float("inf")
    held = np.concatenate([problem.groups[i].rows for i in problem.used_for("validate")])
    pairs = [(getattr(rows, name)[held], getattr(problem.table, name)[held]) for name in QUANTITIES]
    return float(np.mean([(f / y - 1.0) ** 2 for f, y in pairs]))
