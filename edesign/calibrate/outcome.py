"""What the loop's models say about the tests of any problem: predictions, errors, verdict, effects; and the calibration
that is made of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.calibrate.evidence import AT_FLOOR, MOST, Judged, most_of_one
from edesign.calibrate.fit import FARTHEST, correlation_length
from edesign.calibrate.problem import Candidate, Described, Problem, Use
from edesign.calibrate.result import (
    Calibration,
    Effect,
    Errors,
    Estimate,
    Hypothesis,
    NextTest,
    Series,
    Stage,
    Verdict,
    Worst,
)
from edesign.calibrate.search import selection
from edesign.calibrate.search.selection import Adopted, Selection
from edesign.calibrate.uncertainty import Uncertainty, wide
from edesign.calibration.residual.record import Residual

BOTH: tuple[Use, ...] = ("fit", "validate")


@dataclass(frozen=True, eq=False)
class Outcome:
    """What the loop's models say about the tests.

    Attributes:
        problem: at the rate at which errors are told.
        found: by the loop; the law fitted again, without effects, where that predicts the validation tests better.
        errors: by stage.
        predicted: values (n_i,) of every test, by stage.
        floors: NRMS of the noise by use.
        worst, verdict: see Calibration.
    """

    problem: Problem
    found: Selection
    errors: Mapping[Stage, Errors]
    predicted: Mapping[Stage, Sequence[np.ndarray]]
    floors: Mapping[Use, float]
    worst: Worst | None
    verdict: Verdict

    @staticmethod
    def of(problem: Problem, noise: Sequence[float], found: Selection) -> Outcome:
        """Of what the loop found, with the noise (tests,) of the problem."""
        predicted = {stage: predict(problem, judged) for stage, judged in stages(found).items()}
        floor = floor_of(found.final, noise, "validate")
        noisy = found.final.at_floor and not found.adopted
        if not noisy and predicts_worse(problem, predicted["corrected"], predicted["refit"], floor):
            found = _withheld(problem, found, predicted)
            predicted["corrected"] = predicted["refit"]
        errors = {stage: errors_of(problem, values) for stage, values in predicted.items()}
        floors = {use: floor_of(found.final, noise, use) for use in BOTH}
        worst = worst_of(found, noise, problem, predicted["corrected"])
        verdict = verdict_of(found, errors["corrected"], floors, worst)
        return Outcome(problem, found, errors, predicted, floors, worst, verdict)

    @property
    def more_is_left(self) -> bool:
        """Whether more than noise is left."""
        return self.verdict in ("partly_explained", "unexplained", "not_searched")

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
            effects=tuple(
                effect_of(self.problem, self.found.final, one, corrected, describe) for one in self.found.adopted
            ),
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
            coverage=self.found.coverage,
            hypotheses=tuple(self._hypothesis(one, describe) for one in self.found.hypotheses),
            worst=self.worst,
        )

    def _hypothesis(self, one: selection.Hypothesis, describe: Callable[[Candidate], Described]) -> Hypothesis:
        with_it = errors_of(self.problem, predict(self.problem, one.model))
        return Hypothesis(effect_of(self.problem, one.model, one.adopted, with_it, describe), one.why)


def predicts_worse(problem: Problem, one: Sequence[np.ndarray], other: Sequence[np.ndarray], floor: float) -> bool:
    """Whether one prediction of the validation tests is worse than another one.

    Where it leaves noise alone, noise makes a difference of their squared errors: it must be more than twice its
    standard error, that of a sum of as many independent samples as its correlation leaves in each test.

    Args:
        problem: with the tests.
        one, other: predicted values (n_i,) of every test.
        floor: NRMS of the noise in the validation tests.
    """
    left, rival = (errors_of(problem, values).validate for values in (one, other))
    if left <= rival or left > MOST[True] * floor:
        return left > rival
    total, variance = 0.0, 0.0
    for i, use in enumerate(problem.uses):
        if use == "validate":
            more = (problem.measured[i] - one[i]) ** 2 - (problem.measured[i] - other[i]) ** 2
            total += float(more.sum())
            variance += float(more.var()) * more.size * correlation_length(more)
    return total > 2.0 * math.sqrt(variance)


def _withheld(problem: Problem, found: Selection, predicted: Mapping[Stage, Sequence[np.ndarray]]) -> Selection:
    """The law fitted again in the place of the corrected one, the effects as hypotheses."""
    corrected, refit = (errors_of(problem, predicted[stage]).validate for stage in ("corrected", "refit"))
    why = (
        f"with the effects the validation tests are predicted worse ({100.0 * corrected:.3g} %) than without them "
        f"({100.0 * refit:.3g} %)"
    )
    effects = tuple(selection.Hypothesis(one, found.final, why) for one in found.adopted)
    return replace(found, final=found.refit, adopted=(), hypotheses=(*effects, *found.hypotheses))


def stages(found: Selection) -> dict[Stage, Judged]:
    """The three models by stage."""
    return {"declared": found.declared, "refit": found.refit, "corrected": found.final}


def residual_of(series: Series, stage: Stage) -> Residual:
    """The residual of a test at a stage, as its analysis takes it: the samples that are judged."""
    return series.residual(stage)


def predict(problem: Problem, judged: Judged) -> list[np.ndarray]:
    """Predicted values (n_i,) of every test, with what is each test's own taken from its residual."""
    parts = judged.fitted.parts
    found = []
    for i, values in enumerate(problem.predict(judged.fitted.base, parts, BOTH)):
        assert values is not None
        columns = problem.nuisance(judged.fitted.base, parts, i)
        if columns is not None:
            weight = problem.weight(i)
            own = np.ones(values.size) if weight is None else weight
            share = columns @ (columns.T @ (own * (problem.measured[i] - values)))
            values = values + np.divide(share, own, out=np.zeros(values.size), where=own > 0.0)
        found.append(values)
    return found


