"""The frame as a design sees it: places of dampers, storeys with their stiffness, and dampers of a size set in."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from edesign.building.devices import DeviceLaw
from edesign.errors import AnalysisError, InputError
from edesign.project.dampers import BraceStiffness, DamperRun, Dampers, Prototype
from edesign.project.designs import Design
from edesign.project.project import Project
from edesign.study.dampers import device_laws
from edesign.study.design.condensed import CondensedFrame, condense
from edesign.study.structure import make_structure


@dataclass(frozen=True)
class Building:
    """A frame with places for dampers.

    Attributes:
        project: that is studied.
        frame: condensed, linear, in the state that the design asks for.
        law: of the dampers with its prototype.
        prototype: its layers.
        layers: of one damper.
        storeys: numbers of the storeys with dampers, from 1, (s,).
        heights: of all storeys, m.
        storey_stiffness: of the frame without dampers, all storeys, N/m.
        computed_stiffness: the same as computed from the first mode, whether it was given or not, N/m.
        place_storey: (d,) index of each place in `storeys`.
        cosine: (d,) of each damper's slope.
    """

    project: Project
    frame: CondensedFrame
    law: DeviceLaw
    prototype: Prototype
    layers: int
    storeys: np.ndarray
    heights: np.ndarray
    storey_stiffness: np.ndarray
    computed_stiffness: np.ndarray
    place_storey: np.ndarray
    cosine: np.ndarray

    @property
    def designed_stiffness(self) -> np.ndarray:
        """Stiffness of the storeys with dampers, (s,) N/m."""
        return self.storey_stiffness[self.storeys - 1]

    @property
    def attachment(self) -> np.ndarray:
        """Sum of the squared cosines of the places in each storey with dampers, (s,)."""
        return np.bincount(self.place_storey, self.cosine**2, minlength=self.storeys.size)

    def at_places(self, of_storeys: np.ndarray) -> np.ndarray:
        """Stiffness along each damper (d,) from horizontal ones of the storeys (s,): shared equally, over cos^2."""
        return (of_storeys / self.attachment)[self.place_storey]


def make_building(project: Project, name: str, spec: Design) -> Building:
    """Build the frame, find the places and the stiffness of the storeys. Tuned masses are left out.

    Raises:
        InputError: the law has no layers, or the frame cannot be built.
        AnalysisError: the frame is unstable.
    """
    law = law_at(project, spec.law, spec.temperature)
    if law.layers is None or law.layer_area is None or law.layer_thickness is None:
        raise InputError(f"designs.{name}.law: the law `{spec.law}` has no `prototype`: it has no layers to be sized")
    prototype = Prototype.model_construct(
        layers=law.layers, layer_area=law.layer_area, layer_thickness=law.layer_thickness
    )
    trial = _run(spec, law.layers, law.layer_area, law.layer_thickness)
    empty = project.model_copy(update={"dampers": _dampers(project, trial, keep_attachments=False)})
    try:
        structure = make_structure(empty, dampers=True)
    except InputError as error:  # its devices stand in no file: the place is the design
        _, trial_device, message = str(error).rpartition("dampers.devices[0]: ")
        if not trial_device:
            raise
        raise InputError(f"designs.{name}: {message}; its bays and storeys reach beyond the members") from error
    if spec.state == "gravity":
        structure.apply_gravity()
    frame = condense(structure)
    devices = structure.frame.devices
    if not devices:
        raise InputError(f"designs.{name}: no place is left for a damper in these bays and storeys")
    storeys = np.array(spec.storeys.numbers(1, project.frame.n_storeys))
    index = {storey: i for i, storey in enumerate(storeys.tolist())}
    computed = storey_stiffness(frame)
    given = spec.storey_stiffness
    return Building(
        project,
        frame,
        law,
        prototype,
        spec.layers if spec.layers is not None else law.layers,
        storeys,
        np.array(project.frame.storey_heights),
        computed if given == "computed" else np.array(given),
        computed,
        np.array([index[device.storey] for device in devices]),
        np.array([sum(max(c, 0.0) for c, _, degree in device.terms if degree == 0) for device in devices]),
    )


def storey_stiffness(frame: CondensedFrame) -> np.ndarray:
    """Storey shear over storey drift of the frame without dampers under the loads of its first mode, (f,) N/m.

    Under these loads the displacements are the mode itself.

    Raises:
        AnalysisError: a storey does not shear in the first mode.
    """
    mode = frame.modes()
    shear = storey_shears(frame.at_floors(mode.omega[0] ** 2 * frame.mass * mode.masses[0]))
    drift = np.diff(mode.floors[0], prepend=0.0)
    if np.any(shear * drift <= 0.0):
        raise AnalysisError("a storey does not shear in the first mode of the frame: it has no storey stiffness")
    return shear / drift


def storey_shears(floor_forces: np.ndarray) -> np.ndarray:
    """Sums of the forces of the floors at and above each storey, along the last axis."""
    return np.flip(np.cumsum(np.flip(floor_forces, -1), -1), -1)


def law_at(project: Project, name: str, temperature_C: float | None) -> DeviceLaw:
    """A law of the project at a temperature; None: its own."""
    return device_laws(with_temperature(project, name, temperature_C))[name]


def with_temperature(project: Project, name: str, temperature_C: float | None) -> Project:
    """The project with one law at a temperature; None: as it is."""
    dampers = project.dampers
    if temperature_C is None or dampers is None:
        return project
    law = dampers.laws[name].model_copy(update={"temperature": temperature_C})
    return project.model_copy(update={"dampers": dampers.model_copy(update={"laws": {**dampers.laws, name: law}})})


def sized_dampers(
    building: Building, spec: Design, area: np.ndarray, thickness: float, brace: np.ndarray | None
) -> Dampers:
    """The project's dampers with those of the design in place of its devices.

    Args:
        building: with the places.
        spec: the design; its temperature, if it has one, becomes that of its law.
        area: of one layer, (s,) m2.
        thickness: of one layer, m.
        brace: stiffness of the brace of each damper, along it, (s,) N/m; None: rigid.
    """
    areas = tuple(float(value) for value in area)
    project = with_temperature(building.project, spec.law, spec.temperature)
    run = _run(spec, building.layers, areas, thickness, brace)
    return _dampers(project, run, keep_attachments=True)


def _run(
    spec: Design,
    layers: int,
    area: float | tuple[float, ...],
    thickness: float,
    brace: np.ndarray | None = None,
) -> DamperRun:
    stiffness = () if brace is None else tuple(float(k) for k in brace)
    return DamperRun.model_construct(
        kind=spec.kind,
        bays=spec.bays,
        storeys=spec.storeys,
        law=spec.law,
        number=spec.number,
        layers=layers,
        layer_area=area,
        layer_thickness=thickness,
        brace=BraceStiffness.model_construct(stiffness=stiffness) if stiffness else "rigid",
    )


def _dampers(project: Project, run: DamperRun, keep_attachments: bool) -> Dampers:
    before = project.dampers
    assert before is not None, "check_design wants the law"
    attachments = before.attachments if keep_attachments else ()
    return Dampers.model_construct(laws=before.laws, devices=(run,), attachments=attachments)
