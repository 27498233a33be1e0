"""Screening: what each effect and each pair of effects would gain beside a fitted model, to first order.

Each form of each effect is predicted once at each start of its grid. With c the change that it makes, freed of what the
parameters of the model can make of it, and r what the model leaves, both in units of the noise, its size b has the
prior N(0, 1) and

    b = c'r / (1 + c'c)        gain = L(r'r) - L(r'r - (c'r)^2 / (1 + c'c)) - 1/2 log(1 + c'c)

L is the log density with the scale of the noise integrated out. Pairs follow from the same products c_i'c_j.
Nuisance amplitudes of each test, as of hum, whose phase is any, are integrated out of c and r.

The noise is what all effects together leave. What one effect makes looks like slow noise as long as it is not there;
under such noise nothing slow would be separated from chance.

Sources: grouped orthogonal forward regression: Chen, Billings and Luo (1989), Int. J. Control 50, 1873-1896; with
priors it is the evidence of a linear model: MacKay (1992), Neural Computation 4, 415-447; noise by the full model:
Mallows (1973), Technometrics 15, 661-675.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass, replace
from typing import TypeVar

import numpy as np

from edesign.calibration.search.models import FittedModel, Fitter, Start
from edesign.estimation.left_out import PRIOR_FREEDOM
from edesign.estimation.noise import Noise

_TYPICAL = 0.1  # of what was measured: standard deviation of what an effect does that is not linear in its size
_SEEN = 1e-9  # of what was measured: what does less is not seen
_LOOKED = 400  # times the number of pairs wanted, that are looked at

Nuisance = Sequence[np.ndarray | None]
"""(n_i, k) of each test: columns whose nuisance amplitudes have the prior N(0, 1); None: there are none."""
Single = tuple[Start, float]
Pair = tuple[tuple[Start, Start], float]
T = TypeVar("T")


@dataclass(frozen=True)
class Screening:
    """Gains of effects and pairs beside a model, best first.

    Attributes:
        screened: forms that were predicted.
        noise: by which gains are measured.
        alone: log evidence of the model.
        singles: start and gain of each form at its best start.
        pairs: starts and gains of pairs of different effects, one for each pair of names.
    """

    screened: int
    noise: Noise
    alone: float
    singles: tuple[Single, ...]
    pairs: tuple[Pair, ...]

    def better_than(self, alone: float) -> Screening:
        """Return the effects and pairs with which the evidence is larger than another model's alone."""
        least = alone - self.alone
        singles = tuple(one for one in self.singles if one[1] > least)
        return replace(self, singles=singles, pairs=tuple(one for one in self.pairs if one[1] > least))


def screen(fitter: Fitter, model: FittedModel, noise: Noise | None = None) -> Screening:
    """Screen all forms of effects that a model does not have, whose own equations may be wrong.

    Args:
        noise: by which gains are measured; None: what all effects together leave.
    """
    tests, starts, nuisance, screened = _candidates(fitter, model)
    plain = model.fit.model.nuisance_columns(model.fit.values)
    every = [_stacked(of_test) for of_test in zip(plain, *(columns for _, columns in nuisance), strict=True)]
    if noise is None:
        left = _left(tests, every, Noise.white(fitter.problem.deviations))
        noise = fitter.noise(Noise.left_by(left, fitter.problem.deviations, fitter.problem.sizes), model)
    alone = _Evidence.of(tests, plain, noise, len(starts))
    nothing = float(alone.log_of(0.0, 0.0))
    singles = alone.singles(starts)
    pairs = alone.pairs(starts, fitter.settings.pairs)
    for start, columns in nuisance:
        beside = _Evidence.of(tests, columns, noise, len(starts))
        singles.append((start, float(beside.log_of(0.0, 0.0))))
        pairs += [((start, one), log) for one, log in beside.singles(starts) if one.effect.name != start.effect.name]
    best = _best(singles, lambda start: start.effect.label)
    both = _best(pairs, lambda pair: frozenset(start.effect.name for start in pair))[: fitter.settings.pairs]
    return Screening(
        screened,
        noise,
        nothing,
        tuple((start, log - nothing) for start, log in best),
        tuple((pair, log - nothing) for pair, log in both),
    )


