"""A push: lateral loads of a fixed pattern, under gravity, until the roof has a displacement."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.analyses import PushoverAnalysis, TargetAnalysis
from edesign.project.analysis.pushover import Pushover, pattern_name
from edesign.project.analysis.shaking import Eccentric
from edesign.project.analysis_file import AnalysisFile
from edesign.space.nonlinear.masses import IN_PLACE
from edesign.study.analysis.buckling import buckling_warnings
from edesign.study.analysis.capacity_events import EventChannels
from edesign.study.analysis.dampers import core_strain_warnings
from edesign.study.analysis.lateral_patterns import by_floor, eccentric_moments
from edesign.study.analysis.second_order import column_forces, line_shares
from edesign.study.analysis.structure import make_frame, make_structure
from edesign.study.results.braces import brace_quantities, fracture_warnings
from edesign.study.results.coordinates import bending_members, coordinates
from edesign.study.results.couples import LackingCouples
from edesign.study.results.dampers import damper_quantities
from edesign.study.results.floors import diaphragm_motions, floor_displacements, floor_rotations
from edesign.study.results.member_use import run_watch
from edesign.study.results.members import axial_forces, leaning_column_forces, member_forces, plastic_rotations
from edesign.study.results.recording import Quantity, channels, coordinate, store, store_run
from edesign.study.results.requested import requested_quantities
from edesign.study.results.springs import hinge_warnings, spring_quantities
from edesign.study.results.storeys import (
    line_drifts,
    store_drift_extremes,
    storey_drifts,
    storey_shears,
    storey_torques,
)
from edesign.study.results.supports import base_shear, support_reactions
from edesign.study.results.validity import judged, rotation_limits, rotation_names
from edesign.study.results.warnings import AnalysisWarning, store_warnings

Progress = Callable[[int, int], None]
Stop = Callable[[], bool]


@dataclass(frozen=True)
class Push:
    """A push and its recorded response.

    Attributes:
        frame: that was pushed.
        direction: index of that in which it was pushed.
        sign: 1 to the right or along the axis of the direction, -1 to the other side.
        target: last displacement of the control node that was asked for, that under gravity included, m.
        response: judged.
        base_shear: of each step, N, positive in the direction of the push.
        resistance: base shear of each step against the resultant of the loads, N. It is minus `base_shear` where the
            resultant acts against the motion of the roof, as that of a higher mode may.
        displacement: of the control node since gravity in each step, m, positive in that direction.
        floors: displacement of each floor in each step along the axis of the push, that under gravity included, m.
        turned: turn of each floor in each step about the vertical, rad; zeros of floors that are not rigid.
        eccentricity: by what shares of the lengths of each floor the loads stand beside the centres of mass.
        moments: about the vertical, of lateral loads of 1 N beside the centres of mass, by node, N m.
        line_drifts: drift ratios of each step, as `line_drifts` has them, (steps, n).
        line_shares: of each in the vertical loads of each storey, (storeys, n).
        group: its results, without events.
    """

    frame: FrameModel
    direction: int
    sign: float
    target: float
    response: Response
    base_shear: np.ndarray
    resistance: np.ndarray
    displacement: np.ndarray
    floors: np.ndarray
    turned: np.ndarray
    eccentricity: tuple[float, float]
    moments: Mapping[str, float]
    line_drifts: np.ndarray
    line_shares: np.ndarray
    group: Group
    events: EventChannels

    @property
    def start(self) -> float:
        """Displacement of the control node under gravity, m."""
        return float(self.response.time[0])


def push(
    project: AnalysisFile,
    spec: PushoverAnalysis | TargetAnalysis,
    loads: Mapping[str, float],
    target: float,
    progress: Progress | None = None,
    stop: Stop | None = None,
) -> Push:
    """Push a frame until its control node has a displacement, in equal steps.

    Args:
        spec: what it is pushed with; its first pattern, direction and position of masses.
        loads: lateral, on the nodes by name, N; their sum is 1 N.
        target: displacement of the node, that under gravity included, m.
        progress: called now and then with (steps done, steps).
        stop: asked now and then; True ends the push.

    Returns:
        The response with its capacity curve.

    Raises:
        AnalysisError: no equilibrium under gravity.
        CoreError: the frame is a mechanism.
    """
    frame = make_frame(project, spec.dampers)
    direction = pushed_along(frame, spec)
    lateral, degree = frame.model.pattern(), frame.directions[direction].degree
    moments = load_moments(project, frame, spec, loads, direction)
    for name, load in loads.items():
        along = (load, 0.0) if degree == 0 else (0.0, load)
        frame.model.nodal_load(lateral, frame.nodes[name], *along, moments.get(name, 0.0))
    structure = make_structure(project, frame)
    carried = structure.apply_gravity(channels(column_forces(frame)))
    structure.install_dampers()
    group = Group()
    coordinates(group, frame)
    load_factor = Quantity(
        "lateral_load", (), (), (((1.0, "load_factor", lateral, 0),),), "N", "sum of the lateral loads", True, ("max",)
    )
    drifts, shear = line_drifts(frame), base_shear(frame, history=True)
    watch = run_watch(project, frame)
    recorded = watch.watching(
        [
            load_factor,
            floor_displacements(frame, history=True),
            *floor_rotations(frame, history=True),
            *diaphragm_motions(frame, group, history=True),
            storey_drifts(frame, history=True),
            storey_shears(frame, history=True),
            *storey_torques(frame, history=True),
            shear,
            *member_forces(frame, bending_members(frame), "member", history=False),
            *axial_forces(frame),
            *leaning_column_forces(frame),
            *plastic_rotations(frame),
            *brace_quantities(frame, group),
            *spring_quantities(frame, group),
            *damper_quantities(frame, history=False),
            *support_reactions(frame, group, history="supports" in project.outputs.histories),
            *requested_quantities(project, frame, group),
        ]
    )
    couples = LackingCouples(frame)
    names = rotation_names(frame, drifts, recorded)
    events = EventChannels(frame, spec.steps)
    response = structure.analysis.pushover(
        lateral,
        frame.control,
        frame.model.degrees[degree],
        target,
        spec.steps,
        channels([*recorded, drifts, *couples.quantities, *events.quantities]),
        progress,
        stop,
        rotation_limits(project, names),
        watch,
    )
    response, energy_warnings = judged(response, project, names, "displacement")
    coordinate(group, "step", np.arange(response.time.size), "1", "step, 0 is under gravity alone")
    store(group, recorded, response, "step")
    store_drift_extremes(group, frame, drifts, response)
    watch.store(group, "displacement of the controlled node", "m")
    warnings: list[AnalysisWarning] = buckling_warnings(group, frame)
    warnings += core_strain_warnings(group, frame.devices) + couples.warnings(response)
    warnings += hinge_warnings(group, frame)
    store_warnings(group, [] if energy_warnings is None else [*energy_warnings, *warnings, *fracture_warnings(group)])
    store_run(group, response, "displacement of the controlled node", "m")
    coordinate(group, "loaded_node", list(loads), "", "name of the node with a lateral load")
    label = "share of the node in the lateral load"
    group.add("lateral_load_share", ("loaded_node",), list(loads.values()), "1", label)
    floors = _of_direction(group.variables["floor_displacement"].values, direction, 2)
    roof = floors[:, -1]
    group.add("roof_displacement", ("step",), roof, "m", "horizontal displacement of the roof, mean over its nodes")
    group.add("roof_drift", ("step",), roof / frame.floors[-1].level, "1", "roof displacement / height of the frame")
    moved = spec.sign * (response.time - response.time[0])
    label = "displacement of the control node since gravity, positive in the direction of the push"
    group.add("control_displacement", ("step",), moved, "m", label)
    group.attributes |= {
        "pattern": pattern_name(spec.pattern[0]),
        "direction": spec.directions[0],
        "target_roof_displacement_m": target,
    }
    rotation = group.variables.get("floor_rotation")
    turned = np.zeros_like(floors) if rotation is None else rotation.values
    if isinstance(spec, Eccentric) and frame.directions[direction].name:
        group.attributes["eccentricity"] = spec.eccentricity[0]
        of_loads = [moments.get(name, 0.0) for name in loads]
        label = "moment about the vertical that belongs to a lateral load of 1 N, by accidental eccentricity"
        group.add("lateral_load_moment", ("loaded_node",), of_loads, "N*m", label)
    resisting = _of_direction(shear.values(response), direction, 1)
    return Push(
        frame,
        direction,
        spec.sign,
        target,
        response,
        base_shear=spec.sign * resisting,
        resistance=_way_of_resultant(frame, (loads, floors), (moments, turned)) * resisting,
        displacement=moved,
        floors=floors,
        turned=turned,
        eccentricity=_eccentricity(project, spec),
        moments=moments,
        line_drifts=events.line_drifts(response),
        line_shares=line_shares(frame, carried),
        group=group,
        events=events,
    )


def pushed_along(frame: FrameModel, spec: Pushover) -> int:
    """Return the index of the direction of a frame in which it is pushed."""
    return [direction.name for direction in frame.directions].index(spec.axis)


def load_moments(
    project: AnalysisFile, frame: FrameModel, spec: Pushover, loads: Mapping[str, float], direction: int
) -> dict[str, float]:
    """Return the moments about the vertical of lateral loads, by node, N m; none of a plane frame.

    Args:
        loads: on the nodes by name, N.
        direction: index of that in which they act.
    """
    return eccentric_moments(frame, loads, _eccentricity(project, spec), direction)


def _eccentricity(project: AnalysisFile, spec: Pushover) -> tuple[float, float]:
    """By what shares of the lengths of a floor its loads stand beside the centres of mass; none of a plane frame."""
    return spec.eccentricity_with(project.accidental_torsion) if isinstance(spec, Eccentric) else IN_PLACE


def _of_direction(values: np.ndarray, direction: int, dims: int) -> np.ndarray:
    """Values of one direction, of which those of a building have a last dimension beyond the others."""
    return values if values.ndim == dims else values[..., direction]


def _way_of_resultant(frame: FrameModel, *acting: tuple[Mapping[str, float], np.ndarray]) -> float:
    """1 where the resultant of the loads acts to the right, -1: to the left.

    The sum of the loads is 1 N to the right, times a load factor. Whatever way the roof is pushed, the loads do work on
    the motion of the first step, and this work has the sign of the load factor.
    """
    work = sum(
        float(by_floor(frame, loads) @ (moved[min(1, len(moved) - 1)] - moved[0])) for loads, moved in acting if loads
    )
    return -1.0 if work < 0.0 else 1.0
