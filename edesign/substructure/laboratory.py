"""What a file of substructure tests says of laboratory and structure, as the loop takes it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np

from edesign.core.damper import LawValues
from edesign.core.substructure import LinearRig, RigLimits, Sensors, ServoHydraulicRig
from edesign.damper.law_file import Source, read_law_file, resolve
from edesign.damper.testing.specimen import Specimen
from edesign.errors import InputError
from edesign.frame.devices import Device, DeviceLaw, DeviceSize
from edesign.project.analysis.damping import ModalDamping, NoDamping, RayleighDamping
from edesign.project.analysis.outputs import HistoryKind
from edesign.project.dampers.dampers import DamperLaw, LawDescription
from edesign.project.substructure import rig as rig_kinds
from edesign.project.substructure.rts_file import RtsFile
from edesign.project.substructure.structure import ProjectStructure, ShearBuilding
from edesign.substructure.rig import rigs
from edesign.substructure.rig.rigs import RigTransfer
from edesign.substructure.sized_damper import SizedDamper
from edesign.substructure.structure.linear_building import LinearBuilding, building_of_floors
from edesign.substructure.structure.numerical import LinearPart, shear_building
from edesign.substructure.structure.project_frame import ProjectFrame, loop_grows
from edesign.substructure.structure.project_structure import project_part

FRAME_HISTORIES: tuple[HistoryKind, ...] = ("floors", "storeys", "dampers", "energy")
"""What is kept over time of the building, if it is."""
STIFF_OIL = 1e15
"""N/m of an oil column that does not give way: 1e-6 of the displacement of the stiffest specimen of 1 GN/m."""

SMALL = (1e-4, 0.1)
"""m and s: the motion at which a damper is a spring and a dashpot, where no other is known."""


@dataclass(frozen=True)
class TestedDamper:
    """The virtual damper in the laboratory.

    Attributes:
        values: law and effects, as the core takes them.
        scales: of force and deformation, F = scales[0] law(scales[1] u).
        declared: the law without the effects that the tests are to find.
        prototype: layers that the parameters of the law are of, not those of the damper; None: the law has no size.
        temperature_C: degC; None: that of the parameters.
        warnings: of the law at this temperature.
    """

    __test__ = False  # no test of pytest

    values: LawValues
    scales: tuple[float, float]
    declared: DamperLaw
    prototype: Specimen | None
    temperature_C: float | None
    warnings: tuple[str, ...]


NOTHING = TestedDamper(
    LawValues("kelvin_voigt", (0.0, 0.0)), (1.0, 1.0), DamperLaw(type="kelvin_voigt"), None, None, ()
)
"""In a rig that moves alone."""


@dataclass(frozen=True)
class TestedStructure:
    """The structure in the computer.

    Attributes:
        part: its matrices; of a frame that may yield those of its tangent under gravity, for margins.
        building: floors and storeys of the part.
        warnings: what the linear part leaves out.
        frame: that may yield, and runs in the loop; None: the linear part does.
    """

    __test__ = False  # no test of pytest

    part: LinearPart
    building: LinearBuilding
    warnings: tuple[str, ...]
    frame: ProjectFrame | None = None


@dataclass(frozen=True)
class Laboratory:
    """Laboratory, structure and damper that all tests of a file share.

    Attributes:
        structure: None: there are only given targets.
        damper: in the rig; None: the rig moves alone.
        rig, limits, rig_stiffness, corrected: of the rig, as of `SubstructureLoop`.
        transfer: of the rig, with the specimen as a spring for a servo-hydraulic one.
        sensors: of displacement and force.
    """

    structure: TestedStructure | None
    damper: TestedDamper | None
    rig: LinearRig | ServoHydraulicRig
    transfer: RigTransfer
    limits: RigLimits
    rig_stiffness: float
    corrected: bool
    sensors: Sensors

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings of the structure and the damper."""
        of_structure = self.structure.warnings if self.structure is not None else ()
        return (*of_structure, *(self.damper.warnings if self.damper is not None else ()))


