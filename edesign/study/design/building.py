"""The frame as a design sees it: places of dampers, storeys with their stiffness, and dampers of a size set in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from edesign.core import LawValues
from edesign.errors import AnalysisError, InputError, split_code
from edesign.frame.device_places import DevicePlace, device_places
from edesign.frame.devices import Device, DeviceLaw
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis_file import AnalysisFile, File
from edesign.project.dampers.dampers import Brace, DamperRun, Dampers
from edesign.project.dampers.designs import SizedDesign
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.structure import make_structure
from edesign.study.design.braces import sites_of
from edesign.study.design.condensed import CondensedFrame, LinearModes, condense

L = TypeVar("L")


@dataclass(frozen=True)
class Building:
    """A frame, or a building in one direction, with places for dampers.

    Attributes:
        project: the project or building that is studied.
        across: degree of the core along the direction that the dampers act in.
        frame: condensed, linear, in the state that the design asks for.
        law: of the dampers.
        storeys: numbers of the storeys with dampers, from 1, (s,).
        heights: of all storeys, m.
        storey_stiffness: of the frame without dampers, all storeys, N/m.
        computed_stiffness: the same as computed from the first mode, whether it was given or not, N/m.
        names: of the dampers at the places.
        place_storey: (d,) index of each place in `storeys`.
        cosine: (d,) of each damper's slope.
        pull: (d,) horizontal force against the drift over the force of the damper: the cosine, with the sign that the
            deformation has as the floor above moves along the direction.
        deformation_scale: (d,) of its law over its own deformation: of braces that stretch with their length, else 1.
        places: (d,) with the geometry of the braces.
    """

    project: AnalysisFile
    across: int
    frame: CondensedFrame
    law: DeviceLaw
    storeys: np.ndarray
    heights: np.ndarray
    storey_stiffness: np.ndarray
    computed_stiffness: np.ndarray
    names: tuple[str, ...]
    place_storey: np.ndarray
    cosine: np.ndarray
    pull: np.ndarray
    deformation_scale: np.ndarray
    places: tuple[DevicePlace, ...]

    @property
    def designed_stiffness(self) -> np.ndarray:
        """Stiffness of the storeys with dampers, (s,) N/m."""
        return self.storey_stiffness[self.storeys - 1]

    def drifts(self, storeys: np.ndarray, lines: np.ndarray) -> np.ndarray:
        """Return the storey drifts over height, (f,), of a building on the column line that drifts most.

        Args:
            storeys: difference of the displacements of floors, (f,) m.
            lines: drift ratios on the column lines of a building, (l,).
        """
        plan = self.frame.plan
        if plan is None:
            return storeys / self.heights
        found = np.zeros(self.heights.size)
        np.maximum.at(found, plan.storey_of, lines)
        return found

    def largest_drifts(self, floors: np.ndarray, lines: np.ndarray) -> np.ndarray:
        """Return the sizes of the storey drifts over height, (f,), as `drifts`.

        Args:
            floors: displacements of the floors, (f,) m.
            lines: drift ratios on the column lines of a building, (l,).
        """
        return self.drifts(np.abs(np.diff(floors, prepend=0.0)), np.abs(lines))

    def attachment(self, power: float = 2.0) -> np.ndarray:
        """Return the sum of a power of the cosines of the dampers' slopes in each storey with dampers, (s,).

        A storey feels a stiffness in proportion to the square of the cosine, a dashpot to its power 1 + alpha.

        Args:
            power: 2 for stiffness, 1 + alpha for dashpots, 1 for yield forces.
        """
        return np.bincount(self.place_storey, self.cosine**power, minlength=self.storeys.size)

    def at_places(self, of_storeys: np.ndarray, power: float = 2.0) -> np.ndarray:
        """Return values along each damper, (d,), from horizontal values of the storeys, in equal shares.

        Args:
            of_storeys: horizontal stiffness, coefficient or force of each storey with dampers, (s,).
            power: power of the cosine with which a damper adds to its storey (see `attachment`).
        """
        return (of_storeys / self.attachment(power))[self.place_storey]


def make_building(project: AnalysisFile, name: str, spec: SizedDesign) -> Building:
    """Build the frame, find the places and the stiffness of the storeys. Tuned masses are left out.

    Args:
        project: with the law; checked by `check_design`.

    Returns:
        The frame with the places of its dampers and the stiffness of its storeys.

    Raises:
        InputError: the law is wrong, or the frame cannot be built.
        AnalysisError: the frame is unstable.
    """
    law = law_at(project, spec.law, spec.temperature)
    trial = _run(spec, "rigid", {})
    empty = project.with_dampers(_dampers(project, trial, keep_attachments=False))
    try:
        structure = make_structure(empty, dampers=True)
    except InputError as error:  # its devices stand in no file: the place is the design
        _, trial_device, message = str(error).rpartition("dampers.devices[0]: ")
        if not trial_device:
            raise
        sentence, _ = split_code(message)
        raise InputError(
            f"designs.{name}: {sentence}; its bays and storeys reach beyond the members [E-DESIGN-01]"
        ) from error
    if spec.state == "gravity":
        structure.apply_gravity()
    direction = 0 if spec.along is None else ("x", "y").index(spec.along)
    across = structure.frame.directions[direction].degree
    frame = condense(structure, direction)
    devices = structure.frame.devices
    if not devices:
        raise InputError(f"designs.{name}: no place is left for a damper in these bays and storeys [E-DESIGN-01]")
    storeys = np.array(spec.storeys.numbers(1, project.grid.n_storeys))
    index = {storey: i for i, storey in enumerate(storeys.tolist())}
    computed = storey_stiffness(frame, storeys)
    given = spec.storey_stiffness
    return Building(
        project,
        across,
        frame,
        law,
        storeys,
        np.array(project.grid.storey_heights),
        computed if given == "computed" else np.array(given),
        computed,
        tuple(device.name for device in devices),
        np.array([index[device.storey] for device in devices]),
        np.array([sum(max(c, 0.0) for c, _, degree in device.terms if degree == across) for device in devices]),
        np.array([_pull(structure.frame, device, across) for device in devices]),
        np.array([device.deformation_scale for device in devices]),
        tuple(device_places(empty, trial, sites_of(empty), structure.frame.nodes, f"designs.{name}")),
    )


def _pull(frame: FrameModel, device: Device, across: int) -> float:
    """What the deformation of a damper grows by as the floor above it moves by 1."""
    above = {frame.nodes[name] for name in frame.floors[device.storey - 1].nodes}
    return sum(c for c, node, degree in device.terms if degree == across and node in above)


def storey_stiffness(frame: CondensedFrame, storeys: np.ndarray) -> np.ndarray:
    """Return the storey stiffness of the frame without dampers under the loads of its first mode, (f,) N/m.

    It is storey shear over storey drift. Under these loads the displacements are the mode itself. Of a building both
    are along the direction of the design, under the loads of its `Lead`; the drift is at the centre of mass of the
    floor above. A storey below a floor that the ground holds has none, nan.

    Args:
        storeys: with dampers, from 1.

    Raises:
        AnalysisError: a storey with dampers does not shear in the first mode.
    """
    lead = frame.modes().lead
    shear, drift = storey_shears(frame.at_floors(lead.loads)), lead.storeys
    shears = shear * drift > 0.0
    if still := [str(storey) for storey in storeys.tolist() if not shears[storey - 1]]:
        raise AnalysisError(
            f"storey {', '.join(still)} does not shear in the first mode of the frame: it has no storey stiffness "
            "[E-DESIGN-02]"
        )
    return np.divide(shear, drift, out=np.full(shear.size, np.nan), where=shears)


def mode_shears(frame: CondensedFrame, modes: LinearModes) -> np.ndarray:
    """Return the storey shears of modes at unit generalised displacement, (n, f) N/m.

    Args:
        modes: its modes, with or without dampers.
    """
    return storey_shears(frame.at_floors(modes.omega[:, None] ** 2 * frame.mass * modes.masses))


def storey_shears(floor_forces: np.ndarray) -> np.ndarray:
    """Return the sums of the forces of the floors at and above each storey, along the last axis.

    Args:
        floor_forces: (..., f) N, from the lowest floor up.

    Returns:
        The storey shears, (..., f) N, from the lowest storey up.
    """
    return np.flip(np.cumsum(np.flip(floor_forces, -1), -1), -1)


def law_at(project: AnalysisFile, name: str, temperature_C: float | None) -> DeviceLaw:
    """Return a damper law of the project at a temperature.

    Args:
        temperature_C: degC; None: the temperature that the project gives.
    """
    return device_laws(with_temperature(project, name, temperature_C))[name]


def read_law(building: Building, name: str, spec: SizedDesign, read: Callable[[LawValues], L]) -> L:
    """Return what the sizing of dampers without layers needs of their law.

    Args:
        building: the frame with its places and the law.
        read: reads it from the values of the law, or raises an InputError.

    Returns:
        What `read` returns.

    Raises:
        InputError: the law has layers, or is refused.
    """
    if building.law.layers is not None:
        message = f"the law `{spec.law}` has a `prototype`: {spec.method} dampers have no layers [E-DESIGN-03]"
        raise InputError(f"designs.{name}.law: {message}")
    try:
        return read(building.law.law)
    except InputError as error:
        raise InputError(f"designs.{name}.law: `{spec.law}`: {error}") from error


def with_temperature(project: File, name: str, temperature_C: float | None) -> File:
    """Return the project with one of its damper laws at another temperature.

    Args:
        temperature_C: degC; None: the project is returned as it is.
    """
    dampers = project.dampers
    if temperature_C is None or dampers is None:
        return project
    law = dampers.laws[name].model_copy(update={"temperature": temperature_C})
    return project.model_copy(update={"dampers": dampers.model_copy(update={"laws": {**dampers.laws, name: law}})})


def sized_dampers(building: Building, spec: SizedDesign, brace: Brace, size: Mapping[str, Any]) -> Dampers:
    """Return the project's dampers with those of the design in place of its devices.

    Args:
        spec: the design; its temperature, if it has one, becomes that of its law.
        size: keys of a device that say how large it is, such as `layer_area` or `scale`.
    """
    project = with_temperature(building.project, spec.law, spec.temperature)
    return _dampers(project, _run(spec, brace, size), keep_attachments=True)


def per_storey(values: np.ndarray) -> tuple[float, ...]:
    """Return values of the storeys (s,) in the form that a device of a project file has."""
    return tuple(float(value) for value in values)


def _run(spec: SizedDesign, brace: Brace, size: Mapping[str, Any]) -> DamperRun:
    return DamperRun.model_construct(
        kind=spec.kind,
        along=spec.along,
        frames=spec.frames,
        bays=spec.bays,
        storeys=spec.storeys,
        law=spec.law,
        number=spec.number,
        brace=brace,
        **size,
    )


def _dampers(project: AnalysisFile, run: DamperRun, keep_attachments: bool) -> Dampers:
    before = project.dampers
    assert before is not None, "check_design wants the law"
    attachments = before.attachments if keep_attachments else ()
    return Dampers.model_construct(laws=before.laws, devices=(run,), attachments=attachments)
