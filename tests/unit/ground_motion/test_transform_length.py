"""Lengths of transforms."""

from __future__ import annotations

import scipy.fft

from edesign.ground_motion.transform_length import transform_length


def test_it_is_that_of_scipy() -> None:
    """Which has real transforms of the same kernels as numpy."""
    lengths = (*range(1, 2000), *(5**7 + n for n in range(-3, 4)), 1234567)
    assert [transform_length(n) for n in lengths] == [scipy.fft.next_fast_len(n, real=True) for n in lengths]
