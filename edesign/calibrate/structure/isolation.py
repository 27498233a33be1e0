"""The damper law of an isolation layer as the simulation takes it: a linear part, and a link for the rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.calibrate.structure.links import Hysteresis, LawLink, Link, Slider
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS

_SMOOTH = {"A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.0}  # of Bouc-Wen, for which steps are exact
_PROBE = 1e-6  # m, and s: what a law answers to a small quick motion is its largest stiffness


@dataclass(frozen=True)
class IsolationLaw:
    """Force of the isolation layer: stiffness u + dashpot v + that of a link.

    Attributes:
        stiffness: N/m.
        dashpot: N s/m.
        law: of the link; None: there is none.
        values: its parameters.
    """

    stiffness: float
    dashpot: float
    law: str | None = None
    values: Mapping[str, float] | None = None

    @staticmethod
    def of(law: str, values: Mapping[str, float]) -> IsolationLaw:
        """Divide a law.

        Args:
            law: its name, one of `LAWS`.
            values: all parameters, SI.
        """
        if law == "kelvin_voigt":
            return IsolationLaw(values["k"], values["c"])
        if law == "bouc_wen" and all(values[name] == number for name, number in _SMOOTH.items()):
            return IsolationLaw(values["alpha"] * values["Fy"] / values["Y"], 0.0, law, values)
        if law == "elastic_plastic":
            return IsolationLaw(values["b"] * values["k"], 0.0, law, values)
        return IsolationLaw(0.0, 0.0, law, values)

    def links(self) -> tuple[Link, ...]:
        """A new link at rest."""
        if self.law is None or self.values is None:
            return ()
        v = self.values
        if self.law == "bouc_wen" and self.stiffness:
            return (Hysteresis(0, (1.0 - v["alpha"]) * v["Fy"], v["Y"]),)
        if self.law == "elastic_plastic":
            return (Slider(0, (1.0 - v["b"]) * v["Fy"], (1.0 - v["b"]) * v["k"]),)
        damper = Damper(LAWS[self.law], v)
        return (LawLink(0, damper, _largest_stiffness(damper)),)


def equivalent(law: str, values: Mapping[str, float], drift: float, omega: float) -> float:
    """Secant stiffness (N/m) of a law at a drift (m) in steady motion of circular frequency omega (rad/s)."""
    phase = np.linspace(0.0, 4.0 * np.pi, 401)
    u, v = drift * np.sin(phase), drift * omega * np.cos(phase)
    force = Damper(LAWS[law], values).force(phase / omega, u, v)
    return float(force[200:] @ u[200:] / (u[200:] @ u[200:]))


def _largest_stiffness(damper: Damper) -> float:
    time = np.linspace(0.0, 1e-2, 11)
    u = np.linspace(0.0, _PROBE, 11)
    force = damper.force(time, u, np.full(11, _PROBE / 1e-2))
    return float(np.max(np.abs(np.diff(force))) / (u[1] - u[0]))
