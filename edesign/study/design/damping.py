"""Damping that dampers add to the modes of a frame, found in three ways."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.damper.sizing import damping_of_frequencies
from edesign.study.design.condensed import CondensedFrame, Lead, LinearModes, alike


@dataclass(frozen=True)
class ModalDamping:
    """Frequencies and added damping ratios of the modes, (n,) each.

    Attributes:
        omega: with the dampers' storage stiffness, rad/s.
        strain_energy: by Eq. 5.6 with the true modes of the frame with dampers.
        frequencies: by Eq. 5.8, from the frequencies without and with dampers.
        complex: of free vibrations with the complex stiffness of the dampers.
        told, lead: as those of `LinearModes`.
    """

    omega: np.ndarray
    strain_energy: np.ndarray
    frequencies: np.ndarray
    complex: np.ndarray
    told: np.ndarray
    lead: Lead


def modal_damping(frame: CondensedFrame, bare: LinearModes, stiffness: np.ndarray) -> ModalDamping:
    """Return the damping that dampers add to each mode: by strain energy, from the frequencies, and by complex modes.

    Args:
        frame: without dampers.
        stiffness: complex stiffness of each damper with its brace, (d,) N/m; the same in all modes.

    Source: thesis Eqs. 5.6-5.8.
    """
    modes = frame.modes(stiffness.real)
    without = bare.omega
    if frame.plan is None:
        _, ratio = frame.complex_modes(stiffness)
    else:  # modes along x, along y and turns pass each other as dampers are added
        root = np.sqrt(frame.mass)
        _, ratio = frame.complex_modes(stiffness, like=modes)
        without = without[alike(modes.masses * root, bare.masses * root)]
    energies = strain_energy_damping(modes, stiffness)
    loss_factor = stiffness.imag.sum() / stiffness.real.sum()  # of the elastomer, or less behind flexible braces
    by_frequency = damping_of_frequencies(float(loss_factor), without, modes.omega)
    return ModalDamping(modes.omega, energies, by_frequency, ratio, modes.told, modes.lead)


def strain_energy_damping(modes: LinearModes, stiffness: np.ndarray) -> np.ndarray:
    """Return the damping ratio that the dampers add to each mode by modal strain energy, (n,).

    Args:
        modes: with the dampers' storage stiffness.
        stiffness: complex, of each damper with its brace, (d,) N/m.

    Source: thesis Eq. 5.6, with each damper's own loss factor: phi' (K_S + K_D) phi = omega^2 for generalised mass 1.
    """
    return 0.5 * (modes.dampers**2 @ stiffness.imag) / modes.omega**2
