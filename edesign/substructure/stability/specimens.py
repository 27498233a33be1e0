"""Complex stiffness of a specimen over frequency: given values, or a damper law at an amplitude."""

from __future__ import annotations

import numpy as np
import scipy

from edesign.core import LawValues
from edesign.damper.harmonic import complex_stiffness
from edesign.errors import InputError
from edesign.substructure.stability.whole import ComplexStiffness


def tabulated_specimen(frequency: np.ndarray, stiffness: np.ndarray) -> ComplexStiffness:
    """Return the complex stiffness through given values: a cubic spline over frequency, constant outside them.

    Off the imaginary axis it is continued by its Taylor series to the second order, exact for spring, dashpot and mass.

    Args:
        frequency: (n,), Hz, rising, n >= 4.
        stiffness: (n,), N/m, complex.

    Raises:
        InputError: fewer than four, or frequencies that do not rise.
    """
    if frequency.size < 4 or not np.all(np.diff(frequency) > 0.0):
        raise InputError("a specimen's stiffness over frequency takes at least four rising frequencies [E-SIGNAL-01]")
    omega = 2.0 * np.pi * frequency
    cubes = scipy.interpolate.CubicSpline(omega, np.asarray(stiffness, dtype=complex)).c
    inner = omega[1:-1]

    def value(at: np.ndarray) -> np.ndarray:
        real, imag = np.real(at), np.imag(at)
        inside = np.minimum(np.maximum(real, omega[0]), omega[-1])
        off = np.where(inside == real, 1j * imag, 0.0)
        piece = np.searchsorted(inner, inside, side="right")
        a, b, c, d = np.take(cubes, piece, axis=1)
        x = inside - omega[piece]
        own, slope, half_curvature = ((a * x + b) * x + c) * x + d, (3.0 * a * x + 2.0 * b) * x + c, 3.0 * a * x + b
        return np.asarray(own + (slope + half_curvature * off) * off)

    return value


def linearised_law(law: LawValues, amplitude: float, frequency: np.ndarray) -> ComplexStiffness:
    """Return a damper law as it is in steady sines of one amplitude.

    Args:
        amplitude: of the deformation, m.
        frequency: (n,), Hz, rising, n >= 4; at each the law runs through 12 cycles.

    Raises:
        InputError: amplitude or a frequency not greater than zero, or as `tabulated_specimen`.
    """
    if not (amplitude > 0.0 and np.all(frequency > 0.0)):
        raise InputError("a law is linearised at an amplitude and frequencies greater than zero [E-VALUE-02]")
    values = np.array([complex_stiffness(law, amplitude, f) for f in frequency.tolist()])
    return tabulated_specimen(frequency, values)
