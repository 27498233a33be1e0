"""How large an effect is: its share of the force in the tests to validate, and the size that gives a share."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from blind.effects.base import Effect, Histories
from blind.laboratory import observe, predicted
from blind.law import Parameters
from blind.programme import Trial

CLOSE = 0.02  # relative, of the share
STEPS = 24


class Unreachable(Exception):
    """No sensible size gives the share."""


def nrms(error: Histories, force: Histories) -> float:
    """Sum of squared errors over the sum of squared forces, no root."""
    return sum(float(np.dot(e, e)) for e in error) / sum(float(np.dot(f, f)) for f in force)


def share(p: Parameters, tests: Sequence[Trial], effects: Sequence[Effect], beside: Sequence[Effect] = ()) -> float:
    """NRMS on the tests to validate between records with effects and what the law says, or the law with others beside.

    Args:
        p: parameters of the law.
        tests: all of the campaign.
        effects: in the records.
        beside: in the prediction.
    """
    chosen = list(tests) if any(e.memory for e in (*effects, *beside)) else _validated(tests)
    x, force = observe(p, chosen, effects)
    if beside:
        moved = any(acts_on_displacement(effect) for effect in effects if effect not in beside)
        driven = [replace(t, x=y) for t, y in zip(chosen, x, strict=True)] if moved else chosen
        other = observe(p, driven, beside)[1]
    else:
        other = predicted(p, chosen, x)
    pairs = [
        ((f - o)[:: t.every], f[:: t.every])
        for t, f, o in zip(chosen, force, other, strict=True)
        if t.use == "validate"
    ]
    return nrms([e for e, _ in pairs], [f for _, f in pairs])


def fit_size(p: Parameters, tests: Sequence[Trial], effect: Effect, target: float) -> float:
    """Set the size of an effect so that its share is the target; returns the share.

    Raises:
        Unreachable: it would be larger than makes sense.
    """

    def miss(log_size: float) -> float:
        effect.size = math.exp(log_size)
        return math.log(max(share(p, tests, [effect]), 1e-300) / target)

    return target * math.exp(_root(miss, math.log(effect.first), math.log(effect.most)))


def _root(miss: Callable[[float], float], x: float, most: float) -> float:
    """Secant steps within a bracket, on a function that grows about twice as fast as its argument; what is missed."""
    x = min(x, most)
    y = miss(x)
    below, above = -math.inf, math.inf
    slope = 2.0
    for _ in range(STEPS):
        if abs(y) < CLOSE:
            return y
        below, above = (max(below, x), above) if y < 0.0 else (below, min(above, x))
        if below >= most:
            raise Unreachable
        step = x - max(-2.5, min(2.5, y / slope))
        if not below < step < above:
            step = 0.5 * (below + above)
        step = min(step, most)
        new = miss(step)
        if step != x and (new - y) / (step - x) > 0.3:
            slope = (new - y) / (step - x)
        x, y = step, new
    raise Unreachable


def acts_on_displacement(effect: Effect) -> bool:
    """Whether the recorded displacement is not that of the actuator."""
    return type(effect).displacement_channel is not Effect.displacement_channel


def _validated(tests: Sequence[Trial]) -> list[Trial]:
    return [test for test in tests if test.use == "validate"]
