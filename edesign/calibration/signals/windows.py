"""Windows of spectra that numpy lacks; all of scipy.signal for one of them would take a second of every start."""

from __future__ import annotations

import numpy as np

_COEFFICIENTS = (0.35875, 0.48829, 0.14128, 0.01168)


def blackman_harris(samples: int, periodic: bool = False) -> np.ndarray:
    """Four-term window (n,), sidelobes at -92 dB, symmetric unless periodic.

    Source: Harris (1978), Proc. IEEE 66, 51-83, table 1.
    """
    turn = 2.0 * np.pi * np.arange(samples) / max(samples - (0 if periodic else 1), 1)
    return np.asarray(sum((-1) ** k * a * np.cos(k * turn) for k, a in enumerate(_COEFFICIENTS)))
