"""Steel sections with all their properties: rolled I sections of the catalogue, and hollow sections by their names."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal

from edesign.building.sections.hollow_section import hollow_section
from edesign.building.sections.profiles import Profile, profile, profile_names
from edesign.building.sections.section import fillets

DENSITY = 7850.0  # of steel, kg/m3; EN 1991-1-1, Table A.4, and EN 10365

Kind = Literal["I", "RHS", "CHS"]


@dataclass(frozen=True)
class SteelSection:
    """A doubly symmetric section of steel, in SI; y is the strong axis (of a square hollow section either).

    Attributes:
        name: as the catalogue has it: `IPE330`, `SHS200x10`.
        kind: I; RHS: hollow, square or rectangular; CHS: hollow, circular.
        cold_formed: a hollow section by EN 10219; otherwise hot rolled or hot finished.
        h, b: height and width, of a CHS its diameter, m.
        tw, tf: thickness of web and flanges; of hollow sections both the wall, m.
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
    """

    name: str
    kind: Kind
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

    @property
    def webs(self) -> int:
        """Number of plane webs that carry shear along z."""
        return {"I": 1, "RHS": 2, "CHS": 0}[self.kind]

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


@cache
def steel_section(name: str) -> SteelSection:
    """Return a steel section by its name.

    Args:
        name: of a rolled I section, as `profile` takes it, or of a hollow section, sizes in mm: `SHS200x10`,
            `RHS200x100x8`, `CHS168.3x8`, hot finished, with or without `HF` before it; `CFSHS200x10` is cold formed.

    Raises:
        InputError: there is no such section, or the walls of a hollow one do not fit into it.
    """
    hollow = hollow_section(name)
    if hollow is None:
        known = profile_names().canonical(name)
        return _rolled(profile(known or name))
    return SteelSection(
        name=hollow.name,
        kind="CHS" if hollow.round else "RHS",
        cold_formed=hollow.cold_formed,
        h=hollow.h,
        b=hollow.b,
        tw=hollow.t,
        tf=hollow.t,
        r=hollow.r_o,
        A=hollow.A,
        A_vy=hollow.shear_area(along=hollow.b, across=hollow.h),
        A_vz=hollow.shear_area(along=hollow.h, across=hollow.b),
        A_y=hollow.elastic_shear_area(along=hollow.b, across=hollow.h),
        A_z=hollow.elastic_shear_area(along=hollow.h, across=hollow.b),
        I_y=hollow.inertia(depth=hollow.h, width=hollow.b),
        I_z=hollow.inertia(depth=hollow.b, width=hollow.h),
        I_t=hollow.I_t,
        I_w=0.0,
        W_el_y=2.0 * hollow.inertia(depth=hollow.h, width=hollow.b) / hollow.h,
        W_el_z=2.0 * hollow.inertia(depth=hollow.b, width=hollow.h) / hollow.b,
        W_pl_y=hollow.plastic_modulus(depth=hollow.h, width=hollow.b),
        W_pl_z=hollow.plastic_modulus(depth=hollow.b, width=hollow.h),
    )


def _rolled(shape: Profile) -> SteelSection:
    """Return a rolled I section: areas and their moments exact for three rectangles and four fillets.

    Source: A_vz EN 1993-1-1, 6.2.6(3)a with eta = 1, its safe value. A_vy: the flanges; (3)e for welded sections gives
        the same. A_z = h t_w and A_y = 5/6 of the flanges: exact to 5 % and, without the fillets, 10 % (finite
        elements). I_t and I_w (of the flanges): the formulas of the mills' tables (ArcelorMittal, Sections and
        merchant bars, notations and formulae); finite elements give I_t of five within 2.5 %.
    """
    h, b, tw, tf, r = shape.h, shape.b, shape.tw, shape.tf, shape.r
    clear, arm = h - 2.0 * tf, 0.5 * (h - tf)
    flange, web = b * tf, clear * tw
    pairs = fillets(0.5 * clear, r)  # below and above
    beside = fillets(-0.5 * tw, r)  # the same about the other axis: left and right of the web
    area = 2.0 * flange + web + sum(pair.area for pair in pairs)
    I_y = 2.0 * flange * (arm**2 + tf**2 / 12.0) + web * clear**2 / 12.0
    I_y += sum(pair.inertia + pair.area * pair.centre**2 for pair in pairs)
    I_z = (2.0 * flange * b**2 + web * tw**2) / 12.0
    I_z += sum(pair.inertia + pair.area * pair.centre**2 for pair in beside)
    circle = ((r + 0.5 * tw) ** 2 + (r + tf) ** 2 - r**2) / (2.0 * r + tf)  # in the joint of flange and web, diameter
    joints = 2.0 * tw / tf * (0.145 + 0.1 * r / tf) * circle**4
    return SteelSection(
        name=shape.name,
        kind="I",
        cold_formed=False,
        h=h,
        b=b,
        tw=tw,
        tf=tf,
        r=r,
        A=area,
        A_vy=2.0 * flange,
        A_vz=max(area - 2.0 * flange + (tw + 2.0 * r) * tf, web),
        A_y=2.0 * flange * 5.0 / 6.0,
        A_z=h * tw,
        I_y=I_y,
        I_z=I_z,
        I_t=2.0 / 3.0 * (b - 0.63 * tf) * tf**3 + clear * tw**3 / 3.0 + joints,
        I_w=flange * b**2 * (h - tf) ** 2 / 24.0,
        W_el_y=2.0 * I_y / h,
        W_el_z=2.0 * I_z / b,
        W_pl_y=2.0 * flange * arm + web * clear / 4.0 + sum(pair.area * abs(pair.centre) for pair in pairs),
        W_pl_z=flange * b / 2.0 + web * tw / 4.0 + sum(pair.area * abs(pair.centre) for pair in beside),
    )
