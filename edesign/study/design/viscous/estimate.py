"""Response of a frame with viscous dampers estimated by its response spectrum, for the order of the devices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.study.design.building import Building
from edesign.study.design.condensed import LinearModes
from edesign.study.design.estimate import Action, FrameEstimate, SpectralPeaks, frame_estimate, spectral_peaks
from edesign.study.design.viscous.model import Vibration, ViscousFrame


@dataclass(frozen=True)
class ViscousEstimate(FrameEstimate):
    """Largest values over time by CQC of a frame with viscous dampers.

    Attributes:
        damper_stroke: largest deformation of the dashpots, (d,) m.
        damper_velocity: largest pseudo velocity of the dashpots, (d,) m/s.
    """

    damper_stroke: np.ndarray
    damper_velocity: np.ndarray


def viscous_estimate(
    frame: ViscousFrame, coefficient: np.ndarray, vibration: Vibration, action: Action
) -> ViscousEstimate:
    """Estimate the response of a frame with viscous dampers by the response spectrum method.

    Dashpots are linear in all modes, with the energy of the first at its amplitude; springs in series count with the
    stiffness that they add at the first frequency, their losses at that of each mode.

    Args:
        frame: the frame of the design.
        coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        vibration: of the frame with these coefficients.
        action: spectrum, and damping ratio of the frame without dampers.

    Source: as `estimate`; pseudo velocity: FEMA 356, 9.3.5.1.
    """
    building = frame.building
    linear, flexibility = vibration.linear, vibration.flexibility
    modes, storage, peaks = _peaks(building, action, linear, flexibility, vibration.omega)
    shares = 1.0 / np.abs(1.0 + 1.0j * modes.omega[:, None] * linear * flexibility)
    stroke = peaks.combined(modes.dampers * shares)
    velocity = peaks.combined(modes.omega[:, None] * modes.dampers * shares)
    force = frame.at_places(coefficient) * velocity**frame.dashpot.alpha
    found = frame_estimate(building, modes, storage, peaks, force)
    return ViscousEstimate(**vars(found), damper_stroke=stroke, damper_velocity=velocity)


def viscous_drift(
    building: Building, action: Action, linear: np.ndarray, flexibility: np.ndarray, omega: float
) -> np.ndarray:
    """Return the storey drifts over height by the response spectrum method, (f,).

    Args:
        building: the frame with its places.
        action: spectrum, and damping ratio of the frame without dampers.
        linear: coefficient of the linear dashpot at each place, (d,) N s/m.
        flexibility: of the springs in series at each place, (d,) m/N.
        omega: circular frequency at which the springs' stiffness counts, rad/s.
    """
    modes, _, peaks = _peaks(building, action, linear, flexibility, omega)
    return peaks.combined(np.diff(modes.floors, axis=1, prepend=0.0)) / building.heights


def _peaks(
    building: Building, action: Action, linear: np.ndarray, flexibility: np.ndarray, omega: float
) -> tuple[LinearModes, np.ndarray, SpectralPeaks]:
    """Modes with what the springs store at a frequency (rad/s), that stiffness (d,) N/m, and their peaks."""
    storage = _assembly(linear, flexibility, omega).real
    modes = building.frame.modes(storage)
    losses = _assembly(linear, flexibility, modes.omega[:, None]).imag
    added = 0.5 * np.sum(modes.dampers**2 * losses, axis=1) / modes.omega**2
    return modes, storage, spectral_peaks(building.frame, action, modes, added)


def _assembly(linear: np.ndarray, flexibility: np.ndarray, omega: float | np.ndarray) -> np.ndarray:
    """Complex stiffness of dashpots and springs in series at frequencies, N/m."""
    damper = 1.0j * omega * linear
    return np.asarray(damper / (1.0 + damper * flexibility))
