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
    """The frame with its dashpots in the first mode at the amplitude of the design.

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
        """Of the first mode, rad/s; nan where it does not oscillate."""
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
    """The frame of a design with what its dampers are made of.

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
        """Of the cosines with which a storey feels the coefficients of its dampers."""
        return 1.0 + self.dashpot.alpha

    def at_places(self, coefficient: np.ndarray) -> np.ndarray:
        """Coefficient of the dampers at each place (d,) of those of the storeys (s,), N (s/m)^alpha."""
        return self.building.at_places(coefficient, self.power)

    def flexibility(self, coefficient: np.ndarray) -> np.ndarray:
        """Of brace and spring of the device at each place, (d,) m/N; the spring grows with the coefficient."""
        spring = self.dashpot.c / (self.dashpot.spring * self.at_places(coefficient))
        return spring if self.brace is None else spring + 1.0 / self.building.at_places(self.brace)

    def roof(self, modes: DashpotModes, damping: float | None = None) -> float:
        """Amplitude of the first mode at the roof, m; nan: the design says none, and its dashpots are linear.

        Args:
            modes: with the dampers.
            damping: that they add to the first mode; None: that of the modes.
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
        """Peak of the first mode at the roof under an action, m, with the shape of the mode without dampers."""
        share = float(self.bare.participation[0] * self.bare.floors[0, -1])
        ratio = action.inherent_damping + (modes.first_damping if damping is None else damping)
        return abs(share) * action.displacement(modes.first_omega, min(ratio, 1.0))

    def modes(self, linear: np.ndarray, coefficient: np.ndarray) -> DashpotModes:
        """Complex modes with linear dashpots (d,) N s/m and the springs of coefficients (s,)."""
        return dashpot_modes(self.building.frame, self.bare, linear, self.flexibility(coefficient))

    def weight(self, vibration: Vibration) -> np.ndarray:
        """Linear dashpot of the energy of a coefficient of 1 at each place, at the amplitude of a vibration, (d,)."""
        if self.dashpot.alpha == 1.0:
            return np.ones(self.building.frame.n_devices)
        return linear_dashpot(1.0, self.dashpot.alpha, vibration.stroke, vibration.omega)

    def vibration(self, coefficient: np.ndarray, weight: np.ndarray, roof: Roof) -> Vibration:
        """The frame with coefficients (s,) whose dashpots have a weight (d,), at an amplitude.

        Raises:
            AnalysisError: the first mode does not oscillate.
        """
        linear = weight * self.at_places(coefficient)
        modes = self.modes(linear, coefficient)
        if modes.first is None:
            raise AnalysisError("with these dampers the first mode of the frame does not oscillate")
        return Vibration(roof(modes), linear, self.flexibility(coefficient), modes)

    def in_agreement(self, coefficient: np.ndarray, start: Vibration, roof: Roof) -> Vibration:
        """The frame with coefficients (s,), dashpots and amplitude in agreement with each other.

        Args:
            coefficient: of the storeys, N (s/m)^alpha.
            start: with other coefficients.
            roof: amplitude at the roof of modes.

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
        """The first mode without dampers, at the amplitude of a damping ratio."""
        nothing = np.zeros(self.building.frame.n_devices)
        modes = dashpot_modes(self.building.frame, self.bare, nothing, nothing)
        return Vibration(self.roof(modes, damping), nothing, nothing, modes)

    def formula(self, coefficient: np.ndarray, roof: float) -> float:
        """Damping ratio of the first mode without dampers by FEMA 356, Eq. 9-32, for coefficients (s,)."""
        bare, at_roof = self.bare, float(self.bare.floors[0, -1])
        alpha = self.dashpot.alpha
        shape, period = bare.dampers[0] / at_roof, 2.0 * math.pi / float(bare.omega[0])
        amplitude = roof if alpha < 1.0 else 1.0
        return added_damping(self.at_places(coefficient), alpha, shape, amplitude, period, 1.0 / at_roof**2)


def difference(taken: np.ndarray, found: np.ndarray) -> float:
    """Largest difference of weights from those of the amplitude that comes of them, over the latter."""
    return float(np.max(np.abs(taken - found) / found))
