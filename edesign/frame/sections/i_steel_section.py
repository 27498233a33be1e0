"""I sections of parallel flanges with all their properties: of rolled sections and of plates."""

from __future__ import annotations

from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.section import fillets
from edesign.frame.sections.torsion import i_torsion_constant


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
