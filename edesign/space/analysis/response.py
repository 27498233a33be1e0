"""Response of a space frame to static load cases and to a design spectrum, EN 1998-1:2004, 4.3.3.3.

Every response quantity is combined from its own modal values: member forces from modal member forces, storey drifts
from modal drifts of each column. Differences of combined values are never taken.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from edesign.codes.ec8 import DesignSpectrum, ElasticSpectrum
from edesign.codes.ec8.analysis.lateral_force import base_shear, lateral_forces
from edesign.codes.ec8.analysis.modal_combination import close_modes, cqc_coefficients
from edesign.codes.ec8.analysis.torsion import accidental_moments
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcSpectrum
from edesign.core.space import Points, SpaceModel, combine, combine_internal
from edesign.core.space_modes import SpaceModes
from edesign.errors import InputError
from edesign.space.structure.frame import AXES, Axis, LoadCase, SpaceFrame
from edesign.space.structure.masses import mass_shift

if TYPE_CHECKING:
    from edesign.project.building.design import Design
    from edesign.space.analysis.bracing import Bracing
    from edesign.space.checks.foundations import Supports

AnyDesignSpectrum = DesignSpectrum | NtcDesignSpectrum
AnyElasticSpectrum = ElasticSpectrum | NtcSpectrum | NtcDesignSpectrum

STATIONS = np.array([0.0, 1.0 / 6.0, 1.0 / 3.0, 0.5, 2.0 / 3.0, 5.0 / 6.0, 1.0])
"""Places along a member as fractions of its length: loads of secondary beams at third points fall on them."""
AXIAL_AT_END = 6  # place of N in end forces; braces and columns of modes have the same along their length


@dataclass(frozen=True)
class StaticResponse:
    """Effects of the load cases.

    Attributes:
        names: (n_cases,) of the cases.
        displacements: (n_cases, n_nodes, 6) m and rad.
        internal: (n_cases, n_members, n_stations, 6) N, V_y, V_z, T, M_y, M_z; N tension positive.
        reactions: (n_cases, n_nodes, 6) N and N m.
    """

    names: tuple[str, ...]
    displacements: np.ndarray
    internal: np.ndarray
    reactions: np.ndarray


@dataclass(frozen=True)
class SeismicResponse:
    """Effects of the seismic action in one direction, without sign.

    Attributes:
        axis: direction of the ground motion.
        spectrum: design spectrum of this direction.
        acceleration: (n_modes,) S_d(T), m/s2.
        lower_bound: (n_modes,) whether beta a_g governs.
        base_shear: combined from the modes, N.
        base_shear_without_beta: the base shear for beta = 0, N.
        F_b: base shear of the lateral force method, which accidental torsion goes by, N.
        storey_shear: (n_storeys,) N.
        drift: (n_storeys,) d_e: the largest of the storey's columns, of the design spectrum without q_d, m.
        drift_elastic: (n_storeys,) the same of the elastic spectrum of the analysis, m.
        T_1: period of the mode in which most of the mass moves along the axis, s.
        internal: (n_members, n_stations, 6) as in StaticResponse.
        reactions: (n_supports, 6) of the supports on the frame, N and N m.
    """

    axis: Axis
    spectrum: AnyDesignSpectrum
    acceleration: np.ndarray
    lower_bound: np.ndarray
    base_shear: float
    base_shear_without_beta: float
    F_b: float
    storey_shear: np.ndarray
    drift: np.ndarray
    drift_elastic: np.ndarray
    internal: np.ndarray
    reactions: np.ndarray
    T_1: float


@dataclass(frozen=True)
class ResponseSpectrumAnalysis:
    """Modal response spectrum analysis of a frame, EN 1998-1:2004, 4.3.3.3.

    Attributes:
        model, frame: the structure.
        elastic: spectrum of the drifts that cap q d_e (EN 1998-1, 4.3.4(3)), or that NTC 2018, 7.3.6.1, limits.
        design: how modes are combined, their damping, and accidental torsion.
        bracing: what braces bring to columns and beams.
        supports: of the frame.
    """

    model: SpaceModel
    frame: SpaceFrame
    elastic: AnyElasticSpectrum
    design: Design
    bracing: Bracing
    supports: Supports

    def response(self, modes: SpaceModes, axis: Axis, spectrum: AnyDesignSpectrum) -> SeismicResponse:
        """Return the effects of the seismic action in one direction, with accidental torsion.

        Torsion is a static load case of the moments e_ai F_i (4.3.3.3.3), whose effects are added to those of the modes
        with the sign that adds, to drifts as well. F_i are the forces of the lateral force method (4.3.3.2.3), which
        add up to F_b and not to the base shear of the modes. Or the masses of all floors stand e_ai to either side
        (4.3.2(1)P, Eq. 4.3), and of every quantity the larger one of both sides counts, with all modes of either.

        Args:
            modes: of the masses in place; S_d is of their periods.
            axis: of the ground motion.
            spectrum: of this direction.

        Raises:
            InputError: SRSS is asked for and modes are close.
        """
        if self.design.torsion_by != "shifted_masses":
            return self._of_modes(modes, axis, spectrum, self.design.accidental_torsion)
        torsion = self.design.accidental_torsion
        shift = mass_shift(self.frame, (0.0, torsion) if axis == "x" else (torsion, 0.0))
        one, other = (
            self._of_modes(
                self.model.modes(self.frame.node_mass, mass_shift=side), axis, spectrum, 0.0, mass_shift=side
            )
            for side in (shift, -shift)
        )
        larger = {
            name: np.maximum(getattr(one, name), getattr(other, name))
            for name in ("storey_shear", "drift", "drift_elastic", "internal", "reactions")
        }
        S_d = spectrum.acceleration(modes.period)
        return replace(
            one,
            acceleration=S_d,
            lower_bound=np.asarray(S_d > _without_beta(spectrum).acceleration(modes.period)),
            base_shear=max(one.base_shear, other.base_shear),
            base_shear_without_beta=max(one.base_shear_without_beta, other.base_shear_without_beta),
            F_b=self._lateral_base_shear(modes, axis, spectrum),
            **larger,
        )

    def _of_modes(
        self,
        modes: SpaceModes,
        axis: Axis,
        spectrum: AnyDesignSpectrum,
        torsion: float,
        mass_shift: np.ndarray | None = None,
    ) -> SeismicResponse:
        """Return the response in given modes.

        `torsion`: e_ai / L_i of a static load case, 0 for none; `mass_shift`: (n_nodes, 2) m, as the modes were found.
        """
        direction = AXES.index(axis)
        rho = _correlation(modes, self.design.combination, self.design.damping)
        gamma = modes.participation[:, direction]
        S_d = spectrum.acceleration(modes.period)
        amplitude = gamma * S_d / modes.omega**2
        amplitude_elastic = gamma * self.elastic.acceleration(modes.period) / modes.omega**2
        free = _without_beta(spectrum)
        amplitude_free = gamma * free.acceleration(modes.period) / modes.omega**2

        shear = _modal_storey_shear(self.frame, modes, direction, mass_shift)  # (k, storeys) for an amplitude of 1
        drift, storey = _modal_drift(self.frame, modes, direction)  # (k, columns)
        scaled = rho * np.outer(amplitude, amplitude)
        storey_shear = combine(shear.T, scaled)
        F_b = self._lateral_base_shear(modes, axis, spectrum)
        twist = self._accidental_torsion(axis, F_b, torsion)

        def drifts(of: np.ndarray, lateral: float) -> np.ndarray:
            found = combine(drift.T, rho * np.outer(of, of)) + twist.drift * lateral / F_b
            worst = np.zeros(self.frame.n_floors)
            np.maximum.at(worst, storey, found)
            return worst

        axial = modes.end_forces[:, :, AXIAL_AT_END]
        internal = self.bracing.axial_forces(combine_internal(modes.end_forces, scaled, STATIONS), axial, scaled)
        reactions = self.supports.combined(self.bracing, self.supports.modal(modes.end_forces), axial, scaled)
        return SeismicResponse(
            axis=axis,
            spectrum=spectrum,
            acceleration=S_d,
            lower_bound=np.asarray(S_d > free.acceleration(modes.period)),
            base_shear=float(storey_shear[0]),
            base_shear_without_beta=float(combine(shear[:, :1].T, rho * np.outer(amplitude_free, amplitude_free))[0]),
            F_b=F_b,
            storey_shear=storey_shear,
            drift=drifts(amplitude, F_b),
            drift_elastic=drifts(amplitude_elastic, self._lateral_base_shear(modes, axis, self.elastic)),
            internal=internal + twist.internal,
            reactions=reactions + twist.reactions,
            T_1=self._main_period(modes, axis),
        )

    def _main_period(self, modes: SpaceModes, axis: Axis) -> float:
        """Return the period of the mode in which most of the mass moves along an axis, s."""
        return float(modes.period[modes.effective_mass_ratio[:, AXES.index(axis)].argmax()])

    def _lateral_base_shear(
        self, modes: SpaceModes, axis: Axis, spectrum: AnyDesignSpectrum | AnyElasticSpectrum
    ) -> float:
        """Return F_b (4.3.3.2.2); T_1 is the period of the mode in which most of the mass moves along the axis."""
        T_1, frame = self._main_period(modes, axis), self.frame
        return base_shear(
            float(spectrum.acceleration(T_1)),
            frame.acting_mass,
            T_1,
            corner_period(spectrum),
            frame.n_floors - frame.held,
        )

    def _accidental_torsion(self, axis: Axis, F_b: float, ratio: float) -> _Twist:
        """Return the effects of M_ai = e_ai F_i, F_i by the heights of all masses (Eq. 4.11), without sign.

        Floors that are not rigid have a part of F_b, and nothing to turn. Of several diaphragms of a floor each has
        the part of F_i that its mass is of that of the floor, and its own length.
        """
        frame, level = self.frame, self.frame.level_of_nodes
        rigid = [int(np.flatnonzero(frame.node_diaphragm == number)[0]) for number in range(len(frame.diaphragms))]
        if ratio == 0.0 or not rigid:
            nothing = np.zeros((len(frame.members), STATIONS.size, 6))
            return _Twist(nothing, np.zeros(frame.columns.size), np.zeros((self.supports.nodes.size, 6)))
        floors = level[rigid]
        mass = np.bincount(level, weights=frame.node_mass, minlength=frame.n_floors + 1)
        forces = lateral_forces(F_b, mass, frame.heights)[floors]
        for number, at in enumerate(frame.diaphragms):
            if at.part and mass[at.floor]:
                forces[number] *= frame.node_mass[frame.node_diaphragm == number].sum() / mass[at.floor]
        nodal = np.zeros((len(frame.node_names), 6))
        nodal[rigid, 5] = accidental_moments(forces, frame.diaphragm_sizes[:, 1 - AXES.index(axis)], ratio)
        found = static_cases(self.model, (nodal_case(frame, "torsion", nodal),))
        start, end = (nodes[frame.columns] for nodes in frame.ends)
        moved = found.displacements[0][:, AXES.index(axis)]
        axial = found.internal[:, :, 0, 0]
        one = np.ones((1, 1))
        internal = self.bracing.axial_forces(np.abs(found.internal[0]), axial, one)
        reactions = self.supports.combined(self.bracing, found.reactions[:, self.supports.nodes], axial, one)
        return _Twist(internal, np.abs(moved[end] - moved[start]), reactions)


def gravity_above(frame: SpaceFrame, factors: Mapping[str, float]) -> np.ndarray:
    """Return P_tot of each storey: the vertical load at and above it, (n_storeys,) N.

    Args:
        factors: of the load cases, such as 1 for G and psi_2 for Q; cases that are absent do not count.
    """
    down = np.zeros(len(frame.node_names))
    start, end = frame.ends
    for name, factor in factors.items():
        case = frame.cases[name]
        down -= factor * case.nodal[:, 2]
        of_member = factor * -case.uniform[:, 2] * frame.length
        np.add.at(of_member, case.point_member, factor * -case.point_force[:, 2])
        np.add.at(down, start, 0.5 * of_member)
        np.add.at(down, end, 0.5 * of_member)
    at_floor = np.bincount(frame.level_of_nodes, weights=down, minlength=frame.n_floors + 1)[1:]
    return np.asarray(np.cumsum(at_floor[::-1])[::-1])


def corner_period(spectrum: AnyDesignSpectrum | AnyElasticSpectrum) -> float:
    """Return T_C, s."""
    corners = spectrum.corners
    return corners["T_C"] if isinstance(corners, Mapping) else corners[1]


def _without_beta(spectrum: AnyDesignSpectrum) -> AnyDesignSpectrum:
    return replace(spectrum, beta=0.0)


@dataclass(frozen=True)
class _Twist:
    internal: np.ndarray
    drift: np.ndarray
    reactions: np.ndarray


def _correlation(modes: SpaceModes, combination: str, damping: float) -> np.ndarray:
    if combination == "cqc":
        return cqc_coefficients(modes.period, damping)
    if close := close_modes(modes.period):
        first, second = close[0]
        raise InputError(
            f"`srss` needs independent modes, but T_{second + 1} = {modes.period[second]:.4g} s is above "
            f"0.9 T_{first + 1} = {0.9 * modes.period[first]:.4g} s (EN 1998-1, 4.3.3.3.2); use `cqc` [E-SPACE-01]"
        )
    return np.eye(modes.period.size)


def _modal_storey_shear(
    frame: SpaceFrame, modes: SpaceModes, direction: int, mass_shift: np.ndarray | None
) -> np.ndarray:
    """Return the storey shears of each mode for an amplitude of 1, (n_modes, n_storeys)."""
    moved = modes.displacements[:, :, direction]
    if mass_shift is not None:  # the floor turns its masses about its nodes
        moved = moved + modes.displacements[:, :, 5] * (-mass_shift[:, 1] if direction == 0 else mass_shift[:, 0])
    force = modes.omega[:, None] ** 2 * moved * frame.node_mass
    at_floor = force @ (frame.level_of_nodes[:, None] == np.arange(1, frame.n_floors + 1))
    return np.asarray(np.cumsum(at_floor[:, ::-1], axis=1)[:, ::-1])


def _modal_drift(frame: SpaceFrame, modes: SpaceModes, direction: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the drift of each column in each mode, (n_modes, n_columns), and its storey, from 0, (n_columns,)."""
    start, end = (nodes[frame.columns] for nodes in frame.ends)
    moved = modes.displacements[:, :, direction]
    return moved[:, end] - moved[:, start], frame.storey[frame.columns]


def static_cases(model: SpaceModel, cases: tuple[LoadCase, ...]) -> StaticResponse:
    """Return the effects of load cases."""
    points = Points(
        case=np.repeat(np.arange(len(cases)), [case.point_member.size for case in cases]),
        member=np.concatenate([case.point_member for case in cases]),
        position=np.concatenate([case.point_position for case in cases]),
        force=np.concatenate([case.point_force for case in cases]),
    )
    uniform = np.stack([case.uniform for case in cases])
    found = model.static(np.stack([case.nodal for case in cases]), uniform, points)
    internal = model.internal(found.end_forces, STATIONS, uniform, points)
    return StaticResponse(tuple(case.name for case in cases), found.displacements, internal, found.reactions)


def nodal_case(frame: SpaceFrame, name: str, nodal: np.ndarray) -> LoadCase:
    """Return a load case of forces and moments on nodes.

    Args:
        nodal: (n_nodes, 6) N and N m.
    """
    none = np.zeros(0, dtype=int)
    return LoadCase(name, "seismic", nodal, np.zeros((len(frame.members), 3)), none, np.zeros(0), np.zeros((0, 3)))
