"""Dampers on their own: force histories under given deformation, in the C core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name

Method = Literal["best", "ode"]
_METHODS = {"best": lib.ED_DAMPER_BEST, "ode": lib.ED_DAMPER_ODE}
TOLERANCE = 1e-6
"""Relative tolerance of SUNDIALS for laws without an exact step."""


@dataclass(frozen=True)
class LawValues:
    """A damper law by its name, and its parameters in the order of the core, SI units."""

    law: str
    values: tuple[float, ...]


def law_number(law: str) -> int:
    """The core's number of a law, ED_LAW_*."""
    return int(getattr(lib, f"ED_LAW_{law.upper()}"))


class CoreDamper:
    """A damper law of the core with its parameters, and a brace in series.

    Args:
        law: name of the law, e.g. "mgmm".
        parameters: in the order of the core, SI units.
        brace: stiffness in series, N/m; 0: rigid.

    Raises:
        CoreError: a parameter is not allowed.
    """

    def __init__(self, law: str, parameters: Sequence[float], brace: float = 0.0) -> None:
        status, message = ffi.new("int *"), ffi.new("char[256]")
        values = [float(value) for value in parameters]
        handle = lib.ed_damper_new(law_number(law), len(values), values, brace, status, message, 256)
        if handle == ffi.NULL:
            raise CoreError(status_name(status[0]), ffi.string(message).decode(errors="replace"))
        self._handle = ffi.gc(handle, lib.ed_damper_free)

    def force(
        self,
        time: ArrayLike,
        deformation: ArrayLike,
        velocity: ArrayLike,
        method: Method = "best",
        tolerance: float = TOLERANCE,
    ) -> np.ndarray:
        """Force history from rest, the damper held at the first deformation for long before.

        Args:
            time: (n,) s, ascending.
            deformation: (n,) m.
            velocity: (n,) m/s; between samples the cubic through deformation and velocity.
            method: "best" takes the exact step where the law has one, "ode" SUNDIALS.
            tolerance: relative, of SUNDIALS.

        Returns:
            Force (n,) N.

        Raises:
            CoreError: samples that are not finite or not ascending, or the law did not converge.
        """
        t, u, v = (np.ascontiguousarray(values, dtype=float).ravel() for values in (time, deformation, velocity))
        if not t.size == u.size == v.size >= 1:
            raise ValueError(f"{t.size} times, {u.size} deformations, {v.size} velocities")
        result, done = np.empty_like(t), ffi.new("int *")
        status = lib.ed_damper_history(
            self._handle,
            _METHODS[method],
            tolerance,
            t.size,
            ffi.from_buffer("double[]", t),
            ffi.from_buffer("double[]", u),
            ffi.from_buffer("double[]", v),
            ffi.from_buffer("double[]", result),
            done,
        )
        if status != lib.ED_OK:
            text = ffi.string(lib.ed_status_text(status)).decode()
            raise CoreError(status_name(status), f"damper history: {text} at sample {done[0] + 1} of {t.size}")
        return result

    def start(self) -> np.ndarray:
        """State at rest, for `step`."""
        state = np.zeros(lib.ed_damper_state_size(self._handle))
        lib.ed_damper_start(self._handle, ffi.from_buffer("double[]", state))
        return state

    def step(
        self,
        state: np.ndarray,
        duration: float,
        before: tuple[float, float],
        after: tuple[float, float],
        method: Method = "best",
        tolerance: float = TOLERANCE,
    ) -> tuple[np.ndarray, float, tuple[float, float]]:
        """One step from `state` along the cubic through (deformation, velocity) before and after.

        Returns:
            The state at its end, the force there (N), and its derivatives to deformation (N/m) and velocity
            (N s/m) there.
        """
        given = np.ascontiguousarray(state, dtype=float)
        trial, force, slope = np.empty_like(given), ffi.new("double *"), ffi.new("double[2]")
        status = lib.ed_damper_step(
            self._handle,
            _METHODS[method],
            tolerance,
            ffi.from_buffer("double[]", given),
            duration,
            *before,
            *after,
            ffi.from_buffer("double[]", trial),
            force,
            slope,
        )
        if status != lib.ED_OK:
            raise CoreError(status_name(status), f"damper step: {ffi.string(lib.ed_status_text(status)).decode()}")
        return trial, float(force[0]), (float(slope[0]), float(slope[1]))
