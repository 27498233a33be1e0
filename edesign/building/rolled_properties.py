"""Properties of rolled I sections for tables: both axes, plastic modulus, mass."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.building.profiles import Profile
from edesign.building.section import fillets

DENSITY = 7850.0  # of steel, kg/m3; EN 1991-1-1, Table A.4, and EN 10365


@dataclass(frozen=True)
class RolledProperties:
    """Properties of a rolled I section with its fillets, in SI.

    Attributes:
        area: m2.
        I_y, I_z: second moments of area about the strong and the weak axis, m4.
        W_pl_y: plastic section modulus about the strong axis, m3.
        mass: kg/m.
    """

    area: float
    I_y: float
    I_z: float
    W_pl_y: float
    mass: float


def rolled_properties(shape: Profile) -> RolledProperties:
    """Return the properties of three rectangles and four fillets, exact for these."""
    clear, arm = shape.h - 2.0 * shape.tf, 0.5 * (shape.h - shape.tf)
    flange, web = shape.b * shape.tf, clear * shape.tw
    pairs = fillets(0.5 * clear, shape.r)  # below and above
    beside = fillets(-0.5 * shape.tw, shape.r)  # the same about the other axis: left and right of the web
    area = 2.0 * flange + web + sum(pair.area for pair in pairs)
    return RolledProperties(
        area=area,
        I_y=2.0 * flange * (arm**2 + shape.tf**2 / 12.0)
        + web * clear**2 / 12.0
        + sum(pair.inertia + pair.area * pair.centre**2 for pair in pairs),
        I_z=(2.0 * flange * shape.b**2 + web * shape.tw**2) / 12.0
        + sum(pair.inertia + pair.area * pair.centre**2 for pair in beside),
        W_pl_y=2.0 * flange * arm + web * clear / 4.0 + sum(pair.area * abs(pair.centre) for pair in pairs),
        mass=DENSITY * area,
    )
