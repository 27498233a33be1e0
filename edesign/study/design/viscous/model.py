"""A frame in the first mode with viscous dampers as the linear dashpots of the same energy at its amplitude."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.damper.dashpot import Dashpot, added_damping, linear_dashpot
from edesign.errors import AnalysisError
from edesign.project.dampers.designs import ViscousDesign
from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.device_model import DeviceModel
from edesign.study.design.estimate import Action, SpectralPeaks
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS, Relaxation
from edesign.study.design.viscous.dashpot_modes import DashpotModes, dashpot_modes


@dataclass(frozen=True)
class Dashpots:
    """Viscous dampers as the linear dashpots of the same energy, with springs in series.

    Attributes:
        coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        linear: the linear dashpot of the same energy at each place, (d,) N s/m.
        flexibility: of the springs in series at each place, (d,) m/N.
        omega: circular frequency at which the springs' stiffness counts, that of the first mode, rad/s; nan where it
            does not oscillate.
    """

    coefficient: np.ndarray
    linear: np.ndarray
    flexibility: np.ndarray
    omega: float

    def stiffness(self, omega: float | np.ndarray) -> np.ndarray:
        """Return the complex stiffness of dashpots and springs in series, N/m.

        Args:
            omega: circular frequency, rad/s; a column (n, 1) gives (n, d).
        """
        damper = 1.0j * omega * self.linear
        return np.asarray(damper / (1.0 + damper * self.flexibility))


@dataclass(frozen=True)
class Vibration(Dashpots):
    """A vibration of the frame in its first mode with the equivalent linear dashpots of its dampers.

    Attributes:
        roof: amplitude at the roof, m; nan: of no account, the dashpots are linear.
        modes: with these.
    """

    roof: float
    modes: DashpotModes

    @property
    def stroke(self) -> np.ndarray:
        """Amplitude of the dashpots' deformation, (d,) m."""
        assert self.modes.first is not None
        return self.roof * self.modes.first.dashpots

    @property
    def deformation(self) -> np.ndarray:
        """Amplitude of the deformation of dashpots and their springs together, (d,) m."""
        return self.stroke * np.abs(1.0 + 1.0j * self.omega * self.linear * self.flexibility)


@dataclass(frozen=True)
class ViscousStep:
    """One step of the iteration of amplitude and dashpots.

    Attributes:
        vibration: with the dashpots of this step.
        difference: largest one of a linear dashpot from that of the amplitude that comes of it, over the latter.
    """

    vibration: Vibration
    difference: float


