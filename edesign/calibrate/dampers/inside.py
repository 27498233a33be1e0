"""Forces inside a law that relaxes them all, as the MGMM: F + tau F' = everything, tau = c1/k1 (thesis Eq. 4.29)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from edesign.calibrate.dampers.trial import Motion
from edesign.core.fading import fading
from edesign.damper.law import Law

_NOTHING = 1e-9
_KEPT = 64  # motions and relaxation times
_MOMENTS = 18  # from which those of steps shorter than the relaxation are found in double precision


def relaxation_time(law: Law, values: Mapping[str, float]) -> float | None:
    """tau of a law that relaxes all of its forces, s; None: it does not."""
    return values["c1"] / values["k1"] if law.name == "mgmm" else None


def without_dashpots(law: Law, values: Mapping[str, float]) -> dict[str, float] | None:
    """Parameters of the same law without what goes with the velocity; None: it cannot be told apart.

    Of the MGMM its relaxation stays: tau = c1/k1 of a branch that is all but nothing, and k0 beside k_b, where it
    brings no tau k0 v.
    """
    if law.name == "kelvin_voigt":
        return {**values, "c": 0.0}
    if law.name != "mgmm":
        return None
    branch = {name: _NOTHING * values[name] for name in ("k1", "c1")}
    springs = {"k0": 0.0, "k_b": values["k0"] + values["k_b"]}
    return {**values, **branch, **springs, "c_NL": 0.0, "c_a": 0.0, "c_b": 0.0}


def without_power(law: Law, values: Mapping[str, float]) -> dict[str, float] | None:
    """Parameters of the same law without its dashpot of a power of the velocity; None: it has none beside others."""
    return {**values, "c_NL": 0.0} if law.name == "mgmm" else None


def relaxed_force(motion: Motion, force: np.ndarray, tau: complex) -> np.ndarray:
    """Q (n,) N with Q + tau Q' = force (n,) N, a cubic spline between samples; at rest before the first.

    A complex time constant, its real part positive, makes Q complex.
    """
    decay, begin, end, slope_begin, slope_end = _relaxing_cubics(motion, tau)
    slope = motion.spline.slopes(force)
    made = begin * force[:-1] + end * force[1:] + slope_begin * slope[:-1] + slope_end * slope[1:]
    return fading(decay, made, float(force[0]))


def swung_force(motion: Motion, force: np.ndarray, frequency: float, damping: float) -> np.ndarray:
    """Q (n,) N with Q + 2 zeta Q'/w + Q''/w^2 = force (n,) N, w = 2 pi frequency (Hz), zeta = damping below 1.

    1 / (1 + 2 zeta s/w + s^2/w^2) is twice the real part of r / (1 - s/pole) for a real force.
    """
    w = 2.0 * np.pi * frequency
    swings = w * np.sqrt(1.0 - damping**2)
    pole = complex(-damping * w, swings)
    return np.asarray((1j * w**2 / (swings * pole) * relaxed_force(motion, force, -1.0 / pole)).real)


def relaxed_factor(motion: Motion, factor: np.ndarray, force: np.ndarray, tau: float) -> np.ndarray:
    """Q (n,) N with Q + tau Q' = (factor - 1)(F + tau F'): what a factor (n,) in the law adds to its force F (n,) N.

    By parts Q = (factor - 1) F + R with R + tau R' = -tau factor' F, so that no force is differentiated; exact for
    factor and force linear between samples.
    """
    decay, begin, end = _relaxing_lines(motion, tau)
    made = np.diff(factor) * (begin * force[:-1] + end * force[1:])
    return np.asarray((factor - 1.0) * force - fading(decay, made, 0.0))


@lru_cache(maxsize=_KEPT)
def _relaxing_lines(motion: Motion, tau: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Of each step (n - 1,): what is left of R, and what the force at its beginning and end have made of a change of
    the factor by one; kept, as most searches move other parameters.
    """
    x = motion.steps / tau
    decay, mean = np.exp(-x), -np.expm1(-x) / x
    return decay, (mean - decay) / x, (1.0 - mean) / x


@lru_cache(maxsize=_KEPT)
def _relaxing_cubics(motion: Motion, tau: complex) -> tuple[np.ndarray, ...]:
    """Of each step (n - 1,): what is left of Q, and what forces and their slopes at its beginning and end make of it;
    kept, as most searches move other parameters.
    """
    x = motion.steps / tau
    decay = np.exp(-x)
    # moments m_k = x integral exp(-x (1 - s)) s^k ds over a step, k m_(k-1) = x (1 - m_k), taken in the way in which
    # errors die out
    short = np.abs(x) < 1.0
    down, up = x[short], x[~short]
    m = np.empty((4, x.size), dtype=x.dtype)
    last: np.ndarray = down / (_MOMENTS + 1.0)
    for k in range(_MOMENTS, 0, -1):
        last = down * (1.0 - last) / k
        if k <= 4:
            m[k - 1, short] = last
    last = 1.0 - decay[~short]
    for k in range(4):
        last = 1.0 - k / up * last if k else last
        m[k, ~short] = last
    rise = 3.0 * m[2] - 2.0 * m[3]
    h = motion.steps
    return decay, m[0] - rise, rise, h * (m[1] - 2.0 * m[2] + m[3]), h * (m[3] - m[2])
