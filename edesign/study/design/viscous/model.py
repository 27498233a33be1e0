"""A frame in the first mode with viscous dampers as the linear dashpots of the same energy at its amplitude."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from edesign.damper.dashpot import Dashpot, added_damping, linear_dashpot
from edesign.errors import AnalysisError
from edesign.project.dampers.designs import BraceRatio, DriftAmplitude, RoofAmplitude, ViscousDesign
from edesign.study.design.building import Building
from edesign.study.design.estimate import Action
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS, Relaxation
from edesign.study.design.viscous.dashpot_modes import DashpotModes, dashpot_modes

Roof = Callable[[DashpotModes], float]
"""Amplitude at the roof (m) in the first of modes with dampers."""


@dataclass(frozen=True)
class Vibration:
    """A vibration of the frame in its first mode with the equivalent linear dashpots of its dampers.

    Attributes:
        roof: amplitude at the roof, m; nan: of no account, the dashpots are linear.
        linear: the linear dashpot of the same energy at each place, (d,) N s/m.
        flexibility: of the springs in series at each place, (d,) m/N.
        modes: with these.
    """

    roof: float
    linear: np.ndarray
    flexibility: np.ndarray
    modes: DashpotModes

    @property
    def omega(self) -> float:
        """Circular frequency of the first mode, rad/s; nan where the mode does not oscillate."""
        return self.modes.first_omega

    @property
    def stroke(self) -> np.ndarray:
        """Amplitude of the dashpots' deformation, (d,) m."""
        assert self.modes.first is not None
        return self.roof * self.modes.dashpots[self.modes.first]

    @property
    def deformation(self) -> np.ndarray:
        """Amplitude of the deformation of dashpots and their springs together, (d,) m."""
        return self.stroke * np.abs(1.0 + 1.0j * self.omega * self.linear * self.flexibility)