class ViscousModel(DeviceModel[ViscousDesign, Dashpots]):
    """Viscous dampers and their braces in the frame of a design.

    Args:
        building: the frame with its places.
        dashpot: that the law of the design is.
        action: the spectrum; None: there is none.
    """

    def __init__(self, building: Building, spec: ViscousDesign, dashpot: Dashpot, action: Action | None) -> None:
        super().__init__(building, spec, action)
        self.dashpot, self.power = dashpot, 1.0 + dashpot.alpha

    def flexibility(self, coefficient: np.ndarray) -> np.ndarray:
        """Return the flexibility of brace and internal spring in series at each place, (d,) m/N.

        The stiffness of the internal spring is in proportion to the coefficient.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        """
        spring = self.dashpot.c / (self.dashpot.spring * self.at_places(coefficient))
        return spring if self.braces is None else spring + 1.0 / self.braces

    def roof(self, modes: DashpotModes, action: Action | None = None, damping: float | None = None) -> float:
        """Return the amplitude of the first mode at the roof, m; under an action with the shape of the bare mode.

        Args:
            modes: complex modes with the dampers.
            action: whose spectrum gives the amplitude; None: what the design says.
            damping: damping ratio that the dampers add to the first mode; None: that of the modes.
        """
        assert modes.first is not None
        share = self.bare.lead.participation * float(self.bare.lead.floors[-1])
        added = (modes.first_damping if damping is None else damping) + self.bare.first_beside_damping
        return self.roof_amplitude(modes.first.roof, modes.first.storeys, share, modes.first_omega, added, action)

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

    def vibration(self, coefficient: np.ndarray, weight: np.ndarray, action: Action | None = None) -> Vibration:
        """Return the vibration of the frame in the first mode with given equivalent linear dashpots.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            weight: equivalent linear dashpot of a unit coefficient at each place, (d,).
            action: whose spectrum gives the amplitude; None: what the design says.

        Raises:
            AnalysisError: the first mode does not oscillate.
        """
        linear = weight * self.at_places(coefficient)
        modes = self.modes(linear, coefficient)
        if modes.first is None:
            raise AnalysisError("with these dampers the first mode of the frame does not oscillate [E-DESIGN-02]")
        roof = self.roof(modes, action)
        return Vibration(coefficient, linear, self.flexibility(coefficient), modes.first_omega, roof, modes)

    def iterate(
        self, size: Callable[[np.ndarray, float], np.ndarray], start: Vibration, action: Action | None = None
    ) -> tuple[list[ViscousStep], str]:
        """Iterate until the equivalent linear dashpots agree with the amplitude of the first mode.

        Args:
            size: coefficients of the storeys (s,) for dashpots of a weight (d,) and a first frequency (rad/s).
            start: a vibration with other coefficients, whose dashpots are the first trial.
            action: whose spectrum gives the amplitude; None: what the design says.

        Returns:
            The steps, and why the last does not agree; empty if it does.

        Raises:
            AnalysisError: the first mode does not oscillate.

        Source: equivalent linear dashpots, Constantinou and Symans (1993).
        """
        weight, omega, relax = self.weight(start), start.omega, Relaxation()
        steps: list[ViscousStep] = []
        while len(steps) < MOST_ITERATIONS:
            vibration = self.vibration(size(weight, omega), weight, action)
            found, omega = self.weight(vibration), vibration.omega
            steps.append(ViscousStep(vibration, float(np.max(np.abs(weight - found) / found))))
            if steps[-1].difference <= AGREEMENT:
                return steps, ""
            weight = np.exp(relax(np.log(weight), np.log(found)))
        return steps, f"amplitude and dashpots did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations"

    def in_agreement(self, coefficient: np.ndarray, start: Vibration, action: Action | None = None) -> Vibration:
        """Return the vibration of the frame with dampers of given coefficients.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            action: whose spectrum gives the amplitude; None: what the design says.

        Raises:
            AnalysisError: amplitude and dashpots do not agree, or the first mode does not oscillate.
        """
        steps, reason = self.iterate(lambda weight, omega: coefficient, start, action)
        if reason:
            raise AnalysisError(reason)
        return steps[-1].vibration

    def undamped(self, damping: float) -> Vibration:
        """Return the first mode without dampers at the amplitude that belongs to a damping ratio."""
        nothing = np.zeros(self.building.frame.n_devices)
        modes = dashpot_modes(self.building.frame, self.bare, nothing, nothing)
        no_size = np.zeros(self.building.storeys.size)
        return Vibration(no_size, nothing, nothing, modes.first_omega, self.roof(modes, None, damping), modes)

    def formula(self, coefficient: np.ndarray, roof: float) -> float:
        """Return the damping ratio of the first mode without dampers by FEMA 356, Eq. 9-32.

        Of a building it is the mean of its modes by their shares, with the linear dashpots that the formula stands for.

        Args:
            coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
            roof: amplitude at the roof, m; it does not matter for linear dashpots.
        """
        bare, lead = self.bare, self.bare.lead
        alpha, at_roof = self.dashpot.alpha, float(lead.floors[-1])
        shape, period = lead.dampers / at_roof, 2.0 * math.pi / bare.first_omega
        amplitude = roof if alpha < 1.0 else 1.0
        if self.building.frame.plan is not None:
            stroke = amplitude * np.abs(shape)
            linear = linear_dashpot(self.at_places(coefficient), alpha, stroke, bare.first_omega)
            rigid = Dashpots(coefficient, linear, np.zeros(shape.size), bare.first_omega)
            return lead.mean(self.added_damping(rigid, bare).__getitem__)
        return added_damping(self.at_places(coefficient), alpha, shape, amplitude, period, 1.0 / at_roof**2)

    def complex_stiffness(self, state: Dashpots) -> np.ndarray:
        """Return the complex stiffness of dashpots with springs and braces at the first frequency, (d,) N/m."""
        return state.stiffness(state.omega)

    def storage(self, state: Dashpots) -> np.ndarray:
        """Return the stiffness that dashpots and springs store at the first frequency, (d,) N/m."""
        return state.stiffness(state.omega).real

    def added_damping(self, state: Dashpots, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio of each mode by the losses at its own frequency, (n,)."""
        losses = state.stiffness(modes.omega[:, None]).imag
        return np.asarray(0.5 * np.sum(modes.dampers**2 * losses, axis=1) / modes.omega**2)

    def demands(
        self, state: Dashpots, modes: LinearModes, peaks: SpectralPeaks
    ) -> tuple[np.ndarray, Mapping[str, np.ndarray]]:
        """Return the largest force of the dampers at each place, (d,) N, their stroke, and their pseudo velocity.

        Source: pseudo velocity: FEMA 356, 9.3.5.1.
        """
        shares = 1.0 / np.abs(1.0 + 1.0j * modes.omega[:, None] * state.linear * state.flexibility)
        stroke = peaks.combined(modes.dampers * shares)
        velocity = peaks.combined(modes.omega[:, None] * modes.dampers * shares)
        force = self.at_places(state.coefficient) * velocity**self.dashpot.alpha
        return force, {"stroke": stroke, "velocity": velocity}
