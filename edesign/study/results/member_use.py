"""Use of the members of a building by the forces of each step: the largest is found while the run goes on.

No history is kept for it. Of every step a sum that is never less than the use is taken in arrays; the clauses follow
only where it passes the largest use so far.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.ec3.member import Stability
from edesign.core.member_checks import FORCES, MEMBER_CHECKS, Check, MemberTable, mask, member_checks
from edesign.frame.frame_model import FrameModel
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_class import section_class
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.space.analysis.response import STATIONS
from edesign.space.checks.member_checks import LARGEST_CLASS, LARGEST_PLASTIC_CLASS, as_checked
from edesign.space.checks.steel_member import SteelMember
from edesign.space.nonlinear.gravity import gravity_loads
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness
from edesign.study.results.coordinates import bending_members
from edesign.study.results.recording import Quantity

_AT_ONCE = 2**13
"""Steps of members that the core is given at once, 2 MB of constants."""
_FORCES = ("member_axial_force", "member_bending_moment")
_COMPRESSION = np.array([1.0, -1.0])  # forces on both ends act inwards
_N, _M_Y, _M_Z = (FORCES.index(name) for name in ("N", "M_y", "M_z"))


class MemberUse:
    """The largest use of each column and beam of a building over the steps of a run, as their `Watch`.

    `section_use` is that of each end by N, M_y and M_z of one step. Partial factors are 1, shear is left out, and
    hardening may lead beyond 1. `member_use` is that against buckling, as the elastic design has it, by the compression
    and the largest moments of one step; a file without `design` has none. M_b,Rd is that of a uniform moment, unless
    the flange is held. Sections have the class that they have under the compression of the step; of class 4 the use is
    infinite. Members whose section has no class are not judged, and have 0.

    Raises:
        InputError: the steel or section of a member is not known to the clauses.

    Source: EN 1993-1-1:2005, 6.2.9.1(2), Eq. 6.31, and (6), Eq. 6.41, or 6.2.1(7), Eq. 6.2, of class 1 and 2; 6.2.9.2,
        Eq. 6.42, of class 3. 6.3.1 to 6.3.3, Eqs. 6.46, 6.54, 6.61 and 6.62.
    """

    def __init__(self, building: Building, frame: FrameModel) -> None:
        made = with_steel_by_thickness(building)
        every = bending_members(frame)
        self._judged = np.array([section_of(building, one.section).has_class for one in every])
        members = [one for one, judged in zip(every, self._judged, strict=True) if judged]
        self._columns: np.ndarray | None = None
        self._seen = False
        sections: dict[tuple[str, str, int], SteelMember] = {}

        def of_class(number: int) -> list[SteelMember]:
            for one in members:
                if (one.section, one.material, number) not in sections:
                    sections[one.section, one.material, number] = SteelMember(
                        section_of(building, one.section),
                        made.materials[one.material].fy,
                        Stability(0.0, 0.0, 0.0),
                        number,
                        gamma_M0=1.0,
                    )
            return [sections[one.section, one.material, number] for one in members]

        self._of_sections = _Sections(of_class(LARGEST_PLASTIC_CLASS), of_class(LARGEST_CLASS), about_z=True)
        self._section_use = _Largest((len(members), 2))
        self._of_members: _Buckling | None = None
        self._member_use = _Largest((len(members),))
        if made.design is not None:
            whole = space_frame(made)
            number = {member.name: at for at, member in enumerate(whole.members)}
            chosen = [number[member.name] for member in members]
            plastic, elastic = ([kind[at] for at in chosen] for kind in as_checked(made, whole))
            self._of_members = _Buckling(plastic, elastic, about_z=False)
            loads = gravity_loads(made, whole)
            inside = [
                _moments_inside(loads.uniform[at], loads.points.get(at, ()), float(whole.length[at])) for at in chosen
            ]
            self._inside = [
                (axis, np.flatnonzero(of.any(axis=1)), of[of.any(axis=1)])
                for axis, of in enumerate(np.moveaxis(np.array(inside), 2, 0))
                if of.any()
            ]

    def watching(self, quantities: Sequence[Quantity]) -> list[Quantity]:
        """Return quantities of a run with those watched that this needs.

        Args:
            quantities: in the order in which they are recorded.
        """
        watched = [replace(one, watched=True) if one.name in _FORCES else one for one in quantities]
        axial, moment = (next(one for one in watched if one.name == name) for name in _FORCES)
        self._before, self._size = len(axial.cells), len(axial.cells) + len(moment.cells)
        columns = [*axial.keys, *(self._before + at for at in moment.keys)]
        self._columns = None if len(columns) == self._size else np.array(columns)
        return watched

    def __call__(self, abscissas: np.ndarray, values: np.ndarray) -> None:
        """See further steps.

        Args:
            abscissas: (n,) of the steps.
            values: (n, watched) end forces.
        """
        if not np.isfinite(values[-1]).all():
            return  # the run ends here, and its extremes tell
        if self._columns is not None:
            there = np.zeros((len(values), self._size))
            there[:, self._columns] = values
            values = there
        self._seen = True
        compression = values[:, : self._before].reshape(len(values), -1, 2) * _COMPRESSION
        moments = values[:, self._before :].reshape(*compression.shape, 2)
        if not self._judged.all():
            compression, moments = compression[:, self._judged], moments[:, self._judged]
        M_y, M_z = np.abs(moments[..., 0]), np.abs(moments[..., 1])
        forces = Forces(compression, M_y, M_z)
        self._section_use.see(abscissas, self._of_sections.bound(forces), partial(self._of_sections.use, forces))
        if self._of_members is not None:
            forces = Forces(compression.max(axis=2), *self._largest_moments(moments, M_y, M_z))
            self._member_use.see(abscissas, self._of_members.bound(forces), partial(self._of_members.use, forces))

    def _largest_moments(self, moments: np.ndarray, M_y: np.ndarray, M_z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The largest moments of each member in each step, (n, m) about y and z, loads inside counted."""
        tops = np.maximum(M_y[..., 0], M_y[..., 1]), np.maximum(M_z[..., 0], M_z[..., 1])
        for axis, members, loads in self._inside:
            start, end, largest = moments[:, members, 0, axis], moments[:, members, 1, axis], tops[axis][:, members]
            for share, load in zip(STATIONS[1:-1], loads.T[1:-1], strict=True):
                inside = share * end - (1.0 - share) * start + load
                np.maximum(largest, np.abs(inside, out=inside), out=largest)
            tops[axis][:, members] = largest
        return tops

    def store(self, group: Group, abscissa: str, unit: str) -> None:
        """Add the largest uses and where they occur to the group of the run, if it was watched.

        Args:
            group: with members and ends.
            abscissa: what the run is taken in.
            unit: of the abscissa.
        """
        if not self._seen:
            return
        found: list[tuple[str, tuple[str, ...], _Largest, str]] = [
            ("section_use", ("member", "end"), self._section_use, "N, M_y and M_z at the end of the member")
        ]
        if self._of_members is not None:
            found.append(("member_use", ("member",), self._member_use, "the member against buckling"))
        for name, dims, largest, what in found:
            whole = (self._judged.size, *largest.use.shape[1:])
            use, at = np.zeros(whole), np.full(whole, np.nan)
            use[self._judged], at[self._judged] = largest.use, largest.at
            group.add(f"{name}_max", dims, use, "1", f"use of {what}, largest value")
            group.add(f"{name}_at", dims, at, unit, f"{abscissa} of the largest use of {what}")


