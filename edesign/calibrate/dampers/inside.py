"""Forces inside a law that relaxes all of its forces, such as the MGMM: F + tau F' = everything, tau = c1/k1 (thesis Eq. 4.29)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.calibrate.dampers.drivers import fading
from edesign.calibrate.dampers.trial import Motion
from edesign.damper.law import Law


def relaxation_time(law: Law, values: Mapping[str, float]) -> float | None:
    """tau of a law that relaxes all of its forces, s; None: it does not."""
    return values["c1"] / values["k1"] if law.name == "mgmm" else None


def relaxed_force(motion: Motion, force: np.ndarray, tau: float) -> np.ndarray:
    """Q (n,) N with Q + tau Q' = force (n,) N, exact for a force linear between samples, at rest before the first."""
    x = motion.steps / tau
    decay, mean = np.exp(-x), -np.expm1(-x) / x
    made = (1.0 - mean) * force[1:] + (mean - decay) * force[:-1]
    return fading(decay, made, float(force[0]))


def before_relaxation(motion: Motion, force: np.ndarray, tau: float) -> np.ndarray:
    """F + tau F' (n,) N of a force (n,) N."""
    return np.asarray(force + tau * np.gradient(force, motion.time))
