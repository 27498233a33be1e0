"""A frame in the first mode with hysteretic dampers as the secants of their loops at its amplitude."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
import scipy

from edesign.damper.hysteresis import Hysteresis, behind_brace
from edesign.damper.restrained_cycles import RestrainedCycles
from edesign.errors import AnalysisError
from edesign.project.dampers.designs import HystereticDesign, RoofAmplitude
from edesign.study.design.building import Building, mode_shears
from edesign.study.design.condensed import LinearModes
from edesign.study.design.device_model import DeviceModel
from edesign.study.design.estimate import Action, SpectralPeaks, spectral_peaks
from edesign.study.design.relaxation import AGREEMENT, Relaxation

_MOST_ITERATIONS = 300  # of shapes, and of Newton's method; ten where storeys do not hand the drift to each other
_MOST_DOUBLINGS = 60  # of an amplitude, or halvings, on the way to the one that is wanted
_LEAST_STEP = 0.01  # of Newton's
_LEAST = 1e-9  # deformation of a damper over the largest: below it, none
_GAUSS = np.polynomial.legendre.leggauss(64)  # the kink where a damper yields costs the average about 1e-4
_SHARES, _WEIGHTS = 0.5 * (1.0 + _GAUSS[0]), 0.5 * _GAUSS[1]


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
        return 2.0 * math.pi / float(self.modes.omega[0])

    @property
    def stiffness(self) -> np.ndarray:
        """Secant stiffness of dampers and braces, (d,) N/m."""
        return self.secants.force / self.deformation


class HystereticModel(DeviceModel[HystereticDesign, SecantVibration]):
    """Hysteretic dampers and their braces in the frame of a design.

    Args:
        building: the frame with its places.
        spec: the design.
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
        """Return the drift over height at which dampers and braces of each storey yield, (s,), with their feet held.

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
        """
        deformation = self.yield_deformation
        if self.braces is not None:
            deformation = deformation + self.at_places(yield_force) / self.braces
        storeys = self.building.place_storey
        horizontal = np.bincount(storeys, deformation / self.building.cosine) / np.bincount(storeys)
        return np.asarray(horizontal / self.building.heights[self.building.storeys - 1])

    def vibration(self, yield_force: np.ndarray, action: Action | None = None) -> SecantVibration:
        """Return the vibration in the first mode in which shape, period, amplitude and secants agree.

        At each amplitude of the roof shape and secants agree; the amplitude is the one that the design asks for.

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
            action: whose spectrum gives the amplitude; None: what the design says.

        Raises:
            AnalysisError: they do not agree.
        """
        scale, amplitude = self.scale(yield_force), self.spec.amplitude
        if action is None and isinstance(amplitude, RoofAmplitude):
            found = self._at_roof(scale, amplitude.roof_displacement, None)
        else:
            found = self._at_wanted_roof(scale, action)
        return replace(found, damping_average=self._average(scale, found.deformation, found.modes))

    def bare_damping(self, yield_force: np.ndarray) -> float:
        """Return the damping ratio that rigid-plastic dampers add to the first mode without dampers.

        Args:
            yield_force: of all dampers of each storey along its drift, (s,) N.
        """
        roof = self._roof(self.bare, 0.0, None)
        work = 4.0 * float(self.at_places(yield_force) @ self._deformation(self.bare, roof))
        generalised = roof / float(self.bare.floors[0, -1])
        return work / (2.0 * math.pi * (float(self.bare.omega[0]) * generalised) ** 2)

    def storage(self, state: SecantVibration) -> np.ndarray:
        """Return the secant stiffness of dampers and braces in the first mode, for all modes, (d,) N/m."""
        return state.stiffness

    def added_damping(self, state: SecantVibration, modes: LinearModes) -> np.ndarray:
        """Return the damping ratio of each mode, (n,): that of the first alone.

        Source: ASCE/SEI 7-16, 18.7.3.2: hysteretic damping is that of the fundamental mode.
        """
        added = np.zeros(modes.omega.size)
        added[0] = state.damping
        return added

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

    def _at_wanted_roof(self, scale: np.ndarray, action: Action | None) -> SecantVibration:
        """The first mode at the amplitude that its period, shape and damping at this amplitude want."""
        found: SecantVibration | None = None

        def excess(logarithm: float) -> float:
            """Logarithm of the amplitude that is wanted over the one taken; it falls as the amplitude grows."""
            nonlocal found
            found = self._at_roof(scale, math.exp(logarithm), found)
            return math.log(self._roof(found.modes, found.damping, action)) - logarithm

        low = high = math.log(self._roof(self.bare, 0.0, action))
        at_start = excess(low)
        for _ in range(_MOST_DOUBLINGS):
            if at_start >= 0.0:
                high += math.log(2.0)
                if excess(high) <= 0.0:
                    break
            else:
                low -= math.log(2.0)
                if excess(low) >= 0.0:
                    break
        else:
            raise AnalysisError("no amplitude of the first mode with these dampers is the one that the design wants")
        excess(scipy.optimize.brentq(excess, low, high, xtol=AGREEMENT))
        assert found is not None
        return found

    def _at_roof(self, scale: np.ndarray, roof: float, start: SecantVibration | None) -> SecantVibration:
        """The first mode at an amplitude of the roof, m: shape and secants in agreement.

        The inertia forces of the present shape act on the frame with its dampers along their skeletons, whose forces
        only grow: there is one answer. Its secants give the next shape.
        """
        modes = self.bare if start is None else start.modes
        u = roof / float(modes.floors[0, -1]) * modes.dampers[0]
        shape, relax = modes.masses[0] / modes.floors[0, -1], Relaxation()
        for _ in range(_MOST_ITERATIONS):
            u = self._static(scale, roof, self.building.frame.mass * shape, u)
            deformation = np.maximum(np.abs(u), _LEAST * np.abs(u).max())
            secants = self.secants(scale, deformation)
            modes = self.building.frame.modes(secants.force / deformation)
            following = roof / float(modes.floors[0, -1]) * modes.dampers[0]
            if float(np.max(np.abs(following - u))) <= AGREEMENT * float(np.max(np.abs(u))):
                return self._vibration(scale, roof, deformation, secants, modes)
            shape = relax(shape, modes.masses[0] / modes.floors[0, -1])
        raise AnalysisError(f"shape of the first mode and secants of the dampers did not agree to {AGREEMENT:g}")

    def _static(self, scale: np.ndarray, roof: float, loads: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Deformations of the dampers (d,) m under loads on the masses (m,), scaled until the roof moves by `roof`, m.

        Newton's method: u = B p - C f(u), with p such that the roof moves as it shall.

        Raises:
            AnalysisError: it does not converge.
        """
        frame = self.building.frame
        by_loads, by_force = frame.B @ loads / float(frame.floor_A[-1] @ loads), frame.floor_B[-1]
        flexibility = frame.C - np.outer(by_loads, by_force)

        def residual(u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
            secants = self.secants(scale, np.abs(u))
            force = np.sign(u) * secants.force
            return u - by_loads * roof + flexibility @ force, secants.tangent

        u = start
        r, tangent = residual(u)
        for _ in range(_MOST_ITERATIONS):
            size = float(np.max(np.abs(r)))
            if size <= 1e-3 * AGREEMENT * float(np.max(np.abs(u))):
                return u
            step = np.linalg.solve(np.eye(u.size) + flexibility * tangent, r)
            part = 1.0
            while True:
                tried = u - part * step
                r, tangent = residual(tried)
                if float(np.max(np.abs(r))) < size or part < _LEAST_STEP:
                    break
                part *= 0.5
            u = tried
        raise AnalysisError("the frame with its dampers under the inertia forces of its first mode did not converge")

    def _vibration(
        self, scale: np.ndarray, roof: float, deformation: np.ndarray, secants: Secants, modes: LinearModes
    ) -> SecantVibration:
        energy = float(secants.energy @ (modes.dampers[0] / deformation) ** 2)  # of generalised displacement 1
        at_amplitude = energy / (2.0 * math.pi * float(modes.omega[0]) ** 2)
        average = self.spec.equivalent_damping == "average"
        damping = self._average(scale, deformation, modes) if average else at_amplitude
        return SecantVibration(scale, roof, deformation, secants, modes, at_amplitude, math.nan, damping)

    def _average(self, scale: np.ndarray, deformation: np.ndarray, modes: LinearModes) -> float:
        """Mean of the equivalent damping over amplitudes up to that of a deformation (d,) m, in the same shape."""
        first, amplitudes = modes.dampers[0], _SHARES[:, None] * deformation
        found = self.secants(scale, amplitudes)
        here = self.secants(scale, deformation)
        frame = float(modes.omega[0]) ** 2 - float((here.force / deformation) @ first**2)
        stiffness = frame + (found.force / amplitudes) @ first**2
        energy = found.energy @ (first / deformation) ** 2 / _SHARES**2
        return float(_WEIGHTS @ (energy / (2.0 * math.pi * stiffness)))

    def _roof(self, modes: LinearModes, damping: float, action: Action | None) -> float:
        """Amplitude of the first of modes at the roof, m, with a damping ratio that the dampers add."""
        share = float(modes.participation[0]) * float(modes.floors[0, -1])
        return self.roof_amplitude(modes.floors[0], share, float(modes.omega[0]), damping, action)

    @staticmethod
    def _deformation(modes: LinearModes, roof: float) -> np.ndarray:
        """Deformation of dampers and braces (d,) m in the first of modes with an amplitude at the roof."""
        size = np.abs(modes.dampers[0])
        return np.asarray(roof / abs(float(modes.floors[0, -1])) * np.maximum(size, _LEAST * size.max()))

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
                omega, ratio = float(bare.omega[0]), self.action.inherent_damping
                generalised = float(bare.participation[0]) * self.action.displacement(omega, ratio)
            else:
                generalised = self._roof(bare, 0.0, None) / float(bare.floors[0, -1])
            found = np.abs(generalised * mode_shears(frame, bare)[0])
        return np.asarray(found[self.building.storeys - 1])
