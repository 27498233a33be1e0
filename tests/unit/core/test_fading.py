"""Histories that fade step by step."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core.fading import fading


@pytest.mark.parametrize("turn", [0.0, 0.4])
def test_what_fades_follows_its_recursion(turn: float) -> None:
    # q_i = decay_i q_(i-1) + made_i, step by step, over uneven steps; with a turn all is complex
    random = np.random.default_rng(4)
    steps = 0.004 * (1.0 + 0.3 * random.uniform(-1.0, 1.0, 4000))
    decay, made = np.exp(-steps / 0.7), random.standard_normal(4000)
    if turn:
        decay, made = decay * np.exp(1j * turn * steps), made * (1.0 - 2.0j)
    expected = [complex(2.5) if turn else 2.5]
    for one, more in zip(decay.tolist(), made.tolist(), strict=True):
        expected.append(one * expected[-1] + more)
    found = fading(decay, made, 2.5)
    assert np.iscomplexobj(found) == (turn > 0.0)
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-12 * np.max(np.abs(expected)))


def test_what_never_fades_adds_up() -> None:
    made = np.random.default_rng(2).standard_normal(50)
    np.testing.assert_allclose(
        fading(np.ones(50), made, 1.0), 1.0 + np.concatenate(([0.0], np.cumsum(made))), atol=1e-12
    )


def test_every_other_sample_is_read_where_it_stands() -> None:
    decay, made = np.full(20, 0.9), np.arange(20.0)
    np.testing.assert_array_equal(
        fading(decay[::2], made[::2], 1.0), fading(decay[:10], np.arange(0.0, 20.0, 2.0), 1.0)
    )


def test_arrays_of_different_lengths_are_refused() -> None:
    with pytest.raises(ValueError, match="3 decays and 4 contributions"):
        fading(np.ones(3), np.ones(4), 0.0)
