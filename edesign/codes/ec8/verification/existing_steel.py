"""Capacities of existing steel beams and columns in plastic rotation, EN 1998-3:2005, Annex B.

No public text of these numbers could be read: compare them with your copy of the standard.
"""

from __future__ import annotations

from collections.abc import Mapping

LARGEST_AXIAL_RATIO = 0.3
"""nu = N/N_pl up to which Table B.1 holds."""

PLASTIC_ROTATIONS: Mapping[int, Mapping[str, float]] = {
    1: {"DL": 1.0, "SD": 6.0, "NC": 8.0},
    2: {"DL": 0.25, "SD": 2.0, "NC": 3.0},
}
"""Plastic rotations of limit states by class of the section, in theta_y. Source: EN 1998-3:2005, Table B.1.

They are those of lines a and b of primary beams in FEMA 356, Table 5-6, whose levels are IO, LS and CP.
"""


def plastic_rotations(section_class: int, axial_ratio: float, theta_y: float) -> Mapping[str, float] | None:
    """Return the plastic rotation of the end of a member at each limit state, rad; None where the table has none.

    Args:
        section_class: 1 to 4, EN 1993-1-1, 5.5.
        axial_ratio: nu = N/N_pl, compression positive.
        theta_y: chord rotation at yield, rad.

    Source: EN 1998-3:2005, B.5, Table B.1.
    """
    multiples = PLASTIC_ROTATIONS.get(section_class)
    if multiples is None or axial_ratio > LARGEST_AXIAL_RATIO:
        return None
    return {level: multiple * theta_y for level, multiple in multiples.items()}
