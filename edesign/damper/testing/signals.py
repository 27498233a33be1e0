"""Displacement histories of damper tests, as a rig is commanded to follow them.

Amplitudes change with a continuous velocity: a servo-hydraulic actuator cannot follow a jump of it, and the cubic
splines on which damper laws are integrated would ring beside one. `sweep` with `blend=0` gives the bare command.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import scipy
from numpy.typing import ArrayLike

from edesign.errors import InputError

SAMPLING_RATE = 1000.0
"""Hz."""

MOST_SAMPLES = 10_000_000
LEAST_PER_CYCLE = 12
"""Samples: from fewer no properties can be determined, and the splines between them miss the peaks."""

SWEEP_4_4 = tuple(
    (cycles, share / 6.0)
    for cycles, share in (
        *((1.5, share) for share in (3, 6, 2, 1, 3, 4, 5)),
        (3.0, 6),
        *((1.5, share) for share in (5, 4, 3, 2, 1)),
    )
)
"""Cycles and share of the largest amplitude of each block of the sweep of thesis 4.4."""

History = tuple[np.ndarray, np.ndarray]  # time (n,) s, displacement (n,) m


def sine(
    amplitude: float,
    frequency: float,
    cycles: int = 18,
    ramp_up: float = 2.0,
    ramp_down: float = 2.0,
    sampling_rate: float = SAMPLING_RATE,
) -> History:
    """Return a steady sine between ramps in which the amplitude grows and falls in proportion to time.

    The ramps last whole half cycles, so they end where the sine is zero and the velocity stays continuous; there is no
    jump of velocity at the start either, unless it has no ramp.

    Args:
        amplitude: m.
        frequency: Hz.
        cycles: of full amplitude.
        ramp_up: cycles before these, a multiple of a half.
        ramp_down: cycles after these, a multiple of a half.
        sampling_rate: Hz.

    Returns:
        Time (n,) s and displacement (n,) m, zero at both ends.

    Raises:
        InputError: a number is out of its range, or the sampling is too coarse for the frequency.

    Source: thesis 3.2, Fig. 3.5; FEMA 356, 9.3.8.
    """
    _positive(amplitude=amplitude, frequency=frequency, sampling_rate=sampling_rate)
    _sampled(frequency, sampling_rate)
    if cycles < 1 or int(cycles) != cycles:
        raise InputError(f"cycles: a whole number of at least 1 is needed, not {cycles:g} [E-PROG-02]")
    for name, ramp in (("ramp_up", ramp_up), ("ramp_down", ramp_down)):
        if ramp < 0.0 or (2.0 * ramp) % 1.0 != 0.0:
            raise InputError(f"{name}: a multiple of half a cycle is needed, not {ramp:g} [E-PROG-02]")
    total = ramp_up + cycles + ramp_down
    t = _times(total / frequency, sampling_rate)
    phase = np.minimum(frequency * t, total)
    envelope = np.interp(phase, *_corners(ramp_up, cycles, ramp_down))
    u = amplitude * envelope * np.sin(2.0 * np.pi * phase)
    u[phase >= total * (1.0 - 1e-12)] = 0.0  # the last sample, for a frequency that is off by rounding
    return t, u


def sweep(
    maximum: float,
    frequency: float,
    blocks: Sequence[tuple[float, float]] = SWEEP_4_4,
    blend: float = 0.25,
    sampling_rate: float = SAMPLING_RATE,
) -> History:
    """Return a sine of one frequency in blocks of different amplitude; by default the sweep of thesis 4.4.

    The amplitude changes where the displacement is zero. There the commanded velocity jumps; here the amplitude goes
    smoothly from one to the other during `blend` cycles about the zero (after the start and before the end), which
    leaves the zeros where they are and, up to half a cycle, the peaks too.

    Args:
        maximum: largest amplitude, m.
        frequency: Hz.
        blocks: cycles (multiples of a half) and share of `maximum` of each.
        blend: cycles, at most 0.5; 0 lets the velocity jump.
        sampling_rate: Hz.

    Returns:
        Time (n,) s and displacement (n,) m, zero at both ends.

    Raises:
        InputError: a number is out of its range, or the sampling is too coarse for the frequency.

    Source: thesis 4.4, after Dorka & Garcia.
    """
    _positive(maximum=maximum, frequency=frequency, sampling_rate=sampling_rate)
    _sampled(frequency, sampling_rate)
    if not blocks:
        raise InputError("blocks: at least one is needed [E-PROG-02]")
    for cycles, share in blocks:
        if cycles <= 0.0 or (2.0 * cycles) % 1.0 != 0.0:
            raise InputError(f"blocks: the cycles are multiples of a half, not {cycles:g} [E-PROG-02]")
        _positive(share=share)
    if not 0.0 <= blend <= 0.5:
        raise InputError(f"blend: 0 to 0.5 cycles are possible, not {blend:g} [E-PROG-02]")
    ends = np.cumsum([cycles for cycles, _ in blocks])
    total = float(ends[-1])
    t = _times(total / frequency, sampling_rate)
    phase = np.minimum(frequency * t, total)
    shares = np.array([share for _, share in blocks])
    envelope = shares[np.minimum(np.searchsorted(ends, phase, side="right"), len(blocks) - 1)]
    if blend > 0.0:
        middles = np.array([0.5 * blend, *ends[:-1], total - 0.5 * blend])
        steps = np.diff(np.array([0.0, *shares, 0.0]))
        envelope = np.sum([step * _smooth((phase - m) / blend + 0.5) for m, step in zip(middles, steps)], axis=0)  # noqa: B905
    u = maximum * envelope * np.sin(2.0 * np.pi * phase)
    u[phase >= total] = 0.0
    return t, u


def sweep_4_4(maximum: float, frequency: float, blend: float = 0.25, sampling_rate: float = SAMPLING_RATE) -> History:
    """Return the amplitude sweep of thesis 4.4: 21 cycles between 1/6 and 1 of the largest amplitude, see `sweep`.

    Args:
        maximum: largest amplitude, m.
        frequency: Hz.
        blend: cycles in which the amplitude changes, at most 0.5.
        sampling_rate: Hz.
    """
    return sweep(maximum, frequency, SWEEP_4_4, blend, sampling_rate)


def random(
    duration: float,
    band: tuple[float, float],
    seed: int,
    *,
    peak: float | None = None,
    rms: float | None = None,
    taper: float = 0.1,
    sampling_rate: float = SAMPLING_RATE,
) -> History:
    """Return Gaussian noise of even power in a band of frequencies, faded in and out.

    A seed always gives one history.

    Args:
        duration: s.
        band: lowest and highest frequency, Hz.
        peak: largest magnitude of the whole history, m; either this or `rms`.
        rms: root mean square of the whole history, m.
        taper: share of the duration at each end over which it fades (half a cosine).
        sampling_rate: Hz.

    Returns:
        Time (n,) s and displacement (n,) m, zero with zero velocity at both ends.

    Raises:
        InputError: a number is out of its range, or neither or both of `peak` and `rms` are given.
    """
    _positive(duration=duration, sampling_rate=sampling_rate)
    low, high = band
    if not 0.0 <= low < high <= 0.5 * sampling_rate:
        raise InputError(
            f"band: {low:g} Hz to {high:g} Hz is no band below half the sampling rate of {sampling_rate:g} Hz"
            " [E-PROG-03]"
        )
    if (peak is None) == (rms is None):
        raise InputError("random: either a peak or an rms is needed [E-PROG-02]")
    if not 0.0 < taper <= 0.5:
        raise InputError(f"taper: more than 0 and at most 0.5 of the duration is possible, not {taper:g} [E-PROG-02]")
    t = _times(duration, sampling_rate)
    frequencies = np.fft.rfftfreq(t.size, 1.0 / sampling_rate)
    inside = (frequencies >= low) & (frequencies <= high) & (frequencies > 0.0)
    if not inside.any():
        raise InputError(f"band: {duration:g} s are too short for a band from {low:g} Hz to {high:g} Hz [E-PROG-03]")
    generator = np.random.default_rng(seed)
    spectrum = np.zeros(frequencies.size, dtype=complex)
    parts = generator.standard_normal((2, int(inside.sum())))
    spectrum[inside] = parts[0] + 1j * parts[1]
    u = np.fft.irfft(spectrum, t.size)
    share = np.minimum(t, t[-1] - t) / (taper * t[-1])
    u *= 0.5 - 0.5 * np.cos(np.pi * np.clip(share, 0.0, 1.0))
    return t, u * (peak / np.max(np.abs(u)) if peak is not None else (rms or 0.0) / np.sqrt(np.mean(u**2)))


def from_record(
    time: ArrayLike, displacement: ArrayLike, peak: float | None = None, sampling_rate: float = SAMPLING_RATE
) -> History:
    """Sample a given displacement history anew along its cubic spline.

    Args:
        time: (n,) s, ascending.
        displacement: (n,) m.
        peak: the largest absolute displacement is scaled to it, m; None: as given.
        sampling_rate: Hz.

    Returns:
        Time (m,) s, from 0, and displacement (m,) m.

    Raises:
        InputError: the samples are no history, or a number is out of its range.
    """
    _positive(sampling_rate=sampling_rate)
    given, u = np.asarray(time, dtype=float), np.asarray(displacement, dtype=float)
    if given.ndim != 1 or given.size < 2 or given.shape != u.shape:
        raise InputError(
            f"record: {given.size} times and {u.size} displacements; at least 2 of both are needed [E-SIGNAL-01]"
        )
    if not (np.isfinite(given).all() and np.isfinite(u).all()) or np.any(np.diff(given) <= 0.0):
        raise InputError("record: times must ascend, and all numbers be finite [E-SIGNAL-02]")
    duration = float(given[-1] - given[0])
    _possible(duration, sampling_rate)
    t = np.arange(math.floor(duration * sampling_rate * (1.0 + 1e-12)) + 1) / sampling_rate
    sampled = np.asarray(scipy.interpolate.CubicSpline(given - given[0], u)(np.minimum(t, duration)), dtype=float)
    if peak is not None:
        _positive(peak=peak)
        largest = float(np.max(np.abs(sampled)))
        if largest == 0.0:
            raise InputError("record: it is zero throughout and cannot be scaled to a peak [E-SIGNAL-02]")
        sampled *= peak / largest
    return t, sampled


def _corners(ramp_up: float, cycles: float, ramp_down: float) -> tuple[list[float], list[float]]:
    """Corners of the envelope over the cycles; without a ramp it begins or ends at full height."""
    full = ramp_up + cycles
    at, height = [ramp_up, full], [1.0, 1.0]
    if ramp_up > 0.0:
        at, height = [0.0, *at], [0.0, *height]
    if ramp_down > 0.0:
        at, height = [*at, full + ramp_down], [*height, 0.0]
    return at, height


def _times(duration: float, sampling_rate: float) -> np.ndarray:
    """Samples from 0 that reach the end of the duration (the last may lie after it by a part of a sample)."""
    _possible(duration, sampling_rate)
    return np.arange(math.ceil(duration * sampling_rate * (1.0 - 1e-12)) + 1) / sampling_rate


def _possible(duration: float, sampling_rate: float) -> None:
    count = duration * sampling_rate
    if not count <= MOST_SAMPLES:
        raise InputError(
            f"{duration:g} s with {sampling_rate:g} Hz are {count:.3g} samples; at most {MOST_SAMPLES} are possible"
            " [E-PROG-01]"
        )


def _sampled(frequency: float, sampling_rate: float) -> None:
    if sampling_rate < LEAST_PER_CYCLE * frequency:
        raise InputError(
            f"frequency: {frequency:g} Hz has {sampling_rate / frequency:.3g} samples a cycle at a sampling rate of "
            f"{sampling_rate:g} Hz; at least {LEAST_PER_CYCLE} are needed [E-PROG-01]"
        )


def _smooth(x: np.ndarray) -> np.ndarray:
    """Step from 0 to 1 for x from 0 to 1, with a continuous slope."""
    s = np.clip(x, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{name}: a number greater than zero is needed, not {value:g} [E-PROG-02]")
