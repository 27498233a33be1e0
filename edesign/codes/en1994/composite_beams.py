"""Stiffness of composite beams: effective width of the slab, second moments of area without and with cracks.

Full shear connection is taken, without slip. The slab is in compression, or cracked, as a whole.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Slab:
    """The concrete that acts with a beam.

    Attributes:
        thickness: of the concrete above the ribs of a deck, m; of a solid slab all of it.
        rib: height of the ribs of the deck below it, m; concrete there does not count.
        modular_ratio: n, E of the steel / E of the concrete.
        reinforcement: area of the bars along the beam / area of this concrete; at its middle.
    """

    thickness: float
    rib: float
    modular_ratio: float
    reinforcement: float


def effective_width(equivalent_span: float, sides: tuple[float, float]) -> float:
    """Return b_eff, m, without the distance between connectors, b_0 = 0.

    Args:
        equivalent_span: L_e, m, between points of zero moment.
        sides: b_1 and b_2, half of the distance to the next webs, or all of it to an edge, m.

    Source: EN 1994-1-1:2004, 5.4.1.2(5), Eq. 5.3: b_ei = min(L_e / 8, b_i).
    """
    return sum(min(equivalent_span / 8.0, side) for side in sides)


def equivalent_span(length: float, held_ends: int) -> float:
    """Return L_e of the part of a span in sagging, m.

    Args:
        length: of the span, m.
        held_ends: at how many ends a moment holds it: none of a simple beam, one of an end span, two of an inner one.

    Source: EN 1994-1-1:2004, 5.4.1.2, Figure 5.1; constant over the span, 5.4.1.2(4).
    """
    return (1.0, 0.85, 0.70)[held_ends] * length


def uncracked_inertia(area: float, inertia: float, height: float, slab: Slab, width: float) -> float:
    """Return I_1, the second moment of area with all of the concrete, in units of steel, m4.

    Args:
        area: A of the steel section, m2.
        inertia: I_y of the steel section, m4.
        height: h of the steel section, m.
        width: b_eff, m.

    Source: EN 1994-1-1:2004, 1.5.2.11 and 5.4.2.2(2): concrete in tension is uncracked.
    """
    concrete = width * slab.thickness / slab.modular_ratio
    apart = 0.5 * height + slab.rib + 0.5 * slab.thickness
    return inertia + concrete * slab.thickness**2 / 12.0 + area * concrete / (area + concrete) * apart**2


def cracked_inertia(area: float, inertia: float, height: float, slab: Slab, width: float) -> float:
    """Return I_2, the second moment of area of the steel section and the bars alone, m4.

    Args:
        area: see `uncracked_inertia`.
        inertia: see `uncracked_inertia`.
        height: see `uncracked_inertia`.
        width: see `uncracked_inertia`.

    Source: EN 1994-1-1:2004, 1.5.2.12: concrete in tension is neglected, the reinforcement is not.
    """
    bars = slab.reinforcement * width * slab.thickness
    apart = 0.5 * height + slab.rib + 0.5 * slab.thickness
    return inertia + area * bars / (area + bars) * apart**2


def equivalent_inertia(sagging: float, hogging: float) -> float:
    """Return I_eq of a beam of a moment frame, constant over its length.

    Args:
        sagging: I_1.
        hogging: I_2.

    Source: EN 1998-1:2004, 7.7.2(3), Eq. 7.14: I_eq = 0.6 I_1 + 0.4 I_2.
    """
    return 0.6 * sagging + 0.4 * hogging
