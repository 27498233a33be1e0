"""Elastic-plastic oscillator under ground motion against an independent, event-exact integration.

Between yield events the bilinear oscillator is linear under a ground acceleration that is linear in time: solved
by the exact matrix exponential; events (yield, and velocity zero while yielding) are found by bisection to 1e-13
s. The core's Newmark must converge to it with the square of its step.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from scipy.linalg import expm
from verification.structures import channel, oscillator

from edesign.core import Bilinear

M, T, ZETA, RATIO = 1e3, 0.7, 0.03, 0.05
OMEGA = 2 * np.pi / T
K = M * OMEGA**2
FY = 0.25 * 9.81 * M * 0.5
SAMPLE, DURATION = 0.02, 8.0


def ground() -> np.ndarray:
    """A motion of three frequencies with an envelope, m/s2."""
    t = np.arange(int(round(DURATION / SAMPLE)) + 1) * SAMPLE
    envelope = np.sin(np.pi * t / DURATION)
    return envelope * (
        2.2 * np.sin(2 * np.pi * t / 0.6) + 1.2 * np.sin(2 * np.pi * t / 0.25) + np.sin(2 * np.pi * t / 1.7)
    )


def exact(motion: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement and spring force at the samples."""
    c = 2 * ZETA * OMEGA

    @cache
    def transition(k: float, h: float) -> np.ndarray:
        """Third variable: the constant term; fourth: slope times time, driven by the slope, which is the fifth."""
        B = np.zeros((5, 5))
        B[0, 1], B[1, 0], B[1, 1], B[1, 2], B[1, 3] = 1.0, -k / M, -c, 1.0, -1.0
        B[3, 4] = 1.0
        return np.asarray(expm(B * h)[:2])

    def propagate(state: np.ndarray, k: float, offset: float, g0: float, slope: float, h: float) -> np.ndarray:
        """u' = v, v' = -c v - (k u + offset)/M - g0 - slope t; over h."""
        return transition(k, h) @ np.array([state[0], state[1], -offset / M - g0, 0.0, slope])

    state, plastic, out, forces = np.zeros(2), 0.0, [0.0], [0.0]
    hardening = RATIO * K / (1 - RATIO)
    branch = 0  # 0 elastic, +1 or -1 yielding
    for g0, g1 in zip(motion[:-1], motion[1:], strict=True):
        left, start = SAMPLE, g0
        slope = (g1 - g0) / SAMPLE
        while left > 0.0:
            # spring force: elastic K (u - plastic); yielding b K u + sign (1 - b) FY
            k, offset = (K, -K * plastic) if branch == 0 else (RATIO * K, branch * (1 - RATIO) * FY)

            def event(y: np.ndarray, branch: int = branch, plastic: float = plastic) -> float:
                """Positive when the branch has been left."""
                if branch == 0:
                    return abs(K * (y[0] - plastic) - hardening * plastic) - FY
                return -branch * y[1]

            h = left
            end = propagate(state, k, offset, start, slope, h)
            # a look inside the step too, so that no short excursion is missed
            for part in np.linspace(0.1, 1.0, 10) * left:
                trial = propagate(state, k, offset, start, slope, part)
                if event(trial) > 0.0:
                    low, high = 0.0, float(part)
                    while high - low > 1e-13:
                        middle = 0.5 * (low + high)
                        if event(propagate(state, k, offset, start, slope, middle)) > 0.0:
                            high = middle
                        else:
                            low = middle
                    h, end = high, propagate(state, k, offset, start, slope, high)
                    break
            crossed = event(end) > 0.0
            if branch != 0:
                plastic = (1 - RATIO) * (end[0] - branch * FY / K)
            if crossed:
                branch = 0 if branch != 0 else int(np.sign(K * (end[0] - plastic) - hardening * plastic))
            state, start, left = end, start + slope * h, left - h
            if left < 1e-13:
                left = 0.0
        out.append(state[0])
        forces.append(K * (state[0] - plastic))
    return np.array(out), np.array(forces)


@pytest.fixture(scope="module")
def reference() -> tuple[np.ndarray, np.ndarray]:
    return exact(ground())


def core(divide: int) -> tuple[np.ndarray, np.ndarray]:
    s = oscillator(K, M, Bilinear(K, FY, RATIO))
    a = s.analysis(tolerance=1e-10)
    a.rayleigh(2 * ZETA * OMEGA, 0.0)
    motion = ground()
    fine = np.interp(np.arange((motion.size - 1) * divide + 1) / divide, np.arange(motion.size), motion)
    r = a.history(
        fine,
        SAMPLE / divide,
        channels=[channel("displacement", s.nodes[1], 0, "u"), channel("axial_force", s.elements[0], 0, "f")],
        every=divide,
    )
    assert r.status == "completed", r.reason
    return r.values["u"], r.values["f"]


def test_history(reference: tuple[np.ndarray, np.ndarray]) -> None:
    """At T/700 within 0.1 % of the peak, residual displacement included; the error falls with dt^2, events
    blurring the rate."""
    u, f = reference
    assert np.abs(u).max() > 2 * FY / K  # it yields well
    errors = []
    for divide in (5, 20):
        found_u, found_f = core(divide)
        errors.append(np.abs(found_u - u).max() / np.abs(u).max())
        if divide == 20:
            assert np.abs(found_f - f).max() < 2e-3 * np.abs(f).max()
    assert errors[-1] < 1e-3, errors
    assert errors[0] / errors[1] > 8.0, errors  # 16 for order 2
