"""The largest uses of sections and members so far, while steps come: bounds in arrays, the clauses where they pass."""

from __future__ import annotations

import math
from collections.abc import Sequence
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
    """Forces at places, each in a step: of members, or of their ends.

    Attributes:
        compression: (k,), N.
        M_y: magnitude, N m.
        M_z: likewise; None: there is none.
        V_y, V_z: magnitudes, N; None: there is none, or it is not asked for.
    """

    compression: np.ndarray
    M_y: np.ndarray
    M_z: np.ndarray | None = None
    V_y: np.ndarray | None = None
    V_z: np.ndarray | None = None

    def of(self, chosen: np.ndarray) -> Forces:
        """Return those of some places, by their numbers."""
        parts = self.compression, self.M_y, self.M_z, self.V_y, self.V_z
        return Forces(*(None if of is None else of[chosen] for of in parts))  # type: ignore[arg-type]


_ROUNDING = 1.0 + 1e-12
"""Of sums that are taken in another order."""


class Largest:
    """The largest use so far of each place, where it was, and the forces there.

    Args:
        width: number of the forces that are kept of each.
    """

    def __init__(self, shape: tuple[int, ...], width: int) -> None:
        self.use, self.at = np.zeros(shape), np.full(shape, np.nan)
        self.forces = np.full((*shape, width), np.nan)

    def least(self, reached: np.ndarray) -> np.ndarray:
        """Return what a use must pass to be the largest of its place, (places,); minus infinity where it may have.

        Args:
            reached: (places,) what the use may reach in any case.
        """
        use = self.use.ravel()
        return np.where(reached > use, -np.inf, use)

    def see(self, abscissa: np.ndarray, places: np.ndarray, of: Sections, acting: Forces, forces: np.ndarray) -> None:
        """See places in further steps.

        Args:
            abscissa: (k,) of the steps, which rise for each place.
            places: (k,) their numbers.
            of: what stands there, k.
            acting: forces there.
            forces: (k, width) what is kept of them.
        """
        use, at = self.use.reshape(-1), self.at.reshape(-1)
        chosen = np.flatnonzero(of.bound(acting) > use[places])
        if not chosen.size:
            return
        pieces = [chosen[i : i + _AT_ONCE] for i in range(0, chosen.size, _AT_ONCE)]
        found = np.concatenate([of.of(piece).use(acting.of(piece)) for piece in pieces])
        more = np.flatnonzero(found > use[places[chosen]])
        order = more[
            np.lexsort((-chosen[more], found[more]))
        ]  # of a place the last assignment stays: the first largest
        best = chosen[order]
        use[places[best]], at[places[best]] = found[order], abscissa[best]
        self.forces.reshape(use.size, -1)[places[best]] = forces[best]


