"""What the strains of an earthquake leave of a soil: EN 1998-5:2004, 4.2.3."""

from __future__ import annotations

import numpy as np

from edesign.errors import InputError

ACCELERATIONS = (0.10, 0.20, 0.30)
"""alpha S: the ground acceleration on the surface, in g."""
MODULUS_RATIOS = (0.80, 0.50, 0.36)
"""Mean of G / G_max; the table gives +- 0.10, 0.20 and 0.20."""
DAMPING_RATIOS = (0.03, 0.06, 0.10)


def soil_strain(acceleration: float) -> tuple[float, float]:
    """Return G / G_max and the damping ratio of soils with v_s below 360 m/s.

    Args:
        acceleration: alpha S, that of the surface over g.

    Returns:
        G / G_max and the ratio of critical damping.

    Raises:
        InputError: it is beyond the table.

    Source: EN 1998-5:2004, Table 4.1, straight between its columns; below the first column the first one counts.
    """
    if acceleration > ACCELERATIONS[-1]:
        message = "give `strain: {code: given, modulus_ratio: }` and `damping`, from a response analysis of the site"
        raise InputError(
            f"EN 1998-5, Table 4.1 ends at 0.3 g, and {acceleration:.4g} g is asked for; {message} [E-EC8-05]"
        )
    ratio, damping = (float(np.interp(acceleration, ACCELERATIONS, row)) for row in (MODULUS_RATIOS, DAMPING_RATIOS))
    return ratio, damping
