"""Utilisation of steel members by EN 1993-1-1 and EN 1998-1 over combinations and stations, computed by the core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from enum import IntEnum
from operator import attrgetter
from typing import Any, Literal

import numpy as np

from edesign.core._edcore import ffi, lib
from edesign.core.errors import CoreError, status_name

FORCES = ("N", "V_y", "V_z", "T", "M_y", "M_z")

Shape = Literal["I", "RHS", "CHS"]

_SHAPES = {"I": lib.ED_I, "RHS": lib.ED_RHS, "CHS": lib.ED_CHS}


class Check(IntEnum):
    """The checks, by their column in the results."""

    N = lib.ED_CHECK_N
    V_Y = lib.ED_CHECK_V_Y
    V_Z = lib.ED_CHECK_V_Z
    M_Y = lib.ED_CHECK_M_Y
    M_Z = lib.ED_CHECK_M_Z
    N_M = lib.ED_CHECK_N_M
    N_B = lib.ED_CHECK_N_B
    M_B = lib.ED_CHECK_M_B
    EQ_6_61 = lib.ED_CHECK_6_61
    EQ_6_62 = lib.ED_CHECK_6_62
    BEAM_M = lib.ED_CHECK_BEAM_M
    BEAM_N = lib.ED_CHECK_BEAM_N
    BEAM_V = lib.ED_CHECK_BEAM_V
    COLUMN_V = lib.ED_CHECK_COLUMN_V


CLAUSES: dict[Check, str] = {
    Check.N: "EN 1993-1-1, 6.2.3, 6.2.4",
    Check.V_Y: "EN 1993-1-1, 6.2.6",
    Check.V_Z: "EN 1993-1-1, 6.2.6",
    Check.M_Y: "EN 1993-1-1, 6.2.5, 6.2.8",
    Check.M_Z: "EN 1993-1-1, 6.2.5, 6.2.8",
    Check.N_M: "EN 1993-1-1, 6.2.9, 6.2.10",
    Check.N_B: "EN 1993-1-1, 6.3.1",
    Check.M_B: "EN 1993-1-1, 6.3.2",
    Check.EQ_6_61: "EN 1993-1-1, 6.3.3, Eq. 6.61",
    Check.EQ_6_62: "EN 1993-1-1, 6.3.3, Eq. 6.62",
    Check.BEAM_M: "EN 1998-1, 6.6.2(2), Eq. 6.2",
    Check.BEAM_N: "EN 1998-1, 6.6.2(2), Eq. 6.3",
    Check.BEAM_V: "EN 1998-1, 6.6.2(2), Eq. 6.4",
    Check.COLUMN_V: "EN 1998-1, 6.6.3(4), Eq. 6.7",
}

SECTION_CHECKS = (Check.N, Check.V_Y, Check.V_Z, Check.M_Y, Check.M_Z, Check.N_M)
MEMBER_CHECKS = (Check.N_B, Check.M_B, Check.EQ_6_61, Check.EQ_6_62)
BEAM_CHECKS = (Check.BEAM_M, Check.BEAM_N, Check.BEAM_V)


def mask(*checks: Check) -> int:
    """Return a set of checks as bits."""
    return sum({1 << check for check in checks})


@dataclass(frozen=True)
class MemberConstants:
    """Constants of a member for its checks, in SI; the order is that of the core.

    Attributes:
        N_Rd: A f_y / gamma_M0.
        V_y_Rd, V_z_Rd: shear resistances, of yielding or of the buckling of webs.
        M_y_Rd, M_z_Rd: W_pl f_y / gamma_M0, of class 3 W_el f_y / gamma_M0.
        M_y_shear: the part of M_y_Rd that the shear area carries (Eq. 6.30); all of it is on the safe side.
        N_web: h_w t_w f_y / gamma_M0 of an I section (Eq. 6.34), otherwise 0.
        a_y, a_z: web shares, at most 0.5 (Eqs. 6.36 to 6.40).
        N_b_y_Rd, N_b_z_Rd: buckling resistances.
        M_b_Rd: chi_LT M_y,Rk / gamma_M1.
        M_z_Rk: M_z,Rk / gamma_M1.
        lambda_y, lambda_z: slendernesses in flexural buckling.
        C_my, C_mz, C_mLT: equivalent uniform moment factors.
        V_M: V_Ed,M = (M_pl,A + M_pl,B) / L of EN 1998-1, 6.6.2(2); 0 where it is not checked.
        N_Rk: A f_y / gamma_M1; this and what follows is of Annex A alone.
        per_N_cr_y, per_N_cr_z, per_N_cr_T: 1 / N_cr of flexural and torsional buckling, 1/N; 0 where it is
            restrained all along.
        chi_z: of flexural buckling.
        elastic_y, elastic_z: W_el / W_pl.
        a_LT: 1 - I_t / I_y, at least 0.
        lambda_0: slenderness in lateral torsional buckling under uniform moment; 0 without it.
        LT_limit: 0.2 sqrt(C1), where it begins.
        area_by_modulus: A / W_el,y, 1/m.
        C_my_N, C_mz_N: slopes of C_mi,0 = C_mi + C_mi_N N_Ed / N_cr,i.
        shape: of the section.
        class_3: elastic moduli and factors; otherwise class 1 or 2.
        twists: susceptible to torsional deformation (Table B.2).
        annex_a: k_ij of Annex A; otherwise of Annex B.
    """

    N_Rd: float
    V_y_Rd: float
    V_z_Rd: float
    M_y_Rd: float
    M_z_Rd: float
    M_y_shear: float
    N_web: float
    a_y: float
    a_z: float
    N_b_y_Rd: float
    N_b_z_Rd: float
    M_b_Rd: float
    M_z_Rk: float
    lambda_y: float
    lambda_z: float
    C_my: float
    C_mz: float
    C_mLT: float
    V_M: float = 0.0
    N_Rk: float = 0.0
    per_N_cr_y: float = 0.0
    per_N_cr_z: float = 0.0
    per_N_cr_T: float = 0.0
    chi_z: float = 1.0
    elastic_y: float = 1.0
    elastic_z: float = 1.0
    a_LT: float = 0.0
    lambda_0: float = 0.0
    LT_limit: float = 0.0
    area_by_modulus: float = 0.0
    C_my_N: float = 0.0
    C_mz_N: float = 0.0
    shape: Shape = "I"
    class_3: bool = False
    twists: bool = True
    annex_a: bool = False

    @property
    def kind(self) -> int:
        """Shape, class, twisting and annex as the core takes them."""
        bits = self.class_3 * lib.ED_CLASS_3 | (not self.twists) * lib.ED_NO_TWIST | self.annex_a * lib.ED_ANNEX_A
        return int(_SHAPES[self.shape] | bits)


_NAMES = tuple(field.name for field in fields(MemberConstants)[: lib.ED_N_CONSTANTS])
_numbers = attrgetter(*_NAMES)


@dataclass(frozen=True)
class MemberTable:
    """The constants of all members as the core takes them; made once, used for many passes.

    Attributes:
        constants: (n_members, n_constants) in the order of `MemberConstants`.
        kind: (n_members,) shape, class and twisting.
    """

    constants: np.ndarray
    kind: np.ndarray

    @classmethod
    def of(cls, members: Sequence[MemberConstants]) -> MemberTable:
        """Return the table of some members.

        Args:
            members: n_members.
        """
        constants = np.array([_numbers(member) for member in members], dtype=float).reshape(-1, lib.ED_N_CONSTANTS)
        return cls(constants, np.array([member.kind for member in members], dtype=np.intc))

    @property
    def i_shaped(self) -> np.ndarray:
        """Whether each section is an I, (n_members,)."""
        return np.asarray(self.kind & (lib.ED_I | lib.ED_RHS | lib.ED_CHS) == lib.ED_I)

    @property
    def twists(self) -> np.ndarray:
        """Whether each member is susceptible to torsional deformation, (n_members,)."""
        return np.asarray(self.kind & lib.ED_NO_TWIST == 0)

    def column(self, name: str) -> np.ndarray:
        """Return one constant of all members, (n_members,), by its name.

        Args:
            name: a field of `MemberConstants`.
        """
        return self.constants[:, _NAMES.index(name)]


@dataclass(frozen=True)
class Utilisations:
    """The largest utilisation of each member and check, and what gives it.

    Attributes:
        utilisation: (n_members, n_checks); 1 is the limit; 0 where the check never applied; may be infinite where shear
            leaves no resistance to bending.
        combination, station: (n_members, n_checks) the first that gives it; -1 where the check never applied. Member
            checks have the station of the largest compression (N_B), else of the largest M_y.
    """

    utilisation: np.ndarray
    combination: np.ndarray
    station: np.ndarray


def member_checks(
    statics: np.ndarray,
    spectral: np.ndarray,
    static_factors: np.ndarray,
    spectral_factors: np.ndarray,
    combination_set: np.ndarray,
    gravity: np.ndarray,
    members: MemberTable,
    masks: np.ndarray,
    M_b: np.ndarray | None = None,
) -> Utilisations:
    """Return the utilisations of all members under all combinations.

    In each combination N takes both signs of the spectral part, moments and shears the sign that adds. T is not
    checked.

    Args:
        statics: (c, m, s, 6) forces of static cases: N (tension positive), V_y, V_z, T, M_y, M_z at s stations, N, N m.
        spectral: (d, m, s, 6) magnitudes of the responses to d directions.
        static_factors: (k, c) of k combinations.
        spectral_factors: (k, d); the sign does not count.
        combination_set: (k,) which column of `masks` holds for a combination.
        gravity: (c,) whether a case counts in V_Ed,G of EN 1998-1, 6.6.2(2).
        masks: (m, n_sets) checks of a member under the combinations of a set, by `mask`.
        M_b: (m, k) M_b,Rd of members under combinations; without it that of their constants.

    Raises:
        ValueError: shapes do not fit together.
        CoreError: a value is not finite, a resistance is not greater than zero, or a response is negative.
    """
    arrays = [_doubles(x) for x in (statics, spectral, static_factors, spectral_factors)]
    of_sets, of_cases, of_members = (np.ascontiguousarray(x, dtype=np.intc) for x in (combination_set, gravity, masks))
    c, m, s, n_forces = arrays[0].shape
    d, k = arrays[1].shape[0], of_sets.shape[0]
    shapes = [a.shape for a in (*arrays, of_sets, of_cases)]
    if shapes != [(c, m, s, len(FORCES)), (d, m, s, len(FORCES)), (k, c), (k, d), (k,), (c,)] or n_forces != len(
        FORCES
    ):
        raise ValueError(f"shapes do not fit together: {shapes}")
    if len(members.kind) != m or of_members.ndim != 2 or of_members.shape[0] != m:
        raise ValueError(f"{len(members.kind)} constants and masks {of_members.shape} of {m} members")
    if M_b is not None and M_b.shape != (m, k):
        raise ValueError(f"M_b has the shape {M_b.shape}, not {(m, k)}")
    moments = None if M_b is None else _doubles(M_b)
    constants, kind = _doubles(members.constants), np.ascontiguousarray(members.kind, dtype=np.intc)
    utilisation = np.zeros((m, len(Check)))
    combination, station = np.full((2, m, len(Check)), -1, dtype=np.intc)
    status = lib.ed_member_checks(
        *(c, d, m, s, k, of_members.shape[1]),
        *(_c(a) for a in arrays),
        *(_c(a, "int[]") for a in (of_sets, of_cases)),
        _c(constants),
        *(_c(a, "int[]") for a in (kind, of_members)),
        ffi.NULL if moments is None else _c(moments),
        _c(utilisation),
        *(_c(a, "int[]") for a in (combination, station)),
    )
    if status < 0:
        raise CoreError(status_name(status), f"checks of members: {ffi.string(lib.ed_status_text(status)).decode()}")
    return Utilisations(utilisation, combination, station)


def _doubles(values: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(values, dtype=float)


def _c(array: np.ndarray, kind: str = "double[]") -> Any:
    return ffi.from_buffer(kind, array)
