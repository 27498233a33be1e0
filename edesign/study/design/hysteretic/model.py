"""A frame in the first mode with hysteretic dampers as the secants of their loops at its amplitude."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.damper.hysteresis import Hysteresis, behind_brace
from edesign.damper.restrained_cycles import RestrainedCycles
from edesign.project.dampers.designs import HystereticDesign
from edesign.study.design.building import Building, mode_shears, storey_shears
from edesign.study.design.condensed import LinearModes
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.device_model import DeviceModel
from edesign.study.design.estimate import Action, SpectralPeaks, spectral_peaks


@dataclass(frozen=True)
class Secants:
    """Dampers with their braces at amplitudes of their deformation.

    Attributes:
        stroke: amplitude of the dampers alone, (..., d) m.
        force: at the amplitude, (..., d) N.
        tangent: of the force by the deformation of damper and brace, (..., d) N/m.
        energy: of a cycle, (..., d) J.
    """

    stroke: np.ndarray
    force: np.ndarray
    tangent: np.ndarray
    energy: np.ndarray


@dataclass(frozen=True)
class SecantVibration:
    """A vibration of the frame in its first mode with the secant stiffness of its dampers at the amplitude.

    Attributes:
        scale: factor on the forces of the law that gives all dampers of each place, (d,).
        roof: amplitude at the roof, m.
        deformation: amplitude of dampers and braces together, (d,) m.
        secants: of the dampers there.
        modes: with the secant stiffness of dampers and braces.
        damping_at_amplitude: equivalent damping ratio of the first mode by a cycle of the amplitude (Jacobsen).
        damping_average: its mean over all amplitudes up to this one.
        damping: the one that counts.
    """

    scale: np.ndarray
    roof: float
    deformation: np.ndarray
    secants: Secants
    modes: LinearModes
    damping_at_amplitude: float
    damping_average: float
    damping: float

    @property
    def period(self) -> float:
        """Period of the first mode, s."""
        return 2.0 * math.pi / self.modes.first_omega

    @property
    def stiffness(self) -> np.ndarray:
        """Secant stiffness of dampers and braces, (d,) N/m."""
        return self.secants.force / self.deformation


class HystereticModel(DeviceModel[HystereticDesign, SecantVibration]):
    """Hysteretic dampers and their braces in the frame of a design.

    Args:
        building: the frame with its places.
        loop: of the law of the design.
        action: the spectrum; None: there is none.
    """

    power = 1.0

    def __init__(self, building: Building, spec: HystereticDesign, loop: Hysteresis, action: Action | None) -> None:
        super().__init__(building, spec, action)
        self.loop = loop
        known = "first_mode" if action is None else "spectrum"
        self.shear_of = "given" if isinstance(spec.shear, tuple) else spec.shear or known
        self.shears = self._shears()

    def scale(self, yield_force: np.ndarray) -> np.ndarray:
        """Return the factor on the forces of the law that gives all dampers of each place, (d,).

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
        """
        return self.at_places(yield_force) / self.loop.yield_force

    @property
    def yield_deformation(self) -> np.ndarray:
        """Deformation at which the damper of each place yields, (d,) m."""
        return self.loop.yield_force / self.loop.stiffness / self.building.deformation_scale

    def stiffness(self, scale: np.ndarray) -> np.ndarray:
        """Return the initial stiffness of the dampers at each place, (d,) N/m.

        Args:
            scale: factor on the forces of the law, (d,).
        """
        return scale * self.building.deformation_scale * self.loop.stiffness

    def core_strain(self, stroke: np.ndarray) -> np.ndarray | None:
        """Return the strain of the cores of buckling-restrained braces, (d,); None for other dampers.

        Args:
            stroke: amplitude of each damper's deformation, (d,) m.
        """
        if not isinstance(self.loop, RestrainedCycles):
            return None
        return self.loop.core_strain(self.building.deformation_scale * stroke)

    def secants(self, scale: np.ndarray, deformation: np.ndarray) -> Secants:
        """Return the dampers' forces, tangents and energies at amplitudes of their deformation with their braces.

        Args:
            scale: factor on the forces of the law, (d,).
            deformation: amplitude of damper and brace together, (..., d) m.
        """
        to_law = self.building.deformation_scale
        flexibility = np.zeros_like(scale) if self.braces is None else scale / self.braces
        of_law = behind_brace(self.loop, to_law * deformation, to_law * flexibility)
        tangent = scale * to_law * self.loop.tangent(of_law)
        tangent = tangent / (1.0 + tangent * flexibility / scale)
        energy = scale / to_law * self.loop.energy(of_law)
        return Secants(of_law / to_law, scale * self.loop.force(of_law), tangent, energy)

    def elastic_modes(self, yield_force: np.ndarray) -> LinearModes:
        """Return the modes of the frame with its dampers before they yield.

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
        """
        flexibility = 1.0 / self.stiffness(self.scale(yield_force))
        if self.braces is not None:
            flexibility = flexibility + 1.0 / self.braces
        return self.building.frame.modes(1.0 / flexibility)

    def yield_drift(self, yield_force: np.ndarray) -> np.ndarray:
        """Return the drift over height at which dampers and braces of each storey yield, (s,), with fixed column bases.

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
        """
        deformation = self.yield_deformation
        if self.braces is not None:
            deformation = deformation + self.at_places(yield_force) / self.braces
        storeys = self.building.place_storey
        horizontal = np.bincount(storeys, deformation / self.building.cosine) / np.bincount(storeys)
        return np.asarray(horizontal / self.building.heights[self.building.storeys - 1])

    def complex_stiffness(self, state: SecantVibration) -> np.ndarray:
        """Return secant stiffness and loss of the loops at the amplitude of the design, with braces, (d,) N/m."""
        return state.stiffness + 1.0j * state.secants.energy / (np.pi * state.deformation**2)

    def storage(self, state: SecantVibration) -> np.ndarray:
        """Return the secant stiffness of dampers and braces in the first mode, for all modes, (d,) N/m."""
        return state.stiffness

    def added_damping(self, state: SecantVibration, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio of each mode, (n,): that of the first alone, in a building by their shares in it.

        Source: ASCE/SEI 7-16, 18.7.3.2: hysteretic damping is that of the fundamental mode.
        """
        return np.asarray(state.damping * (modes.lead.share / modes.lead.share.max()))

    def losses(self, state: SecantVibration, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio of each mode by the loops at the amplitude of the design, (n,)."""
        return strain_energy_damping(modes, self.complex_stiffness(state))

    def demands(
        self, state: SecantVibration, modes: LinearModes, peaks: SpectralPeaks
    ) -> tuple[np.ndarray, Mapping[str, np.ndarray]]:
        """Return the largest force of the dampers at each place, (d,) N, their stroke and ductility, and core strain.

        The force of a buckling-restrained brace is its compression, the larger one.
        """
        secants = self.secants(state.scale, peaks.combined(modes.dampers))
        stroke, force = secants.stroke, secants.force
        further = {"stroke": stroke, "ductility": stroke / self.yield_deformation}
        if isinstance(self.loop, RestrainedCycles):
            of_law = self.building.deformation_scale * stroke
            force = state.scale * self.loop.compression(of_law)
            further["core_strain"] = self.loop.core_strain(of_law)
        return force, further

    def roof(self, modes: LinearModes, damping: float, action: Action | None) -> float:
        """Return the amplitude of the first of modes at the roof, m.

        Args:
            modes: with the secants of dampers and braces.
            damping: damping ratio that the dampers add to the first.
            action: whose spectrum gives the amplitude; None: what the design says.
        """
        lead, at_roof = modes.lead, float(modes.lead.floors[-1])
        share = lead.participation * at_roof
        return self.roof_amplitude(at_roof, lead.storeys, share, modes.first_omega, damping, action)

    def _shears(self) -> np.ndarray:
        """Shears of the storeys with dampers, without them, linear, (s,) N: of spectrum or first mode, or given."""
        frame, bare = self.building.frame, self.bare
        if isinstance(self.spec.shear, tuple):
            return np.array(self.spec.shear)[self.building.storeys - 1]
        if self.shear_of == "spectrum":
            assert self.action is not None, "check_design wants a level"
            peaks = spectral_peaks(self.building.frame, self.action, bare, np.zeros(bare.omega.size))
            found = peaks.combined(mode_shears(frame, bare))
        else:
            if self.action is not None:
                omega, ratio = bare.first_omega, self.action.inherent_damping + bare.first_beside_damping
                generalised = bare.lead.participation * self.action.displacement(omega, ratio)
            else:
                generalised = self.roof(bare, 0.0, None) / float(bare.lead.floors[-1])
            found = np.abs(generalised * storey_shears(frame.at_floors(bare.lead.loads)))
        return np.asarray(found[self.building.storeys - 1])
