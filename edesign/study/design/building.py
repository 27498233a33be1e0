"""The frame as a design sees it: places of dampers, storeys with their stiffness, and dampers of a size set in."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import compress
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np

from edesign.core import CoreError, LawValues
from edesign.errors import AnalysisError, InputError, split_code
from edesign.frame.device_places import DevicePlace, device_places
from edesign.frame.devices import DeviceLaw
from edesign.project.analysis_file import AnalysisFile, File
from edesign.project.dampers.dampers import Brace, BraceSection, BraceStiffness, DamperRun, Dampers
from edesign.project.dampers.designs import HystereticDesign, SizedDesign
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.structure import make_structure
from edesign.study.design.beside import NOTHING_BESIDE, Standing
from edesign.study.design.braces import sites_of
from edesign.study.design.condensed import CondensedFrame, LinearModes, condense, pull

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
        beside: dampers of other designs that stand in the frame.
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
    beside: Standing

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


def make_building(
    project: AnalysisFile,
    name: str,
    spec: SizedDesign,
    beside: Standing = NOTHING_BESIDE,
    size: Mapping[str, Any] = MappingProxyType({}),
) -> Building:
    """Build the frame, find the places and the stiffness of the storeys. Tuned masses are left out.

    Args:
        project: with the law; checked by `check_design`.
        size: keys of a device that say how large dampers are which carry gravity loads, and stand in the frame so.

    Returns:
        The frame with the places of its dampers and the stiffness of its storeys.

    Raises:
        InputError: the law is wrong, or the frame cannot be built.
        AnalysisError: the frame is unstable.
    """
    law = law_at(project, spec.law, spec.temperature)
    storeys = design_storeys(spec, project.grid.n_storeys)
    runs = _runs(spec, storeys, "rigid", size)
    trial = _dampers(project, runs, beside, keep_attachments=False)
    try:
        structure = make_structure(project.with_dampers(trial), dampers=True)
    except InputError as error:  # its devices stand in no file: the place is the design
        _, trial_device, message = str(error).rpartition("dampers.devices[0]: ")
        if not trial_device:
            raise
        sentence, _ = split_code(message)
        raise InputError(
            f"designs.{name}: {sentence}; its bays and storeys reach beyond the members [E-DESIGN-01]"
        ) from error
    except CoreError as error:
        if law.restrained is None or carries_gravity(spec):
            raise
        raise AnalysisError(f"braces that the frame stands by need `carries_gravity: true`: {error}") from error
    if spec.state == "gravity":
        structure.apply_gravity()
    direction = 0 if spec.along is None else ("x", "y").index(spec.along)
    across = structure.frame.directions[direction].degree
    devices = [device for device in structure.frame.devices if device.name not in beside.stiffness]
    reference = None
    if carries_gravity(spec) and structure.frame.brace_stiffness is not None:
        reference = structure.frame.brace_stiffness[[device.number for device in devices]]
    frame = condense(structure, direction, beside.stiffness, reference)
    if not devices:
        raise InputError(f"designs.{name}: no place is left for a damper in these bays and storeys [E-DESIGN-01]")
    sites, where = sites_of(project), f"designs.{name}"
    index = {storey: i for i, storey in enumerate(storeys.tolist())}
    pulls = np.array([pull(structure.frame, device, across) for device in devices])
    numbers = np.array([device.storey for device in devices])
    computed = storey_stiffness(frame, storeys, numbers, pulls)
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
        np.array([index[storey] for storey in numbers.tolist()]),
        np.array([sum(max(c, 0.0) for c, _, degree in device.terms if degree == across) for device in devices]),
        pulls,
        np.array([device.deformation_scale for device in devices]),
        tuple(place for run in runs for place in device_places(project, run, sites, structure.frame.nodes, where)),
        beside,
    )


def design_storeys(spec: SizedDesign, n_storeys: int) -> np.ndarray:
    """Return the numbers of the storeys with dampers of a design, (s,), from the lowest.

    Args:
        n_storeys: of the frame.
    """
    return np.unique([storey for run in spec.runs for storey in run.storeys.numbers(1, n_storeys)])


def carries_gravity(spec: SizedDesign) -> bool:
    """Return whether the dampers of a design act from the beginning, under the gravity loads too."""
    return isinstance(spec, HystereticDesign) and spec.carries_gravity


def storey_stiffness(
    frame: CondensedFrame, storeys: np.ndarray, places: np.ndarray | None = None, pulls: np.ndarray | None = None
) -> np.ndarray:
    """Return the storey stiffness of the frame without dampers under the loads of its first mode, (f,) N/m.

    It is storey shear over storey drift. Under these loads the displacements are the mode itself. Of a building both
    are along the direction of the design, under the loads of its `Lead`; the drift is at the centre of mass of the
    floor above. A storey below a floor that the ground holds has none, nan. Where the frame stands by its dampers, the
    first mode is that with their reference, and the shear is what the dampers leave.

    Args:
        storeys: with dampers, from 1.
        places: storey of each damper, from 1, (d,), for a frame that stands by them.
        pulls: `pull` of each, (d,).

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
    if frame.reference is not None and places is not None and pulls is not None:
        np.subtract.at(shear, places - 1, frame.reference * lead.dampers * pulls)
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
        brace: of the dampers; lists go by the storeys with dampers.
        size: keys of a device that say how large it is, such as `layer_area` or `scale`; of tuples (s,) each place has
            those of its storeys.
    """
    project = with_temperature(building.project, spec.law, spec.temperature)
    return _dampers(project, _runs(spec, building.storeys, brace, size), NOTHING_BESIDE, keep_attachments=True)


def per_storey(values: np.ndarray) -> tuple[float, ...]:
    """Return values of the storeys (s,) in the form that a device of a project file has."""
    return tuple(float(value) for value in values)


def _runs(spec: SizedDesign, storeys: np.ndarray, brace: Brace, size: Mapping[str, Any]) -> tuple[DamperRun, ...]:
    """The dampers of each kind; of lists by the storeys with dampers, (s,), each has its own."""
    found = []
    for run in spec.runs:
        here = np.isin(storeys, run.storeys.numbers(1, int(storeys[-1]))).tolist()

        def own(given: Any, here: list[bool] = here) -> Any:
            return tuple(compress(given, here)) if isinstance(given, tuple) else given

        held = brace
        if isinstance(brace, BraceStiffness):
            held = brace.model_copy(update={"stiffness": own(brace.stiffness)})
        elif isinstance(brace, BraceSection):
            held = brace.model_copy(update={"section": own(brace.section)})
        about = {**run._asdict(), "law": spec.law, "number": spec.number, "brace": held}
        if carries_gravity(spec):
            about["carries_gravity"] = True
        found.append(DamperRun.model_construct(**about, **{key: own(given) for key, given in size.items()}))
    return tuple(found)


def _dampers(project: AnalysisFile, runs: tuple[DamperRun, ...], beside: Standing, keep_attachments: bool) -> Dampers:
    before = project.dampers
    assert before is not None, "check_design wants the law"
    attachments = before.attachments if keep_attachments else ()
    laws = {**before.laws, **beside.laws}
    return Dampers.model_construct(laws=laws, devices=(*runs, *beside.devices), attachments=attachments)
