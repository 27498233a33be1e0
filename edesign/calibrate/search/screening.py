"""Which effects are worth a fit: how much of the residual the signature of each could explain, beside what the model
can already do.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from edesign.calibrate.fit import Fitted, Model, fit
from edesign.calibrate.problem import Candidate, Part, PredictionError
from edesign.calibrate.side_by_side import side_by_side

_STARTS = 2  # of a form that are looked at with the slopes to all of its parameters
_FAR_LESS = 0.5  # of the size of a start
_FAR = 1.5  # a linear step is not believed farther, in logarithmic coordinates


@dataclass(frozen=True, eq=False)
class Signature:
    """What a candidate, linear about one of its starts, would do.

    Attributes:
        candidate: the form of an effect.
        model: the model with it.
        start: (p,) coordinates from which a fit of that model would go.
        frozen: (n_i, q) of each test: slopes to the parameters of the model without it.
        gain: reduction of chi2.
        about: (q,) coordinates of its unknowns at that start.
        columns: (N, q + 1) slopes to its unknowns, and the change at its start, free from what the model can do.
    """

    candidate: Candidate
    model: Model
    start: np.ndarray
    frozen: tuple[np.ndarray, ...]
    gain: float
    about: np.ndarray
    columns: np.ndarray

    @property
    def freedom(self) -> int:
        """How many numbers the candidate has, with those that are the first test's own."""
        own = self.model.problem.nuisance(self.model.base_values(self.start), self.model.parts(self.start)[-1:], 0)
        return len(self.candidate.unknowns) + (0 if own is None else own.shape[1])


