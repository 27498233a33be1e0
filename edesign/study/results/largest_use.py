"""The largest uses of sections and members so far, while steps come: bounds in arrays, the clauses where they pass."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass
from typing import Self

import numpy as np

from edesign.core.member_checks import FORCES, MEMBER_CHECKS, Check, MemberTable, mask, member_checks
from edesign.frame.sections.section_class import section_class
from edesign.space.checks.member_checks import LARGEST_CLASS, LARGEST_PLASTIC_CLASS
from edesign.space.checks.steel_member import SteelMember
from edesign.study.results.checked_members import CheckedMember

_AT_ONCE = 2**13
"""Steps of members that the core is given at once, 2 MB of constants."""
_N, _V_Y, _V_Z, _M_Y, _M_Z = (FORCES.index(name) for name in ("N", "V_y", "V_z", "M_y", "M_z"))


@dataclass(frozen=True)
class Forces:
    """Forces of steps at places: members, or their ends.

    Attributes:
        compression: (n, m) or (n, m, 2), N.
        M_y: magnitude, N m.
        M_z: likewise; None: there is none.
        V_y, V_z: magnitudes, N; None: there is none, or it is not asked for.
    """

    compression: np.ndarray
    M_y: np.ndarray
    M_z: np.ndarray | None = None
    V_y: np.ndarray | None = None
    V_z: np.ndarray | None = None


Exact = Callable[[np.ndarray, np.ndarray], np.ndarray]
SHEAR_COUNTS = 0.5
"""Share of V_Rd from which shear reduces other resistances (EN 1993-1-1, 6.2.8(2), 6.2.10(2))."""


class Largest:
    """The largest use so far of each place, where it was, and the forces there.

    Args:
        width: number of the forces that are kept of each.
    """

    def __init__(self, shape: tuple[int, ...], width: int) -> None:
        self.use, self.at = np.zeros(shape), np.full(shape, np.nan)
        self.forces = np.full((*shape, width), np.nan)

    def see(
        self,
        abscissa: np.ndarray,
        bound: np.ndarray,
        exact: Exact,
        forces: Exact,
        chosen: np.ndarray,
    ) -> None:
        """See further steps.

        Args:
            abscissa: (n,).
            bound: (n, ...) never less than the use, of the chosen places.
            exact: gives the use in steps of chosen places, both as numbers.
            forces: likewise what is kept of them, (k, width).
            chosen: (places,) numbers of the places among all.
        """
        flat = bound.reshape(len(bound), -1)
        use = self.use.reshape(-1)
        rows = flat.argmax(axis=0)
        places = np.flatnonzero(flat[rows, np.arange(chosen.size)] > use[chosen])
        if not places.size:
            return
        self._keep(abscissa, rows[places], places, exact, forces, chosen)
        rows, at = np.nonzero(flat[:, places] > use[chosen[places]])
        if rows.size:
            self._keep(abscissa, rows, places[at], exact, forces, chosen)

    def _keep(
        self,
        abscissa: np.ndarray,
        rows: np.ndarray,
        places: np.ndarray,
        exact: Exact,
        forces: Exact,
        chosen: np.ndarray,
    ) -> None:
        use, at = self.use.reshape(-1), self.at.reshape(-1)
        cut = range(0, len(rows), _AT_ONCE)
        found = np.concatenate([exact(rows[i : i + _AT_ONCE], places[i : i + _AT_ONCE]) for i in cut])
        more = np.flatnonzero(found > use[chosen[places]])
        order = more[np.lexsort((-rows[more], found[more]))]  # of a place the last assignment stays: the first largest
        to = chosen[places[order]]
        use[to] = found[order]
        at[to] = abscissa[rows[order]]
        self.forces.reshape(use.size, -1)[to] = forces(rows[order], places[order])


class Sections:
    """Constants of the sections of members for the clauses, and what bounds their use.

    Args:
        members: one after the other.
        about: about which axes, y and z, members bend for the class of their section.
    """

    checks = mask(Check.N_M, Check.V_Y, Check.V_Z)
    places = 2  # of a member

    def __init__(self, members: Sequence[CheckedMember], about: tuple[bool, bool]) -> None:
        distinct: dict[tuple[int, bool], int] = {}
        kinds: list[CheckedMember] = []
        for member in members:
            if (id(member.plastic), member.weak) not in distinct:
                distinct[id(member.plastic), member.weak] = len(kinds)
                kinds.append(member)
        self._kind = np.array([distinct[id(member.plastic), member.weak] for member in members])
        self._table = MemberTable.of(
            [of.constants for kind in ("plastic", "elastic") for of in (getattr(k, kind) for k in kinds)]
        )
        self._annex_a = kinds[0].plastic.annex_a
        limits = [class_limits(kind.plastic, (False, True) if kind.weak else about) for kind in kinds]
        self._plastic_up_to, self._elastic_up_to = np.array(limits)[self._kind].T
        self._lowest = float(self._plastic_up_to.min())
        self._prepare()

    def _prepare(self) -> None:
        grow_y, grow_z = 1.0 / (1.0 - 0.5 * self._of("a_y")), 1.0 / (1.0 - 0.5 * self._of("a_z"))
        names = ("N", "M_y", "M_z", "V_y", "V_z")
        resistances = (1.0 / self._of(f"{name}_Rd") for name in names)
        self._factors = [of[:, None] for of in resistances]
        self._grow = grow_y[:, None], grow_z[:, None]

    def _of(self, name: str) -> np.ndarray:
        """A constant of all members as of class 1 or 2."""
        return self._table.column(name)[self._kind]

    def of(self, chosen: np.ndarray) -> Self:
        """Return the same of some members."""
        if chosen.size == self._kind.size:
            return self
        found = copy(self)
        found._kind = self._kind[chosen]
        found._plastic_up_to, found._elastic_up_to = self._plastic_up_to[chosen], self._elastic_up_to[chosen]
        found._prepare()
        return found

    def ceiling(self, forces: Forces) -> np.ndarray:
        """Return what the use passes under no forces of these magnitudes or less, each by itself.

        Args:
            forces: of n steps; of the axial force the magnitude.
        """
        return self._bound(forces, self._highest)

    def bound(self, forces: Forces) -> np.ndarray:
        """Return what the use of no place passes; infinite where the class leaves the clauses of class 2.

        Args:
            forces: of n steps.
        """
        return self._bound(forces, self._plastic_bound)

    def _bound(self, forces: Forces, of: Callable[[Forces], np.ndarray]) -> np.ndarray:
        found = of(forces)
        if float(forces.compression.max()) > self._lowest:
            limit = self._plastic_up_to.reshape(-1, *(1,) * (found.ndim - 2))
            found[forces.compression > limit] = np.inf
        return found

    def _highest(self, forces: Forces) -> np.ndarray:
        """The sum of 6.2.1(7), which grows with each force."""
        n, m_y, m_z, shear = self._shares(forces)
        return np.maximum(n + m_y if m_z is None else n + m_y + m_z, shear)

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """M_N,Rd / M_Rd is at least what is taken here; exponents are at least 1.5, or 1 of I sections about z."""
        n, m_y, m_z, shear = self._shares(forces)
        grow_y, grow_z = self._grow
        linear = n + m_y if m_z is None else n + m_y + m_z
        left = np.maximum(1.0 - n, 1e-9)
        m_y = m_y / np.minimum(left * grow_y, 1.0)
        if m_z is None:
            return np.maximum(np.where(m_y > 1.0, linear, np.minimum(m_y, linear)), shear)
        m_z = m_z / np.minimum(left * grow_z, 1.0)
        powers = np.maximum(np.maximum(m_y, m_z), m_y * np.sqrt(m_y) + m_z)
        within = np.where((m_y > 1.0) | (m_z > 1.0), linear, np.minimum(powers, linear))
        return np.maximum(within, shear)

    def _shares(self, forces: Forces) -> tuple[np.ndarray, np.ndarray, np.ndarray | None, np.ndarray]:
        """N, M_y and M_z over what shear leaves at least, 1 - rho_y - rho_z (6.2.8(3), 6.2.10(3)), and shear alone."""
        per_N, per_M_y, per_M_z, per_V_y, per_V_z = self._factors
        n, m_y = np.abs(forces.compression) * per_N, forces.M_y * per_M_y
        m_z = None if forces.M_z is None else forces.M_z * per_M_z
        shears = [V * per for V, per in ((forces.V_y, per_V_y), (forces.V_z, per_V_z)) if V is not None]
        shear = shears[0] if len(shears) == 1 else np.maximum(*shears)
        if float(shear.max()) > SHEAR_COUNTS:
            left = 1.0 - sum(np.clip(2.0 * v - 1.0, 0.0, 1.0) ** 2 for v in shears)
            grown = 1.0 / np.maximum(left, 1e-9)
            n, m_y, m_z = n * grown, m_y * grown, None if m_z is None else m_z * grown
        return n, m_y, m_z, shear

    def use(self, forces: Forces, rows: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Return the use in steps of places, for which the core takes them as members of their own.

        Args:
            forces: of n steps.
            rows: (k,) the steps.
            places: (k,) the places, one after the other.
        """
        members, shape = places // self.places, (len(forces.M_y), -1)
        compression, *others = (
            np.zeros(len(rows)) if of is None else of.reshape(shape)[rows, places]
            for of in (forces.compression, forces.V_y, forces.V_z, forces.M_y, forces.M_z)
        )
        elastic = compression > self._plastic_up_to[members]
        kinds = self._kind[members] + elastic * (len(self._table.kind) // 2)
        statics = np.zeros((1, len(rows), 1, len(FORCES)))
        for place, of in zip((_N, _V_Y, _V_Z, _M_Y, _M_Z), (-compression, *others), strict=True):
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


class Buckling(Sections):
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

    def _highest(self, forces: Forces) -> np.ndarray:
        return self._plastic_bound(forces)

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """Tables B.1 and B.2 with factors that do not fall; infinite with Annex A, whose factors have no such bound."""
        if self._annex_a:
            return np.full(forces.M_y.shape, np.inf)
        compression = np.maximum(forces.compression, 0.0)
        per_y, per_z, per_M_y, per_M_z = self._per
        n_y, n_z, m_y = compression * per_y, compression * per_z, forces.M_y * per_M_y
        of_twist, of_bending = self._k_zy
        k_yy = self._k_yy[0] + self._k_yy[1] * n_y
        about_y, about_z = n_y + k_yy * m_y, n_z + (of_twist + of_bending * k_yy) * m_y
        if forces.M_z is not None:
            of_z = (self._k_zz[0] + self._k_zz[1] * n_z) * forces.M_z * per_M_z
            about_y, about_z = about_y + 0.6 * of_z, about_z + of_z
        return np.maximum(np.maximum(about_y, about_z), m_y)


def class_limits(member: SteelMember, about: tuple[bool, bool]) -> tuple[float, float]:
    """Return the compressions up to which a bent section is of class 2 and of class 3, N; below zero: never.

    Args:
        about: whether it bends about y, and about z.
    """
    found = []
    for number in (LARGEST_PLASTIC_CLASS, LARGEST_CLASS):

        def within(force: float, number: int = number) -> bool:
            return section_class(member.section, member.fy, -force, *about).number <= number

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
