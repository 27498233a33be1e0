"""The loop along the imaginary axis on a grid that resolves it, and the count of its unstable roots."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.errors import InputError
from edesign.substructure.stability.loop import Loop

EVEN_POINTS = 2000
"""Even steps up to the last frequency; a delay must turn by less than half a turn in each."""
BANDWIDTHS = np.linspace(-4.0, 4.0, 33)
"""Points about each resonance, in half bandwidths."""
NARROWEST = 1e-4
"""Damping ratio of a resonance that is still resolved from the start; narrower ones have no bandwidth of their own."""
TAIL_DECADES = 6
TAIL_POINTS = 200
"""Decades above the highest mode that are searched for the end of the loop, and points in each."""
CONTRACTIVE = 0.99
"""Instead of 1: what two samples of the tail may miss between them."""
LARGEST_CHANGE = 0.3
"""Of R and of L between two frequencies, over the smaller: an angle of 0.3 rad."""
GAIN_OF_INTEREST = 20.0
"""Where L or 1/L is larger, it is not resolved: no gain margin is that wide."""
CLOSEST = 1e-10
"""Least step over the frequency: poles and zeros on the axis are not resolved further."""
ROUNDS = 60
"""Halvings of one interval; rounding ends them before."""


@dataclass(frozen=True)
class Sweep:
    """The loop at s = i omega.

    Attributes:
        omega: (m,), rad/s, rising from 0.
        transfer: L, (m,).
        ratio: R, (m,).
        bounded: above the last frequency the loop cannot enclose -1; False: it may, at ever higher frequencies.
    """

    omega: np.ndarray
    transfer: np.ndarray
    ratio: np.ndarray
    bounded: bool

    @property
    def unstable_roots(self) -> int:
        """Roots in the right half plane, a pair counted twice, without those far above the last frequency.

        R has no pole there, as structure and rig are stable by themselves: R goes round 0 half a turn, clockwise, for
        each (principle of the argument, Nyquist 1932). R begins on the real axis, which a complex spring misses
        somewhat, and ends at 1.
        """
        start, end = complex(self.ratio[0]), complex(self.ratio[-1])
        begins = float(np.angle(start if start.real > 0.0 else -start))
        angle = begins + float(np.sum(np.angle(self.ratio[1:] / self.ratio[:-1]))) - float(np.angle(end))
        return round(-angle / np.pi)


def sweep(loop: Loop, highest_frequency: float | None = None) -> Sweep:
    """Sweep the loop from frequency zero to where it has faded.

    Args:
        loop: with its rig and compensator.
        highest_frequency: Hz, at which it ends whatever is above, such as half the rate of a sampled loop; None: the
            end is sought.

    Raises:
        InputError: a mode of the structure does not decay, or a part of the loop is not finite at a frequency, which is
            named.
    """
    whole = loop.whole
    resonances = np.array([*(mode.root for mode in whole.modes if np.isfinite(mode.root)), *whole.numerical_roots])
    top = max(float(np.max(np.abs(resonances), initial=0.0)), max(mode.omega for mode in whole.modes))
    end, bounded = _end(loop, top) if highest_frequency is None else (2.0 * np.pi * highest_frequency, True)
    if end not in whole.swept:
        omega = first_grid(resonances, end)
        whole.swept[end] = omega, whole.specimen_share(1j * omega)
    omega, share = whole.swept[end]
    omega, values = refined(omega, _values(loop, omega, share), lambda at: _values(loop, at), _too_far)
    return Sweep(omega, values[0], values[1], bounded)


def refined(
    omega: np.ndarray,
    values: np.ndarray,
    function: Callable[[np.ndarray], np.ndarray],
    too_far: Callable[[np.ndarray], np.ndarray],
) -> tuple[np.ndarray, np.ndarray]:
    """Return a grid that resolves a function of frequency, rad/s, and its values there.

    Args:
        omega: (m,) to begin with, rising.
        values: (k, m) there.
        function: values at further frequencies.
        too_far: whether they change too much from each frequency to the next, (m - 1,).

    Returns:
        Frequencies, rad/s, rising, and values (k, m) there.
    """
    for _ in range(ROUNDS):
        coarse = np.nonzero(too_far(values) & (np.diff(omega) > CLOSEST * omega[1:]))[0]
        if not coarse.size:
            break
        between = 0.5 * (omega[coarse] + omega[coarse + 1])
        values = np.insert(values, coarse + 1, function(between), axis=1)
        omega = np.insert(omega, coarse + 1, between)
    return omega, values


def first_grid(resonances: np.ndarray, end: float) -> np.ndarray:
    """Return even steps and points about each resonance, rad/s, from 0 to the end.

    Args:
        resonances: (k,) roots, 1/s.
        end: rad/s.

    Returns:
        (m,) rad/s, rising.
    """
    half_width = np.maximum(np.abs(resonances.real), NARROWEST * np.abs(resonances))
    about = (resonances.imag[:, None] + half_width[:, None] * BANDWIDTHS).ravel()
    grid = np.unique(np.concatenate([np.linspace(0.0, end, EVEN_POINTS + 1), about]))
    return np.asarray(grid[(grid >= 0.0) & (grid <= end)])


def _values(loop: Loop, omega: np.ndarray, share: np.ndarray | None = None) -> np.ndarray:
    """L and R, (2, m); the share of the specimen there may be known.

    Raises:
        InputError: not finite.
    """
    s = 1j * omega
    share = loop.whole.specimen_share(s) if share is None else share
    actuation = loop.actuation(s)
    ratio = 1.0 + (actuation - 1.0) * share
    if not np.all(np.isfinite(ratio)):
        first = omega[~np.isfinite(ratio)][0] / (2.0 * np.pi)
        raise InputError(f"rig, compensator or specimen has no finite transfer function at {first:.4g} Hz [E-RIG-04]")
    over, under = loop.parts(actuation, share, s)
    with np.errstate(divide="ignore", invalid="ignore"):  # all of the stiffness is the specimen's: L is infinite at 0
        return np.array([over / under, ratio])


def _too_far(values: np.ndarray) -> np.ndarray:
    """Say whether L or R changes too much from each frequency to the next, (m - 1,)."""
    size = np.abs(values)
    with np.errstate(invalid="ignore"):
        change = np.abs(np.diff(values, axis=1)) > LARGEST_CHANGE * np.minimum(size[:, 1:], size[:, :-1])
    smaller, larger = (pick(size[0, 1:], size[0, :-1]) for pick in (np.minimum, np.maximum))
    asked = (larger > 1.0 / GAIN_OF_INTEREST) & (smaller < GAIN_OF_INTEREST)
    return np.asarray((change[0] & asked) | change[1])


def _end(loop: Loop, top: float) -> tuple[float, bool]:
    """Frequency, rad/s, above which the loop cannot enclose -1, and whether there is one.

    Above it |L| < 1, as with the circle criterion, or |R - 1| < 1. A specimen of more mass than the numerical part has
    none under a delay: its difference equation is unstable by itself. Then the sweep ends above the modes.
    """
    omega = top * np.logspace(0.0, TAIL_DECADES, TAIL_DECADES * TAIL_POINTS + 1)
    transfer, ratio = _values(loop, omega)
    for limit in (1.0 / GAIN_OF_INTEREST, CONTRACTIVE):
        quiet = np.minimum(np.abs(transfer), np.abs(ratio - 1.0)) < limit
        above = np.nonzero(~quiet)[0]
        start = int(above[-1]) + 1 if above.size else 0
        if start < omega.size - TAIL_POINTS:  # a whole decade is quiet, which chance is not
            return 2.0 * float(omega[start]), True
    return 2.0 * top, False