def errors_of(problem: Problem, predicted: Sequence[np.ndarray]) -> Errors:
    """NRMS over the tests of each use, and of each test: over the samples that are judged."""
    judged = [_judged(problem, i) for i in range(len(problem.measured))]
    measured = [values[own] for values, own in zip(problem.measured, judged, strict=True)]
    squared = [float(np.sum((m - p[own]) ** 2)) for m, p, own in zip(measured, predicted, judged, strict=True)]
    power = [float(m @ m) for m in measured]

    def over(use: Use) -> float:
        chosen = [i for i, u in enumerate(problem.uses) if u == use]
        return sum(squared[i] for i in chosen) / sum(power[i] for i in chosen)

    tests = {name: s / p for name, s, p in zip(problem.names, squared, power, strict=True)}
    return Errors(over("fit"), over("validate"), tests)


def floor_of(final: Judged, noise: Sequence[float], use: Use) -> float:
    """NRMS of noise (tests,) in the tests used so, and of what an error of a condition, as a temperature, changes."""
    problem = final.fitted.model.problem  # its conditions are as far in doubt as the tests show
    chosen = [i for i, u in enumerate(problem.uses) if u == use]
    judged = {i: _judged(problem, i) for i in chosen}
    power = sum(float(np.sum(problem.measured[i][judged[i]] ** 2)) for i in chosen)
    doubts = [doubt[judged[i]] for i in chosen if (doubt := problem.doubt(final.fitted.parts, i)) is not None]
    random = sum(noise[i] ** 2 * problem.measured[i][judged[i]].size for i in chosen)
    return (random + sum(float(doubt @ doubt) for doubt in doubts)) / power


def _judged(problem: Problem, index: int) -> np.ndarray:
    """Which samples (n,) of a test are judged."""
    found = np.zeros(problem.measured[index].size, dtype=bool)
    for piece in problem.judged(index):
        found[piece.samples] = True
    return found


