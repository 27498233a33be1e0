"""What a law file can carry of a correction: its effects in forms that law files know, fitted again."""

from __future__ import annotations

from dataclasses import replace

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.evidence import Judged
from edesign.calibrate.fit import Fitted, fit
from edesign.calibrate.outcome import errors_of, parameters_of, predict, predicts_worse
from edesign.calibrate.problem import Candidate, Described, Part, PredictionError
from edesign.calibrate.result import CarriedLaw
from edesign.calibrate.search.contest import fit_best
from edesign.calibrate.search.screening import screen
from edesign.damper.amendment_kinds import kind_if_known
from edesign.damper.amendments import Amendment

_FITTED = 3  # forms of an effect


def described(candidate: Candidate) -> Described:
    """What people and files are told of a form of an effect in damper tests."""
    form, fixed = candidate.effect
    return replace(form.described, fixed=fixed)


def carried_law(final: Fitted, refit: Fitted, fast: DamperProblem, full: DamperProblem, floor: float) -> CarriedLaw:
    """The corrected law with its effects in forms that a law file carries; the law fitted again, where that predicts
    the validation tests better than such forms do.

    Args:
        final: the corrected model.
        refit: the law fitted again, without effects.
        fast: the problem at the rate of a fit.
        full: at the rate at which errors are told.
        floor: NRMS of the noise in the validation tests.
    """
    damper = [candidate for candidate, _ in final.parts if candidate.kind == "damper"]
    lost = [candidate for candidate in damper if not _carries(candidate)]
    try:
        if not lost:
            return _carried(final, lost, full)
        known = _in_known_forms(final, lost, fast.certain)
        if not predicts_worse(full, predict(full, Judged(known)), predict(full, Judged(refit)), floor):
            return _carried(known, lost, full)
        return replace(_carried(refit, damper, full), withheld=True)
    except PredictionError:  # without what is lost the rest has no prediction; the law as declared has one
        bare = replace(final.model, problem=fast, effects=(), held=True, misfit=1.0)
        return _carried(fit(bare, bare.coordinates()), damper, full)


def _carried(fitted: Fitted, lost: list[Candidate], full: DamperProblem) -> CarriedLaw:
    effects = tuple(_amendment(part) for part in fitted.parts if part[0].kind == "damper")
    error = errors_of(full, predict(full, Judged(fitted)))
    parameters = {name: estimate.value for name, estimate in parameters_of(Judged(fitted)).items()}
    return CarriedLaw(parameters, effects, tuple(candidate.label for candidate in lost), error.validate)


def _in_known_forms(final: Fitted, lost: list[Candidate], problem: DamperProblem) -> Fitted:
    kept = [part for part in final.parts if part[0] not in lost]
    model = replace(final.model, problem=problem, effects=tuple(effect for effect, _ in kept), misfit=1.0)
    found = fit(model, model.coordinates(final.base, kept))
    noise = [s for s, use in zip(model.noise, problem.uses, strict=True) if use == "fit"]
    for name in dict.fromkeys(candidate.name for candidate in lost):
        if any(effect.name == name for effect in found.model.effects):
            continue
        left = [s * r for s, r in zip(noise, found.residuals, strict=True)]
        pool = [c for c in problem.candidates(left) if c.name == name and _carries(c)]
        tried = [judged.fitted for judged in fit_best(screen(found, pool)[:_FITTED])]
        found = min([found, *tried], key=lambda fitted: fitted.chi2)
    return found


def _carries(candidate: Candidate) -> bool:
    return kind_if_known(candidate.name, described(candidate).amendment) is not None


def _amendment(part: Part) -> Amendment:
    candidate, values = part
    told = described(candidate)
    own = {unknown.name: float(v) for unknown, v in zip(candidate.unknowns, values, strict=True)}
    return Amendment(candidate.name, told.amendment, own | dict(told.fixed))