def member_use(project: AnalysisFile, frame: FrameModel) -> MemberUse | None:
    """Return what finds the use of members in a run; None of a plane frame, or if no section has a class."""
    if not isinstance(project, Building):
        return None
    judged = any(section_of(project, one.section).has_class for one in bending_members(frame))
    return MemberUse(project, frame) if judged else None


@dataclass(frozen=True)
class Forces:
    """Forces of steps at places: members, or their ends.

    Attributes:
        compression: (n, m) or (n, m, 2), N.
        M_y, M_z: magnitudes, N m.
    """

    compression: np.ndarray
    M_y: np.ndarray
    M_z: np.ndarray


class _Largest:
    """The largest use so far of each place, and where it was."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.use, self.at = np.zeros(shape), np.full(shape, np.nan)

    def see(
        self,
        abscissa: np.ndarray,
        bound: np.ndarray,
        exact: Callable[[np.ndarray, np.ndarray], np.ndarray],
    ) -> None:
        """See further steps.

        Args:
            abscissa: (n,).
            bound: (n, *shape) never less than the use.
            exact: gives the use in steps of places, both as numbers.
        """
        flat = bound.reshape(len(bound), -1)
        use = self.use.reshape(-1)
        rows = flat.argmax(axis=0)
        places = np.flatnonzero(flat[rows, np.arange(use.size)] > use)
        if not places.size:
            return
        self._keep(abscissa, rows[places], places, exact)
        rows, at = np.nonzero(flat[:, places] > use[places])
        if rows.size:
            self._keep(abscissa, rows, places[at], exact)

    def _keep(
        self,
        abscissa: np.ndarray,
        rows: np.ndarray,
        places: np.ndarray,
        exact: Callable[[np.ndarray, np.ndarray], np.ndarray],
    ) -> None:
        use, at = self.use.reshape(-1), self.at.reshape(-1)
        cut = range(0, len(rows), _AT_ONCE)
        found = np.concatenate([exact(rows[i : i + _AT_ONCE], places[i : i + _AT_ONCE]) for i in cut])
        more = np.flatnonzero(found > use[places])
        order = more[np.lexsort((-rows[more], found[more]))]  # of a place the last assignment stays: the first largest
        use[places[order]] = found[order]
        at[places[order]] = abscissa[rows[order]]


class _Sections:
    """Constants of the sections of members for the clauses, and what bounds their use.

    Args:
        plastic: the members as of class 1 or 2.
        elastic: as of class 3.
        about_z: whether the class is that under bending about both axes.
    """

    checks = mask(Check.N_M)
    places = 2  # of a member

    def __init__(self, plastic: Sequence[SteelMember], elastic: Sequence[SteelMember], about_z: bool) -> None:
        distinct = {id(member): i for i, member in enumerate({id(member): member for member in plastic}.values())}
        first = [next(i for i, member in enumerate(plastic) if distinct[id(member)] == k) for k in range(len(distinct))]
        self._kind = np.array([distinct[id(member)] for member in plastic])
        kinds = [of[i] for of in (plastic, elastic) for i in first]
        self._table = MemberTable.of([member.constants for member in kinds])
        self._annex_a = plastic[0].annex_a
        limits = [_class_limits(plastic[i], about_z) for i in first]
        self._plastic_up_to, self._elastic_up_to = np.array(limits)[self._kind].T
        self._lowest = float(self._plastic_up_to.min())
        self._prepare()

    def _prepare(self) -> None:
        grow_y, grow_z = 1.0 / (1.0 - 0.5 * self._of("a_y")), 1.0 / (1.0 - 0.5 * self._of("a_z"))
        resistances = (1.0 / self._of(f"{name}_Rd") for name in ("N", "M_y", "M_z"))
        self._factors = [of[:, None] for of in (*resistances, grow_y, grow_z)]

    def _of(self, name: str) -> np.ndarray:
        """A constant of all members as of class 1 or 2."""
        return self._table.column(name)[self._kind]

    def bound(self, forces: Forces) -> np.ndarray:
        """Return what the use of no place passes; infinite where the class leaves the clauses of class 2.

        Args:
            forces: of n steps.
        """
        found = self._plastic_bound(forces)
        if float(forces.compression.max()) > self._lowest:
            limit = self._plastic_up_to.reshape(-1, *(1,) * (found.ndim - 2))
            found[forces.compression > limit] = np.inf
        return found

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """M_N,Rd / M_Rd is at least what is taken here; exponents are at least 1.5, or 1 of I sections about z."""
        per_N, per_M_y, per_M_z, grow_y, grow_z = self._factors
        n, m_y, m_z = np.abs(forces.compression) * per_N, forces.M_y * per_M_y, forces.M_z * per_M_z
        linear = n + m_y + m_z
        left = np.maximum(1.0 - n, 1e-9)
        m_y /= np.minimum(left * grow_y, 1.0)
        m_z /= np.minimum(left * grow_z, 1.0)
        powers = np.maximum(np.maximum(m_y, m_z), m_y * np.sqrt(m_y) + m_z)
        return np.where((m_y > 1.0) | (m_z > 1.0), linear, np.minimum(powers, linear))

    def use(self, forces: Forces, rows: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Return the use in steps of places, for which the core takes them as members of their own.

        Args:
            forces: of n steps.
            rows: (k,) the steps.
            places: (k,) the places, one after the other.
        """
        members, shape = places // self.places, (len(forces.M_y), -1)
        compression, M_y, M_z = (of.reshape(shape)[rows, places] for of in (forces.compression, forces.M_y, forces.M_z))
        elastic = compression > self._plastic_up_to[members]
        kinds = self._kind[members] + elastic * (len(self._table.kind) // 2)
        statics = np.zeros((1, len(rows), 1, len(FORCES)))
        for place, of in zip((_N, _M_Y, _M_Z), (-compression, M_y, M_z), strict=True):
            statics[0, :, 0, place] = of
        found = member_checks(
            statics=statics,
            spectral=np.zeros((0, len(rows), 1, len(FORCES))),
            static_factors=np.ones((1, 1)),
            spectral_factors=np.zeros((1, 0)),
            combination_set=np.zeros(1, dtype=int),
            gravity=np.zeros(1, dtype=int),
            members=MemberTable(self._table.constants[kinds], self._table.kind[kinds]),
            masks=np.full((len(rows), 1), self.checks),
        )
        use = found.utilisation.max(axis=1)
        return np.where(elastic & (compression > self._elastic_up_to[members]), np.inf, use)


class _Buckling(_Sections):
    """Constants of members against buckling, and what bounds their use."""

    checks = mask(*MEMBER_CHECKS)
    places = 1

    def _prepare(self) -> None:
        y, z, C_my, C_mz = (self._of(name) for name in ("lambda_y", "lambda_z", "C_my", "C_mz"))
        of_i, twists = self._table.i_shaped[self._kind], self._table.twists[self._kind]
        of_shape = np.where(of_i, np.clip(2.0 * z - 0.6, 0.0, 1.4), np.clip(z - 0.2, 0.0, 0.8))
        self._k_yy = C_my, C_my * np.clip(y - 0.2, 0.0, 0.8)
        self._k_zz = C_mz, C_mz * of_shape
        self._k_zy = np.where(twists, np.minimum(1.0, 0.6 + z), 0.0), np.where(twists, 0.0, 0.6)
        self._per = [1.0 / self._of(name) for name in ("N_b_y_Rd", "N_b_z_Rd", "M_b_Rd", "M_z_Rk")]

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """Tables B.1 and B.2 with factors that do not fall; infinite with Annex A, whose factors have no such bound."""
        if self._annex_a:
            return np.full(forces.M_y.shape, np.inf)
        compression = np.maximum(forces.compression, 0.0)
        per_y, per_z, per_M_y, per_M_z = self._per
        n_y, n_z, m_y, m_z = compression * per_y, compression * per_z, forces.M_y * per_M_y, forces.M_z * per_M_z
        k_yy, k_zz = (constant + slope * n for (constant, slope), n in ((self._k_yy, n_y), (self._k_zz, n_z)))
        about_z = k_zz * m_z
        of_twist, of_bending = self._k_zy
        about_y = np.maximum(n_y + k_yy * m_y + 0.6 * about_z, n_z + (of_twist + of_bending * k_yy) * m_y + about_z)
        return np.maximum(about_y, m_y)


def _class_limits(member: SteelMember, about_z: bool) -> tuple[float, float]:
    """The compressions up to which a bent section is of class 2 and of class 3, N; below zero: never."""
    found = []
    for number in (LARGEST_PLASTIC_CLASS, LARGEST_CLASS):

        def within(force: float, number: int = number) -> bool:
            return section_class(member.section, member.fy, -force, about_y=True, about_z=about_z).number <= number

        low, high = 0.0, member.section.A * member.fy
        if not within(low):
            found.append(-math.inf)
        elif within(high):
            found.append(math.inf)
        else:
            while high - low > 1e-9 * high:
                middle = 0.5 * (low + high)
                low, high = (middle, high) if within(middle) else (low, middle)
            found.append(low)
    return found[0], found[1]


def _moments_inside(uniform: np.ndarray, points: Sequence[tuple[float, np.ndarray]], length: float) -> np.ndarray:
    """Moments about y and z that loads inside give a simply supported member at `STATIONS`, (n, 2) N m.

    Args:
        uniform: (3,) in the axes of the member, N/m.
        points: place as a share of the length, and force, (3,) N.
        length: m.
    """
    shape = np.multiply.outer(0.5 * STATIONS * (1.0 - STATIONS) * length**2, uniform)
    for position, force in points:
        nearer = np.minimum(STATIONS * (1.0 - position), position * (1.0 - STATIONS))
        shape = shape + np.multiply.outer(nearer * length, force)
    return np.stack([shape[:, 2], -shape[:, 1]], axis=1)
