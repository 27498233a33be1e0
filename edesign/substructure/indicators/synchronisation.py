"""Tracking indicator of Mercan and Ricles: the area enclosed in the synchronisation plot."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from edesign.substructure.indicators.channels import channel


def tracking_indicator(target: ArrayLike, measured: ArrayLike) -> np.ndarray:
    """Return the signed area between measured over target displacement and the 45-degree line, sample by sample.

    TI = (A - TA) / 2 with A the integral of x_t dx_m and TA that of x_m dx_t, by trapezoids. It grows while the
    measured channel is late and falls while it leads. A sine of amplitude a, late by phi, adds pi a^2 sin(phi) a cycle;
    a short delay tau adds tau times the integral of the squared velocity.

    Args:
        target: x_t (n,), m.
        measured: x_m (n,), m.

    Returns:
        (n,) m2.

    Raises:
        InputError: lengths that differ, NaN.

    Source: Mercan & Ricles (2007), Stability and accuracy analysis of outer loop dynamics in real-time pseudodynamic
    testing of SDOF systems, EESD 36. Formula as in the public notes of Riascos, Ou & Dyke (2014) on assessment
    measures; they print a plus sign in the difference of x_m, with which it would be no area.
    """
    x_t = channel("target", target)
    x_m = channel("measured", measured, x_t.size)
    products = 0.5 * (x_t[:-1] * x_m[1:] - x_t[1:] * x_m[:-1])  # of A less that of TA, halved
    return np.concatenate(([0.0], np.cumsum(products)))
