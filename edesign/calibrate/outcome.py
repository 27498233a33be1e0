"""What the loop's models say about the tests of any problem: predictions, errors, verdict, effects."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.calibrate.evidence import AT_FLOOR, Judged
from edesign.calibrate.problem import Candidate, Problem, Use
from edesign.calibrate.result import Effect, Errors, Estimate, Verdict
from edesign.calibrate.selection import Adopted, Selection

BOTH: tuple[Use, ...] = ("fit", "validate")
_EXPLAINED = 1.5  # times the noise floor: error of the validation tests up to which nothing is left to explain


@dataclass(frozen=True)
class Described:
    """What people and files are told of a form of an effect.

    Attributes:
        title: for people.
        signature: what it leaves in a residual, for people.
        amendment: form by which a law file carries it; "" if it cannot.
        fixed: numbers that are not searched, by name, SI.
    """

    title: str
    signature: str
    amendment: str = ""
    fixed: Mapping[str, float] = field(default_factory=dict)


def predict(problem: Problem, judged: Judged) -> list[np.ndarray]:
    """Predicted values (n_i,) of every test, with what is each test's own taken from its residual."""
    parts = judged.fitted.parts
    found = []
    for i, values in enumerate(problem.predict(judged.fitted.base, parts, BOTH)):
        assert values is not None
        columns = problem.nuisance(parts, i) if parts else None
        if columns is not None:
            values = values + columns @ np.linalg.lstsq(columns, problem.measured[i] - values, rcond=None)[0]
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


def floor_of(problem: Problem, noise: Sequence[float], use: Use) -> float:
    """NRMS of noise (tests,) in the tests used so."""
    chosen = [i for i, u in enumerate(problem.uses) if u == use]
    power = sum(float(problem.measured[i] @ problem.measured[i]) for i in chosen)
    return sum(noise[i] ** 2 * problem.measured[i].size for i in chosen) / power


def verdict_of(found: Selection, corrected: Errors, floors: Mapping[Use, float]) -> Verdict:
    """See Calibration.verdict."""
    quiet = found.final.left <= AT_FLOOR or found.final.fitted.reduced <= _EXPLAINED
    at_floor = quiet and corrected.validate <= _EXPLAINED * floors["validate"]
    if not found.adopted:
        return "none" if at_floor else "unexplained"
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
