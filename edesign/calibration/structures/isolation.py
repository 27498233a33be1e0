"""The damper law of an isolation layer as a response takes it: a linear part, and a link for the rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.calibration.structures.building import Building
from edesign.calibration.structures.record import StructureTest
from edesign.calibration.structures.response import Link
from edesign.damper.damper import Damper
from edesign.damper.laws import law as law_of

_PROBE = 1e-6  # m, in 10 ms: what a law answers to a small quick motion is its largest stiffness
_DRIFT = 0.1  # m, of an isolation layer whose drift is not measured
_TURNS = 5  # of stiffness and frequency, which depend on each other


@dataclass(frozen=True)
class IsolationLaw:
    """Force of an isolation layer: stiffness u + dashpot v + that of links.

    Attributes:
        stiffness: N/m.
        dashpot: N s/m.
        links: for what is not linear.
    """

    stiffness: float
    dashpot: float
    links: tuple[Link, ...] = ()

    @staticmethod
    def of(law: str, values: Mapping[str, float]) -> IsolationLaw:
        """Divide a law.

        Args:
            values: all parameters, SI.

        Raises:
            InputError: a parameter is out of its bounds.
        """
        complete = law_of(law).complete(values)
        if law == "kelvin_voigt":
            return IsolationLaw(complete["k"], complete["c"])
        time, u = np.linspace(0.0, 1e-2, 11), np.linspace(0.0, _PROBE, 11)
        force = Damper(law_of(law), complete).force(time, u, np.full(11, _PROBE / 1e-2))
        stiffest = float(np.max(np.abs(np.diff(force))) / (u[1] - u[0]))
        return IsolationLaw(0.0, 0.0, (Link(0, stiffest, law, tuple(complete.values())),))


def linear(building: Building, law: str, values: Mapping[str, float], tests: Sequence[StructureTest]) -> Building:
    """Return a building whose isolation layer has the secant stiffness of its law at the largest drift measured.

    Args:
        values: its parameters, SI.
    """
    divided = IsolationLaw.of(law, values)
    histories = [test.column("displacement", 0) for test in tests]
    drift = max((float(np.max(np.abs(u))) for u in histories if u is not None), default=_DRIFT)
    stiffness, dashpots, omega = building.stiffness.copy(), building.dashpots.copy(), 2.0 * np.pi
    stiffness[0], dashpots[0] = divided.stiffness, divided.dashpot
    for _ in range(_TURNS if divided.links else 0):
        stiffness[0] = _secant(Damper(law_of(law), values), drift, omega)
        omega = float(np.sqrt(max(stiffness[0], 1e-12) / building.masses.sum()))
    return replace(building, stiffness=stiffness, dashpots=dashpots)


def _secant(damper: Damper, drift: float, omega: float) -> float:
    """Return the secant stiffness, N/m, in the second of two cycles."""
    phase = np.linspace(0.0, 4.0 * np.pi, 401)
    u, v = drift * np.sin(phase), drift * omega * np.cos(phase)
    force = damper.force(phase / omega, u, v)
    return float(force[200:] @ u[200:] / (u[200:] @ u[200:]))
