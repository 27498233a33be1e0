"""Irregular motions and trials on which effects are predicted, and how close predictions must be."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial

U, STIFFNESS = 0.01, 2e6  # m, N/m: largest displacement and stiffness of the motions here
SWEPT = 1e-6  # of a factor by work: sweeps over all steps end when its state moves by less than 1e-6 of itself
ROUNDING = 1e-12  # of quantities about 1: sums of a few hundred terms in double precision


def motion(seed: int, n: int = 400, uneven: bool = False) -> Motion:
    """Five sines from rest, with their own derivatives."""
    rng = np.random.default_rng(seed)
    step = rng.uniform(0.005, 0.02, n - 1) if uneven else np.full(n - 1, 0.01)
    t = np.concatenate(([0.0], np.cumsum(step)))
    w, phase = rng.uniform(2.0, 20.0, 5), rng.uniform(0.0, 6.0, 5)
    angle = np.outer(t, w) + phase
    scale = 0.3 * U
    return Motion(t, scale * np.sin(angle).sum(1), scale * np.cos(angle) @ w, -scale * np.sin(angle) @ w**2)


def trial(of: Motion, order: int = 0, temperature: float | np.ndarray = 20.0) -> Trial:
    law = STIFFNESS * of.displacement + 2e4 * of.velocity
    return Trial("t", "fit", order, of, law, np.broadcast_to(temperature, of.time.shape).astype(float))


def two_tests() -> tuple[Trial, Trial]:
    return trial(motion(1), 0), trial(motion(2, 300, uneven=True), 1)


def steps(of: Motion) -> Iterator[tuple[int, float, float]]:
    """Index of a step's end, its duration and its deformation."""
    for i in range(1, of.time.size):
        yield i, float(of.time[i] - of.time[i - 1]), float(of.displacement[i] - of.displacement[i - 1])


def factor(form: Form, p: dict[str, float], tests: tuple[Trial, ...]) -> list[np.ndarray]:
    memory: dict[str, float] = {}
    found = [form.factor(p, t, t.motion, t.force, memory) for t in tests]
    return [np.broadcast_to(f, t.force.shape) for f, t in zip(found, tests, strict=True) if f is not None]


def parallel(form: Form, p: dict[str, float], tests: tuple[Trial, ...]) -> list[np.ndarray]:
    memory: dict[str, float] = {}
    found = [form.parallel(p, t, t.motion, memory) for t in tests]
    return [np.asarray(f) for f in found if f is not None]


def close(found: list[np.ndarray], expected: list[np.ndarray], scale: float = 1.0) -> None:
    assert len(found) == len(expected)
    for a, b in zip(found, expected, strict=True):
        np.testing.assert_allclose(a, b, rtol=0.0, atol=ROUNDING * scale)


def sizes(tests: int = 3) -> Sizes:
    further = (trial(motion(order + 1), order, 25.0) for order in range(2, tests))
    return Sizes.of((*two_tests(), *further))


def shaken(u: np.ndarray) -> Motion:
    still = np.zeros_like(u)
    return Motion(np.linspace(0.0, 10.0, u.size), u, still, still)
