"""Classes of joints by their stiffness, EN 1993-1-8, 5.2.2."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

RIGID = 25.0
"""k_b of unbraced frames, from which on a joint is rigid (EN 1993-1-8, 5.2.2.5(1)), if K_b / K_c is at least 0.1."""
PINNED = 0.5
"""S_j L_b / (E I_b) up to which a joint is nominally pinned (the same)."""


@dataclass(frozen=True)
class JointClass:
    """S_j,ini L_b / (E I_b) of a joint, and the class that it has by it."""

    ratio: float
    name: Literal["pinned", "semi-rigid", "rigid"]


def classified(stiffness: float, of_beam: float) -> JointClass:
    """Return the class of a joint of an unbraced frame.

    Args:
        stiffness: S_j,ini, N m/rad.
        of_beam: E I_b / L_b of the connected member, N m/rad.

    Source: EN 1993-1-8:2005, 5.2.2.5(1), Figure 5.4, zones 1 to 3.
    """
    ratio = stiffness / of_beam
    return JointClass(ratio, "rigid" if ratio >= RIGID else "pinned" if ratio <= PINNED else "semi-rigid")
