"""Coefficients of the inverse rig by least squares on a record, as the compensators of thesis 6.2.3 find them."""

from __future__ import annotations

import numpy as np
import scipy

ORDER, CUTOFF = 6, 20.0
"""Of the Butterworth filter on command and displacement, Hz (thesis 6.2.3, after Chae et al. 2013)."""


def filtered(step: float) -> bool:
    """Say whether a record goes through the filter: it is sampled fast enough for it.

    Args:
        step: between its samples, s.
    """
    return CUTOFF < 0.5 / step


def fitted_alpha(command: np.ndarray, displacement: np.ndarray, step: float) -> tuple[float, float, float]:
    """Return alpha_0 (-), alpha_1 (s), alpha_2 (s2) of command = alpha_0 x + alpha_1 x' + alpha_2 x''.

    Both channels go through the same filter; derivatives are backward differences (Eq. 6.17), and all samples count
    alike (Eq. 6.13). A record sampled too slowly for the filter is not filtered.

    With a step T and a_j of the series of the inverse rig, alpha_1 = a_1 - (a_3 + T alpha_2) m_4/m_2 and alpha_2 = a_2
    + alpha_1 T/2. The moments m_j are the integrals of omega^j S(omega) of the displacement. So differences make
    alpha_2 larger by half a step times alpha_1. Of alpha_1 more is lost to the terms that the series leaves out.

    Args:
        command: (n,) m.
        displacement: (n,) m.
        step: between samples, s.

    Returns:
        alpha_0, -; alpha_1, s; alpha_2, s2.
    """
    u, x = command - command[0], displacement - displacement[0]
    if filtered(step):
        sections = scipy.signal.butter(ORDER, CUTOFF, fs=1.0 / step, output="sos")
        u, x = (scipy.signal.sosfilt(sections, one) for one in (u, x))
    velocity = np.diff(x) / step
    acceleration = np.diff(velocity) / step
    columns = np.column_stack([x[2:], velocity[1:], acceleration])
    size = np.sqrt(np.mean(columns**2, axis=0))
    found = np.linalg.lstsq(columns / size, u[2:], rcond=None)[0] / size
    return float(found[0]), float(found[1]), float(found[2])