class ViscousFrame:
    """The frame of a design with viscous dampers and their braces.

    Args:
        building: the frame with its places.
        spec: the design.
        dashpot: that the law of the design is.
        action: the spectrum; None: there is none.
    """

    def __init__(self, building: Building, spec: ViscousDesign, dashpot: Dashpot, action: Action | None) -> None:
        self.building, self.spec, self.dashpot, self.action = building, spec, dashpot, action
        self.bare = building.frame.modes()
        ratio = spec.brace.ratio if isinstance(spec.brace, BraceRatio) else None
        self.brace = None if ratio is None else ratio * building.designed_stiffness

    @property
    def power(self) -> float:
        """The power of the cosine with which a damper's coefficient adds to that of its storey, 1 + alpha."""
        return 1.0 + self.dashpot.alpha

    def at_places(self, coefficient: np.ndarray) -> np.ndarray:
        """Return the coefficient of the dampers at each place, (d,) N (s/m)^alpha.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        """
        return self.building.at_places(coefficient, self.power)

    def flexibility(self, coefficient: np.ndarray) -> np.ndarray:
        """Return the flexibility of brace and internal spring in series at each place, (d,) m/N.

        The stiffness of the internal spring is in proportion to the coefficient.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        """
        spring = self.dashpot.c / (self.dashpot.spring * self.at_places(coefficient))
        return spring if self.brace is None else spring + 1.0 / self.building.at_places(self.brace)

    def roof(self, modes: DashpotModes, damping: float | None = None) -> float:
        """Return the amplitude of the first mode at the roof, m; nan where linear dashpots need none.

        Args:
            modes: complex modes with the dampers.
            damping: damping ratio that the dampers add to the first mode; None: that of the modes.
        """
        amplitude = self.spec.amplitude
        if isinstance(amplitude, RoofAmplitude):
            return amplitude.roof_displacement
        assert modes.first is not None
        if isinstance(amplitude, DriftAmplitude):
            drifts = np.abs(np.diff(modes.floors[modes.first], prepend=0.0)) / self.building.heights
            return amplitude.drift / float(drifts.max())
        return math.nan if self.action is None else self.spectral_roof(modes, self.action, damping)

    def spectral_roof(self, modes: DashpotModes, action: Action, damping: float | None = None) -> float:
        """Return the peak of the first mode at the roof under an action, m, with the shape of the mode without dampers.

        Args:
            modes: complex modes with the dampers.
            action: spectrum, and damping ratio of the frame without dampers.
            damping: damping ratio that the dampers add to the first mode; None: that of the modes.
        """
        share = float(self.bare.participation[0] * self.bare.floors[0, -1])
        ratio = action.inherent_damping + (modes.first_damping if damping is None else damping)
        return abs(share) * action.displacement(modes.first_omega, min(ratio, 1.0))

    def modes(self, linear: np.ndarray, coefficient: np.ndarray) -> DashpotModes:
        """Return the complex modes of the frame with linear dashpots and the springs in series with them.

        Args:
            linear: coefficient of the linear dashpot at each place, (d,) N s/m.
            coefficient: of all dampers of each storey, on which the internal springs depend, (s,) N (s/m)^alpha.
        """
        return dashpot_modes(self.building.frame, self.bare, linear, self.flexibility(coefficient))

    def weight(self, vibration: Vibration) -> np.ndarray:
        """Return the equivalent linear dashpot of a unit coefficient at each place, (d,) (s/m)^(1 - alpha).

        Both dissipate the same energy in a cycle of the vibration.

        Args:
            vibration: with the stroke of each dashpot and the circular frequency.
        """
        if self.dashpot.alpha == 1.0:
            return np.ones(self.building.frame.n_devices)
        return linear_dashpot(1.0, self.dashpot.alpha, vibration.stroke, vibration.omega)

    def vibration(self, coefficient: np.ndarray, weight: np.ndarray, roof: Roof) -> Vibration:
        """Return the vibration of the frame in the first mode with given equivalent linear dashpots.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            weight: equivalent linear dashpot of a unit coefficient at each place, (d,).
            roof: gives the amplitude at the roof, m, for complex modes.

        Raises:
            AnalysisError: the first mode does not oscillate.
        """
        linear = weight * self.at_places(coefficient)
        modes = self.modes(linear, coefficient)
        if modes.first is None:
            raise AnalysisError("with these dampers the first mode of the frame does not oscillate")
        return Vibration(roof(modes), linear, self.flexibility(coefficient), modes)

    def in_agreement(self, coefficient: np.ndarray, start: Vibration, roof: Roof) -> Vibration:
        """Iterate until the equivalent linear dashpots agree with the amplitude of the first mode.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            start: a vibration with other coefficients, whose dashpots are the first trial.
            roof: gives the amplitude at the roof, m, for complex modes.

        Returns:
            The vibration of the frame.

        Raises:
            AnalysisError: they do not agree, or the first mode does not oscillate.
        """
        weight, relax = self.weight(start), Relaxation()
        for _ in range(MOST_ITERATIONS):
            found = self.vibration(coefficient, weight, roof)
            following = self.weight(found)
            if difference(weight, following) <= AGREEMENT:
                return found
            weight = np.exp(relax(np.log(weight), np.log(following)))
        raise AnalysisError(f"amplitude and dashpots did not agree to {AGREEMENT:g} in {MOST_ITERATIONS} iterations")

    def undamped(self, damping: float) -> Vibration:
        """Return the first mode without dampers at the amplitude that belongs to a damping ratio.

        Args:
            damping: damping ratio added to that of the frame.
        """
        nothing = np.zeros(self.building.frame.n_devices)
        modes = dashpot_modes(self.building.frame, self.bare, nothing, nothing)
        return Vibration(self.roof(modes, damping), nothing, nothing, modes)

    def formula(self, coefficient: np.ndarray, roof: float) -> float:
        """Return the damping ratio of the first mode without dampers by FEMA 356, Eq. 9-32.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            roof: amplitude at the roof, m; it does not matter for linear dashpots.
        """
        bare, at_roof = self.bare, float(self.bare.floors[0, -1])
        alpha = self.dashpot.alpha
        shape, period = bare.dampers[0] / at_roof, 2.0 * math.pi / float(bare.omega[0])
        amplitude = roof if alpha < 1.0 else 1.0
        return added_damping(self.at_places(coefficient), alpha, shape, amplitude, period, 1.0 / at_roof**2)


def difference(taken: np.ndarray, found: np.ndarray) -> float:
    """Return the largest relative difference between assumed and resulting equivalent linear dashpots.

    Args:
        taken: assumed dashpots of a unit coefficient, (d,).
        found: those at the amplitude that follows, (d,).
    """
    return float(np.max(np.abs(taken - found) / found))
