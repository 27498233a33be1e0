"""Rests of a motion: where it moves by no more than noise, it stands still."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from edesign.calibration.dampers.motion import Motion
from edesign.calibration.signals.interpolation import CUBIC

_STRAYS = 2.0  # standard deviations of the noise, within which a motion at rest stays
_GENTLE = 0.01  # of the rms acceleration: with less, a motion that turns is as good as one that rests meanwhile
_FEWEST = 32  # samples: of a motion that turns and strays that far, they show a bend that is beyond noise
_SURE = 3.0  # standard deviations, beyond which something is none of noise
_PARTS = 8  # of a rest, by which an end is cut that creeps; half of a rest must be left
_NORMAL = 1.4826  # standard deviation over the median of the absolute value


def at_rest(motion: Motion) -> np.ndarray:
    """Return whether samples (n,) are of a rest in which a motion was held."""
    return np.asarray((motion.velocity == 0.0) & (motion.acceleration == 0.0))


def held(motion: Motion, measured: np.ndarray, noise: float) -> Motion:
    """Return a motion that stands still in its rests.

    What smoothing leaves of the noise is a small velocity, of which a law of a low power of the velocity makes a force
    in each rest. A rest stays within noise for longer than a motion does that turns, however gently. It ends where the
    velocity goes beyond what noise makes of it there, and what is left neither creeps nor bends beyond noise. The
    displacement in a rest is the mean of its samples, and what that changes is made up for between rests.

    Args:
        motion: freed of noise.
        measured: (n,) m, its displacement with noise.
        noise: standard deviation of white noise as strong next to the motion, m.
    """
    if motion.cornered or motion.degree != CUBIC or noise == 0.0:
        return motion
    time, gentle = motion.time, _GENTLE * float(np.sqrt(np.mean(motion.acceleration**2)))
    longest = math.sqrt(8.0 * _STRAYS * noise / max(gentle, 1e-300))
    wide = max(round(longest / float(np.median(motion.steps))), _FEWEST)
    if wide >= time.size:
        return motion
    strayed = maximum_filter1d(motion.displacement, wide) - minimum_filter1d(motion.displacement, wide)
    slow = maximum_filter1d((strayed <= _STRAYS * noise).astype(np.int8), wide)
    slow[: wide // 2] |= slow[wide // 2]  # a spline has the ends of a record on one side only
    slow[-(wide // 2) :] |= slow[-(wide // 2) - 1]
    rests, levels = np.zeros(time.size, dtype=bool), list[tuple[int, float]]()
    for each in np.flatnonzero(np.diff(slow, prepend=0, append=0)).reshape(-1, 2).tolist():
        first, last = _standing(measured, noise, *_within(motion.velocity, *each))
        if first < last:
            rests[first:last] = True
            levels += [(one, float(np.mean(measured[first:last]))) for one in (first, last - 1)]
    if not levels:
        return motion
    at, level = np.array([one for one, _ in levels]), np.array([one for _, one in levels])
    moved = np.interp(time, time[at], level - motion.displacement[at])
    return replace(
        motion,
        displacement=np.where(rests, np.interp(time, time[at], level), motion.displacement + moved),
        velocity=np.where(rests, 0.0, motion.velocity + np.gradient(moved, time)),
        acceleration=np.where(rests, 0.0, motion.acceleration),
    )


def _within(velocity: np.ndarray, first: int, last: int) -> tuple[int, int]:
    """Return the first sample of a rest and the one after its last: its ends are where it begins to move.

    Args:
        velocity: (n,) m/s.
        first, last: of the samples among which they are; the ends of a record are none at which it begins to move.
    """
    speed = np.abs(velocity[first:last])
    still = np.flatnonzero(speed <= _SURE * _NORMAL * float(np.median(speed)))
    begin = first if first == 0 else first + int(still[0])
    return begin, last if last == velocity.size else first + int(still[-1]) + 1


def _standing(measured: np.ndarray, noise: float, first: int, last: int) -> tuple[int, int]:
    """Return the samples of a rest without an end that creeps: none if what is left creeps or bends beyond noise.

    Args:
        measured: (n,) m, evenly sampled.
        noise: of white noise, m.
        first, last: of the samples among which they are.
    """
    least = max(_FEWEST, (last - first) // 2)
    while last - first >= least:
        part = measured[first:last]
        ways, _ = np.linalg.qr(np.vander(np.linspace(-1.0, 1.0, part.size), 3, increasing=True))
        if np.all(np.abs(ways[:, 1:].T @ part) <= _SURE * noise):
            return first, last
        cut = part.size // _PARTS
        begin, end = (abs(float(np.mean(one) - np.median(part))) for one in (part[:cut], part[-cut:]))
        first, last = (first + cut, last) if begin > end else (first, last - cut)
    return first, first
