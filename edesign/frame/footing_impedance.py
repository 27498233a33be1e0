"""Stiffness and damping of rigid rectangular footings on a half-space of soil.

Notation of NIST GCR 12-917-21, Chapter 2: the footing is 2L by 2B with L >= B; x runs along L, y along B, z is
vertical; xx is rocking about x, yy about y, zz torsion. Static stiffness is that at the surface times a factor of
embedment. At a frequency omega the stiffness is alpha K and the dashpot 2 alpha K (beta + beta_s) / omega, with
a_0 = omega B / V_s.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import sqrt
from typing import Literal

Way = Literal["x", "y", "z", "xx", "yy", "zz"]
WAYS: tuple[Way, ...] = ("x", "y", "z", "xx", "yy", "zz")

LARGEST_PSI = 2.5
"""Bound of V_p / V_s: waves under a footing on saturated clay do not run at V_p (Pais & Kausel 1988)."""


@dataclass(frozen=True)
class Block:
    """A rigid rectangular footing in a half-space.

    Attributes:
        half_length, half_width: L and B, m; L >= B.
        embedment, contact: D, and the height d of the walls that the soil touches, m.
        shear_modulus: G, Pa.
        poisson: nu.
    """

    half_length: float
    half_width: float
    embedment: float
    contact: float
    shear_modulus: float
    poisson: float

    @property
    def slenderness(self) -> float:
        """Slenderness L / B."""
        return self.half_length / self.half_width

    @property
    def psi(self) -> float:
        """Speed of compression waves under the footing over that of shear waves."""
        if self.poisson >= 0.5:
            return LARGEST_PSI
        return min(sqrt(2.0 * (1.0 - self.poisson) / (1.0 - 2.0 * self.poisson)), LARGEST_PSI)


def surface_pais_kausel(block: Block) -> dict[Way, float]:
    """Return the static stiffness at the surface, N/m and N m/rad.

    Args:
        block: sizes of the footing and properties of the soil.

    Source: Pais & Kausel 1988, Soil Dynamics and Earthquake Engineering 7, 213-227; NIST GCR 12-917-21, Table 2-2a;
        ASCE/SEI 41-17, Figure 8-2, is the same with the whole sides.
    """
    G, B, nu, r = block.shear_modulus, block.half_width, block.poisson, block.slenderness
    return {
        "x": G * B / (2.0 - nu) * (6.8 * r**0.65 + 2.4),
        "y": G * B / (2.0 - nu) * (6.8 * r**0.65 + 0.8 * r + 1.6),
        "z": G * B / (1.0 - nu) * (3.1 * r**0.75 + 1.6),
        "xx": G * B**3 / (1.0 - nu) * (3.2 * r + 0.8),
        "yy": G * B**3 / (1.0 - nu) * (3.73 * r**2.4 + 0.27),
        "zz": G * B**3 * (4.25 * r**2.45 + 4.06),
    }


def surface_gazetas(block: Block) -> dict[Way, float]:
    """Return the static stiffness at the surface, N/m and N m/rad.

    Args:
        block: sizes of the footing and properties of the soil.

    Source: Gazetas 1991, Journal of Geotechnical Engineering 117, 1363-1381, for rectangles; NIST GCR 12-917-21,
        Table 2-2a.
    """
    G, L, B, nu, r = block.shear_modulus, block.half_length, block.half_width, block.poisson, block.slenderness
    across = 2.0 * G * L / (2.0 - nu) * (2.0 + 2.5 * r**-0.85)
    about_x, about_y = 4.0 / 3.0 * L * B**3, 4.0 / 3.0 * B * L**3  # second moments of the area of its underside, m4
    return {
        "x": across - 0.2 / (0.75 - nu) * G * L * (1.0 - 1.0 / r),
        "y": across,
        "z": 2.0 * G * L / (1.0 - nu) * (0.73 + 1.54 * r**-0.75),
        "xx": G / (1.0 - nu) * about_x**0.75 * r**0.25 * (2.4 + 0.5 / r),
        "yy": G / (1.0 - nu) * about_y**0.75 * 3.0 * r**0.15,
        "zz": G * (about_x + about_y) ** 0.75 * (4.0 + 11.0 * (1.0 - 1.0 / r) ** 10),
    }


def embedment_pais_kausel(block: Block) -> dict[Way, float]:
    """Return the factors of embedment; the walls count as far as the soil touches them.

    Args:
        block: sizes of the footing and properties of the soil.

    Source: Pais & Kausel 1988; NIST GCR 12-917-21, Table 2-2b.
    """
    r, d = block.slenderness, block.contact / block.half_width
    across = 1.0 + (0.33 + 1.34 / (1.0 + r)) * d**0.8
    return {
        "x": across,
        "y": across,
        "z": 1.0 + (0.25 + 0.25 / r) * d**0.8,
        "xx": 1.0 + d + 1.6 / (0.35 + r) * d**2,
        "yy": 1.0 + d + 1.6 / (0.35 + r**4) * d**2,
        "zz": 1.0 + (1.3 + 1.32 / r) * d**0.9,
    }


def embedment_gazetas(block: Block) -> dict[Way, float]:
    """Return the factors of embedment: of the trench, of depth D, and of the walls, touched over the height d.

    Args:
        block: sizes of the footing and properties of the soil.

    Source: Gazetas 1991; NIST GCR 12-917-21, Table 2-2b.
    """
    L, B, D, d = block.half_length, block.half_width, block.embedment, block.contact
    if D == 0.0:
        return dict.fromkeys(WAYS, 1.0)
    walls, middle = 4.0 * d * (L + B), D - 0.5 * d  # area, m2; depth of its centre, m
    across = (1.0 + 0.15 * sqrt(D / B)) * (1.0 + 0.52 * (middle * walls / (B * L**2)) ** 0.4)
    rolling = 1.0 + 1.26 * d / B * (1.0 + d / B * (d / D) ** -0.2 * sqrt(B / L)) if d > 0.0 else 1.0
    pitching = 1.0 + 0.92 * (d / L) ** 0.6 * (1.5 + (d / L) ** 1.9 * (d / D) ** -0.6) if d > 0.0 else 1.0
    return {
        "x": across,
        "y": across,
        "z": (1.0 + D / (21.0 * B) * (1.0 + 1.3 * B / L)) * (1.0 + 0.2 * (walls / (4.0 * B * L)) ** (2.0 / 3.0)),
        "xx": rolling,
        "yy": pitching,
        "zz": 1.0 + 1.4 * (1.0 + B / L) * (d / B) ** 0.9,
    }


FORMULAS = {
    "pais_kausel": (surface_pais_kausel, embedment_pais_kausel),
    "gazetas": (surface_gazetas, embedment_gazetas),
}


def static_stiffness(block: Block, formula: str) -> dict[Way, float]:
    """Return the static stiffness of an embedded footing by one of FORMULAS, N/m and N m/rad.

    Args:
        block: sizes of the footing and properties of the soil.
        formula: a key of `FORMULAS`.
    """
    surface, embedment = FORMULAS[formula]
    factors = embedment(block)
    return {way: stiffness * factors[way] for way, stiffness in surface(block).items()}


def dynamic_modifiers(slenderness: float, a_0: float) -> dict[Way, float]:
    """Return alpha, the stiffness at a frequency over the static one; embedment does not change it.

    Args:
        slenderness: L / B.
        a_0: omega B / V_s.

    Source: Pais & Kausel 1988; NIST GCR 12-917-21, Table 2-3a.
    """
    r, a = slenderness, a_0**2
    return {
        "x": 1.0,
        "y": 1.0,
        "z": 1.0 - (0.4 + 0.2 / r) * a / (10.0 / (1.0 + 3.0 * (r - 1.0)) + a),
        "xx": 1.0 - (0.55 + 0.01 * sqrt(r - 1.0)) * a / (2.4 - 0.4 / r**3 + a),
        "yy": 1.0 - 0.55 * a / (0.6 + 1.4 / r**3 + a),
        "zz": 1.0 - (0.33 - 0.03 * sqrt(r - 1.0)) * a / (0.8 / (1.0 + 0.33 * (r - 1.0)) + a),
    }


def radiation_damping(block: Block, stiffness: Mapping[Way, float], a_0: float) -> dict[Way, float]:
    """Return the damping ratios beta by waves that run away from the underside and the walls.

    In rocking, waves of both halves of the underside cancel at low frequencies; those of walls that move horizontally
    do not. So the dashpot rises from what the latter radiate to plane waves from all faces, which is the limit of high
    frequencies. At the surface this is NIST GCR 12-917-21, Table 2-3a. Its Table 2-3b counts those walls in both
    parts, beyond plane waves; here they count once. In torsion waves of all faces cancel at low frequencies.

    Args:
        stiffness: the static stiffness, embedment included, N/m and N m/rad.
        a_0: omega B / V_s.

    Source: Pais & Kausel 1988; NIST GCR 12-917-21, Tables 2-3a and 2-3b.
    """
    G, B, psi = block.shear_modulus, block.half_width, block.psi
    r, d, a = block.slenderness, block.contact / block.half_width, a_0**2
    # plane waves from all faces, over rho V_s B^2 or rho V_s B^4
    across = {
        "x": 4.0 * (r + d * (psi + r)),
        "y": 4.0 * (r + d * (1.0 + psi * r)),
        "z": 4.0 * (psi * r + d * (1.0 + r)),
    }
    walls = {"xx": 4.0 / 3.0 * (psi * r + 1.0) * d**3, "yy": 4.0 / 3.0 * (r + psi) * d**3, "zz": 0.0}
    others = {
        "xx": 4.0 / 3.0 * (psi * r + d + 3.0 * d * r),
        "yy": 4.0 / 3.0 * (psi * r**3 + d * r**3 + 3.0 * d * r**2),
        "zz": 4.0 / 3.0 * (r**3 + r + d * (psi * (r**3 + 1.0) + 3.0 * r + 3.0 * r**2)),
    }
    rise = {
        "xx": a / (2.2 - 0.4 / r**3 + a),
        "yy": a / (1.8 / (1.0 + 1.75 * (r - 1.0)) + a),
        "zz": a / (1.4 / (1.0 + 3.0 * (r - 1.0) ** 0.7) + a),
    }
    alpha = dynamic_modifiers(r, a_0)
    found: dict[Way, float] = {}
    for way in WAYS:
        if way in across:
            waves, scale = across[way], G * B
        else:
            waves, scale = walls[way] + others[way] * rise[way], G * B**3
        found[way] = waves * scale / stiffness[way] * a_0 / (2.0 * alpha[way])
    return found
