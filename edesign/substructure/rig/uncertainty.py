"""How sure the transfer function of an identified rig is."""

from __future__ import annotations

import numpy as np

from edesign.project.substructure.rig import RigFile
from edesign.substructure.laboratory import rig_transfer


def transfer_deviations(file: RigFile, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the standard deviations of the amplitude (ratio of it) and phase (rad) of a rig, (n,) each.

    They follow from the covariance of its numbers in first order. With J the slopes of ln H, the variances are those of
    the real and the imaginary part of J times the errors.

    Args:
        file: of the rig, checked, with a covariance.
        omega: (n,) circular frequencies, rad/s.
    """
    assert file.covariance is not None
    covariance, s = np.array(file.covariance), 1j * omega
    slopes = np.zeros((omega.size, len(covariance)), dtype=complex)
    for i, name in enumerate(file.standard_errors):
        error, value = float(np.sqrt(covariance[i, i])), float(getattr(file.rig, name))
        if error > 0.0:  # the slope over the range that is uncertain
            low, high = max(value - error, 0.0), value + error
            first, last = (rig_transfer(file.rig.model_copy(update={name: one}), 0.0)(s) for one in (low, high))
            slopes[:, i] = np.log(last / first) / (high - low)
    amplitude, phase = (np.einsum("ni,ij,nj->n", part, covariance, part) for part in (slopes.real, slopes.imag))
    return np.sqrt(np.maximum(amplitude, 0.0)), np.sqrt(np.maximum(phase, 0.0))
