"""A push: lateral loads of a fixed pattern, under gravity, until the roof has a displacement."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.analyses import PushoverAnalysis, TargetAnalysis
from edesign.project.analysis.pushover import pattern_name
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.buckling import buckling_warnings
from edesign.study.analysis.capacity_events import EventChannels
from edesign.study.analysis.dampers import core_strain_warnings
from edesign.study.analysis.lateral_patterns import by_floor
from edesign.study.analysis.structure import make_frame, make_structure
from edesign.study.results.braces import brace_quantities, fracture_warnings
from edesign.study.results.coordinates import bending_members, coordinates
from edesign.study.results.couples import LackingCouples
from edesign.study.results.dampers import damper_quantities
from edesign.study.results.floors import floor_displacements
from edesign.study.results.members import axial_forces, leaning_column_forces, member_forces, plastic_rotations
from edesign.study.results.recording import Quantity, channels, coordinate, store, store_run
from edesign.study.results.requested import requested_quantities
from edesign.study.results.springs import hinge_warnings, spring_quantities
from edesign.study.results.storeys import line_drifts, store_drift_extremes, storey_drifts, storey_shears
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
        sign: 1 to the right, -1 to the left.
        target: last displacement of the control node that was asked for, that under gravity included, m.
        response: judged.
        base_shear: of each step, N, positive in the direction of the push.
        resistance: base shear of each step against the resultant of the loads, N. It is minus `base_shear` where the
            resultant acts against the motion of the roof, as that of a higher mode may.
        displacement: of the control node since gravity in each step, m, positive in that direction.
        group: its results, without events.
    """

    frame: FrameModel
    sign: float
    target: float
    response: Response
    base_shear: np.ndarray
    resistance: np.ndarray
    displacement: np.ndarray
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
    direction: int = 0,
) -> Push:
    """Push a frame until the first node of the roof from the left has a displacement, in equal steps.

    Args:
        spec: what it is pushed with; its first pattern and direction.
        loads: lateral, on the nodes by name, N; their sum is 1 N.
        target: displacement of the node, that under gravity included, m.
        progress: called now and then with (steps done, steps).
        stop: asked now and then; True ends the push.
        direction: index of that in which the frame is pushed.

    Returns:
        The response with its capacity curve.

    Raises:
        AnalysisError: no equilibrium under gravity.
        CoreError: the frame is a mechanism.
    """
    frame = make_frame(project, spec.dampers)
    lateral, degree = frame.model.pattern(), frame.directions[direction].degree
    for name, load in loads.items():
        along = (load, 0.0) if degree == 0 else (0.0, load)
        frame.model.nodal_load(lateral, frame.nodes[name], *along)
    structure = make_structure(project, frame)
    structure.apply_gravity()
    structure.install_dampers()
    group = Group()
    coordinates(group, frame)
    load_factor = Quantity(
        "lateral_load", (), (), (((1.0, "load_factor", lateral, 0),),), "N", "sum of the lateral loads", True, ("max",)
    )
    drifts, shear = line_drifts(frame), base_shear(frame, history=True)
    recorded = [
        load_factor,
        floor_displacements(frame, history=True),
        storey_drifts(frame, history=True),
        storey_shears(frame, history=True),
        shear,
        *member_forces(frame, bending_members(frame), "member", history=False),
        *axial_forces(frame),
        *leaning_column_forces(frame),
        *plastic_rotations(frame),
        *brace_quantities(frame, group),
        *spring_quantities(frame, group),
        *damper_quantities(frame, history=False),
        *(support_reactions(frame, group) if "supports" in project.outputs.histories else []),
        *requested_quantities(project, frame, group),
    ]
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
    )
    response, energy_warnings = judged(response, project, names, "displacement")
    coordinate(group, "step", np.arange(response.time.size), "1", "step, 0 is under gravity alone")
    store(group, recorded, response, "step")
    store_drift_extremes(group, frame, drifts, response)
    warnings: list[AnalysisWarning] = buckling_warnings(group, frame)
    warnings += core_strain_warnings(group, frame.devices) + couples.warnings(response)
    warnings += hinge_warnings(group, frame)
    store_warnings(group, [] if energy_warnings is None else [*energy_warnings, *warnings, *fracture_warnings(group)])
    store_run(group, response, "displacement of the controlled node", "m")
    coordinate(group, "loaded_node", list(loads), "", "name of the node with a lateral load")
    label = "share of the node in the lateral load"
    group.add("lateral_load_share", ("loaded_node",), list(loads.values()), "1", label)
    roof = group.variables["floor_displacement"].values[:, -1]
    group.add("roof_displacement", ("step",), roof, "m", "horizontal displacement of the roof, mean over its nodes")
    group.add("roof_drift", ("step",), roof / frame.floors[-1].level, "1", "roof displacement / height of the frame")
    sign = 1.0 if spec.directions[0] == "right" else -1.0
    moved = sign * (response.time - response.time[0])
    label = "displacement of the control node since gravity, positive in the direction of the push"
    group.add("control_displacement", ("step",), moved, "m", label)
    group.attributes |= {
        "pattern": pattern_name(spec.pattern[0]),
        "direction": spec.directions[0],
        "target_roof_displacement_m": target,
    }
    resisting = shear.values(response)
    return Push(
        frame,
        sign,
        target,
        response,
        base_shear=sign * resisting,
        resistance=_way_of_resultant(frame, loads, group.variables["floor_displacement"].values) * resisting,
        displacement=moved,
        group=group,
        events=events,
    )


def _way_of_resultant(frame: FrameModel, loads: Mapping[str, float], floors: np.ndarray) -> float:
    """1 where the resultant of the loads acts to the right, -1: to the left.

    The sum of the loads is 1 N to the right, times a load factor. Whatever way the roof is pushed, the loads do work on
    the motion of the first step, and this work has the sign of the load factor.
    """
    moved = floors[min(1, len(floors) - 1)] - floors[0]
    return -1.0 if float(by_floor(frame, loads) @ moved) < 0.0 else 1.0
