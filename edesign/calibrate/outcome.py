"""What the loop's models say about the tests of any problem: predictions, errors, verdict, effects; and the calibration
that is made of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibrate.evidence import AT_FLOOR, Judged
from edesign.calibrate.problem import Candidate, Described, Problem, Use
from edesign.calibrate.residual.record import Residual
from edesign.calibrate.result import Calibration, Effect, Errors, Estimate, NextTest, Series, Stage, Verdict
from edesign.calibrate.search.selection import Adopted, Selection

BOTH: tuple[Use, ...] = ("fit", "validate")
_EXPLAINED, _NONE = 1.5, 2.0
"""Times the noise floor: error of the validation tests up to which effects explain all, and up to which none is asked
for.
"""


@dataclass(frozen=True, eq=False)
class Outcome:
    """What the loop's models say about the tests.

    Attributes:
        problem: at the rate at which errors are told.
        found: by the loop.
        errors: by stage.
        predicted: values (n_i,) of every test, by stage.
        floors: NRMS of the noise by use.
        verdict: see Calibration.
    """

    problem: Problem
    found: Selection
    errors: Mapping[Stage, Errors]
    predicted: Mapping[Stage, Sequence[np.ndarray]]
    floors: Mapping[Use, float]
    verdict: Verdict

    @staticmethod
    def of(problem: Problem, noise: Sequence[float], found: Selection) -> Outcome:
        """Of what the loop found, with the noise (tests,) of the problem."""
        predicted = {stage: predict(problem, judged) for stage, judged in stages(found).items()}
        errors = {stage: errors_of(problem, values) for stage, values in predicted.items()}
        floors = {use: floor_of(found.final, noise, use) for use in BOTH}
        return Outcome(problem, found, errors, predicted, floors, verdict_of(found, errors["corrected"], floors))

    @property
    def more_is_left(self) -> bool:
        """Whether more than noise is left."""
        return self.verdict in ("partly_explained", "unexplained")

    def calibration(
        self,
        title: str,
        law: str,
        describe: Callable[[Candidate], Described],
        shape: str,
        next_test: NextTest | None,
        series: tuple[Series, ...],
        seconds: float,
    ) -> Calibration:
        """All of it for people and files; `shape` is of what is left."""
        left = share_left(self.errors["refit"], self.errors["corrected"], self.floors)
        corrected = self.errors["corrected"]
        return Calibration(
            title=title,
            law=law,
            errors=self.errors,
            noise_floor=self.floors["validate"],
            noise_floor_fit=self.floors["fit"],
            effects=tuple(effect_of(self.problem, self.found, one, corrected, describe) for one in self.found.adopted),
            verdict=self.verdict,
            unexplained_share=left if self.more_is_left else 0.0,
            unexplained_shape=shape,
            next_test=next_test,
            refused=tuple((candidate.label, evidence.text) for candidate, evidence in self.found.refused),
            parameters={stage: parameters_of(judged) for stage, judged in stages(self.found).items()},
            law_held=self.found.law_held,
            series=series,
            seconds=seconds,
            ending=self.found.ending,
        )


def stages(found: Selection) -> dict[Stage, Judged]:
    """The three models by stage."""
    return {"declared": found.declared, "refit": found.refit, "corrected": found.final}


def residual_of(series: Series, stage: Stage) -> Residual:
    """The residual of a test at a stage, as its analysis takes it."""
    return Residual(
        series.name,
        series.order,
        series.use,
        series.time,
        series.displacement,
        series.velocity,
        series.measured,
        series.predicted[stage],
        series.temperature,
    )


def predict(problem: Problem, judged: Judged) -> list[np.ndarray]:
    """Predicted values (n_i,) of every test, with what is each test's own taken from its residual."""
    parts = judged.fitted.parts
    found = []
    for i, values in enumerate(problem.predict(judged.fitted.base, parts, BOTH)):
        assert values is not None
        columns = problem.nuisance(judged.fitted.base, parts, i) if parts else None
        if columns is not None:
            weight = problem.weight(i)
            own = 1.0 if weight is None else weight
            values = values + columns @ (columns.T @ (own * (problem.measured[i] - values))) / own
        found.append(values)
    return found


