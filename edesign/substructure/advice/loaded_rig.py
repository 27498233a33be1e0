"""Poles of a servo-hydraulic rig with the specimen that loads it: whether the rig is stable by itself."""

from __future__ import annotations

import math

import numpy as np

from edesign.project.substructure.rig import RigModel, ServoHydraulicRig
from edesign.substructure.stability.whole import ComplexStiffness

AGREED = 1e-6
"""Relative change of the frequency at which specimen and pole agree."""
ROUNDS = 50


def loaded_poles(plant: RigModel, specimen: ComplexStiffness) -> np.ndarray:
    """Return the poles of a servo-hydraulic rig with its specimen, 1/s, the least stable first; none of another rig.

    s (tau s + 1) (1 + (k + c s) / k_oil) + gain = 0, with spring and dashpot of the specimen as they are at the
    frequency of the first pole. Its delay stands before that loop.

    Returns:
        (n,) 1/s, complex.
    """
    if not isinstance(plant, ServoHydraulicRig):
        return np.zeros(0, dtype=complex)
    omega = plant.proportional_gain
    poles = _poles(plant, specimen, omega)
    for _ in range(ROUNDS):
        before, omega = omega, max(abs(complex(poles[0])), 1e-3)
        poles = _poles(plant, specimen, omega)
        if abs(omega - before) <= AGREED * omega:
            break
    return poles


def _poles(plant: ServoHydraulicRig, specimen: ComplexStiffness, omega: float) -> np.ndarray:
    at = complex(specimen(np.array([omega + 0j]))[0])
    load = np.array([at.imag / omega, at.real])
    of_rig = 1.0 / plant.flexibility.stiffness if plant.flexibility is not None else 0.0
    of_oil = 1.0 / plant.oil_stiffness if plant.oil_stiffness else 0.0
    bends = np.polyadd([1.0], of_rig * load)
    soft = np.polyadd([1.0], (of_rig + of_oil) * load)
    valve = np.array([plant.valve_time_constant, 1.0, 0.0])
    roots = np.roots(np.trim_zeros(np.polyadd(np.polymul(soft, valve), plant.proportional_gain * bends), "f"))
    return np.asarray(roots[np.argsort(-roots.real)], dtype=complex)


def is_unstable(poles: np.ndarray) -> bool:
    """Say whether a rig with its specimen is unstable: its rightmost pole is not left of the imaginary axis.

    Args:
        poles: (n,), the rightmost first, 1/s.
    """
    return bool(poles.size) and bool(poles[0].real >= 0.0)


def pole_in_words(poles: np.ndarray) -> str:
    """Return the unstable pole in words.

    Args:
        poles: (n,), the rightmost first, 1/s.
    """
    pole = complex(poles[0])
    return f"pole at {pole.real:.3g} 1/s, {abs(pole.imag) / (2.0 * math.pi):.3g} Hz"
