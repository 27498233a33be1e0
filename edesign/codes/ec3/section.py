"""A section of steel, with the properties that the clauses ask for."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

DENSITY = 7850.0  # of steel, kg/m3; EN 1991-1-1, Table A.4, and EN 10365

Shape = Literal["I", "RHS", "CHS", "L", "2U", "U", "BRB", "other"]


@dataclass(frozen=True)
class SteelSection:
    """A doubly symmetric section of steel, or an angle, in SI; y is the strong axis (of a square section either).

    Attributes:
        name: as the catalogue has it: `IPE330`, `SHS200x10`.
        kind: I; RHS: hollow, square or rectangular; CHS: hollow, circular; L: an angle, y and z its principal axes u
            and v; 2U: two channels back to back; U: one, of tables alone; BRB: the core of a buckling-restrained brace,
            known by its area; other: of a shape that no clause knows. Of the last five the section moduli and the shear
            areas of the clauses are nan.
        cold_formed: a hollow section by EN 10219; otherwise hot rolled or hot finished.
        h, b: height and width, of a CHS its diameter, m.
        tw, tf: thickness of web and flanges; of hollow sections that are not welded both the wall, m.
        r: radius of the fillets of an I section; outer radius of the corners of an RHS; 0 of a CHS; m.
        A: area, m2.
        A_vy, A_vz: shear areas of EN 1993-1-1, 6.2.6(3), for forces along y and z, m2.
        A_y, A_z: shear areas of the elastic shear deformation, m2.
        I_y, I_z: second moments of area, m4.
        I_t: St Venant torsion constant, m4.
        I_w: warping constant, m6; 0 of hollow sections, which hardly warp.
        W_el_y, W_el_z, W_pl_y, W_pl_z: elastic and plastic section moduli, m3.
        i_y, i_z: radii of gyration, m.
        mass: kg/m.
        welded: of plates; otherwise rolled or hollow.
        parts: of a riveted I section, whose flanges are no single plates: name, c/t and whether it is an outstand of
            each flat part of a flange, and the depth of the web that is free, m, behind "web".
    """

    name: str
    kind: Shape
    cold_formed: bool
    h: float
    b: float
    tw: float
    tf: float
    r: float
    A: float
    A_vy: float
    A_vz: float
    A_y: float
    A_z: float
    I_y: float
    I_z: float
    I_t: float
    I_w: float
    W_el_y: float
    W_el_z: float
    W_pl_y: float
    W_pl_z: float
    welded: bool = False
    parts: tuple[tuple[str, float, bool], ...] = ()

    @classmethod
    def of(cls, name: str, kind: Shape, **known: float) -> SteelSection:
        """Return a section of which some properties are known.

        Args:
            known: by their names, SI; without them moduli and the shear areas of the clauses are nan, others 0.
        """
        unknown = dict.fromkeys(("A_vy", "A_vz", "W_el_y", "W_el_z", "W_pl_y", "W_pl_z"), math.nan)
        none = dict.fromkeys(("h", "b", "tw", "tf", "r", "A", "A_y", "A_z", "I_y", "I_z", "I_t", "I_w"), 0.0)
        values: dict[str, Any] = {**none, **unknown, **known}
        return cls(name=name, kind=kind, cold_formed=False, **values)

    @property
    def has_class(self) -> bool:
        """Whether EN 1993-1-1 classifies it, and can check members of it."""
        return self.kind not in ("other", "U")

    @property
    def axial_alone(self) -> bool:
        """Whether its checks are those of an axial force alone, so that only pin-ended braces may have it."""
        return self.kind in ("L", "2U", "BRB")

    @property
    def webs(self) -> int:
        """Number of plane webs that carry shear along z."""
        return {"I": 1, "RHS": 2, "CHS": 0, "L": 0, "2U": 2, "U": 1, "BRB": 0, "other": 0}[self.kind]

    @property
    def h_w(self) -> float:
        """Height between the flanges, m."""
        return self.h - 2.0 * self.tf

    @property
    def i_y(self) -> float:
        """Radius of gyration about the strong axis y, m."""
        return math.sqrt(self.I_y / self.A)

    @property
    def i_z(self) -> float:
        """Radius of gyration about the weak axis z, m."""
        return math.sqrt(self.I_z / self.A)

    @property
    def mass(self) -> float:
        """Mass of the section, kg/m."""
        return DENSITY * self.A
