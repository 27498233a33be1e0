"""Steel sections with all their properties: rolled I sections, I sections of plates, hollow sections, and angles."""

from __future__ import annotations

from functools import cache

from edesign.codes.ec3.section import SteelSection
from edesign.errors import InputError
from edesign.frame.sections.angles import angle, angle_name, near_angle
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.profiles import profile, profile_names
from edesign.frame.sections.section import fillets
from edesign.frame.sections.tapered import near_tapered, tapered, tapered_name
from edesign.frame.sections.torsion import i_torsion_constant


@cache
def steel_section(name: str) -> SteelSection:
    """Return a steel section by its name.

    Args:
        name: of a rolled I section, as `profile` takes it, or of a hollow section, sizes in mm: `SHS200x10`,
            `RHS200x100x8`, `CHS168.3x8`, hot finished, with or without `HF` before it; `CFSHS200x10` is cold formed.
            `HSS8x6x1/2` is of ASTM A500, in inches. `L100x100x10` is an angle, of braces alone,
            `IPN300` has tapered flanges.

    Raises:
        InputError: there is no such section, or the walls of a hollow one do not fit into it.
    """
    hollow = hollow_section(name)
    if hollow is None and (bar := angle_name(name)) is not None:
        return angle(bar)
    if hollow is None and (sloping := tapered_name(name)) is not None:
        return tapered(sloping)
    if hollow is None and (near := near_angle(name) or near_tapered(name)):
        raise InputError(f"there is no section `{name}`; {near} [E-NAME-01]")
    if hollow is None:
        known = profile_names().canonical(name)
        of = profile(known or name)
        return i_steel_section(of.name, of.h, of.b, of.tw, of.tf, of.r)
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


def i_steel_section(
    name: str, h: float, b: float, tw: float, tf: float, r: float = 0.0, welded: bool = False
) -> SteelSection:
    """Return an I section: areas and their moments exact for three rectangles and four fillets.

    Args:
        h: height, m.
        b: width of the flanges, m.
        tw: thickness of the web, m.
        tf: thickness of the flanges, m.
        r: radius of the fillets, m; 0 of plates.
        welded: of plates; the width of its welds is not known, and the flat parts reach up to the plates.

    Source: A_vz EN 1993-1-1, 6.2.6(3)a, of welded sections (3)d, with eta = 1, its safe value. A_vy: the flanges; (3)e
        for welded sections gives the same. A_z = h t_w and A_y = 5/6 of the flanges: exact to 5 % and, without the
        fillets, 10 % (finite elements). I_w, of the flanges: the formula of the mills' tables (ArcelorMittal, Sections
        and merchant bars, notations and formulae).
    """
    clear, arm = h - 2.0 * tf, 0.5 * (h - tf)
    flange, web = b * tf, clear * tw
    pairs = fillets(0.5 * clear, r) if r > 0.0 else ()  # below and above
    beside = fillets(-0.5 * tw, r) if r > 0.0 else ()  # the same about the other axis: left and right of the web
    area = 2.0 * flange + web + sum(pair.area for pair in pairs)
    I_y = 2.0 * flange * (arm**2 + tf**2 / 12.0) + web * clear**2 / 12.0
    I_y += sum(pair.inertia + pair.area * pair.centre**2 for pair in pairs)
    I_z = (2.0 * flange * b**2 + web * tw**2) / 12.0
    I_z += sum(pair.inertia + pair.area * pair.centre**2 for pair in beside)
    return SteelSection(
        name=name,
        kind="I",
        cold_formed=False,
        h=h,
        b=b,
        tw=tw,
        tf=tf,
        r=r,
        A=area,
        A_vy=2.0 * flange,
        A_vz=web if welded else max(area - 2.0 * flange + (tw + 2.0 * r) * tf, web),
        A_y=2.0 * flange * 5.0 / 6.0,
        A_z=h * tw,
        I_y=I_y,
        I_z=I_z,
        I_t=i_torsion_constant(h, b, tf, tw, r),
        I_w=flange * b**2 * (h - tf) ** 2 / 24.0,
        W_el_y=2.0 * I_y / h,
        W_el_z=2.0 * I_z / b,
        W_pl_y=2.0 * flange * arm + web * clear / 4.0 + sum(pair.area * abs(pair.centre) for pair in pairs),
        W_pl_z=flange * b / 2.0 + web * tw / 4.0 + sum(pair.area * abs(pair.centre) for pair in beside),
        welded=welded,
    )
