"""Whether a law of another kind, without any effect, predicts the tests better than the declared one.

A law that cannot follow its tests asks for effects that no rig has. So laws of other kinds are fitted to the same
tests, and compared with the declared law by the rule by which effects are adopted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.predictions import errors_of, predicted
from edesign.calibration.results.result import OtherLaw
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SearchSettings
from edesign.damper.fitting.loading import prepare, scales_of
from edesign.damper.fitting.observed import Observed, observe
from edesign.damper.fitting.start import start_values
from edesign.damper.laws import LAWS
from edesign.damper.testing.campaign import Campaign
from edesign.errors import EdesignError
from edesign.estimation.least_squares import Fit, fit
from edesign.estimation.left_out import LEAST, difference, score
from edesign.estimation.model import Model, PredictionError
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter

RIVALS = (
    *("viscous", "viscous_power", "kelvin_voigt", "maxwell", "maxwell_power", "zener"),
    *("fractional_kelvin", "fractional_zener", "generalised_maxwell", "elastic_plastic", "bouc_wen", "chaboche"),
)
"""Laws of every kind that are fitted within seconds: dashpots, springs beside them, relaxation by one time, by two and
by a power of the frequency, and hysteresis without rate."""

SLOW_RIVALS = ("mgmm",)
"""Laws that are asked where none of the others does better."""

_BRANCHES = 2  # of a law with branches
_STARTS, _APART, _SEED = 4, 1.1, 1  # of a rival; standard deviation of the logarithm of a start about the first: 3
_FITS, _SETTLED = 4, 0.2  # under the noise that a fit leaves, until the logarithm of that falls no more
_FIRST, _ROUGH = 0.1, 6  # noise of first fits, of what was measured; their steps


@dataclass(frozen=True, eq=False)
class _Flat:
    """A model of which nothing but the bounds of its parameters is known: its law was not declared."""

    model: Model

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """With flat priors."""
        return tuple(replace(one, flat=True) for one in self.model.parameters)

    @property
    def measured(self) -> tuple[np.ndarray, ...]:
        """Of the model."""
        return self.model.measured

    def predict(self, values: np.ndarray) -> Sequence[Sequence[np.ndarray] | PredictionError]:
        """Return what the model predicts."""
        return self.model.predict(values)

    def nuisance_columns(self, values: np.ndarray) -> Sequence[np.ndarray | None]:
        """Return the model's columns."""
        return self.model.nuisance_columns(values)


@dataclass(frozen=True, eq=False)
class _Rival:
    """A law fitted to the tests, with the noise that it leaves."""

    problem: DamperProblem
    fit: Fit
    noise: Noise


def other_law(
    campaign: Campaign,
    base: FittedModel,
    best: FittedModel,
    validate: float,
    settings: SearchSettings,
) -> OtherLaw | None:
    """Return the law that predicts the tests best, if it does better than the declared one.

    It predicts tests left out better than the declared law fitted again, and the validation tests better than the model
    that stands. Where few tests are fitted, the first is seldom sure by the rule: a gain that is not small is told too.

    Args:
        base: the declared law fitted again, at the sampling of a fit.
        best: the model that stands, at that sampling.
        validate: NRMS of the validation tests by that.

    Returns:
        None: no law does, or the model that stands surely does better than any, or predicts validation tests better.
    """
    problem: DamperProblem = base.problem  # type: ignore[assignment]
    loadings = prepare(campaign.used_for("fit"))
    observed = observe(loadings, scales_of(loadings))
    of_best = unbounded(problem, settings).noise(best.noise, best)
    for names in (RIVALS, SLOW_RIVALS):
        rivals = [r for name in names if name != problem.law.name and (r := _rival(base, observed, name))]
        found = _better(base, best, rivals, of_best, validate)
        if found is not None:
            return found
    return None


def _rival(base: FittedModel, observed: Observed, name: str) -> _Rival | None:
    """Return a law fitted to the tests from several starts.

    None: it cannot be, or after rough fits it leaves more than the declared law, and is not worth the time of others.
    """
    law, problem = LAWS[name], base.problem
    assert isinstance(problem, DamperProblem)
    try:
        begun = start_values(law, observed, branches=_BRANCHES if law.branch else 1)
        # `alone` is of the declared law, whose parameters of the same name are other ones
        own = replace(problem, law=law, declared=law.complete(begun), refit=True, alone={})
        model = _Flat(own.model(()))
        spread = _APART / np.array([one.spread if one.logarithmic else np.inf for one in model.parameters])
        starts = spread * np.random.default_rng(_SEED).standard_normal((_STARTS, spread.size))
        starts[0] = 0.0
        sizes = zip(problem.sizes, problem.deviations, strict=True)
        noise = Noise.white([max(_FIRST * size, deviation) for size, deviation in sizes])
        rough = [one for start in starts if (one := _fitted(model, noise, start, _ROUGH)) is not None]
        if not rough:
            return None
        found = min(rough, key=lambda one: _power(one.left))
        if _power(found.left) > _power(base.left):
            return None
        for _ in range(_FITS):
            noise = Noise.left_by(found.left, problem.deviations, problem.sizes)
            again = fit(model, noise, found)
            fall = np.mean(np.log(noise.long_run)) - np.mean(
                np.log(Noise.left_by(again.left, problem.deviations, problem.sizes).long_run)
            )
            found = again
            if fall < _SETTLED:
                break
    except (EdesignError, PredictionError, np.linalg.LinAlgError):  # a law that cannot be fitted predicts nothing
        return None
    return _Rival(own, found, Noise.left_by(found.left, problem.deviations, problem.sizes))


def _power(left: Sequence[np.ndarray]) -> float:
    return sum(float(one @ one) for one in left)


def _fitted(model: Model, noise: Noise, start: np.ndarray, steps: int) -> Fit | None:
    try:
        return fit(model, noise, start, steps)
    except PredictionError:
        return None


def _better(
    base: FittedModel, best: FittedModel, rivals: Sequence[_Rival], of_best: Noise, validate: float
) -> OtherLaw | None:
    found: OtherLaw | None = None
    problem: DamperProblem = base.problem  # type: ignore[assignment]
    for rival in rivals:
        # by the noise of the one that leaves less, as effects are
        noise = min((rival.noise, of_best), key=lambda one: float(np.mean(np.log(one.long_run))))
        own = score(rival.fit, noise, refits=True)
        if not np.isfinite(own.total):
            continue
        ahead = difference(own, score(base.fit, noise, refits=True))
        behind = difference(score(best.fit, noise, refits=True), own)
        if ahead.total <= LEAST or behind.sure:
            continue
        if found is not None and (found.sure, found.gain) >= (ahead.sure, ahead.total):
            continue
        try:
            errors = errors_of(rival.problem, predicted(rival.problem, (), rival.fit.values))
            declared = errors_of(problem, predicted(problem, (), base.fit.values))
        except PredictionError:
            continue
        if errors.validate < validate:
            law = rival.problem.law
            both = ahead.total, ahead.error, errors.fit, declared.fit, errors.validate, declared.validate
            found = OtherLaw(law.name, law.title, *both, ahead.sure)
    return found
