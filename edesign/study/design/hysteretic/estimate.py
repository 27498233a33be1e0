"""Response of a frame with hysteretic dampers estimated by its response spectrum, for the order of the devices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.damper.restrained_cycles import RestrainedCycles
from edesign.study.design.estimate import Action, FrameEstimate, frame_estimate, spectral_peaks
from edesign.study.design.hysteretic.model import HystereticFrame, SecantVibration


@dataclass(frozen=True)
class HystereticEstimate(FrameEstimate):
    """Largest values over time by CQC of a frame with hysteretic dampers.

    Attributes:
        damper_stroke: largest deformation of the dampers, (d,) m.
        ductility: that over the deformation at which they yield, (d,).
        core_strain: of buckling-restrained braces, (d,); None: the dampers are others.
    """

    damper_stroke: np.ndarray
    ductility: np.ndarray
    core_strain: np.ndarray | None


def hysteretic_estimate(
    frame: HystereticFrame, yield_force: np.ndarray, vibration: SecantVibration, action: Action
) -> HystereticEstimate:
    """Estimate the response of a frame with hysteretic dampers by the response spectrum method.

    Dampers have the secant stiffness of the first mode in all modes; their damping counts in the first alone. The force
    of a buckling-restrained brace is its compression, the larger one.

    Args:
        frame: the frame of the design.
        yield_force: of all dampers of each storey along its drift, (s,) N.
        vibration: of the frame with these yield forces.
        action: spectrum, and damping ratio of the frame without dampers.

    Source: as `estimate`; ASCE/SEI 7-16, 18.7.3.2: hysteretic damping is that of the fundamental mode.
    """
    modes, storage = vibration.modes, vibration.stiffness
    added = np.zeros(modes.omega.size)
    added[0] = vibration.damping
    peaks = spectral_peaks(frame.building.frame, action, modes, added)
    scale, loop = frame.scale(yield_force), frame.loop
    secants = frame.secants(scale, peaks.combined(modes.dampers))
    force = secants.force
    if isinstance(loop, RestrainedCycles):
        force = scale * loop.compression(frame.building.deformation_scale * secants.stroke)
    found = frame_estimate(frame.building, modes, storage, peaks, force)
    ductility = secants.stroke / frame.yield_deformation
    strain = frame.core_strain(secants.stroke)
    return HystereticEstimate(**vars(found), damper_stroke=secants.stroke, ductility=ductility, core_strain=strain)


def bare_estimate(frame: HystereticFrame, action: Action) -> FrameEstimate:
    """Estimate the response of the frame without dampers by the response spectrum method.

    Args:
        frame: the frame of the design.
        action: spectrum, and damping ratio of the frame without dampers.
    """
    modes, nothing = frame.bare, np.zeros(frame.building.frame.n_devices)
    peaks = spectral_peaks(frame.building.frame, action, modes, np.zeros(modes.omega.size))
    return frame_estimate(frame.building, modes, nothing, peaks, nothing)
