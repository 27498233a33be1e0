"""Coulomb friction in the guides of the rig."""

from __future__ import annotations

from typing import ClassVar

import numpy as np

from edesign.calibrate.dampers.effect import Form
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial, Values
from edesign.calibrate.dampers.turning_points import with_turning_points
from edesign.calibrate.problem import Kind
from edesign.calibrate.unknown import Unknown
from edesign.core.fading import fading

_START = 0.03  # of the force


class _Friction(Form):
    name: ClassVar[str] = "friction"
    kind: ClassVar[Kind] = "rig"
    signature: ClassVar[str] = (
        "a force of one size against the motion: jumps at every reversal, the same at all amplitudes and frequencies"
    )

    def _force(self, sizes: Sizes) -> Unknown:
        # friction gives no energy: never below zero
        return Unknown("F_c", "N", 0.0, 0.5 * sizes.force, 0.1 * sizes.force)


class Tanh(_Friction):
    """Friction that smooths out at rest: F = F_c tanh(v / v0)."""

    form: ClassVar[str] = "tanh"
    title: ClassVar[str] = "Coulomb friction in the guides"
    source: ClassVar[str] = "Coulomb (1785); Andersson et al. (2007), Tribology International 40, 580-587, Eq. 4"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        # the slower v0, the nearer to the sign of the velocity; towards the largest velocity it is a dashpot
        v = sizes.velocity
        return (self._force(sizes), Unknown("v0", "m/s", 1e-4 * v, 0.3 * v, 0.02 * v, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((_START * sizes.force, v0 * sizes.velocity) for v0 in (0.02, 0.1, 0.002))

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray(p["F_c"] * np.tanh(motion.velocity / p["v0"]))


class Presliding(_Friction):
    """Friction that builds up over a way (Dahl): F = F_c z / x0, z' = v - |v| z / x0."""

    form: ClassVar[str] = "presliding"
    title: ClassVar[str] = "friction in the guides that builds up over a way"
    source: ClassVar[str] = "Dahl (1968), Aerospace Corp. TOR-0158(3107-18)-1; Dahl (1976), AIAA Journal 14, 1675-1682"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        # where the way is as long as the largest motion there is no sliding left: a spring and a lossy one at that
        u = sizes.displacement
        return (self._force(sizes), Unknown("x0", "m", 1e-4 * u, 0.5 * u, 0.02 * u, logarithmic=True))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((_START * sizes.force, x0 * sizes.displacement) for x0 in (0.02, 0.1))

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        """Exact: between turning points z goes exponentially over the way to +-x0, whatever the speed."""
        points, index = with_turning_points(motion)
        way = np.diff(points)
        most = self._most(p, motion, index)
        keeps = np.exp(-np.abs(way) / (p["x0"] * most))
        gains = np.sign(way) * most * (1.0 - keeps)
        return np.asarray(p["F_c"] * fading(keeps, gains, 0.0)[index])

    def _most(self, p: Values, motion: Motion, index: np.ndarray) -> np.ndarray | float:
        """What z / x0 goes to, on the ways between turning points."""
        return 1.0


class LuGre(Presliding):
    """Friction that builds up over a way and falls with speed.

    F = F_c z / x0, z' = v - |v| z / (x0 g), g = 1 + s exp(-(v/v_s)^2).
    """

    form: ClassVar[str] = "lugre"
    title: ClassVar[str] = "friction in the guides that builds up over a way and is larger near rest"
    source: ClassVar[str] = (
        "Canudas de Wit, Olsson, Astrom & Lischinsky (1995), IEEE Trans. Autom. Control 40, 419-425, without "
        "damping of the bristles"
    )

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        v = sizes.velocity
        return (
            *super().unknowns(sizes),
            Unknown("s", "", 0.0, 3.0, 1.0),
            Unknown("v_s", "m/s", 1e-3 * v, 0.5 * v, 0.1 * v, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((*row, 0.5, 0.1 * sizes.velocity) for row in super().starts(sizes))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """Without the fall with speed: s = 0."""
        return ((Presliding(), p),)

    def _most(self, p: Values, motion: Motion, index: np.ndarray) -> np.ndarray:
        at = np.full(index[-1] + 1, 1.0 + p["s"])  # at rest in the turning points between samples
        at[index] = 1.0 + p["s"] * np.exp(-((motion.velocity / p["v_s"]) ** 2))
        return 0.5 * (at[1:] + at[:-1])


class Stribeck(_Friction):
    """Friction that falls from breaking away to sliding: F = F_c (1 + s exp(-(v/v_s)^2)) tanh(10 v / v_s)."""

    form: ClassVar[str] = "stribeck"
    title: ClassVar[str] = "friction in the guides that is larger near rest"
    source: ClassVar[str] = "Armstrong-Helouvry, Dupont & Canudas de Wit (1994), Automatica 30, 1083-1138, section 2.1"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        v = sizes.velocity
        return (
            self._force(sizes),
            Unknown("s", "", 0.0, 3.0, 1.0),
            Unknown("v_s", "m/s", 1e-3 * v, 0.5 * v, 0.1 * v, logarithmic=True),
        )

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((_START * sizes.force, 0.5, v_s * sizes.velocity) for v_s in (0.1, 0.02))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """Without the fall to sliding: s = 0."""
        return ((Tanh(), {"F_c": p["F_c"], "v0": 0.1 * p["v_s"]}),)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        ratio = motion.velocity / p["v_s"]
        return np.asarray(p["F_c"] * (1.0 + p["s"] * np.exp(-(ratio**2))) * np.tanh(10.0 * ratio))


class Loaded(Tanh):
    """Friction that grows with the force F through the guides: (F_c + mu |F|) tanh(v / v0)."""

    form: ClassVar[str] = "loaded"
    title: ClassVar[str] = "friction in the guides that grows with the force"
    signature: ClassVar[str] = (
        "a force against the motion that jumps at every reversal, more at large forces than at small ones"
    )
    source: ClassVar[str] = "Coulomb (1785), the load of the guides a share of the damper's force"

    def unknowns(self, sizes: Sizes) -> tuple[Unknown, ...]:
        return (*super().unknowns(sizes), Unknown("mu", "", 0.0, 0.5, 0.1))

    def starts(self, sizes: Sizes) -> tuple[tuple[float, ...], ...]:
        return tuple((0.3 * size, v0, _START) for size, v0 in super().starts(sizes))

    def simpler(self, p: Values) -> tuple[tuple[Form, Values], ...]:
        """Without the share of the load: mu = 0."""
        return ((Tanh(), p),)

    def carriage(self, p: Values, trial: Trial, motion: Motion, force: np.ndarray) -> np.ndarray:
        return np.asarray((p["F_c"] + p["mu"] * np.abs(force)) * np.tanh(motion.velocity / p["v0"]))


FORMS = (Tanh, Presliding, Stribeck, LuGre, Loaded)