def errors_of(problem: Problem, predicted: Sequence[np.ndarray]) -> Errors:
    """NRMS over the tests of each use, and of each test."""
    squared = [float(np.sum((m - p) ** 2)) for m, p in zip(problem.measured, predicted, strict=True)]
    power = [float(m @ m) for m in problem.measured]

    def over(use: Use) -> float:
        chosen = [i for i, u in enumerate(problem.uses) if u == use]
        return sum(squared[i] for i in chosen) / sum(power[i] for i in chosen)

    tests = {name: s / p for name, s, p in zip(problem.names, squared, power, strict=True)}
    return Errors(over("fit"), over("validate"), tests)


def floor_of(final: Judged, noise: Sequence[float], use: Use) -> float:
    """NRMS of noise (tests,) in the tests used so, and of what an error of a condition, as a temperature, changes."""
    problem = final.fitted.model.problem  # its conditions are as far in doubt as the tests show
    chosen = [i for i, u in enumerate(problem.uses) if u == use]
    power = sum(float(problem.measured[i] @ problem.measured[i]) for i in chosen)
    doubts = [doubt for i in chosen if (doubt := problem.doubt(final.fitted.parts, i)) is not None]
    random = sum(noise[i] ** 2 * problem.measured[i].size for i in chosen)
    return (random + sum(float(doubt @ doubt) for doubt in doubts)) / power


def verdict_of(found: Selection, corrected: Errors, floors: Mapping[Use, float]) -> Verdict:
    """See Calibration.verdict."""
    most = _EXPLAINED if found.adopted else _NONE
    quiet = found.final.left <= AT_FLOOR or found.final.fitted.reduced <= most
    at_floor = quiet and corrected.validate <= most * floors["validate"]
    if not found.adopted:
        return "none" if at_floor or corrected.validate <= floors["validate"] else "unexplained"
    return "explained" if at_floor else "partly_explained"


def share_left(refit: Errors, corrected: Errors, floors: Mapping[Use, float]) -> float:
    """Of the error of the refitted model over noise, in the validation tests."""
    over = max(refit.validate - floors["validate"], 1e-300)
    return min(max((corrected.validate - floors["validate"]) / over, 0.0), 1.0)


def effect_of(
    problem: Problem,
    found: Selection,
    adopted: Adopted,
    corrected: Errors,
    describe: Callable[[Candidate], Described],
) -> Effect:
    """An effect of the final model, with the error that it removes from the validation tests."""
    candidate = adopted.candidate
    told = describe(candidate)
    errors = standard_errors(found.final)
    values = {
        unknown.name: Estimate(float(value), errors[(candidate.label, unknown.name)], unknown.unit)
        for unknown, value in zip(candidate.unknowns, adopted.values, strict=True)
    }
    without = errors_of(problem, predict(problem, adopted.without))
    return Effect(
        name=candidate.name,
        form=candidate.form,
        kind=candidate.kind,
        title=told.title,
        amendment=told.amendment,
        parameters=values,
        fixed=told.fixed,
        delta_validate=without.validate - corrected.validate,
        evidence=f"{told.signature}; {adopted.evidence.text}",
        share=adopted.evidence.share,
        indistinguishable_from=tuple(adopted.alike),
    )


def standard_errors(judged: Judged) -> dict[tuple[str, str], float]:
    """Of every unknown by the label of its effect ("" for the base model) and its name, SI."""
    fitted = judged.fitted
    owners = [""] * len(fitted.model.base)
    owners += [effect.label for effect in fitted.model.effects for _ in effect.unknowns]
    variances = np.diag(fitted.covariance) if fitted.x.size else np.empty(0)
    return {
        (owner, u.name): abs(u.slope(float(c))) * float(np.sqrt(max(v, 0.0)))
        for owner, u, c, v in zip(owners, fitted.model.unknowns, fitted.x, variances, strict=True)
    }


def parameters_of(judged: Judged) -> dict[str, Estimate]:
    """Parameters of the base model, by name."""
    errors = standard_errors(judged)
    return {
        u.name: Estimate(float(value), errors.get(("", u.name), 0.0), u.unit)
        for u, value in zip(judged.fitted.model.problem.base, judged.fitted.base, strict=True)
    }