def _candidates(
    fitter: Fitter, model: FittedModel
) -> tuple[list[np.ndarray], list[Start], list[tuple[Start, Nuisance]], int]:
    """Return what the model leaves and what changes it, and the candidates.

    Returns:
        Columns (n_i, 1 + b + m) of each test: what is left; what each parameter of the model, and of the errors of
        known equations, makes; what each start makes. Starts (m). Starts of effects that act through nuisance
        amplitudes, with all such columns. How many forms were predicted.
    """
    measured = np.concatenate(model.fit.model.measured)
    size = float(np.linalg.norm(measured))
    starts, nuisance, screened = list[Start](), list[tuple[Start, Nuisance]](), 0
    columns = [[r[:, np.newaxis], j] for r, j in zip(model.fit.left, model.fit.slopes, strict=True)]
    for of_test, wrong in zip(columns, fitter.discrepancy(model, model.names) or (), strict=False):
        of_test.append(wrong)
    for effect in fitter.problem.effects:
        if effect.name in model.names:
            continue
        screened += 1
        if effect.nuisance:
            effects, of_effect = (*model.effects, effect), [Start(effect, np.array(s)) for s in effect.starts]
            fitter.effort.spend(len(of_effect), effects)
            columns_at = fitter.problem.model(effects).nuisance_columns
            nuisance += [(start, columns_at(np.append(model.fit.values, start.values))) for start in of_effect]
            continue
        for start, change in fitter.changes(model.effects, model.fit.values, model.fit.predicted, effect):
            power = float(np.linalg.norm(np.concatenate(change)))
            if power < _SEEN * size:
                continue
            # by how many prior standard deviations of its size it stands for
            unit = 1.0
            if effect.parameters:
                unit = effect.parameters[0].coordinate(start[0]) if effect.linear else power / (_TYPICAL * size)
            starts.append(Start(effect, start))
            for of_test, of_change in zip(columns, change, strict=True):
                of_test.append(of_change[:, np.newaxis] / unit)
    return [np.hstack(of_test) for of_test in columns], starts, nuisance, screened


def _left(tests: Sequence[np.ndarray], nuisance: Nuisance, noise: Noise) -> list[np.ndarray]:
    """Return what all columns together, each with the prior N(0, 1), leave (n_i,) of each test."""
    each = [_products(test, of_test, noise.weight(i))[0] for i, (test, of_test) in enumerate(_both(tests, nuisance))]
    products = np.sum(each, axis=0)
    sizes = np.linalg.solve(products[1:, 1:] + np.eye(len(products) - 1), products[1:, 0])
    left = []
    for i, (test, columns) in enumerate(_both(tests, nuisance)):
        rest = test[:, 0] - test[:, 1:] @ sizes
        if columns is not None:
            u, s, _ = np.linalg.svd(noise.weight(i) * columns, full_matrices=False)
            rest = rest - u @ (s**2 / (1.0 + s**2) * (u.T @ rest))
        left.append(rest)
    return left


def _products(test: np.ndarray, nuisance: np.ndarray | None, weight: float) -> tuple[np.ndarray, float]:
    """Return inner products in units of the noise, nuisance columns integrated out, and their log determinant."""
    found = weight**2 * (test.T @ test)
    if nuisance is None:
        return found, 0.0
    u, s, _ = np.linalg.svd(weight * nuisance, full_matrices=False)
    along = weight * s[:, np.newaxis] / np.sqrt(1.0 + s[:, np.newaxis] ** 2) * (u.T @ test)
    return found - along.T @ along, float(np.sum(np.log1p(s**2)))