class Sections:
    """Constants of the sections of members for the clauses, and what bounds their use.

    Args:
        members: one after the other.
        about: about which axes, y and z, members bend for the class of their section.
    """

    checks = mask(Check.N_M, Check.V_Y, Check.V_Z)

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
        self._kinds = len(kinds)
        self._annex_a = kinds[0].plastic.annex_a
        limits = [class_limits(kind.plastic, (False, True) if kind.weak else about) for kind in kinds]
        self._plastic_up_to, self._elastic_up_to = np.array(limits).T
        self._prepare()

    def _prepare(self) -> None:
        self._grow = tuple(1.0 / (1.0 - 0.5 * self._of(name)) for name in ("a_y", "a_z"))
        self._per = tuple(1.0 / self._of(f"{name}_Rd") for name in ("N", "M_y", "M_z", "V_y", "V_z"))

    def _of(self, name: str) -> np.ndarray:
        """A constant of all kinds as of class 1 or 2."""
        return self._table.column(name)[: self._kinds]

    def of(self, chosen: np.ndarray) -> Self:
        """Return the same of some members, which may repeat."""
        found = copy(self)
        found._kind = self._kind[chosen]
        return found

    def ceiling(self, peak: Forces) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return a sum that the use does not pass under forces up to these: 6.2.1(7), with what shear leaves.

        Args:
            peak: magnitudes, of the axial force too.

        Returns:
            factors of N, M_y and M_z, and what the use may reach without them; each (k,).
        """
        factors, shear = self._factors(peak)
        shear[peak.compression > self._plastic_up_to[self._kind]] = np.inf
        per_N, per_M_y, per_M_z = (_ROUNDING * of for of in factors)
        return per_N, per_M_y, per_M_z, shear

    def bound(self, forces: Forces) -> np.ndarray:
        """Return what the use of no place passes, (k,); infinite where the class leaves the clauses of class 2."""
        found = self._plastic_bound(forces)
        found[forces.compression > self._plastic_up_to[self._kind]] = np.inf
        return found

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """M_N,Rd / M_Rd is at least what is taken here; exponents are at least 1.5, or 1 of I sections about z."""
        (per_N, per_M_y, per_M_z), shear = self._factors(forces)
        grow_y, grow_z = (of[self._kind] for of in self._grow)
        n, m_y = np.abs(forces.compression) * per_N, forces.M_y * per_M_y
        m_z = None if forces.M_z is None else forces.M_z * per_M_z
        linear = n + m_y if m_z is None else n + m_y + m_z
        left = np.maximum(1.0 - n, 1e-9)
        m_y = m_y / np.minimum(left * grow_y, 1.0)
        if m_z is None:
            return np.maximum(np.where(m_y > 1.0, linear, np.minimum(m_y, linear)), shear)
        m_z = m_z / np.minimum(left * grow_z, 1.0)
        powers = np.maximum(np.maximum(m_y, m_z), m_y * np.sqrt(m_y) + m_z)
        within = np.where((m_y > 1.0) | (m_z > 1.0), linear, np.minimum(powers, linear))
        return np.maximum(within, shear)

    def _factors(self, forces: Forces) -> tuple[tuple[np.ndarray, np.ndarray, np.ndarray], np.ndarray]:
        """1 / N, M_y and M_z that shear leaves at least, 1 - rho_y - rho_z (6.2.8(3), 6.2.10(3)), and shear alone."""
        per_N, per_M_y, per_M_z, per_V_y, per_V_z = (of[self._kind] for of in self._per)
        shears = [V * per for V, per in ((forces.V_y, per_V_y), (forces.V_z, per_V_z)) if V is not None]
        left = 1.0 - sum(np.clip(2.0 * v - 1.0, 0.0, 1.0) ** 2 for v in shears)
        grown = 1.0 / np.maximum(left, 1e-9)
        return (per_N * grown, per_M_y * grown, per_M_z * grown), shears[0] if len(shears) == 1 else np.maximum(*shears)

    def use(self, forces: Forces) -> np.ndarray:
        """Return the use of places, (k,), for which the core takes them as members of their own."""
        compression, count = forces.compression, len(self._kind)
        elastic = compression > self._plastic_up_to[self._kind]
        kinds = self._kind + elastic * self._kinds
        statics = np.zeros((1, count, 1, len(FORCES)))
        parts = -compression, forces.V_y, forces.V_z, forces.M_y, forces.M_z
        for place, of in zip((_N, _V_Y, _V_Z, _M_Y, _M_Z), parts, strict=True):
            statics[0, :, 0, place] = 0.0 if of is None else of
        found = member_checks(
            statics=statics,
            spectral=np.zeros((0, count, 1, len(FORCES))),
            static_factors=np.ones((1, 1)),
            spectral_factors=np.zeros((1, 0)),
            combination_set=np.zeros(1, dtype=int),
            gravity=np.zeros(1, dtype=int),
            members=MemberTable(self._table.constants[kinds], self._table.kind[kinds]),
            masks=np.full((count, 1), self.checks),
        )
        use = found.utilisation.max(axis=1)
        return np.where(elastic & (compression > self._elastic_up_to[self._kind]), np.inf, use)


class Buckling(Sections):
    """Constants of members against buckling, and what bounds their use."""

    checks = mask(*MEMBER_CHECKS)

    def _prepare(self) -> None:
        y, z, C_my, C_mz = (self._of(name) for name in ("lambda_y", "lambda_z", "C_my", "C_mz"))
        of_i, twists = self._table.i_shaped[: self._kinds], self._table.twists[: self._kinds]
        of_shape = np.where(of_i, np.clip(2.0 * z - 0.6, 0.0, 1.4), np.clip(z - 0.2, 0.0, 0.8))
        self._k = (
            *(C_my, C_my * np.clip(y - 0.2, 0.0, 0.8)),
            *(C_mz, C_mz * of_shape),
            *(np.where(twists, np.minimum(1.0, 0.6 + z), 0.0), np.where(twists, 0.0, 0.6)),
        )
        self._per = tuple(1.0 / self._of(name) for name in ("N_b_y_Rd", "N_b_z_Rd", "M_b_Rd", "M_z_Rk"))

    def ceiling(self, peak: Forces) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Return the sum of Eqs. 6.61 and 6.62 with the factors of the largest compression; see `Sections`."""
        k_yy, k_zz, k_zy, (per_y, per_z, per_M_y, per_M_z) = self._interaction(peak.compression)
        reached = np.where(peak.compression > self._plastic_up_to[self._kind], np.inf, 0.0)
        if self._annex_a:
            reached[:] = np.inf
        per_N, k_y = np.maximum(per_y, per_z), np.maximum(np.maximum(k_yy, k_zy), 1.0)
        return _ROUNDING * per_N, _ROUNDING * k_y * per_M_y, _ROUNDING * k_zz * per_M_z, reached

    def _interaction(
        self, compression: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, tuple[np.ndarray, ...]]:
        """k_yy, k_zz and k_zy of Tables B.1 and B.2 that do not fall with the compression, and 1 / resistances."""
        per = tuple(of[self._kind] for of in self._per)
        yy, yy_n, zz, zz_n, of_twist, of_bending = (of[self._kind] for of in self._k)
        k_yy, k_zz = yy + yy_n * (compression * per[0]), zz + zz_n * (compression * per[1])
        return k_yy, k_zz, of_twist + of_bending * k_yy, per

    def _plastic_bound(self, forces: Forces) -> np.ndarray:
        """Tables B.1 and B.2 with factors that do not fall; infinite with Annex A, whose factors have no such bound."""
        if self._annex_a:
            return np.full(forces.M_y.shape, np.inf)
        compression = np.maximum(forces.compression, 0.0)
        k_yy, k_zz, k_zy, (per_y, per_z, per_M_y, per_M_z) = self._interaction(compression)
        n_y, n_z, m_y = compression * per_y, compression * per_z, forces.M_y * per_M_y
        about_y, about_z = n_y + k_yy * m_y, n_z + k_zy * m_y
        if forces.M_z is not None:
            of_z = k_zz * forces.M_z * per_M_z
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
