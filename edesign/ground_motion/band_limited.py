"""A sampled acceleration between its samples: upsampling, and the polygon that stands for the band-limited motion."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import lru_cache

import numpy as np

from edesign.ground_motion.transform_length import transform_length

_PARTS = 1024  # of a step, to which positions are rounded: a wave of four samples then moves by 1/2600 of a turn
_MARGIN = 256  # samples beyond each end, over which the motion fades away


def upsampled(acceleration: np.ndarray, factors: Iterable[int]) -> Iterator[np.ndarray]:
    """Return the motion at a multiple of its rate, without content above the Nyquist frequency of the given samples.

    Beyond both ends the motion is continued by point reflection and faded out, so that a record that starts or ends
    with a value does not ring there, and its end does not reach round into its beginning. Given samples stay as they
    are, and those at one time are the same bit for bit in all results.

    Args:
        acceleration: (n,).
        factors: how many new steps to an old one, powers of two.

    Yields:
        For each factor ((n - 1) factor + 1,), from the first to the last of the given samples.

    Source: interpolation by the discrete Fourier transform (Oppenheim & Schafer, Discrete-Time Signal Processing, 8).
    """
    content, size = np.empty(0, dtype=complex), 0
    between: dict[tuple[int, int], np.ndarray] = {}  # samples at a fraction of the step (numerator, denominator)
    for factor in factors:
        if factor == 1:
            yield acceleration
            continue
        if not size:
            extended = _extended(acceleration)
            content, size = np.fft.rfft(extended), extended.size
        fine = np.empty((acceleration.size, factor))
        fine[:, 0] = acceleration
        for part in range(1, factor):
            common = part & -part  # the largest power of two in it; factors are powers of two
            key = part // common, factor // common
            if key not in between:
                shifted = np.fft.irfft(content * _shift(size, *key), size)
                between[key] = shifted[_MARGIN : _MARGIN + acceleration.size]
            fine[:, part] = between[key]
        yield fine.ravel()[: (acceleration.size - 1) * factor + 1]


def band_limited_at(acceleration: np.ndarray, positions: np.ndarray) -> np.ndarray:
    """Interpolate a band-limited motion at any positions between the first and the last of the given samples.

    Args:
        acceleration: (n,).
        positions: (m,), in steps of the given samples, 0 to n - 1. Beyond as many different parts of a step as
            `_PARTS` they are rounded to so many.

    Returns:
        (m,); given samples where positions are whole numbers.
    """
    whole = np.floor(positions).astype(int)
    parts = np.round(positions - whole, 9)
    if np.unique(parts).size > _PARTS:
        parts = np.round(parts * _PARTS) / _PARTS
    whole[parts == 1.0] += 1
    parts[parts == 1.0] = 0.0
    found = np.asarray(acceleration)[whole]
    extended = _extended(acceleration)
    content, size = np.fft.rfft(extended), extended.size
    turn = 2.0 * np.pi / size * np.arange(size // 2 + 1)
    for part in np.unique(parts[parts > 0.0]):
        shift = np.exp(1j * part * turn)
        if size % 2 == 0:
            shift[-1] = shift[-1].real  # half of it belongs to the negative frequency
        here = parts == part
        found[here] = np.fft.irfft(content * shift, size)[_MARGIN + whole[here]]
    return found


def polygon_samples(acceleration: np.ndarray) -> np.ndarray:
    """Return the corners of a polygon that has the content of the band-limited motion through the given samples.

    Linear interpolation multiplies the content at frequency f by sinc^2(f dt), too little by (pi f dt)^2 / 3. The
    second difference over 12 makes up for it: what is left is of the order of (f dt)^4. The ends stay as they are.

    Args:
        acceleration: (n,).

    Returns:
        (n,).

    Source: 1 / sinc^2(f dt) = 1 + x / 12 + x^2 / 90 + ..., where x = 4 sin^2(pi f dt) stands for minus the second
        difference.
    """
    corners = np.multiply(acceleration, 14.0)
    corners[1:-1] -= acceleration[2:]  # without temporary arrays: memory is what takes time here
    corners[1:-1] -= acceleration[:-2]
    corners *= 1.0 / 12.0
    corners[[0, -1]] = acceleration[[0, -1]]
    return np.asarray(corners)


def _extended(acceleration: np.ndarray) -> np.ndarray:
    """The motion with margins over which it fades away, as long as the Fourier transform is quick."""
    n = acceleration.size
    size = transform_length(n + 2 * _MARGIN)
    after = size - n - _MARGIN
    extended = np.pad(acceleration, (_MARGIN, after), mode="reflect", reflect_type="odd")
    extended[:_MARGIN] *= 0.5 - 0.5 * np.cos(np.pi * (np.arange(_MARGIN) + 0.5) / _MARGIN)
    extended[n + _MARGIN :] *= 0.5 + 0.5 * np.cos(np.pi * (np.arange(after) + 0.5) / after)
    return np.asarray(extended)


@lru_cache(maxsize=16)
def _shift(size: int, numerator: int, denominator: int) -> np.ndarray:
    """Factors on the content of `size` samples that move it by a fraction of a step; matching asks for them again."""
    turn = 2.0 * np.pi * numerator / denominator / size
    factors = np.exp(1j * turn * np.arange(size // 2 + 1))
    if size % 2 == 0:
        factors[-1] = factors[-1].real  # half of it belongs to the negative frequency
    factors.setflags(write=False)
    return factors