class Screen:
    """The residual of a fitted model, and the part of it that the model's own parameters cannot explain."""

    def __init__(self, fitted: Fitted) -> None:
        self.fitted = fitted
        self.residual = np.concatenate(fitted.residuals)
        self.slopes = np.vstack(fitted.slopes) if fitted.x.size else np.empty((self.residual.size, 0))
        self.basis = np.linalg.qr(self.slopes)[0] if fitted.x.size else self.slopes
        self.inverse = np.linalg.pinv(fitted.hessian)
        self.whole = replace(fitted.model, problem=fitted.model.problem.coarse)
        self.quick = replace(self.whole, effects=tuple(e for e in fitted.model.effects if not e.slow))
        self.quick_x = self.quick.coordinates(fitted.base, [part for part in fitted.parts if not part[0].slow])

    @cached_property
    def whole_residual(self) -> np.ndarray:
        """Of the model, coarse."""
        if self.whole.problem is self.fitted.model.problem:
            return self.residual
        return np.concatenate(self.whole.residuals(self.fitted.x))

    @cached_property
    def quick_residual(self) -> np.ndarray:
        """Of its quick effects alone, coarse."""
        if len(self.quick.effects) == len(self.whole.effects):
            return self.whole_residual
        return np.concatenate(self.quick.residuals(self.quick_x, about=(self.fitted.base, self.fitted.parts)))

    def free(self, values: np.ndarray) -> np.ndarray:
        """Values (N,) or (N, k) without what the model's own parameters can make of them."""
        return values - self.basis @ (self.basis.T @ values)

    def signature(self, candidate: Candidate) -> Signature | None:
        """The best of a candidate's starts; None: none of them can be predicted."""
        fitted = self.fitted
        model = replace(fitted.model, effects=(*fitted.model.effects, candidate))
        best: Signature | None = None
        for x, here in self._likely(model, candidate):
            try:
                found = self._at(model, candidate, x, here)
            except PredictionError:
                continue
            if best is None or found.gain > best.gain:
                best = found
        return best

    def _likely(self, model: Model, candidate: Candidate) -> list[tuple[np.ndarray, np.ndarray]]:
        """Coordinates and residual (N,) of the starts that alone, at whatever size, would explain most; at a size that
        the residual has, where that is far smaller than the start's, as few effects are linear in their size.
        """
        found = []
        for start in candidate.starts:
            own = [u.coordinate(float(v)) for u, v in zip(candidate.unknowns, start, strict=True)]
            x = np.concatenate((self.fitted.x, own))
            try:
                here = self._residual(model, candidate, x)
            except PredictionError:
                continue
            change = self.free(here - self.residual)
            size = float(change @ change)
            share = -float(change @ self.residual) / size if size > 0.0 else 0.0
            found.append((share**2 * size, share, x, here))
        found.sort(key=lambda item: -item[0])
        return [self._sized(model, candidate, share, x, here) for _, share, x, here in found[:_STARTS]]

    def _sized(
        self, model: Model, candidate: Candidate, share: float, x: np.ndarray, here: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """A start with the share of its size that would explain most; itself where that is not far less."""
        first = self.fitted.x.size
        if not candidate.unknowns or candidate.unknowns[0].logarithmic or not 0.0 < abs(share) < _FAR_LESS:
            return x, here
        low, high = candidate.unknowns[0].span
        smaller = x.copy()
        smaller[first] = min(max(share * x[first], low), high)
        try:
            return smaller, self._residual(model, candidate, smaller)
        except PredictionError:
            return x, here

    def _residual(self, model: Model, candidate: Candidate, x: np.ndarray) -> np.ndarray:
        """Residual (N,) with a candidate, of which the change is a coarse one; what a quick one changes is taken beside
        the quick effects alone.
        """
        about = self.fitted.base, self.fitted.parts
        if candidate.slow:
            whole = replace(self.whole, effects=model.effects)
            return self.residual + np.concatenate(whole.residuals(x, about=about)) - self.whole_residual
        quick = replace(self.quick, effects=(*self.quick.effects, candidate))
        own = np.concatenate((self.quick_x, x[self.fitted.x.size :]))
        return self.residual + np.concatenate(quick.residuals(own, about=about)) - self.quick_residual

    def _at(self, model: Model, candidate: Candidate, x: np.ndarray, here: np.ndarray) -> Signature:
        first = self.fitted.x.size
        columns = np.empty((here.size, len(candidate.unknowns)))
        for j, unknown in enumerate(candidate.unknowns):
            step = unknown.step(float(x[first + j]))
            moved = x.copy()
            moved[first + j] += step
            columns[:, j] = (self._residual(model, candidate, moved) - here) / step
        return self._linear(model, candidate, x[first:], here - self.residual, columns)

    def beside(self, signature: Signature) -> Signature:
        """A signature beside the law as declared, that law held, beside this model, as if it did the same here."""
        candidate = signature.candidate
        model = replace(self.fitted.model, effects=(*self.fitted.model.effects, candidate))
        return self._linear(model, candidate, signature.about, signature.columns[:, -1], signature.columns[:, :-1])

    def _linear(
        self, model: Model, candidate: Candidate, about: np.ndarray, change: np.ndarray, columns: np.ndarray
    ) -> Signature:
        """Of a candidate whose values `about` change the residual by `change` (N,), linear with slopes (N, q)."""
        here = self.residual + change
        free_here, free_columns = self.free(here), self.free(columns)
        move = np.linalg.lstsq(free_columns, -free_here, rcond=1e-8)[0] if columns.shape[1] else np.empty(0)
        move = _within(candidate, about, move)
        left = free_here + free_columns @ move
        cost, at_start = float(left @ left), float(free_here @ free_here)
        if at_start < cost:
            move, cost = np.zeros_like(move), at_start
        base = -self.inverse @ (self.slopes.T @ (here + columns @ move) + self.fitted.model.pull(self.fitted.x))
        start = np.concatenate((self.fitted.x + np.clip(base, -_FAR, _FAR), about + move))
        return Signature(
            candidate,
            model,
            start,
            self.fitted.slopes,
            self.fitted.chi2 - cost,
            about,
            np.column_stack((free_columns, free_here - self.free(self.residual))),
        )


def _within(candidate: Candidate, x: np.ndarray, move: np.ndarray) -> np.ndarray:
    found = np.empty_like(move)
    for j, unknown in enumerate(candidate.unknowns):
        low, high = unknown.span
        far = _FAR if unknown.logarithmic else np.inf
        found[j] = min(max(x[j] + min(max(move[j], -far), far), low), high) - x[j]
    return found


Seen = Callable[[Sequence[Candidate]], None]


def screen(fitted: Fitted, candidates: Sequence[Candidate], seen: Seen = lambda candidates: None) -> list[Signature]:
    """Signatures of candidates, those that explain most first. Those of conditions in doubt are seen with nothing in
    doubt: what is left of a wrong condition, and may be as much as doubt allows, goes in no straight line with them.

    Args:
        fitted: the model so far.
        candidates: forms of effects it may lack.
        seen: told which of them have been screened, as they are.
    """
    model, certain = fitted.model, fitted.model.problem.certain
    doubted = [c for c in candidates if c.doubted]
    if certain is model.problem or not doubted:
        return ordered(_signatures(fitted, candidates, seen))
    found = _signatures(fitted, [c for c in candidates if not c.doubted], seen)
    known = _signatures(fit(replace(model, problem=certain), fitted.x, most_steps=0), doubted, seen)
    return ordered([*found, *(replace(one, model=replace(one.model, problem=model.problem)) for one in known)])


def _signatures(fitted: Fitted, candidates: Sequence[Candidate], seen: Seen) -> list[Signature]:
    """Signatures of candidates that can be predicted: first of faults of the measurement, last of slow ones."""
    whole = Screen(fitted)
    _ = whole.quick_residual  # before processes begin
    model = fitted.model
    known = (*model.given, *fitted.slopes, *candidates)
    found = []
    for cost in range(3):
        alike = [candidate for candidate in candidates if _cost(candidate) == cost]
        found += side_by_side(whole.signature, alike, model.workers, known)
        seen(alike)
    return [signature for signature in found if signature is not None]


def _cost(candidate: Candidate) -> int:
    return 2 if candidate.slow else 0 if candidate.kind == "instrument" else 1


def promised(fitted: Fitted, i: int, part: Part) -> float:
    """Reduction of chi2 that another form in the place of the effect i could bring, linear about given values.

    Args:
        fitted: the model.
        i: number of the effect.
        part: the other form with its values.

    Raises:
        PredictionError: it cannot be predicted there.
    """
    effects = list(fitted.model.effects)
    effects[i] = part[0]
    model = replace(fitted.model, effects=tuple(effects))
    x = model.coordinates(fitted.base, [*fitted.parts[:i], part, *fitted.parts[i + 1 :]])
    first = x.size - sum(len(effect.unknowns) for effect in effects[i:])
    here = np.concatenate(model.residuals(x))
    columns = np.empty((here.size, len(part[0].unknowns)))
    for j, unknown in enumerate(part[0].unknowns):
        moved = x.copy()
        moved[first + j] += unknown.step(float(x[first + j]))
        columns[:, j] = np.concatenate(model.residuals(moved)) - here
    whole = Screen(fitted)
    residual, free = whole.free(here), whole.free(columns)
    left = residual - free @ np.linalg.lstsq(free, residual, rcond=1e-8)[0]
    return fitted.chi2 - float(left @ left)


def screen_again(fitted: Fitted, signatures: Sequence[Signature]) -> list[Signature]:
    """Signatures beside the law as declared and held, beside that law with effects or with its parameters free, those
    that explain most first, as if they did the same here: nothing is predicted again.
    """
    whole = Screen(fitted)
    return ordered(whole.beside(signature) for signature in signatures)


def ordered(signatures: Iterable[Signature]) -> list[Signature]:
    """Those that explain most first."""
    return sorted(signatures, key=lambda signature: -signature.gain)
