"""I sections riveted from a web plate, four angles and cover plates, as old buildings have them."""

from __future__ import annotations

from edesign.codes.ec3.section import SteelSection
from edesign.errors import InputError
from edesign.frame.sections.angles import angle_name, leg_properties, near_angle
from edesign.project.frame.sections import RivetedSection

NOTE = (
    "rivet holes are not deducted, and rivets are not checked: show 6.2.2.2 and 6.2.5(4) to (6) of EN 1993-1-1, and "
    "the rivets by EN 1993-1-8, 3.6"
)
"""What the checks leave out of riveted sections."""


def riveted_section(name: str, own: RivetedSection) -> SteelSection:
    """Return a riveted I section: areas and their moments exact for the plates and the angles with their roundings.

    The checks take it as a welded I section with the flanges of the outstanding legs and the cover plates: t_f spreads
    their area evenly over the width. Flat parts are the outstanding legs, the covers beyond the middle of these, and
    the web between the legs on it.

    Args:
        own: as the file describes it.

    Raises:
        InputError: there is no such angle, its outstanding leg is not said, or parts do not fit together.

    Source: A_vz EN 1993-1-1, 6.2.6(3)d of the web plate, with eta = 1. I_t: sum of the parts one by one, on the safe
        side. I_w = I_z (distance of the flanges)2 / 4. A_y = 5/6 of the flanges.
    """
    known = angle_name(own.angles)
    if known is None:
        near = near_angle(own.angles).partition(";")[0] or "write it like `L80x80x10`"
        raise InputError(f"angles: `{own.angles}` is no angle of the catalogue; {near} [E-NAME-01]")
    long, short, t, A_1, from_long, from_short, I_short, I_long = leg_properties(known)
    if long != short and own.outstanding is None:
        message = f"`{known}` has unequal legs: say which stands out, `outstanding: long` or `short`"
        raise InputError(f"{message} [E-FRAME-01]")
    if own.outstanding == "short":  # the long leg lies on the web
        out, on_web, out_of_web, from_back, about_y, about_z = short, long, from_long, from_short, I_long, I_short
    else:
        out, on_web, out_of_web, from_back, about_y, about_z = long, short, from_short, from_long, I_short, I_long
    H, tw = own.height, own.web
    width, thick = (own.covers.width, own.covers.thickness) if own.covers is not None else (0.0, 0.0)
    if 2.0 * on_web >= H:
        raise InputError(f"two legs of {1e3 * on_web:g} mm leave no web in a height of {1e3 * H:g} mm [E-FRAME-01]")
    b = max(2.0 * out + tw, width)
    arm, beside, cover = 0.5 * H - from_back, 0.5 * tw + out_of_web, width * thick
    A = H * tw + 4.0 * A_1 + 2.0 * cover
    I_y = tw * H**3 / 12.0 + 4.0 * (about_y + A_1 * arm**2)
    I_y += 2.0 * (width * thick**3 / 12.0 + cover * (0.5 * (H + thick)) ** 2)
    I_z = H * tw**3 / 12.0 + 4.0 * (about_z + A_1 * beside**2) + thick * width**3 / 6.0
    flange = 2.0 * out * t + cover
    h = H + 2.0 * thick
    parts = [("web", H - 2.0 * on_web, False), ("angle", out / t, True)]
    if cover:
        parts.append(("cover", max(0.5 * (width - tw - out), 0.0) / thick, True))
    apart = h - flange / b
    return SteelSection(
        name=name,
        kind="I",
        cold_formed=False,
        h=h,
        b=b,
        tw=tw,
        tf=flange / b,
        r=0.0,
        A=A,
        A_vy=2.0 * flange,
        A_vz=H * tw,
        A_y=2.0 * flange * 5.0 / 6.0,
        A_z=H * tw,
        I_y=I_y,
        I_z=I_z,
        I_t=(H * tw**3 + 4.0 * (out + on_web - t) * t**3 + 2.0 * width * thick**3) / 3.0,
        I_w=I_z * apart**2 / 4.0,
        W_el_y=2.0 * I_y / h,
        W_el_z=2.0 * I_z / b,
        W_pl_y=tw * H**2 / 4.0 + 4.0 * A_1 * arm + cover * (H + thick),
        W_pl_z=H * tw**2 / 4.0 + 4.0 * A_1 * beside + thick * width**2 / 2.0,
        welded=True,
        parts=tuple(parts),
    )
