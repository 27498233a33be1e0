"""State in which a test begins where it is the test's own: found from its force, as what was done before, and how long
before, is not recorded.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from edesign.calibrate.dampers.acting import Acting
from edesign.calibrate.dampers.effect import BEGUN
from edesign.calibrate.dampers.trial import Trial, after
from edesign.damper.history import NONE, Extremes

_CHANGE = 1e-3  # of the state, a number that is about 1 where it does as much as the law: for differences
_FARTHEST = 3.0  # e^-3: a twentieth of the force would be left
_ROUNDS = 4  # of Gauss and Newton, on a parabola

Run = Callable[[Trial, Sequence[Acting]], tuple[np.ndarray, Extremes]]
"""Force (n,) N of a test, and what the law remembers after it."""


class Begun(NamedTuple):
    """Force (n,) N of a test from its own beginning, and its change by that of the state there."""

    force: np.ndarray
    change: np.ndarray


def from_own_beginnings(trials: Sequence[Trial], acting: Sequence[Acting], run: Run) -> Iterator[Begun]:
    """Each test from the beginning that suits its force best; the next one is made of a specimen that went through it.

    Args:
        trials: in the order in which they were made.
        acting: parts, some of which begin each test anew; they remember.
        run: of a test.
    """
    been = NONE
    for given in trials:
        found, been = _from_own_beginning(after(been, given), acting, run)
        yield found


def _from_own_beginning(trial: Trial, acting: Sequence[Acting], run: Run) -> tuple[Begun, Extremes]:
    """From the state that the parabola asks for through the force from no state, its slope there, and the force from
    the state that the slope asks for.
    """
    remembered = [dict(part.memory) for part in acting]

    def begun(state: float) -> tuple[np.ndarray, Extremes]:
        for part, memory in zip(acting, remembered, strict=True):
            part.memory = {**memory, **({BEGUN: state} if part.form.begins else {})}
        return run(trial, acting)

    moved, _ = begun(_CHANGE)
    plain, been = begun(0.0)  # after it: what parts remember then is that of a test begun so
    slope = (moved - plain) / _CHANGE
    if not trial.made:
        return Begun(plain, slope), been
    weight = 1.0 if trial.counted is None else trial.counted
    left = weight * (trial.force - plain)
    state = _nearer(0.0, left, weight * slope)
    if abs(state) < _CHANGE:
        return Begun(plain, slope), been
    force, _ = begun(state)
    bend = (force - plain - state * slope) / state**2
    for _ in range(_ROUNDS):
        own = slope + state * bend
        state = _nearer(state, left - weight * state * own, weight * (own + state * bend))
    force, been = begun(state)
    return Begun(force, slope + 2.0 * state * bend), been


def _nearer(state: float, left: np.ndarray, change: np.ndarray) -> float:
    """The state with a step by which least is left, where a force changes so with it."""
    step = float(change @ left) / max(float(change @ change), 1e-300)
    return float(np.clip(state + step, -_FARTHEST, _FARTHEST))