def worst_of(
    found: Selection, noise: Sequence[float], problem: Problem, predicted: Sequence[np.ndarray]
) -> Worst | None:
    """The test, or channel, that leaves most of those that leave more than noise (tests,) does, by what chance makes of
    as many samples and what an error of a condition, as a temperature, may be; None: all are at the noise floor.
    """
    pieces = [(i, piece) for i in range(len(noise)) for piece in problem.judged(i)]
    worst, times = None, 0.0
    for i, piece in pieces:
        measured = problem.measured[i][piece.samples]
        error = float(np.sum((measured - predicted[i][piece.samples]) ** 2))
        random = (noise[i] * piece.louder) ** 2 * measured.size
        doubt = found.final.fitted.model.problem.doubt(found.final.fitted.parts, i)
        doubted = 0.0 if doubt is None else float(np.sum(doubt[piece.samples] ** 2))
        most = most_of_one(measured.size, len(pieces), bool(found.adopted))
        allowed = most * random + FARTHEST**2 * doubted
        power = max(float(measured @ measured), 1e-300)
        if error > allowed and error / (random + doubted) > times:
            times = error / (random + doubted)
            worst = Worst(piece.name, error / power, (random + doubted) / power)
    return worst


def verdict_of(found: Selection, corrected: Errors, floors: Mapping[Use, float], worst: Worst | None) -> Verdict:
    """See Calibration.verdict; never better than the worst test allows."""
    most = MOST[bool(found.adopted)]
    quiet = found.final.left <= AT_FLOOR or found.final.fitted.reduced <= most
    at_floor = worst is None and quiet and corrected.validate <= most * floors["validate"]
    if found.adopted:
        return "explained" if at_floor else "partly_explained"
    if at_floor:
        return "none"
    return "unexplained" if found.ending == "complete" else "not_searched"


def share_left(refit: Errors, corrected: Errors, floors: Mapping[Use, float]) -> float:
    """Of the error of the refitted model over noise, in the validation tests."""
    over = max(refit.validate - floors["validate"], 1e-300)
    return min(max((corrected.validate - floors["validate"]) / over, 0.0), 1.0)


def effect_of(
    problem: Problem,
    model: Judged,
    adopted: Adopted,
    with_it: Errors,
    describe: Callable[[Candidate], Described],
) -> Effect:
    """An effect of a model, with the error that it removes from the validation tests.

    Args:
        problem: with the tests.
        model: the one with the effect.
        adopted: the effect.
        with_it: errors of that model.
        describe: what people are told of a form.
    """
    candidate = adopted.candidate
    told = describe(candidate)
    found = estimates(model)
    values = {
        unknown.name: replace(found[candidate.label, unknown.name], value=float(value))
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
        delta_validate=without.validate - with_it.validate,
        evidence=f"{told.signature}; {adopted.evidence.text}",
        share=adopted.evidence.share,
        indistinguishable_from=tuple(adopted.alike),
    )


def estimates(judged: Judged) -> dict[tuple[str, str], Estimate]:
    """Every unknown by the label of its effect ("" for the base model) and its name, SI."""
    fitted = judged.fitted
    owners = [""] * len(fitted.model.base)
    owners += [effect.label for effect in fitted.model.effects for _ in effect.unknowns]
    sure = Uncertainty.of(fitted)
    found = {}
    for row, owner, unknown, bound in zip(
        np.eye(fitted.x.size), owners, fitted.model.unknowns, sure.bounds, strict=True
    ):
        x = float(row @ fitted.x)
        slope = abs(unknown.slope(x))
        if bound:
            error, half, untold = math.inf, math.inf, f"at its {bound} bound"
        else:
            error, half = slope * sure.standard_error(row), slope * sure.half_width(row)
            untold = "known to no decade" if wide(sure.half_width(row), unknown.logarithmic) else ""
        found[owner, unknown.name] = Estimate(unknown.value(x), error, unknown.unit, half, untold)
    return found


def parameters_of(judged: Judged) -> dict[str, Estimate]:
    """Parameters of the base model, by name."""
    found = estimates(judged)
    return {
        u.name: found.get(("", u.name), Estimate(float(value), 0.0, u.unit))
        for u, value in zip(judged.fitted.model.problem.base, judged.fitted.base, strict=True)
    }
