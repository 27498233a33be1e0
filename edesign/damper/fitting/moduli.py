"""Complex stiffness of the linear laws: force / deformation under a sine of circular frequency omega."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

Values = Mapping[str, float]


def _kelvin_voigt(p: Values, s: np.ndarray) -> np.ndarray:
    return p["k"] + p["c"] * s


def _branch(k: float, c: float, s: np.ndarray) -> np.ndarray:
    return c * s / (1.0 + c / k * s)


def _zener(p: Values, s: np.ndarray) -> np.ndarray:
    return p["k0"] + _branch(p["k1"], p["c1"], s)


def _generalised_maxwell(p: Values, s: np.ndarray) -> np.ndarray:
    total = np.full(s.shape, p["k0"], dtype=complex)
    for i in range(1, len(p) // 2 + 1):
        total += _branch(p[f"k{i}"], p[f"c{i}"], s)
    return total


def _fractional_kelvin(p: Values, s: np.ndarray) -> np.ndarray:
    return p["k0"] * (1.0 + p["c"] * s ** p["alpha"])


def _fractional_zener(p: Values, s: np.ndarray) -> np.ndarray:
    return p["k0"] * (1.0 + p["b"] * s ** p["alpha"]) / (1.0 + p["a"] * s ** p["alpha"])


def _maxwell(p: Values, s: np.ndarray) -> np.ndarray:
    return p["c0"] * s / (1.0 + p["lambda"] * s)


def _fractional_maxwell(p: Values, s: np.ndarray) -> np.ndarray:
    return p["c0"] * s / (1.0 + p["lambda"] * s ** p["nu"])


def _linearised(p: Values, s: np.ndarray) -> np.ndarray:
    return p["k_eff"] * (1.0 + 2.0 * p["zeta_eff"] / p["omega"] * s)


_MODULI: dict[str, Callable[[Values, np.ndarray], np.ndarray]] = {
    "kelvin_voigt": _kelvin_voigt,
    "zener": _zener,
    "generalised_maxwell": _generalised_maxwell,
    "fractional_kelvin": _fractional_kelvin,
    "fractional_zener": _fractional_zener,
    "viscous": lambda p, s: p["c"] * s,
    "maxwell": _maxwell,
    "fractional_maxwell": _fractional_maxwell,
    "linearised": _linearised,
}
LINEAR_LAWS = frozenset(_MODULI)


def complex_stiffness(law: str, values: Values, omega: np.ndarray) -> np.ndarray:
    """Return the complex stiffness (n,) N/m of a linear law.

    Args:
        values: parameters by name, SI.
        omega: (n,) circular frequencies, rad/s.

    Source: the equations of edesign.damper.laws under u = exp(i omega t); thesis Eqs. 4.1-4.2 for Maxwell branches.
    """
    return _MODULI[law](values, 1j * np.asarray(omega, dtype=float))
