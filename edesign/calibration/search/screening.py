"""Screening: what each effect and each pair of effects would gain beside a fitted model, to first order.

Each form of each effect is predicted once at each start of its grid. With c the change that it makes, freed of what the
parameters of the model can make of it, and r what the model leaves, both in units of the noise, its size b has the
prior N(0, 1) and

    b = c'r / (1 + c'c)        gain = L(r'r) - L(r'r - (c'r)^2 / (1 + c'c)) - 1/2 log(1 + c'c)

L is the log density with the scale of the noise integrated out. Pairs follow from the same products c_i'c_j.
Sources: grouped orthogonal forward regression: Chen, Billings and Luo (1989), Int. J. Control 50, 1873-1896; with
priors it is the evidence of a linear model: MacKay (1992), Neural Computation 4, 415-447.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.calibration.search.models import FittedModel, Fitting, Start
from edesign.calibration.search.problem import Columns, Effect
from edesign.estimation.least_squares import weighted
from edesign.estimation.left_out import PRIOR_FREEDOM
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise

_TYPICAL = 0.1  # of what was measured: standard deviation of what an effect does that is not linear in its size
_SEEN = 1e-9  # of what was measured: what does less is not seen
_LOOKED = 400  # times the number of pairs wanted, that are looked at


@dataclass(frozen=True)
class Screening:
    """Gains of effects and pairs beside a model, best first.

    Attributes:
        screened: forms that were predicted.
        singles: start and gain of each form at its best start.
        pairs: starts and gains of pairs of different effects.
    """

    screened: int
    singles: tuple[tuple[Start, float], ...]
    pairs: tuple[tuple[tuple[Start, Start], float], ...]


def screen(fitting: Fitting, model: FittedModel, noise: Noise, wrong: Columns | None) -> Screening:
    """Screen all forms of effects that a model does not have.

    Args:
        fitting: of the search.
        model: fitted.
        noise: by which gains are measured.
        wrong: columns (n_i, k) by which the equations of the model may be wrong; None: there are none.
    """
    here = model.fit.weighted(noise)
    free = _freed(model, noise)
    known = [-np.vstack(here.slopes)]
    if wrong is not None:
        known.append(np.concatenate([f(noise.weight(i) * c) for i, (f, c) in enumerate(zip(free, wrong, strict=True))]))
    base = np.hstack(known)
    spread = np.linalg.inv(np.linalg.cholesky(base.T @ base + np.eye(base.shape[1])))
    residual = np.concatenate(here.residuals)
    freedom = PRIOR_FREEDOM + sum(noise.independent(i, r.size) for i, r in enumerate(here.residuals))
    measured = np.concatenate(model.fit.model.measured)
    size = float(np.linalg.norm(measured))
    starts: list[Start] = []
    columns: list[np.ndarray] = []
    alone: list[tuple[Start, float]] = []
    screened = 0
    for effect in fitting.problem.effects:
        if effect.name in model.names:
            continue
        screened += 1
        effects = (*model.effects, effect)
        values = np.array([[*model.fit.values, *start] for start in effect.starts])
        if effect.own:
            fitting.effort.spend(len(values), effects)
            alone += [
                (Start(effect, np.array(s)), _gain_of_own(fitting, model, effects, v, noise, freedom))
                for s, v in zip(effect.starts, values, strict=True)
            ]
            continue
        for start, there in zip(effect.starts, fitting.predict(effects, values), strict=True):
            if isinstance(there, PredictionError):
                continue
            change = [f - g for f, g in zip(there, model.fit.predicted, strict=True)]
            power = float(np.linalg.norm(np.concatenate(change)))
            if not np.isfinite(power) or power < _SEEN * size:
                continue
            unit = _unit(effect, start, power / (_TYPICAL * size))
            starts.append(Start(effect, np.array(start)))
            columns.append(
                np.concatenate(
                    [f(noise.weight(i) / unit * c) for i, (f, c) in enumerate(zip(free, change, strict=True))]
                )
            )
    if not columns:
        return Screening(screened, tuple(sorted(alone, key=lambda one: -one[1])), ())
    c = np.column_stack(columns)
    # (I + B B')^-1 of what the parameters of the model, with their priors, can make of a change
    shared = spread @ (base.T @ c)
    pull = spread @ (base.T @ residual)
    products = c.T @ c - shared.T @ shared
    along = c.T @ residual - shared.T @ pull
    power = float(residual @ residual - pull @ pull)
    own = np.diag(products) + 1.0
    gains = _gain(along**2 / own, power, freedom) - 0.5 * np.log(own)
    best: dict[str, tuple[Start, float]] = {}
    for i in np.argsort(-gains, kind="stable"):
        best.setdefault(starts[i].effect.label, (_sized(starts[i], along[i] / own[i]), float(gains[i])))
    for one, gain in sorted(alone, key=lambda one: -one[1]):
        best.setdefault(one.effect.label, (one, gain))
    singles = sorted(best.values(), key=lambda one: -one[1])
    pairs = _pairs(starts, products, along, power, freedom, fitting.settings.pairs)
    return Screening(screened, tuple(singles), tuple(pairs))


def _unit(effect: Effect, start: Sequence[float], typical: float) -> float:
    """Return by how many prior standard deviations of its size a start stands for."""
    if not effect.parameters:
        return 1.0
    return effect.parameters[0].coordinate(start[0]) if effect.linear else typical


def _sized(start: Start, size: float) -> Start:
    """Return a start with the size that the tests ask for, where it is linear in it."""
    if not start.effect.linear:
        return start
    first = start.effect.parameters[0]
    return Start(start.effect, np.array([first.value(size), *start.values[1:]]))


def _gain(explained: np.ndarray, power: float, freedom: float) -> np.ndarray:
    """Return the gain of explained power, the scale of the noise integrated out."""
    left = np.maximum(power - explained, 0.0)
    return np.asarray(0.5 * freedom * (np.log1p(power / freedom) - np.log1p(left / freedom)))


def _pairs(
    starts: Sequence[Start], products: np.ndarray, along: np.ndarray, power: float, freedom: float, number: int
) -> list[tuple[tuple[Start, Start], float]]:
    """Return the best pairs of starts of different effects, one for each pair of names."""
    own = np.diag(products) + 1.0
    determinant = np.maximum(np.outer(own, own) - products**2, 1e-12 * np.outer(own, own))
    explained = (
        np.outer(along**2, own) + np.outer(own, along**2) - 2.0 * products * np.outer(along, along)
    ) / determinant
    gains = _gain(explained, power, freedom) - 0.5 * np.log(determinant)
    names = np.array([start.effect.name for start in starts])
    gains[(names[:, np.newaxis] == names) | np.tri(len(starts), dtype=bool)] = -np.inf
    found: list[tuple[tuple[Start, Start], float]] = []
    seen: set[tuple[str, str]] = set()
    for flat in np.argsort(-gains, axis=None, kind="stable")[: _LOOKED * number]:
        i, k = divmod(int(flat), len(starts))
        pair = str(names[i]), str(names[k])
        if not np.isfinite(gains[i, k]) or len(found) == number:
            break
        if pair in seen:
            continue
        seen.add(pair)
        matrix = np.array([[own[i], products[i, k]], [products[i, k], own[k]]])
        sizes = np.linalg.solve(matrix, along[[i, k]])
        found.append(((_sized(starts[i], sizes[0]), _sized(starts[k], sizes[1])), float(gains[i, k])))
    return found


def _freed(model: FittedModel, noise: Noise) -> list[Callable[[np.ndarray], np.ndarray]]:
    """Return what frees a weighted change of each test of what is that test's own."""

    def of(columns: np.ndarray | None, weight: float) -> Callable[[np.ndarray], np.ndarray]:
        if columns is None:
            return lambda change: change
        u, s, _ = np.linalg.svd(weight * columns, full_matrices=False)
        shares = u * (1.0 - 1.0 / np.sqrt(1.0 + s**2))
        return lambda change: change - shares @ (u.T @ change)

    own = model.fit.model.own(model.fit.values)
    return [of(columns, noise.weight(i)) for i, columns in enumerate(own)]


def _gain_of_own(
    fitting: Fitting, model: FittedModel, effects: Sequence[Effect], values: np.ndarray, noise: Noise, freedom: float
) -> float:
    """Return the gain of an effect that adds shares of each test's own."""
    with_it = fitting.problem.model(tuple(effects))
    none = [np.zeros((f.size, 0)) for f in model.fit.predicted]
    before = weighted(model.fit.model, noise, model.fit.values, model.fit.predicted, none)
    after = weighted(with_it, noise, values, model.fit.predicted, none)
    power, left = (sum(float(r @ r) for r in one.residuals) for one in (before, after))
    return float(_gain(np.array(power - left), power, freedom)) - 0.5 * (sum(after.own) - sum(before.own))
