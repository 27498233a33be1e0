"""A damper law at the size of the device."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.core.damper import TOLERANCE, CoreDamper, LawValues, Method


class SizedDamper(CoreDamper):
    """A damper F = scales[0] law(scales[1] u) that is moved step by step, or by a whole history.

    Args:
        scales: of force and deformation.

    Raises:
        CoreError: a parameter is not allowed.
        ValueError: a scale is not finite, or 0.
    """

    def __init__(self, law: LawValues, scales: tuple[float, float]) -> None:
        if not (np.all(np.isfinite(scales)) and np.all(scales)):
            raise ValueError(f"scales {scales} of force and deformation: finite and not 0")
        super().__init__(law.law, law.values, effects=law.effects)
        self.scales = scales

    def force(
        self,
        time: ArrayLike,
        deformation: ArrayLike,
        velocity: ArrayLike,
        method: Method = "best",
        tolerance: float = TOLERANCE,
        length: float | None = None,
    ) -> np.ndarray:
        """Return the force history of the device, as `CoreDamper.force`.

        Args:
            time: (n,) s, ascending.
            deformation: (n,) m, of the device.
            velocity: (n,) m/s, of the device.
            method: how the law is integrated.
            tolerance: relative, of SUNDIALS.
            length: of "fixed", m, of the device.

        Returns:
            (n,) N.
        """
        scale = self.scales[1]
        u, v = scale * np.asarray(deformation, dtype=float), scale * np.asarray(velocity, dtype=float)
        return self.scales[0] * super().force(time, u, v, method, tolerance, self._of_law(length))

    def step(
        self,
        state: np.ndarray,
        duration: float,
        before: tuple[float, float],
        after: tuple[float, float],
        method: Method = "best",
        tolerance: float = TOLERANCE,
        length: float | None = None,
    ) -> tuple[np.ndarray, float, tuple[float, float]]:
        """Take one step of the device, as `CoreDamper.step`.

        Args:
            state: (n,) of the law at its start.
            duration: s.
            before: deformation (m) and velocity (m/s) of the device at its start.
            after: deformation (m) and velocity (m/s) of the device at its end.
            method: how the law is integrated.
            tolerance: relative, of SUNDIALS.
            length: of "fixed", m, of the device.
        """
        force, scale = self.scales
        start, end = (scale * before[0], scale * before[1]), (scale * after[0], scale * after[1])
        found, value, (of_u, of_v) = super().step(state, duration, start, end, method, tolerance, self._of_law(length))
        return found, force * value, (force * scale * of_u, force * scale * of_v)

    def _of_law(self, length: float | None) -> float | None:
        return None if length is None else abs(self.scales[1]) * length
