"""Which further test would separate the effects that the tests made so far cannot tell apart."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Trial
from edesign.calibrate.evidence import Judged
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.result import NextTest
from edesign.calibrate.search.selection import Selection
from edesign.calibrate.side_by_side import side_by_side
from edesign.damper.history import spline_velocity

_RATE, _PER_CYCLE = 60.0, 40  # samples of the tests thought of, per second and per cycle
_FREQUENCIES = (0.1, 0.5, 2.0, 5.0)  # Hz
_SHARES = (0.1, 0.5, 1.0, 1.3)  # of the largest displacement so far
_CYCLES = 12
_WARMER = 15.0  # K


def next_test(problem: DamperProblem, found: Selection, workers: int = 1) -> NextTest | None:
    """The test, of those a laboratory can make, in which look-alikes would differ most.

    Each model predicts each test that could be made after the campaign; the one with the largest NRMS between two
    predictions is told. None: no effect has a look-alike among effects.

    Args:
        problem: the tests made, at the rate of a fit.
        found: effects and their look-alikes.
        workers: processes.
    """
    best: NextTest | None = None
    for adopted in found.adopted:
        for name, other in adopted.alike.items():
            if name == "refit":
                continue
            told = _best_test(problem, found.final, other, (adopted.candidate.name, name), workers)
            if told is not None and (best is None or told.difference > best.difference):
                best = told
    return best


def _best_test(
    problem: DamperProblem, one: Judged, other: Judged, names: tuple[str, str], workers: int
) -> NextTest | None:
    remembers = problem.lasting or any(
        part[0].effect[0].remembers for judged in (one, other) for part in judged.fitted.parts
    )
    before = problem.trials if remembers else ()
    so_far = max(_differences(problem, one, other), default=0.0)

    def difference(test: tuple[str, Trial]) -> tuple[float, str] | None:
        text, trial = test
        try:
            return _differences(replace(problem, trials=(*before, trial)), one, other)[-1], text
        except PredictionError:
            return None

    told = [test for test in side_by_side(difference, _tests(problem), workers) if test is not None]
    if not told:
        return None
    most, text = max(told, key=lambda test: test[0])
    return NextTest(text, names, most, so_far)


def _differences(problem: DamperProblem, one: Judged, other: Judged) -> list[float]:
    """NRMS between two models' predictions of each test."""
    first, second = (problem.predict(j.fitted.base, j.fitted.parts, ("fit", "validate")) for j in (one, other))
    return [
        float(np.sum((a - b) ** 2)) / max(float(a @ a), 1e-300)
        for a, b in zip(first, second, strict=True)
        if a is not None and b is not None
    ]


def _tests(problem: DamperProblem) -> Iterator[tuple[str, Trial]]:
    """Tests that could be made after the campaign."""
    largest = problem.sizes.displacement
    temperature = float(np.mean(problem.trials[-1].temperature))
    for frequency in _FREQUENCIES:
        for share in _SHARES:
            amplitude = share * largest
            text = f"{_CYCLES} cycles of {1e3 * amplitude:.3g} mm at {frequency:g} Hz"
            motion = _sine(amplitude, frequency)
            yield f"{text}, {temperature:g} degC", _trial(problem, motion, temperature)
            if share == 0.5:
                warm = temperature + _WARMER
                yield f"{text}, {warm:g} degC", _trial(problem, motion, warm)
    for side in ("stretch", "push back"):
        sign = 1.0 if side == "stretch" else -1.0
        yield (
            f"{side} by {1e3 * 0.5 * largest:.3g} mm in 0.2 s, hold for 60 s, {temperature:g} degC",
            _trial(problem, _hold(sign * 0.5 * largest), temperature),
        )


def _trial(problem: DamperProblem, motion: Motion, temperature: float) -> Trial:
    n = motion.time.size
    return Trial("next", "validate", len(problem.trials), motion, np.full(n, np.nan), np.full(n, temperature))


def _sine(amplitude: float, frequency: float) -> Motion:
    """Cycles with half a cycle to grow."""
    time = np.arange(0.0, _CYCLES / frequency, 1.0 / max(_RATE, _PER_CYCLE * frequency))
    grow = np.clip(2.0 * frequency * time, 0.0, 1.0)
    return _motion(time, amplitude * grow * np.sin(2.0 * np.pi * frequency * time))


def _hold(displacement: float) -> Motion:
    time = np.arange(0.0, 60.0, 0.01)
    return _motion(time, displacement * 0.5 * (1.0 - np.cos(np.pi * np.clip(time / 0.2, 0.0, 1.0))))


def _motion(time: np.ndarray, displacement: np.ndarray) -> Motion:
    velocity = spline_velocity(time, displacement)
    return Motion(time, displacement, velocity, spline_velocity(time, velocity))
