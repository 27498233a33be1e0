"""Second-order effects and imperfections of frames, EN 1993-1-1:2005, 5.2 and 5.3."""

from __future__ import annotations

import math

from edesign.errors import InputError

PHI_0 = 1.0 / 200.0
"""Basic initial sway. Source: EN 1993-1-1:2005, 5.3.2(3)a."""
FIRST_ORDER = 10.0
"""alpha_cr from which on first-order elastic analysis is enough. Source: EN 1993-1-1:2005, 5.2.1(3), Eq. 5.1."""
AMPLIFICATION = 3.0
"""alpha_cr from which on amplified first-order effects are enough. Source: EN 1993-1-1:2005, 5.2.2(5)B."""


def sway_amplification(alpha_cr: float) -> float:
    """Return 1 / (1 - 1/alpha_cr), by which sway effects are multiplied; 1 from alpha_cr = 10 on.

    Args:
        alpha_cr: factor on the design loads at elastic sway buckling.

    Raises:
        InputError: alpha_cr is below 3, where a second-order analysis is needed.

    Source: EN 1993-1-1:2005, 5.2.2(5)B, Eq. 5.4, and 5.2.1(3), Eq. 5.1.
    """
    if not alpha_cr >= AMPLIFICATION:
        raise InputError(
            f"alpha_cr = {alpha_cr:.3g} is below 3: the frame needs a second-order analysis (5.2.2(6)) [E-EC3-01]"
        )
    return 1.0 if alpha_cr >= FIRST_ORDER else 1.0 / (1.0 - 1.0 / alpha_cr)


def initial_sway(height: float, columns: int) -> float:
    """Return phi = phi_0 alpha_h alpha_m, rad.

    Args:
        height: of the structure, m.
        columns: m, of a row, that carry at least half of the mean vertical load.

    Raises:
        InputError: the height is not greater than zero, or there is no column.

    Source: EN 1993-1-1:2005, 5.3.2(3)a, Eq. 5.5: alpha_h = 2 / sqrt(h) within 2/3 and 1, alpha_m = sqrt(0.5 (1 + 1/m)).
    """
    if not height > 0.0 or columns < 1:
        raise InputError(
            f"initial sway of {columns} columns, {height:g} m high: both must be greater than zero [E-VALUE-02]"
        )
    alpha_h = min(max(2.0 / math.sqrt(height), 2.0 / 3.0), 1.0)
    return PHI_0 * alpha_h * math.sqrt(0.5 * (1.0 + 1.0 / columns))
