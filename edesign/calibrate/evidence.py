"""Whether one model is better than another by more than chance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.special import chdtri

from edesign.calibrate.cross_validation import HeldOut, leave_one_out
from edesign.calibrate.fit import Fitted, correlation_length

AT_FLOOR = 1.2
"""Power left where the tests move, over that of the noise there, up to which a residual is at the noise floor."""

MOST = {True: 1.5, False: 2.0}
"""Times the noise floor: error of the validation tests, and of each test, up to which effects explain all (True), and
up to which none is asked for.
"""

_CHANCE = 0.01  # with which noise alone makes one of all tests seem to be above its floor
_ALL_NOISE = 1.05
"""The same, up to which no other form of an effect could do better: the estimate of the noise may be off by as much."""

SHARE = 0.25
"""Least share of the excess over noise that an effect must remove: less is a symptom of something else."""

CLEAR = 0.5
"""Share of the excess with which one effect needs no search for pairs, and two beside the declared law are taken."""

_UNCHANGED = 0.05  # share of what an effect once removed below which it is needless
_MOST_OF_IT = 0.5  # share of the excess
_LEAST_BIC = 10.0  # Kass and Raftery (1995): "very strong"
_LEAST_EXCESS = 0.02  # of the noise: less is not told from nothing
_TWINS = 0.01  # difference of the mean logarithm of the error below which two effects are one equation
_KINDS = ("instrument", "rig", "structure", "damper")
_LEAST_T = 1.0  # of the tests' improvements: one test that improves against all others passes only if it is much
_ONE_ALONE = 0.7  # the same, for what may show in one test alone, the largest, and the others take a little for it
_NEARLY_ALL = 0.9  # share of the excess that chance does not remove, even if one test alone shows it


def most_of_one(samples: int, tests: int, adopted: bool) -> float:
    """Times its noise, up to which one of so many tests, with so many samples, is at its floor: `MOST` times what the
    noise of the loudest of them is by chance, which matters where a test has a few numbers.
    """
    return MOST[adopted] * float(chdtri(samples, _CHANCE / tests)) / samples


@dataclass(frozen=True, eq=False)
class Judged:
    """A fitted model with its errors on tests left out."""

    fitted: Fitted

    @cached_property
    def held_out(self) -> HeldOut:
        """Each test left out in turn."""
        return leave_one_out(self.fitted)

    @property
    def labels(self) -> frozenset[str]:
        """Of the forms of its effects."""
        return frozenset(effect.label for effect in self.fitted.model.effects)

    @property
    def names(self) -> tuple[str, ...]:
        """Of its effects, sorted; one that has two forms has two."""
        return tuple(sorted(effect.name for effect in self.fitted.model.effects))

    @property
    def last_is_new(self) -> bool:
        """Whether the last effect is another one, not a further form of one that was there."""
        *before, last = self.fitted.model.effects
        return all(effect.name != last.name for effect in before)

    @property
    def at_floor(self) -> bool:
        """Whether nothing but noise is left."""
        return self.left <= AT_FLOOR

    @property
    def all_noise(self) -> bool:
        """Whether so little is left that no other form of an effect could do better."""
        return self.left <= _ALL_NOISE

    @cached_property
    def left(self) -> float:
        """Power of the residual over that of the noise, where the tests move; about 1 at the noise floor. No test, and
        no channel of one, may be above its own floor for all to be there.
        """
        model = self.fitted.model
        noise = [s for s, use in zip(model.noise, model.problem.uses, strict=True) if use == "fit"]
        return max(model.problem.left(self.fitted.residuals, noise), AT_FLOOR * self._worst)

    @property
    def _worst(self) -> float:
        """Of the tests and channels fitted to, the largest power over the most that noise has there."""
        problem, adopted = self.fitted.model.problem, bool(self.fitted.model.effects)
        fitted = [i for i, use in enumerate(problem.uses) if use == "fit"]
        judged = [problem.judged(i) for i in fitted]
        number = sum(map(len, judged))
        found = [0.0]
        for residual, pieces in zip(self.fitted.residuals, judged, strict=True):
            own = [residual[piece.samples] for piece in pieces]
            counted = residual.size / sum(r.size for r in own)  # those that are judged stand for the others
            for r, piece in zip(own, pieces, strict=True):
                most = most_of_one(r.size, number, adopted) * counted * r.size * piece.louder**2
                found.append(float(r @ r) / most)
        return max(found)


@dataclass(frozen=True)
class Evidence:
    """How a model compares with a rival on the same tests.

    Attributes:
        share: of the rival's excess over noise that the model removes: the smaller one of that on the tests fitted to
            and that on tests left out.
        t: sum of the tests' improvements (logarithms of their errors) over the root of their squares: sqrt(tests) if
            all improve alike, 1 if one alone does.
        bic: information criterion of the rival minus that of the model; above 10 is very strong.
        beside_motion: whether the model has more than the rival something that is slower or faster than all motion; a
            misfit of the law is not, however few of the samples it leaves independent.
        better, tests: how many tests improve when they are left out, of how many.
    """

    share: float
    t: float
    bic: float
    better: int
    tests: int
    beside_motion: bool = False

    @property
    def beyond_chance(self) -> bool:
        """Whether cross-validation and information criterion agree that the model is better; or most of the excess goes
        by what no motion does. What shows in the fastest test alone, say, and removes nearly all that it has when it is
        left out, may cost the others a little.
        """
        known = self.bic > _LEAST_BIC or (self.beside_motion and self.share >= _MOST_OF_IT)
        agree = self.t >= (_ONE_ALONE if self.share >= _NEARLY_ALL else _LEAST_T)
        return self.share > 0.0 and agree and known

    @property
    def adopts(self) -> bool:
        """Whether the model is better by more than chance, and by a good share."""
        return self.beyond_chance and self.share >= SHARE

    @property
    def clear(self) -> bool:
        """Whether the model is better by more than chance, and removes most."""
        return self.adopts and self.share >= CLEAR

    @property
    def needed(self) -> bool:
        """Whether what the model has more than its rival still does something."""
        return self.beyond_chance and self.share >= _UNCHANGED

    @property
    def clearly_better(self) -> bool:
        """Whether a simpler rival cannot stand for the model: better beyond chance, or by a good share."""
        return self.beyond_chance or (self.share >= SHARE and self.t >= _ONE_ALONE)

    @property
    def better_form(self) -> bool:
        """Whether another form of the same effects is better: that these are there is not in question, and a test that
        alone tells a parameter, as the only one at its temperature, need not agree.
        """
        return self.share >= SHARE and self.bic > _LEAST_BIC

    @property
    def text(self) -> str:
        """For people."""
        removed = f"removes {100.0 * self.share:.1f} %" if self.share > 0.0 else "removes nothing"
        return (
            f"{removed} of the excess over noise in tests left out; {self.better} of {self.tests} tests improve "
            f"(t = {self.t:.1f}); BIC falls by {self.bic:z.0f}"
        )


def simplest(models: Sequence[Judged]) -> Judged:
    """Of models, the one with the fewest parameters that the best on tests left out does not clearly beat."""
    best = min(models, key=_score)
    fair = [judged for judged in models if judged is best or not _beaten(judged, best)]
    least = min(judged.fitted.freedom for judged in fair)
    equal = [judged for judged in fair if judged.fitted.freedom == least]
    first = min(_score(judged) for judged in equal)
    twins = [judged for judged in equal if _score(judged) - first < _TWINS]
    return min(twins, key=lambda judged: (_rank(judged), _score(judged)))


def _beaten(judged: Judged, best: Judged) -> bool:
    evidence = compare(best, judged)
    return evidence.clearly_better or (set(judged.names) == set(best.names) and evidence.better_form)


def _beside_motion(judged: Judged) -> int:
    return sum(effect.beside_motion for effect in judged.fitted.model.effects)


def _score(judged: Judged) -> float:
    return judged.held_out.score / float(judged.held_out.samples.sum())


def _rank(judged: Judged) -> int:
    """Of twins a fault of the measurement is the simpler thing to think of."""
    return sum(_KINDS.index(effect.kind) for effect in judged.fitted.model.effects)


def compare(model: Judged, rival: Judged) -> Evidence:
    """Evidence for a model against a rival.

    Source of the criterion: Schwarz (1978), Ann. Statist. 6, 461-464, with as many samples as the correlation of the
    model's residual leaves independent.
    """
    before, after = rival.held_out, model.held_out
    gains = before.samples * np.log(before.ratio / after.ratio)
    size = math.sqrt(float(gains @ gains))
    fitted = (rival.fitted.chi2 - model.fitted.chi2) / max(rival.fitted.chi2 - rival.fitted.samples, 1e-12)
    return Evidence(
        share=min(_share(before, after), fitted),
        t=float(gains.sum()) / size if size > 0.0 else 0.0,
        bic=_bic(rival.fitted, model.fitted) - _bic(model.fitted, model.fitted),
        better=int(np.sum(gains > 0.0)),
        tests=gains.size,
        beside_motion=_beside_motion(model) > _beside_motion(rival),
    )


def _share(before: HeldOut, after: HeldOut) -> float:
    """Share of the excess that goes, by the mean of the tests' logarithms, those with more excess before counting for
    more.
    """
    rival, model = (np.maximum(side.ratio - 1.0, _LEAST_EXCESS) for side in (before, after))
    weight = np.sqrt(rival * before.samples)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = float(weight @ np.log(model / rival)) / float(weight.sum())
    return 1.0 - math.exp(min(mean, 50.0)) if math.isfinite(mean) else -math.inf


def _bic(fitted: Fitted, correlated_as: Fitted) -> float:
    """n ln(chi2 / n) + p ln n with the independent samples n of a residual."""
    n = sum(r.size / correlation_length(r) for r in correlated_as.residuals)
    return n * math.log(max(fitted.chi2, 1e-300) / fitted.samples) + fitted.freedom * math.log(max(n, 2.0))