def laboratory(file: RtsFile) -> Laboratory:
    """Return the laboratory of a checked file.

    Raises:
        InputError: the law or the structure cannot be tested so; the message says why, and where it stands.
    """
    structure, device = _structure(file)
    damper = _damper(file, device)
    if structure is not None and device is not None and file.may_yield:
        structure = _with_frame(structure, device, damper or NOTHING, file)
    plant = file.plant
    transfer = rig_transfer(plant, stiffness_of(damper))
    limits = plant.limits
    return Laboratory(
        structure=structure,
        damper=damper,
        rig=_rig(plant, transfer, file.sub_step),
        transfer=transfer,
        limits=RigLimits(limits.stroke or inf, limits.velocity or inf, limits.force or inf),
        rig_stiffness=plant.flexibility.stiffness if plant.flexibility is not None else 0.0,
        corrected=plant.flexibility.corrected if plant.flexibility is not None else False,
        sensors=_sensors(file),
    )


def _structure(file: RtsFile) -> tuple[TestedStructure | None, Device | None]:
    """The structure, and the damper in it if a project says it."""
    described = file.structure
    if isinstance(described, ShearBuilding):
        count = len(described.masses)
        part = shear_building(described.masses, described.stiffnesses, _damping(described), described.storey)
        period = 1.0 / float(part.frequencies()[0])
        return TestedStructure(part, building_of_floors(count, period), ()), None
    if not isinstance(described, ProjectStructure):
        return None, None
    assert file.project is not None
    found = project_part(file.project, described.physical[0], vertical=False, estimate=file.may_yield)
    return TestedStructure(found.part, found.building, found.warnings), found.device


def _with_frame(structure: TestedStructure, device: Device, damper: TestedDamper, file: RtsFile) -> TestedStructure:
    """The structure with its frame that may yield, and a warning where its loop is not stable with an ideal rig."""
    assert file.project is not None
    collapse = file.analysis.collapse_drift if file.analysis is not None else None
    kept = FRAME_HISTORIES if "building" in file.outputs.histories else ()
    thickness = damper.prototype.layer_thickness / damper.scales[1] if damper.prototype is not None else None
    device = replace(device, layer_thickness=thickness)
    frame = ProjectFrame(file.project, device, damper.values, damper.scales, collapse, kept)
    structure = replace(structure, frame=frame)
    k, c = tangent_of(damper)
    step, force = file.loop.main_step, file.loop.force
    if not loop_grows(structure.part, (k, c), step, force == "held"):
        return structure
    text = (
        f"the frame meets the specimen's force {force}: with main steps of {1e3 * step:.4g} ms small vibrations grow "
        f"even with an ideal rig and a spring of {k:.3g} N/m with a dashpot of {c:.3g} N s/m as specimen; take shorter "
        "main steps"
    )
    return replace(structure, warnings=(*structure.warnings, text))


def _damping(described: ShearBuilding) -> NoDamping | RayleighDamping | ModalDamping:
    given = described.damping
    if given.kind == "rayleigh":
        first, second = given.modes
        return RayleighDamping(
            kind="rayleigh", ratio=given.ratio, modes=(first, second), stiffness="initial", state="initial"
        )
    if given.kind == "modal":
        modes = given.modes or len(described.masses)
        return ModalDamping(kind="modal", ratio=given.ratio, modes=modes, state="initial")
    return NoDamping(kind="none")


