"""Lengths of which a discrete Fourier transform is quick."""

from __future__ import annotations


def transform_length(least: int) -> int:
    """Return the smallest number from a least one on whose only prime factors are 2, 3 and 5.

    A real transform has fast kernels for these factors. `scipy.fft.next_fast_len` gives the same number, but loading
    it takes longer than the transforms of many a record.

    Args:
        least: 1 or more.
    """
    best = 1 << (least - 1).bit_length()
    five = 1
    while five < best:
        odd = five
        while odd < best:
            parts = -(-least // odd)
            best = min(best, odd << (parts - 1).bit_length())
            odd *= 3
        five *= 5
    return best