@dataclass(frozen=True)
class _Evidence:
    """Evidence of a model with nuisance columns, and of starts beside it.

    Attributes:
        power: of what is left, freed of what the parameters of the model can make of it.
        along: (m,) product of it with each start's change.
        products: (m, m) of the changes.
        determinant: log, of what is integrated out.
        freedom: independent samples, with those that the prior of the scale is worth.
    """

    power: float
    along: np.ndarray
    products: np.ndarray
    determinant: float
    freedom: float

    @staticmethod
    def of(tests: Sequence[np.ndarray], nuisance: Nuisance, noise: Noise, starts: int) -> _Evidence:
        """Integrate out the parameters of the model and the nuisance amplitudes."""
        every = [_products(test, of_test, noise.weight(i)) for i, (test, of_test) in enumerate(_both(tests, nuisance))]
        products = np.sum([one for one, _ in every], axis=0)
        rest = [0, *range(len(products) - starts, len(products))]
        known = np.arange(1, len(products) - starts)
        root = np.linalg.cholesky(products[np.ix_(known, known)] + np.eye(known.size))
        made = np.linalg.solve(root, products[np.ix_(known, rest)])
        products = products[np.ix_(rest, rest)] - made.T @ made
        determinant = sum(one for _, one in every) + 2.0 * float(np.sum(np.log(np.diag(root))))
        freedom = PRIOR_FREEDOM + sum(noise.independent(i, len(test)) for i, test in enumerate(tests))
        return _Evidence(float(products[0, 0]), products[0, 1:], products[1:, 1:], determinant, freedom)

    def log_of(self, explained: np.ndarray | float, determinant: np.ndarray | float) -> np.ndarray:
        """Return the log evidence where so much power is explained, the scale of the noise integrated out."""
        left = np.maximum(self.power - explained, 0.0)
        return np.asarray(-0.5 * self.freedom * np.log1p(left / self.freedom) - 0.5 * (self.determinant + determinant))

    def singles(self, starts: Sequence[Start]) -> list[Single]:
        """Return each start with the size that the tests ask for, and its log evidence."""
        own = np.diag(self.products) + 1.0
        logs = self.log_of(self.along**2 / own, np.log(own))
        logs = logs + _log_priors(starts)
        return [(_sized(*of), float(log)) for *of, log in zip(starts, self.along / own, logs, strict=True)]

    def pairs(self, starts: Sequence[Start], number: int) -> list[Pair]:
        """Return the best pairs of starts of different effects with their log evidence."""
        own, along, products = np.diag(self.products) + 1.0, self.along, self.products
        with np.errstate(all="ignore"):  # of changes too large for their products no pair is looked at
            determinant = np.maximum(np.outer(own, own) - products**2, 1e-12 * np.outer(own, own))
            twice = 2.0 * products * np.outer(along, along)
            explained = (np.outer(along**2, own) + np.outer(own, along**2) - twice) / determinant
            logs = self.log_of(explained, np.log(determinant)) + np.add.outer(_log_priors(starts), _log_priors(starts))
        names = np.array([start.effect.name for start in starts])
        logs[(names[:, np.newaxis] == names) | np.tri(len(starts), dtype=bool)] = -np.inf
        found: list[Pair] = []
        for flat in np.argsort(-logs, axis=None, kind="stable")[: _LOOKED * number]:
            i, k = divmod(int(flat), len(starts))
            if not np.isfinite(logs[i, k]):
                break
            matrix = np.array([[own[i], products[i, k]], [products[i, k], own[k]]])
            sizes = np.linalg.solve(matrix, along[[i, k]])
            found.append(((_sized(starts[i], sizes[0]), _sized(starts[k], sizes[1])), float(logs[i, k])))
        return found


def _log_priors(starts: Sequence[Start]) -> np.ndarray:
    return np.array([start.effect.log_prior for start in starts])


def _best(found: Sequence[tuple[T, float]], key: Callable[[T], Hashable]) -> list[tuple[T, float]]:
    """Return the best of each key, best first."""
    best: dict[Hashable, tuple[T, float]] = {}
    for one in sorted(found, key=lambda each: -each[1]):
        best.setdefault(key(one[0]), one)
    return list(best.values())


def _sized(start: Start, size: float) -> Start:
    """Return a start with the size that the tests ask for, where it is linear in it."""
    if not start.effect.linear:
        return start
    first = start.effect.parameters[0]
    return Start(start.effect, np.array([first.value(size), *start.values[1:]]))


def _stacked(columns: Sequence[np.ndarray | None]) -> np.ndarray | None:
    some = [one for one in columns if one is not None]
    return np.hstack(some) if some else None


def _both(tests: Sequence[np.ndarray], nuisance: Nuisance) -> list[tuple[np.ndarray, np.ndarray | None]]:
    return list(zip(tests, nuisance, strict=True))
