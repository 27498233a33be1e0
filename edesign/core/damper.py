"""Dampers on their own: force histories under given deformation, in the C core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name
from edesign.core.stop import STOP, raise_if_stopped

Method = Literal["best", "ode", "fixed"]
Placement = Literal["whole", "inside", "springs", "dashpots"]
"""Where an effect acts: on all of the law's force, inside a law that relaxes, on its springs or dashpots alone."""
PLACEMENTS: tuple[Placement, ...] = get_args(Placement)
METHODS = {"best": lib.ED_DAMPER_BEST, "ode": lib.ED_DAMPER_ODE, "fixed": lib.ED_DAMPER_FIXED}
"""The core's number of each method."""
TOLERANCE = 1e-6
"""Relative tolerance of SUNDIALS for laws without an exact step."""


@dataclass(frozen=True)
class EffectValues:
    """An effect of a law.

    Attributes:
        name: of the effect and its form, e.g. "payne.whole".
        values: parameters in the order of the core, SI units.
        placement: where it acts. "whole": a factor on all of the law's force, a force beside it; "inside": within a
            law that relaxes all of its forces; "springs", "dashpots": a factor on what these carry of the law's force.
    """

    name: str
    values: tuple[float, ...]
    placement: Placement = "whole"


@dataclass(frozen=True)
class LawValues:
    """A damper law by its name, its parameters in the order of the core, SI units, and its effects."""

    law: str
    values: tuple[float, ...]
    effects: tuple[EffectValues, ...] = ()


def law_number(law: str) -> int:
    """Return the core's number of a law, ED_LAW_*."""
    return int(getattr(lib, f"ED_LAW_{law.upper()}"))


def effect_number(name: str) -> int:
    """Return the core's number of an effect, ED_EFFECT_*."""
    return int(getattr(lib, f"ED_EFFECT_{name.upper().replace('.', '_')}"))


def effect_remembers(name: str) -> bool:
    """Return whether the force of an effect depends on what the damper did before.

    Args:
        name: of the effect and its form, e.g. "payne.whole".

    Raises:
        AttributeError: this core has no such effect.
    """
    return bool(lib.ed_effect_remembers(effect_number(name)) == 1)


def placement_number(placement: Placement) -> int:
    """Return the core's number of a placement, ED_PLACE_*."""
    return int(getattr(lib, f"ED_PLACE_{placement.upper()}"))


