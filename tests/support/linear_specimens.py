"""Complex stiffness of specimens without a law of a damper: spring, dashpot and mass; a spring with loss."""

from __future__ import annotations

import numpy as np

from edesign.substructure.stability.whole import ComplexStiffness


def linear_specimen(stiffness: float, damping: float = 0.0, mass: float = 0.0) -> ComplexStiffness:
    """Spring, N/m, with a dashpot, N s/m, and a mass, kg, that moves with the interface: k + i c w - m w^2."""
    return lambda omega: np.asarray(stiffness + 1j * damping * omega - mass * omega**2)


def complex_spring(stiffness: float, loss_factor: float) -> ComplexStiffness:
    """k (1 + i n) at every frequency; stiffness in N/m."""
    return lambda omega: np.full(np.shape(omega), stiffness * (1.0 + 1j * loss_factor))
