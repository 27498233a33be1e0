"""Natural modes of a frame with dampers: their stiffness at the frequency of the first mode."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.devices import Device
from edesign.core import Modes
from edesign.errors import InputError
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.project import Project
from edesign.study.recording import coordinate
from edesign.study.structure import Structure

SMALL_STRAIN = 1e-4
SMALL_DEFORMATION = 1e-5  # m, of dampers without layers
_ROUNDING = 1e-9  # of a first harmonic, against the force itself


def damped_modes(project: Project, structure: Structure, spec: ModalAnalysis) -> tuple[Modes, np.ndarray]:
    """The modes of a frame whose dampers vibrate steadily in the first of them.

    Returns:
        The modes, and the complex stiffness of each device, N/m.

    Raises:
        InputError: a strain is given for dampers without layers.
        AnalysisError: there are not so many modes, or the structure is unstable.
    """
    devices = structure.frame.devices
    amplitudes = [_amplitude(project, spec, device) for device in devices]
    return structure.steady_modes(spec.modes, devices, amplitudes)


def store_damper_stiffness(group: Group, structure: Structure, modes: Modes, stiffness: np.ndarray) -> None:
    """Add the dampers' stiffness and loss factor to a group."""
    devices = structure.frame.devices
    coordinate(group, "damper", [device.name for device in devices], "", "name of the damper")
    label = (
        "of the damper with its brace in steady vibration in the first mode; of an isolated base between the extremes"
    )
    storing = np.abs(stiffness.real) > _ROUNDING * np.abs(stiffness)
    loss = np.full(stiffness.size, np.nan)  # of a dashpot, or a stop that stays open: there is none
    np.divide(stiffness.imag, stiffness.real, out=loss, where=storing)
    group.add("damper_storage_stiffness", ("damper",), stiffness.real, "N/m", f"storage stiffness {label}")
    group.add("damper_loss_factor", ("damper",), loss, "1", f"loss factor {label}")
    group.attributes["damper_frequency_Hz"] = float(modes.omega[0]) / (2.0 * np.pi)


def _amplitude(project: Project, spec: ModalAnalysis, device: Device) -> float:
    if spec.damper_deformation is not None:
        return spec.damper_deformation
    if spec.damper_strain is not None:
        if device.layer_thickness is None:
            message = f"the damper {device.name} has no layers; give `damper_deformation`"
            raise InputError(f"{_where(project, spec)}: damper_strain: {message}")
        return spec.damper_strain * device.layer_thickness
    if device.design_deformation is not None:
        return device.design_deformation
    return SMALL_STRAIN * device.layer_thickness if device.layer_thickness is not None else SMALL_DEFORMATION


def _where(project: Project, spec: ModalAnalysis) -> str:
    """The place of an analysis in the project file; its name if it comes from elsewhere."""
    i = next((i for i, item in enumerate(project.analyses) if item.name == spec.name), None)
    return f"{project.path}: {spec.name}" if i is None else f"{project.where('analyses', i)}: analyses[{i}]"
