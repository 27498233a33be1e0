"""Histories that drive effects: what fades."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibrate.dampers.drivers import fading


@pytest.mark.parametrize("jitter", [0.0, 1e-5, 0.3])
def test_what_fades_follows_its_recursion(jitter: float) -> None:
    # q_i = decay_i q_(i-1) + made_i, step by step; time columns of seven digits (1e-5 of a step) are taken as even
    random = np.random.default_rng(4)
    steps = 0.004 * (1.0 + jitter * random.uniform(-1.0, 1.0, 4000))
    decay, made = np.exp(-steps / 0.7), random.standard_normal(4000)
    expected = [2.5]
    for one, more in zip(decay.tolist(), made.tolist(), strict=True):
        expected.append(one * expected[-1] + more)
    found = fading(decay, made, 2.5)
    # where steps count as even, an error of jitter h/tau = 6e-8 in each of tau/h = 175 steps, at random
    near = 1e-6 if jitter == 1e-5 else 1e-12
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=near * np.max(np.abs(expected)))


def test_what_never_fades_adds_up() -> None:
    made = np.random.default_rng(2).standard_normal(50)
    np.testing.assert_allclose(
        fading(np.ones(50), made, 1.0), 1.0 + np.concatenate(([0.0], np.cumsum(made))), atol=1e-12
    )
