"""The laboratory: what is recorded in the tests of a campaign with hidden effects, before noise."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from blind import law
from blind.effects.base import Effect, Histories
from blind.law import Parameters, middle
from blind.programme import Trial
from blind.series import Changes, Joint, deformation

PASSES = 16  # at most, where what an effect adds depends on the force or the deformation it changes
SETTLED, UNSETTLED = 1e-4, 1e-3  # of the largest force


class Unsettled(ArithmeticError):
    """Effects that change each other come to no end."""


def observe(p: Parameters, tests: Sequence[Trial], effects: Sequence[Effect]) -> tuple[Histories, Histories]:
    """Displacement mm and force kN of each test as recorded, (n,) each at all steps.

    Args:
        p: parameters of the law at 20 degC.
        tests: all of a campaign, in order, or some if no effect remembers.
        effects: hidden in it.
    """
    force = _damper(p, tests, effects)
    for effect in effects:
        force = effect.rig(tests, force)
    x = [test.x for test in tests]
    for effect in effects:
        force, x = effect.force_channel(tests, force), effect.displacement_channel(tests, x)
    return x, force


def predicted(p: Parameters, tests: Sequence[Trial], x: Histories | None = None) -> Histories:
    """Force of the law alone (n,) kN, under displacements (n,) mm or those of the tests."""
    x = [test.x for test in tests] if x is None else x
    return [law.force(law.at_temperature(p, t.temperature), u, t.h) for t, u in zip(tests, x, strict=True)]


def _damper(p: Parameters, tests: Sequence[Trial], effects: Sequence[Effect]) -> Histories:
    """Force of damper and all that is in its line."""
    each = [_parameters(p, test, effects) for test in tests]
    driven = [test.x for test in tests]
    for effect in effects:
        driven = effect.deformation(tests, driven)
    joints = [joint for joint in (effect.joint() for effect in effects) if joint is not None]
    joint = _in_line(joints)
    u = driven
    force = [law.force(q, x, test.h) for q, test, x in zip(each, tests, u, strict=True)]
    again = _feedback(effects, joint is not None)
    changes = _changes(tests, effects, u, force)
    moved, wide = np.inf, False
    for step in range(PASSES if again else 1):
        before = force
        if step:
            new = _changes(tests, effects, u, force)
            # in line with something soft, full steps may overshoot
            changes = [a.mean(b) for a, b in zip(changes, new, strict=True)] if wide else new
        if joint is not None:
            u = [deformation(q, x, t.h, joint, c) for q, x, t, c in zip(each, driven, tests, changes, strict=True)]
        force = [_force(q, x, test.h, c) for q, x, test, c in zip(each, u, tests, changes, strict=True)]
        largest = max(float(np.abs(f).max()) for f in force)
        last, moved = moved, max(float(np.abs(f - b).max()) for f, b in zip(force, before, strict=True)) / largest
        wide = wide or moved > 0.5 * last
        if moved < SETTLED:
            break
    if again and not moved < UNSETTLED:
        raise Unsettled
    return force


def _parameters(p: Parameters, test: Trial, effects: Sequence[Effect]) -> Parameters:
    q: Parameters = law.at_temperature(p, test.temperature)
    for effect in effects:
        q = effect.parameters(test, q)
    return q


def _feedback(effects: Sequence[Effect], in_line: bool) -> bool:
    """Whether one pass is not enough."""
    names = {effect.name for effect in effects}
    inner = [e for e in effects if _changes_damper(e)]
    return bool(names & {"self_heating", "degradation"}) or (in_line and bool(inner))


def _changes_damper(effect: Effect) -> bool:
    own = type(effect)
    return any(getattr(own, hook) is not getattr(Effect, hook) for hook in ("factors", "right", "parallel"))


def _changes(tests: Sequence[Trial], effects: Sequence[Effect], u: Histories, force: Histories) -> list[Changes]:
    """What all effects add."""
    factors = [[np.ones(test.n - 1) for _ in range(3)] for test in tests]
    right, parallel = [np.zeros(test.n - 1) for test in tests], [np.zeros(test.n) for test in tests]
    for effect in effects:
        for i, triple in enumerate(effect.factors(tests, u, force) or ()):
            factors[i] = [
                f * (middle(g) if isinstance(g, np.ndarray) else g) for f, g in zip(factors[i], triple, strict=True)
            ]
        for i, history in enumerate(effect.right(tests, u) or ()):
            right[i] = right[i] + middle(history)
        for i, history in enumerate(effect.parallel(tests, u) or ()):
            parallel[i] = parallel[i] + history
    return [Changes(f[0], f[1], f[2], r, q) for f, r, q in zip(factors, right, parallel, strict=True)]


def _force(p: Parameters, u: np.ndarray, h: float, changes: Changes) -> np.ndarray:
    q = law.parts(p, u, h)
    right = changes.elastic * q.elastic + changes.viscous * q.viscous + changes.power * q.power + changes.right
    return law.relaxed(p, right, h, law.static_force(p, float(u[0]))) + changes.parallel


def _in_line(joints: Sequence[Joint]) -> Joint | None:
    """Several joints one after the other (two at most: play and flexibility)."""
    if len(joints) < 2:
        return joints[0] if joints else None
    first, second = joints

    def force(w: float) -> tuple[float, float]:
        low, high = (0.0, w) if w > 0.0 else (w, 0.0)
        f, slope = 0.0, 0.0
        for _ in range(50):
            a = 0.5 * (low + high)
            (f, k1), (g, k2) = first(a), second(w - a)
            slope = k1 * k2 / (k1 + k2) if k1 + k2 > 0.0 else 0.0
            if abs(f - g) < 1e-9:
                break
            low, high = (a, high) if f < g else (low, a)
        return f, slope

    return force
