"""The capacity curve of a frame and the target displacements that follow from it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.codes.asce41 import target_displacement as asce41
from edesign.codes.capacity_curve import CapacityCurve
from edesign.codes.ec8.analysis import target_displacement as n2
from edesign.codes.fema356 import target_displacement as fema356
from edesign.codes.motion_sets import DAMPING
from edesign.codes.spectrum import Spectrum, characteristic_period
from edesign.errors import AnalysisError, InputError
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.actions.hazard import EC8Hazard
from edesign.project.analysis.analyses import PushoverAnalysis, TargetAnalysis
from edesign.project.analysis.pushover import METHODS, Method
from edesign.project.analysis_file import AnalysisFile
from edesign.space.nonlinear.masses import IN_PLACE
from edesign.study.analysis.damper_stiffness import small_amplitude
from edesign.study.analysis.dampers import goes_with_speed
from edesign.study.analysis.lateral_patterns import by_body, by_floor, lateral_loads
from edesign.study.analysis.leading_mode import leading_mode, torsional_ratios
from edesign.study.analysis.push import Progress, Push, Stop, push, pushed_along
from edesign.study.analysis.second_order import second_order_slope
from edesign.study.analysis.structure import Structure, device_stiffness, elastic_frame, make_frame
from edesign.study.analysis.torsional_amplification import TorsionalAmplification, torsional_amplification

PASSES = 8
"""Pushes until one reaches far enough; each goes as far as the last one asked, which two or three do."""


@dataclass(frozen=True)
class Target:
    """A target displacement with the quantities that it follows from.

    Attributes:
        d_t: of the control node since gravity, m.
        values: (name, value, unit, long name) of everything it follows from.
        idealised: displacements (m) and base shears (N) of the lines that stand for the capacity curve.
        mu: (ratio of demand to strength, the largest that is permitted), None where a method has no limit.
    """

    d_t: float
    values: tuple[tuple[str, float, str, str], ...]
    idealised: tuple[tuple[float, ...], tuple[float, ...]]
    mu: tuple[float, float] | None = None


class Basis:
    """The lateral loads, masses and leading mode that all pushes of a frame with one pattern and direction share.

    Attributes:
        loads: lateral, on the nodes by name; their sum is 1 N.
        forces: of the floors from the lowest, N.
        of_bodies: forces, N, and masses, kg, of what moves as one, that of the control node last.
        mass: of the frame, kg.
    """

    def __init__(self, project: AnalysisFile, spec: PushoverAnalysis | TargetAnalysis) -> None:
        frame = make_frame(project, spec.dampers)
        self._project, self._dampers = project, spec.dampers
        self._direction = pushed_along(frame, spec)
        self.loads = lateral_loads(project, frame, spec.pattern[0], spec.dampers, self._direction)
        self.forces = by_floor(frame, self.loads)
        self.of_bodies = by_body(frame, self.loads), by_body(frame, frame.masses)
        self.mass = frame.mass

    @cached_property
    def first_mode(self) -> tuple[float, float]:
        """Period under gravity, s, and participation factor of the control node in the mode leading in the direction.

        The frame has the stiffness that displacement-dependent dampers have before they yield, which is in K_i, to
        which the period belongs (FEMA 356, 9.3.5.1).
        """
        structure = self._elastic
        along = structure.frame.directions[self._direction]
        mode = leading_mode(structure, along, _stiffness_at_rest(structure.frame))
        return mode.period, float(mode.participation * mode.shape[structure.frame.control, along.degree])

    @cached_property
    def torsional_modes(self) -> dict[int, float]:
        """Of the first two modes of a building those that are mostly turns about the vertical, and how much, by number.

        A mode is one if its effective part in turns is larger than those along x and y.
        """
        frame = self._elastic.frame
        if not frame.turning:
            return {}
        modes = self._elastic.modes(2, frame.brace_stiffness)
        turns, others = torsional_ratios(frame, modes), modes.effective_mass_ratio[:, :2].max(axis=1)
        return {i + 1: float(turns[i]) for i in range(2) if turns[i] > others[i]}

    @cached_property
    def _elastic(self) -> Structure:
        """The frame with its dampers, under gravity."""
        return self._made()

    def amplification(self, pushed: Push, spectrum: Spectrum) -> TorsionalAmplification | None:
        """Return how much more column lines of a building move than a push shows; None where no floor is rigid.

        Args:
            pushed: to the displacement that counts.
            spectrum: of the horizontal action.

        Raises:
            AnalysisError: the building is unstable.
        """
        if not pushed.frame.turning:
            return None
        structure = self._made(pushed.eccentricity) if any(pushed.eccentricity) else self._elastic
        return torsional_amplification(pushed, structure, _stiffness_at_rest(structure.frame), spectrum)

    def _made(self, eccentricity: tuple[float, float] = IN_PLACE) -> Structure:
        structure = elastic_frame(self._project, self._dampers, eccentricity)
        structure.apply_gravity()
        return structure


def _stiffness_at_rest(frame: FrameModel) -> np.ndarray | None:
    """Stiffness of dampers that do not go with speed before they yield, (n_dampers,) N/m; None: there are none."""
    stiffness = frame.brace_stiffness
    for device in frame.devices:
        if device.restrained is None and not goes_with_speed(device):
            if stiffness is None:
                stiffness = np.zeros(len(frame.model.damper_names))
            stiffness[device.number] = device_stiffness(device, small_amplitude(device), 1.0).real  # at any speed
    return stiffness


@dataclass(frozen=True)
class Capacity:
    """A push as a capacity curve.

    Attributes:
        project: the validated project.
        spec: of the push.
        basis: what all pushes of it share.
        push: to its end.
    """

    project: AnalysisFile
    spec: PushoverAnalysis | TargetAnalysis
    basis: Basis
    push: Push

    @cached_property
    def curve(self) -> CapacityCurve:
        """Base shear against displacement of the control node since gravity.

        Raises:
            AnalysisError: the push does not count, or has no step.
        """
        response = self.push.response
        error = response.statistics.get("energy_error", 0.0)
        if not response.finite or not error <= self.project.validity.energy_error or response.time.size < 2:
            raise AnalysisError(f"there is no capacity curve: {response.reason} [E-PUSH-01]")
        try:
            return CapacityCurve(self.push.displacement, np.append(0.0, self.push.base_shear[1:]))
        except InputError as problem:
            raise AnalysisError(str(problem)) from problem

    def second_order_slope(self, first: float, last: float) -> float | None:
        """Return the slope of the curve that is due to vertical loads between two displacements, N/m.

        Args:
            first: displacement of the control node since gravity at which the part of the curve begins, m.
            last: displacement of the control node since gravity at which it ends, m.

        Returns:
            None where the columns do not know second-order forces, or the lateral forces do no work between the two.
        """
        if self.project.elements.geometry.columns == "linear":
            return None
        return second_order_slope(self.push, self.basis.forces, first, last)

    def target(self, method: Method, level: str) -> Target:
        """Return a target displacement.

        Args:
            method: n2, or another key of `METHODS`.
            level: name of the hazard level.

        Returns:
            The target displacement with the values that it follows from.

        Raises:
            AnalysisError: there is none.
        """
        try:
            return _METHODS[method](self, level_spectrum(self.project, self.spec, level))
        except InputError as problem:
            raise AnalysisError(f"{METHODS[method]}: {problem}") from problem


def level_spectrum(project: AnalysisFile, spec: PushoverAnalysis | TargetAnalysis, level: str) -> Spectrum:
    """Return the elastic spectrum from which target displacements of a hazard level are found.

    Args:
        spec: the pushover, which may give a damping ratio of its own.
    """
    spectrum = elastic_spectrum(checked_hazard(project), level)
    return spectrum if spec.damping is None else spectrum.with_damping(spec.damping)


def capacity(
    project: AnalysisFile,
    spec: PushoverAnalysis | TargetAnalysis,
    progress: Progress | None = None,
    stop: Stop | None = None,
) -> Capacity:
    """Push a frame to its roof drift, or without one to 150 % of its largest target displacement.

    Args:
        spec: of one pattern and direction.
        progress: called now and then with (steps done, steps) of each push.
        stop: asked now and then; True ends the push.

    Raises:
        AnalysisError: no equilibrium under gravity, no usable mode, or no target displacement.
        CoreError: the frame is a mechanism.
    """
    basis = Basis(project, spec)
    sign, height = spec.sign, project.grid.height
    if spec.roof_drift is not None:
        target = sign * spec.roof_drift * height
        return Capacity(project, spec, basis, push(project, spec, basis.loads, target, progress, stop))
    most = height * (project.largest_drift if project.largest_drift is not None else 1.0)
    levels = spec.levels if spec.levels is not None else tuple(project.hazard_levels)
    period, C_0 = basis.first_mode
    elastic = C_0 * max(float(level_spectrum(project, spec, level).displacement(period)) for level in levels)
    reach, start = min(n2.RANGE * elastic, most), 0.0
    for _ in range(PASSES):
        pushed = push(project, spec, basis.loads, start + sign * reach, progress, stop)
        found = Capacity(project, spec, basis, pushed)
        if found.push.response.status != "completed":
            break
        start = found.push.start
        wanted = n2.RANGE * max(found.target(method, level).d_t for method in spec.targets for level in levels)
        if found.curve.end >= min(wanted, most):
            break
        reach = min(wanted, most)
    return found


def _n2(capacity: Capacity, spectrum: Spectrum) -> Target:
    oscillator = n2.equivalent_oscillator(*capacity.basis.of_bodies)
    found = n2.target_displacement(capacity.curve, oscillator, spectrum, _corner(spectrum))
    relation, Gamma = found.idealisation, oscillator.Gamma
    values = (
        ("Gamma", Gamma, "1", "transformation factor, Eq. B.3"),
        ("m", oscillator.mass, "kg", "mass m* of the equivalent oscillator, Eq. B.2"),
        ("d_m", relation.d_m, "m", "displacement d_m* up to which the curve of the oscillator is idealised"),
        ("F_y", relation.F_y, "N", "yield force F_y* of the idealised oscillator"),
        ("d_y", relation.d_y, "m", "yield displacement d_y* of the idealised oscillator, Eq. B.6"),
        ("T", relation.T, "s", "period T* of the idealised oscillator, Eq. B.7"),
        ("S_e", found.S_e, "m/s2", "ordinate of the elastic spectrum at T*"),
        ("d_et", found.d_et, "m", "target displacement d_et* of the oscillator if it stays elastic, Eq. B.8"),
        ("q_u", found.q_u, "1", "acceleration of the elastic oscillator over that of the oscillator as it is"),
        ("d_t_oscillator", found.d_t_oscillator, "m", "target displacement d_t* of the oscillator"),
        ("d_t", found.d_t, "m", "target displacement of the control node since gravity, Eq. B.13"),
    )
    end = max(found.d_t, Gamma * relation.d_y)
    V_y = Gamma * relation.F_y
    return Target(found.d_t, values, ((0.0, Gamma * relation.d_y, end), (0.0, V_y, V_y)))


def _corner(spectrum: Spectrum) -> float:
    corner = characteristic_period(spectrum)
    assert corner is not None, "check_pushover refuses spectra without corner periods"
    return corner


def _fema356(capacity: Capacity, spectrum: Spectrum) -> Target:
    basis, storeys = capacity.basis, capacity.project.grid.n_storeys
    period, C_0 = basis.first_mode
    T_S = _corner(spectrum)
    found = fema356.target_displacement(capacity.curve, period, C_0, basis.mass, storeys, spectrum, T_S)
    C_3 = ("C_3", found.C_3, "1", "C_3: negative slope after yielding, Eq. 3-17")
    return Target(found.d_t, (*_coefficients(found, period, "R"), C_3), _lines(found))


def _asce41(capacity: Capacity, spectrum: Spectrum) -> Target:
    basis, storeys = capacity.basis, capacity.project.grid.n_storeys
    period, C_0 = basis.first_mode
    if capacity.spec.site_class is not None:
        site: str = capacity.spec.site_class
    else:
        hazard = capacity.project.hazard
        assert isinstance(hazard, EC8Hazard), "check_pushover wants site_class with another"
        site = asce41.SITE_CLASSES[hazard.ground]
    lambda_ = asce41.near_fault_factor(_rarest_at_one_second(capacity.project))
    found, limit = asce41.target_displacement(
        capacity.curve,
        period,
        C_0,
        basis.mass,
        storeys,
        spectrum,
        site,
        lambda_,
        capacity.second_order_slope,
    )
    slopes = (
        ("alpha_2", limit.alpha_2, "slope of the descent over K_e; nan: none"),
        ("alpha_PDelta", limit.alpha_PDelta, "part of alpha_2 that is due to vertical loads; nan: none, or not known"),
        ("alpha_e", limit.alpha_e, "effective negative slope, Eq. 7-33; nan: none"),
    )
    values = (
        *_coefficients(found, period, "mu_strength"),
        ("a", asce41.SITE_FACTORS[site], "1", f"site factor of site class {site}, Eq. 7-29"),
        ("lambda", lambda_, "1", "near-fault factor of Eq. 7-33"),
        *((name, float("nan") if slope is None else slope, "1", label) for name, slope, label in slopes),
        ("mu_max", limit.mu_max, "1", "largest permitted mu_strength, Eq. 7-32; infinite without a descent"),
    )
    return Target(found.d_t, values, _lines(found), (found.ratio, limit.mu_max))


def _rarest_at_one_second(project: AnalysisFile) -> float:
    """S_X1 of the rarest level, which stands for the BSE-2N: the largest ordinate at 1 s, m/s2.

    It is that of 5 % damping; a table has only its own. One that ends before 1 s gives its last ordinate, no less.
    """
    hazard, found = checked_hazard(project), []
    for level in project.hazard_levels:
        spectrum = elastic_spectrum(hazard, level)
        with suppress(InputError):
            spectrum = spectrum.with_damping(DAMPING)
        found.append(float(spectrum.acceleration(min(1.0, spectrum.last_period))))
    return max(found)


def _coefficients(
    found: fema356.CoefficientTarget, period: float, ratio: str
) -> tuple[tuple[str, float, str, str], ...]:
    lines = found.idealisation
    return (
        ("T_i", period, "s", "elastic fundamental period under gravity, without velocity-dependent dampers"),
        ("K_i", lines.K_i, "N/m", "initial stiffness of the capacity curve"),
        ("K_e", lines.K_e, "N/m", "effective stiffness: the secant at 60 % of the yield strength"),
        ("T_e", found.T_e, "s", "effective fundamental period"),
        ("V_y", lines.V_y, "N", "effective yield strength"),
        ("D_y", lines.D_y, "m", "displacement at the effective yield strength"),
        ("V_d", lines.V_d, "N", "base shear where the second line ends"),
        ("D_d", lines.D_d, "m", "displacement where the second line ends"),
        ("alpha", lines.alpha, "1", "slope of the second line over K_e"),
        ("S_a", found.S_a, "m/s2", "ordinate of the spectrum at T_e"),
        ("C_m", found.C_m, "1", "effective mass factor"),
        (ratio, found.ratio, "1", "ratio of elastic demand to yield strength"),
        ("C_0", found.C_0, "1", "C_0: participation factor of the first mode at the control node"),
        ("C_1", found.C_1, "1", "C_1: inelastic over elastic displacement"),
        ("C_2", found.C_2, "1", "C_2: pinched and degrading loops"),
        ("d_t", found.d_t, "m", "target displacement of the control node since gravity"),
    )


def _lines(found: fema356.CoefficientTarget) -> tuple[tuple[float, ...], tuple[float, ...]]:
    lines = found.idealisation
    return (0.0, lines.D_y, lines.D_d), (0.0, lines.V_y, lines.V_d)


_METHODS: dict[Method, Callable[[Capacity, Spectrum], Target]] = {
    "n2": _n2,
    "fema356": _fema356,
    "asce41": _asce41,
}
