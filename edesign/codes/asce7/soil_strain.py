"""What the strains of an earthquake leave of a soil: ASCE/SEI 7-16, 19.3."""

from __future__ import annotations

import numpy as np

from edesign.errors import InputError

ACCELERATIONS = (0.0, 0.1, 0.4, 0.8)
"""S_DS / 2.5, in g."""
MODULUS_RATIOS = {
    "A": (1.00, 1.00, 1.00, 1.00),
    "B": (1.00, 1.00, 0.95, 0.90),
    "C": (1.00, 0.95, 0.75, 0.60),
    "D": (1.00, 0.90, 0.50, 0.10),
    "E": (1.00, 0.60, 0.05),
}
DAMPING_RATIOS = {
    "C": (0.01, 0.01, 0.03, 0.05),
    "D": (0.01, 0.02, 0.07, 0.15),
    "E": (0.01, 0.05, 0.20),
}


def modulus_ratio(site_class: str, acceleration: float) -> float:
    """Return G / G_0, straight between the columns of the table.

    Args:
        site_class: A to E.
        acceleration: S_DS / 2.5, in g.

    Raises:
        InputError: site class E beyond 0.4 g, which needs an investigation of the site.

    Source: ASCE/SEI 7-16, Table 19.3-2; ASCE/SEI 41-17, Table 8-2.
    """
    return _read(MODULUS_RATIOS[site_class], site_class, acceleration)


def damping_ratio(site_class: str, acceleration: float) -> float:
    """Return the hysteretic damping ratio of a soil.

    Args:
        site_class: C, D or E.
        acceleration: S_DS / 2.5, in g.

    Raises:
        InputError: site class A or B, of which the code names none, or E beyond 0.4 g.

    Source: ASCE/SEI 7-16, Table 19.3-3.
    """
    if site_class not in DAMPING_RATIOS:
        message = (
            f"ASCE/SEI 7 names no hysteretic damping of site class {site_class}; give the `damping` of the soil"
            " [E-ASCE-01]"
        )
        raise InputError(message)
    return _read(DAMPING_RATIOS[site_class], site_class, acceleration)


def _read(row: tuple[float, ...], site_class: str, acceleration: float) -> float:
    last = ACCELERATIONS[len(row) - 1]
    if len(row) < len(ACCELERATIONS) and acceleration > last:
        message = "give `strain: {code: given, modulus_ratio: }` and `damping`, from an analysis of the site"
        raise InputError(
            f"site class {site_class} is in the table up to {last:g} g, not {acceleration:.4g} g; {message} [E-ASCE-01]"
        )
    return float(np.interp(acceleration, ACCELERATIONS[: len(row)], row))
