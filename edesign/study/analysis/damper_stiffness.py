"""Natural modes of a frame with dampers: their stiffness at the frequency of the first mode."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Modes
from edesign.damper.dashpot import locks_when_small
from edesign.damper.temperature import LINEAR_LAWS
from edesign.errors import InputError
from edesign.frame.devices import Device
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import listed
from edesign.study.analysis.structure import Structure
from edesign.study.results.recording import coordinate
from edesign.study.results.warnings import AnalysisWarning, store_warnings

_SMALL_STRAIN = 1e-4
_SMALL_DEFORMATION = 1e-5  # m, of dampers without layers
_ROUNDING = 1e-9  # of a first harmonic, against the force itself


@dataclass(frozen=True)
class DampedModes:
    """The modes of a frame whose dampers vibrate steadily in the first of them.

    Attributes:
        modes: of the frame with the dampers' storage stiffness.
        stiffness: complex, of each device, N/m; 0 of those that are left out.
        frequency: at which each device vibrates, Hz; nan of those that are left out.
        amplitude: of each device and its brace, m; nan of those that are left out.
        small: devices that no amplitude is given for, and whose stiffness is that of small vibrations.
        left_out: devices that no amplitude is given for, and whose stiffness is anything without one: dashpots with
            alpha < 1. In series with a spring they lock in small vibrations and give way in large ones.
    """

    modes: Modes
    stiffness: np.ndarray
    frequency: np.ndarray
    amplitude: np.ndarray
    small: tuple[Device, ...]
    left_out: tuple[Device, ...]


def damped_modes(project: AnalysisFile, structure: Structure, spec: ModalAnalysis) -> DampedModes:
    """Return the natural modes of a frame with dampers at the amplitudes that are given for them.

    Args:
        structure: the frame with its dampers, and its analysis.
        spec: the modal analysis, with the number of modes.

    Returns:
        The modes with the complex stiffness and amplitude of each damper.

    Raises:
        InputError: a strain is given for dampers without layers.
        AnalysisError: there are not so many modes, or the structure is unstable.
    """
    devices = structure.frame.devices
    given = [_amplitude(project, spec, device) for device in devices]
    unknown = [device for device, amplitude in zip(devices, given, strict=True) if amplitude is None]
    left_out = tuple(device for device in unknown if _sprung(device) and locks_when_small(device.values))
    amplitude = np.array([small_amplitude(d) if a is None else a for d, a in zip(devices, given, strict=True)])
    counted = np.array([device not in left_out for device in devices])
    stiffness = np.zeros(len(devices), dtype=complex)
    frequency = np.full(len(devices), np.nan)
    taking_part = [device for device in devices if device not in left_out]
    if taking_part:
        found = structure.steady_modes(spec.modes, taking_part, amplitude[counted].tolist())
        modes, stiffness[counted], frequency[counted] = found
    else:
        modes = structure.modes(spec.modes)
    storing = dict(zip(devices, _storing(stiffness), strict=True))
    stiffness.real[~_storing(stiffness)] = 0.0  # the rounding of a dashpot's cycle
    small = tuple(device for device in unknown if storing[device] and not _linear(device))
    return DampedModes(modes, stiffness, frequency, np.where(counted, amplitude, np.nan), small, left_out)


def store_damper_stiffness(group: Group, structure: Structure, found: DampedModes) -> None:
    """Add stiffness, loss factor and amplitude of the dampers to a group, and a warning where stiffness is left out.

    Args:
        group: of the modal analysis.
        structure: the frame with its dampers.
    """
    devices, stiffness = structure.frame.devices, found.stiffness
    coordinate(group, "damper", [device.name for device in devices], "", "name of the damper")
    plane = structure.frame.model.dimension == 2
    mode = "first mode; of an isolated base between the extremes" if plane else "leading mode of its direction"
    label = f"of the damper with its brace in steady vibration in the {mode}"
    storing = _storing(stiffness)
    loss = np.full(stiffness.size, np.nan)  # of a dashpot, or a stop that stays open: there is none
    np.divide(stiffness.imag, stiffness.real, out=loss, where=storing)
    group.add("damper_storage_stiffness", ("damper",), stiffness.real, "N/m", f"storage stiffness {label}")
    group.add("damper_loss_factor", ("damper",), loss, "1", f"loss factor {label}")
    label = "of damper and brace at which it counts; nan: not known, its stiffness is left out"
    group.add("damper_amplitude", ("damper",), found.amplitude, "m", f"amplitude {label}")
    if not plane:
        label = "at which the damper vibrates: that of the leading mode of its direction; nan: it is left out"
        group.add("damper_frequency", ("damper",), found.frequency, "Hz", f"frequency {label}")
    group.attributes["damper_frequency_Hz"] = float(found.modes.omega[0]) / (2.0 * np.pi)
    group.attributes["dampers_in_small_vibrations"] = [device.name for device in found.small]
    if found.left_out:
        names = listed([device.name for device in found.left_out], 4)
        text = (
            f"the stiffness of {names} is left out of the modes: no `design_deformation` is given, and a dashpot with "
            "alpha < 1 behind a spring is as stiff as the spring in small vibrations and has no stiffness in large ones"
        )
        store_warnings(group, [AnalysisWarning("damper_amplitude", text, 1.0)])


def _amplitude(project: AnalysisFile, spec: ModalAnalysis, device: Device) -> float | None:
    if spec.damper_deformation is not None:
        return spec.damper_deformation
    if spec.damper_strain is not None:
        if device.layer_thickness is None:
            message = f"the damper {device.name} has no layers; give `damper_deformation` [E-DAMPER-01]"
            raise InputError(f"{_where(project, spec)}: damper_strain: {message}")
        return spec.damper_strain * device.layer_thickness
    return device.design_deformation


def _storing(stiffness: np.ndarray) -> np.ndarray:
    """Which devices have a storage stiffness: not a dashpot alone, or one that is left out."""
    return np.asarray(np.abs(stiffness.real) > _ROUNDING * np.abs(stiffness))


def _linear(device: Device) -> bool:
    return device.values.law in LINEAR_LAWS and not device.values.effects and not device.play


def _sprung(device: Device) -> bool:
    """Whether a spring is in series with a dashpot: its brace, or one of its own."""
    return device.brace > 0.0 or device.values.law == "maxwell_power"


def small_amplitude(device: Device) -> float:
    """Return an amplitude of a device's deformation, m, at which its stiffness is that at the start of loading."""
    return _SMALL_STRAIN * device.layer_thickness if device.layer_thickness is not None else _SMALL_DEFORMATION


def _where(project: AnalysisFile, spec: ModalAnalysis) -> str:
    """The place of an analysis in the project file; its name if it comes from elsewhere."""
    i = next((i for i, item in enumerate(project.analyses) if item.name == spec.name), None)
    return f"{project.path}: {spec.name}" if i is None else f"{project.where('analyses', i)}: analyses[{i}]"
