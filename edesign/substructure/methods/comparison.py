"""What the tests of all methods share: a checked ground motion, and the response against the direct one."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from edesign.errors import InputError
from edesign.substructure.indicators.response_error import response_error


def checked_ground(step: float, ground: ArrayLike) -> np.ndarray:
    """Check the acceleration of the ground.

    Args:
        step: between the samples, s.
        ground: (n,) m/s2.

    Returns:
        (n,) m/s2.

    Raises:
        InputError: the step is not greater than zero, there are less than two samples, one is not finite, or the
            ground does not move.
    """
    values = np.ascontiguousarray(ground, dtype=float)
    if not 0.0 < step < math.inf:
        raise InputError(f"step: must be greater than zero, not {step:g} s [E-VALUE-02]")
    if values.ndim != 1 or values.size < 2:
        raise InputError(
            f"ground motion: needs a series of at least two samples, not the shape {values.shape} [E-SIGNAL-01]"
        )
    if not np.all(np.isfinite(values)):
        raise InputError(f"ground motion: sample {int(np.argmin(np.isfinite(values))) + 1} is not finite [E-SIGNAL-02]")
    if not np.any(values):
        raise InputError("ground motion: all samples are zero [E-SIGNAL-02]")
    return values


def positive(name: str, value: float) -> None:
    """Refuse a number that is not greater than zero and finite.

    Args:
        name: of the number, for the message.

    Raises:
        InputError: so it is; the message begins with the name.
    """
    if not 0.0 < value < math.inf:
        raise InputError(f"{name}: must be greater than zero, not {value:g} [E-VALUE-02]")


@dataclass(frozen=True, eq=False, kw_only=True)
class MethodRecord:
    """A test by any method in the time of the earthquake, beside the direct response; n samples of N, d degrees.

    Attributes:
        time: (N,) s.
        displacement: (n, d) of the structure, m.
        deformation: (n,) of the damper, m.
        damper_force: (n,) N.
        direct_displacement: (N, d) without a test, m.
        direct_deformation: (N,) of the damper, m.
        direct_force: (N,) of the damper, N.
    """

    time: np.ndarray
    displacement: np.ndarray
    deformation: np.ndarray
    damper_force: np.ndarray
    direct_displacement: np.ndarray
    direct_deformation: np.ndarray
    direct_force: np.ndarray

    @property
    def response_error(self) -> float:
        """Root mean square error of the damper's deformation over that of the direct one, dimensionless."""
        return response_error(self.deformation, self.direct_deformation)