class CoreDamper:
    """A damper law of the core with its parameters and effects, and a brace in series with them.

    Args:
        law: name of the law, e.g. "mgmm".
        parameters: in the order of the core, SI units.
        brace: stiffness in series, N/m; 0: rigid.
        play: of the pins of the brace, from end to end, m.
        effects: effects that the law has not; they act together.
        prior_extremes: largest and smallest deformation, m, largest and smallest velocity, m/s, that the damper went
            through before; the MGMM alone minds.

    Raises:
        CoreError: a parameter or extreme is not allowed, or the law takes no effects with a brace, or none at this
            placement.
    """

    def __init__(
        self,
        law: str,
        parameters: Sequence[float],
        brace: float = 0.0,
        effects: Sequence[EffectValues] = (),
        prior_extremes: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0),
        play: float = 0.0,
    ) -> None:
        status, message = ffi.new("int *"), ffi.new("char[256]")
        values = [float(value) for value in parameters]
        handle = lib.ed_damper_new(law_number(law), len(values), values, brace, play, status, message, 256)
        if handle == ffi.NULL:
            raise CoreError(status_name(status[0]), ffi.string(message).decode(errors="replace"))
        self._handle = ffi.gc(handle, lib.ed_damper_free)
        lib.ed_damper_ask(handle, STOP)
        if lib.ed_damper_set_prior_extremes(handle, prior_extremes) != lib.ED_OK:
            text = f"extremes {prior_extremes} are not allowed: largest at least 0, smallest at most 0, finite"
            raise CoreError("ED_E_ARGUMENT", text)
        for effect in effects:
            number, values = effect_number(effect.name), [float(value) for value in effect.values]
            place = placement_number(effect.placement)
            refused = lib.ed_damper_add_effect(handle, number, place, len(values), values, message, 256)
            if refused != lib.ED_OK:
                raise CoreError(status_name(refused), ffi.string(message).decode(errors="replace"))

    @property
    def handle(self) -> Any:
        """The core's object, for other parts of the core that move it; it lives as long as this one."""
        return self._handle

    def force(
        self,
        time: ArrayLike,
        deformation: ArrayLike,
        velocity: ArrayLike,
        method: Method = "best",
        tolerance: float = TOLERANCE,
        length: float | None = None,
    ) -> np.ndarray:
        """Return the force history from rest, the damper held at the first deformation for long before.

        Args:
            time: (n,) s, ascending.
            deformation: (n,) m.
            velocity: (n,) m/s; between samples the cubic through deformation and velocity.
            method: "best" takes the exact step where the law has one, "ode" SUNDIALS, "fixed" the exact step or
                sub-steps that the motion alone decides, so that forces are a smooth function of the parameters.
            tolerance: relative, of SUNDIALS.
            length: of a deformation in which the law changes, m, for "fixed": such as the one at yield, and the same
                for all dampers that are compared. A sub-step moves a quarter of it at most.

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
            METHODS[method],
            fineness(method, tolerance, length),
            t.size,
            ffi.from_buffer("double[]", t),
            ffi.from_buffer("double[]", u),
            ffi.from_buffer("double[]", v),
            ffi.from_buffer("double[]", result),
            done,
        )
        _check(status, "damper history", f" at sample {done[0] + 1} of {t.size}")
        return result

    def start(self) -> np.ndarray:
        """Return the state at rest, for `step`.

        Returns:
            (n,) of the law.
        """
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
        length: float | None = None,
    ) -> tuple[np.ndarray, float, tuple[float, float]]:
        """Take one step along the cubic through deformation and velocity before and after it.

        Args:
            state: (n,) of the law at its start.
            duration: s.
            before: deformation (m) and velocity (m/s) at its start.
            after: deformation (m) and velocity (m/s) at its end.
            method: as in `force`; a state goes on by the method that made it.
            tolerance: relative, of SUNDIALS.
            length: as in `force`.

        Returns:
            The state at its end, the force there (N), and its derivatives to deformation (N/m) and velocity
            (N s/m) there.
        """
        given = np.ascontiguousarray(state, dtype=float)
        trial, force, slope = np.empty_like(given), ffi.new("double *"), ffi.new("double[2]")
        status = lib.ed_damper_step(
            self._handle,
            METHODS[method],
            fineness(method, tolerance, length),
            ffi.from_buffer("double[]", given),
            duration,
            *before,
            *after,
            ffi.from_buffer("double[]", trial),
            force,
            slope,
        )
        _check(status, "damper step")
        return trial, float(force[0]), (float(slope[0]), float(slope[1]))


def fineness(method: Method, tolerance: float, length: float | None) -> float:
    """Return the settings of the core for how finely a method goes.

    Args:
        method: how a law is integrated.
        tolerance: relative, of SUNDIALS.
        length: of "fixed", m.

    Raises:
        CoreError: "fixed" without a length above 0.
    """
    if method != "fixed":
        return tolerance
    if length is None or not (length > 0.0 and np.isfinite(length)):
        text = f'length = {length} is not allowed: method "fixed" needs one, finite and above 0'
        raise CoreError("ED_E_ARGUMENT", f"damper history: {text}")
    return length


def _check(status: int, call: str, where: str = "") -> None:
    raise_if_stopped(status)
    if status != lib.ED_OK:
        text = ffi.string(lib.ed_status_text(status)).decode()
        raise CoreError(status_name(status), f"{call}: {text}{where}")
