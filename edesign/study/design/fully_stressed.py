"""The least dampers by histories: fully stressed, every storey that needs dampers drifts as far as it may."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.study.design.building import Building
from edesign.study.design.least_total import LEAST
from edesign.study.design.loop import LARGEST_FACTOR, LARGEST_STEP, Round, RoundOutcome, S, Search, demand_of

_FIRST_POWER = 2.0  # of the drift, with which damping grows: displacements fall about with its root


@dataclass(frozen=True)
class StoreySizes:
    """The dampers of each storey over the stiffness of the storey, as the search changes them.

    Attributes:
        first: of the first round, (s,).
        weight: of each in the sum that is to be least, (s,).
        inherent: with which the dampers of a storey damp as the frame does without them.
        least, most: that a storey may have.
        storeys: their numbers from 1, (s,).
    """

    first: np.ndarray
    weight: np.ndarray
    inherent: float
    least: float
    most: float
    storeys: np.ndarray


def storey_sizes(
    building: Building, first: np.ndarray, unit: np.ndarray, weight: np.ndarray, inherent: float, most: float
) -> StoreySizes:
    """Return the sizes from which a search by histories starts.

    Args:
        building: the frame with its places.
        first: size of the dampers of the first round, (s,).
        unit: size over which the search takes them, (s,).
        weight: of each in the sum that is to be least, (s,).
        inherent: with which the dampers of a storey damp as the frame does without them, over the unit.
        most: the largest that an estimate would take, over the unit; histories know what more would do.
    """
    return StoreySizes(
        np.maximum(first / unit, LEAST), weight, inherent, LEAST, LARGEST_FACTOR * most, building.storeys
    )


def search_fully_stressed(
    first: S,
    make: Callable[[np.ndarray], S],
    verify: Callable[[S, int, float], RoundOutcome],
    sizes: StoreySizes,
    most_rounds: int,
    precision: float,
    kept: Callable[[Sequence[Round[S]]], None] = lambda rounds: None,
    settled: Callable[[Round[S]], bool] = lambda last: True,
) -> Search[S]:
    """Find the dampers of least sum whose histories meet all criteria, whatever an estimate says of the first ones.

    A storey that drifts further than it may gets more, one that does not gets less, down to the least. The criteria say
    by how much the largest drift is too large, the histories how those of the other storeys depend on it. With which
    power of the drift dampers must grow is learnt from the last two rounds. Where a round would change the sum by less
    than the precision, all dampers grow by it until the criteria are met.

    Args:
        make: makes the dampers of sizes (s,).
        verify: histories and verdicts of dampers, their round and their sum over that of the first round.
        sizes: of the first round, and their limits.
        most_rounds: how many may be tried.
        kept: called with all rounds after each.
        settled: whether what the dampers presume of their histories agrees with them; asked after each round.

    Returns:
        The search; the chosen round is that of the least sum that met all criteria, or the last where none did.

    Source: Levy and Lavan (2006), Fully stressed design of passive controllers in framed structures for seismic
        loadings, Structural and Multidisciplinary Optimization 32; the power: Irons and Tuck (1969), International
        Journal for Numerical Methods in Engineering 1.
    """
    rounds: list[Round[S]] = []
    agreed: list[Round[S]] = []
    x, sizing, power, before = sizes.first, first, _FIRST_POWER, None
    reason = ""
    while True:
        changed = float(sizes.weight @ x) / float(sizes.weight @ sizes.first)
        number = len(rounds) + 1
        rounds.append(Round(number, changed, sizing, None if sizing.reason else verify(sizing, number, changed)))
        outcome = rounds[-1].outcome
        if outcome is None:
            reason = sizing.reason
            break
        kept(rounds)
        agrees = settled(rounds[-1])
        agreed += [rounds[-1]] if agrees else []
        if len(rounds) == most_rounds:
            reason = f"not met within {most_rounds} rounds; the last misses: {outcome.misses}"
            break
        damping, excess = np.log(x + sizes.inherent), _excess(outcome, sizes.storeys)
        if not outcome.met and np.all(x[excess > 0.0] >= sizes.most):
            reason = f"even the largest dampers of the storeys that drift too far miss: {outcome.misses}"
            break
        if before is not None:
            power = _power(damping - before[0], excess - before[1], power)
        before = damping, excess
        change = np.clip(power * excess, -math.log(LARGEST_STEP), math.log(LARGEST_STEP))
        following = np.clip(np.exp(damping + change) - sizes.inherent, sizes.least, sizes.most)
        if agrees and sizes.weight @ np.abs(following - x) <= precision * (sizes.weight @ x):
            best = min((r.changed for r in agreed if _met(r)), default=math.inf)
            if best <= (1.0 + precision) * changed:
                break
            following = np.minimum((1.0 + precision) * x, sizes.most)
        try:
            x, sizing = _made(make, x, following, precision)
        except (InputError, AnalysisError) as error:
            reason = f"the largest dampers that can be sized miss: {outcome.misses}; beyond them {error}"
            break
    good = [r for r in agreed if _met(r)] or [r for r in rounds if _met(r)]
    if good:
        return Search(tuple(rounds), min(good, key=lambda r: r.changed))
    return Search(tuple(rounds), rounds[-1], reason)


def _met(one: Round[S]) -> bool:
    return one.outcome is not None and one.outcome.met


def _excess(outcome: RoundOutcome, storeys: np.ndarray) -> np.ndarray:
    """Logarithm of the drift of each storey with dampers over what it may be, (s,); 0: just as far as it may."""
    largest = max((demand_of(verdict) for verdict in outcome.verdicts), default=1.0)
    known = outcome.drift and np.all(np.isfinite(outcome.drift))
    drift = np.array(outcome.drift)[storeys - 1] if known else np.ones(storeys.size)
    return np.asarray(math.log(largest) + np.log(np.maximum(drift / drift.max(), np.finfo(float).tiny)))


def _power(grown: np.ndarray, gained: np.ndarray, power: float) -> float:
    """The power of the drift with which the damping of the last round would have led to the limit; else as before."""
    squared = float(gained @ gained)
    found = -float(grown @ gained) / squared if squared > 0.0 else 0.0
    return found if found > 0.0 else power


def _made(
    make: Callable[[np.ndarray], S], known: np.ndarray, wanted: np.ndarray, precision: float
) -> tuple[np.ndarray, S]:
    """Sizes (s,) and their dampers: those wanted, or the nearest on the way there from known ones that can be made."""
    while True:
        try:
            return wanted, make(wanted)
        except (InputError, AnalysisError):
            if np.max(np.abs(wanted / known - 1.0)) <= precision:
                raise
            wanted = 0.5 * (known + wanted)