def _damper(file: RtsFile, device: Device | None) -> TestedDamper | None:
    """The specimen, at the size of a device of a project, or at that of the file."""
    placed, said = file.law, file.specimen
    if placed is None:
        return None
    described: LawDescription = placed.law
    source = asked = Source(placed.path, placed.root, placed.keys)
    if placed.law.file is not None:
        described, source = read_law_file(placed.path.parent / placed.law.file, file.law_file_content(placed))
    bare = resolve(described, source, placed.law.temperature, asked)
    found = bare
    if said.effects:
        own = Source(file.path, file.root, ("specimen",))
        whole = described.model_copy(update={"effects": (*described.effects, *said.effects)})
        found = resolve(whole, own, placed.law.temperature, asked)
    size = DeviceSize(said.number, said.layers, said.layer_area, said.layer_thickness)
    if device is not None:
        size = device.size
    prototype = placed.law.prototype or described.prototype
    if prototype is None and size.resized:
        whose = "the specimen" if device is None else f"the damper {device.name} of the project"
        raise InputError(
            f"{file.where('specimen')}: specimen: the law has no `prototype`, and {whose} changes the size of one; "
            "give the law its `prototype` [E-RTS-05]"
        )
    law, of_law = DeviceLaw(found.for_core, property_factor=placed.law.property_factor), None
    if prototype is not None:
        layers = (prototype.layers, prototype.layer_area, prototype.layer_thickness)
        law = DeviceLaw(found.for_core, *layers, property_factor=placed.law.property_factor)
        of_law = Specimen(said.law if isinstance(said.law, str) else "specimen", *layers)
    force, deformation, _ = size.scales(law)
    if law.restrained is not None and device is not None and device.restrained is not None:
        deformation = law.restrained.length / device.restrained.length
    return TestedDamper(
        values=found.for_core,
        scales=(force, deformation),
        declared=placed.law,
        prototype=of_law,
        temperature_C=placed.law.temperature,
        warnings=found.warnings,
    )


def stiffness_of(damper: TestedDamper | None) -> float:
    """Return the stiffness of a damper to a tenth of a millimetre in a tenth of a second, N/m; 0 without a damper.

    Args:
        damper: in the rig, or None.
    """
    if damper is None:
        return 0.0
    _, force, _ = _small_step(damper)
    return force / SMALL[0]


def tangent_of(damper: TestedDamper) -> tuple[float, float]:
    """Return the spring (N/m) and the dashpot (N s/m) that a damper is in small motions, none below 0.

    Args:
        damper: in the rig.

    Returns:
        Stiffness, N/m, and damping coefficient, N s/m.
    """
    _, _, (of_u, of_v) = _small_step(damper)
    return max(of_u, 0.0), max(of_v, 0.0)


def _small_step(damper: TestedDamper) -> tuple[np.ndarray, float, tuple[float, float]]:
    displacement, duration = SMALL
    device, velocity = SizedDamper(damper.values, damper.scales), displacement / duration
    return device.step(device.start(), duration, (0.0, velocity), (displacement, velocity))


def rig_transfer(plant: rig_kinds.RigModel, specimen_stiffness: float) -> RigTransfer:
    """Return the transfer function of a rig of a file; a servo-hydraulic one has a spring as specimen.

    Args:
        specimen_stiffness: of that spring, N/m.
    """
    match plant:
        case rig_kinds.IdealRig():
            return rigs.ideal()
        case rig_kinds.DelayRig():
            return rigs.pure_delay(plant.delay, plant.gain)
        case rig_kinds.FirstOrderRig():
            return rigs.first_order(plant.time_constant, plant.delay, plant.gain)
        case rig_kinds.SecondOrderRig():
            return rigs.second_order(plant.frequency, plant.damping, plant.delay, plant.gain)
        case rig_kinds.TransferFunctionRig():
            return RigTransfer(plant.numerator, plant.denominator, plant.delay)
        case rig_kinds.ServoHydraulicRig():
            softness = specimen_stiffness / plant.oil_stiffness if plant.oil_stiffness else 0.0
            return rigs.servo_hydraulic(plant.proportional_gain, plant.valve_time_constant, plant.delay, softness)


def _rig(plant: rig_kinds.RigModel, transfer: RigTransfer, sub_step: float) -> LinearRig | ServoHydraulicRig:
    if not isinstance(plant, rig_kinds.ServoHydraulicRig):
        return transfer.discrete(sub_step)
    return ServoHydraulicRig(
        plant.proportional_gain, plant.oil_stiffness or STIFF_OIL, plant.valve_time_constant, plant.delay
    )


def _sensors(file: RtsFile) -> Sensors:
    said = file.sensors
    reach, force = file.displacement_range, file.force_range

    def quantisation(largest: float | None) -> float:
        return 2.0 * largest / 2.0**said.bits if said.bits is not None and largest is not None else 0.0

    return Sensors(
        displacement_noise=file.encoder_noise,
        displacement_quantisation=quantisation(reach),
        displacement_range=reach or inf,
        force_noise=said.force_noise,
        force_quantisation=quantisation(force),
        force_range=force or inf,
        force_delay=said.force_delay,
    )
