"""What force histories show without any law: equivalent stiffness and damping of every test."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.damper.fitting.loading import Loading
from edesign.damper.fitting.scales import Scales


@dataclass(frozen=True)
class Observed:
    """Linear equivalents of tests, and the sizes in all of them.

    Attributes:
        omega: mean circular frequency of every test (n,), rad/s.
        complex_stiffness: k + i omega c of the least squares of F on u and v, every test (n,), N/m.
        scales: sizes of force, deformation, velocity.
        largest_force: of all tests, N.
    """

    omega: np.ndarray
    complex_stiffness: np.ndarray
    scales: Scales
    largest_force: float


def observe(loadings: Sequence[Loading], scales: Scales) -> Observed:
    """Return linear equivalents of tests (F = k u + c v).

    Args:
        scales: sizes of force, deformation and velocity.
    """
    omega, stiffness = [], []
    for loading in loadings:
        basis = np.column_stack((loading.displacement, loading.velocity))
        size = np.maximum(np.linalg.norm(basis, axis=0), 1e-300)
        k, c = np.linalg.lstsq(basis / size, loading.force, rcond=None)[0] / size
        frequency = 2.0 * np.pi * loading.frequency
        omega.append(frequency)
        stiffness.append(complex(k, frequency * c))
    largest = max(float(np.max(np.abs(loading.force))) for loading in loadings)
    return Observed(np.array(omega), np.array(stiffness), scales, largest)
