"""Steel sections with all their properties: rolled I sections, I sections of plates, hollow sections, and angles."""

from __future__ import annotations

from functools import cache

from edesign.codes.ec3.section import SteelSection
from edesign.errors import InputError
from edesign.frame.sections.angles import angle, angle_name, near_angle
from edesign.frame.sections.channels import channel_pair, near_channel, pair_name
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.i_steel_section import i_steel_section
from edesign.frame.sections.profiles import profile, profile_names
from edesign.frame.sections.restrained_core import core, core_name
from edesign.frame.sections.tapered import near_tapered, tapered, tapered_name


@cache
def steel_section(name: str) -> SteelSection:
    """Return a steel section by its name.

    Args:
        name: of a rolled I section, as `profile` takes it, or of a hollow section, sizes in mm: `SHS200x10`,
            `RHS200x100x8`, `CHS168.3x8`, hot finished, with or without `HF` before it; `CFSHS200x10` is cold formed.
            `HSS8x6x1/2` is of ASTM A500, in inches. `L100x100x10` is an angle, of braces alone,
            `IPN300` has tapered flanges, `BRB25` is a buckling-restrained brace with a core of 25 cm2,
            `2UPN200x10` two channels back to back.

    Raises:
        InputError: there is no such section, or the walls of a hollow one do not fit into it.
    """
    hollow = hollow_section(name)
    if hollow is None and (bar := angle_name(name)) is not None:
        return angle(bar)
    if hollow is None and (sloping := tapered_name(name)) is not None:
        return tapered(sloping)
    if hollow is None and (pair := pair_name(name)) is not None:
        return channel_pair(pair)
    if hollow is None and (plate := core_name(name)) is not None:
        return core(plate)
    if hollow is None and (near := near_angle(name) or near_tapered(name) or near_channel(name)):
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
