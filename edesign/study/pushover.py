"""Pushover analysis: lateral loads of a fixed pattern, under gravity, up to a roof drift."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from edesign.archive.dataset import Group
from edesign.building.frame import FrameModel
from edesign.errors import AnalysisError
from edesign.project.analyses import PushoverAnalysis
from edesign.project.project import Project
from edesign.study import quantities as q
from edesign.study.buckling import buckling_warnings
from edesign.study.recording import Quantity, channels, coordinate, store, store_run
from edesign.study.requested import requested_quantities
from edesign.study.structure import make_frame, make_structure
from edesign.study.validity import judged, rotation_limits, rotation_names
from edesign.study.warnings import store_warnings


def run_pushover(
    project: Project,
    spec: PushoverAnalysis,
    progress: Callable[[int, int], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> Group:
    """Push a frame to the right; the first node of the roof from the left is taken to the target in equal steps.

    Raises:
        AnalysisError: no equilibrium under gravity, or no usable first mode.
        CoreError: the frame is a mechanism.
    """
    frame = make_frame(project, spec.dampers)
    lateral = frame.model.pattern("lateral")
    loads = lateral_loads(project, frame, spec.pattern)
    for name, load in loads.items():
        frame.model.nodal_load(lateral, frame.nodes[name], load, 0.0, 0.0)
    structure = make_structure(project, frame)
    structure.apply_gravity()
    structure.install_dampers()
    group = Group()
    q.coordinates(group, frame)
    load_factor = Quantity(
        "lateral_load", (), (), (((1.0, "load_factor", lateral, 0),),), "N", "sum of the lateral loads", True, ("max",)
    )
    drifts = q.line_drifts(frame)
    recorded = [
        load_factor,
        q.floor_displacements(frame, history=True),
        q.storey_drifts(frame, history=True),
        q.storey_shears(frame, history=True),
        q.base_shear(frame, history=True),
        *q.member_forces(frame, q.bending_members(frame), "member", history=False),
        *q.axial_forces(frame),
        *q.plastic_rotations(frame),
        *q.dampers(frame, history=False),
        *requested_quantities(project, frame, group),
    ]
    names = rotation_names(frame, drifts, recorded)
    target = spec.roof_drift * frame.frame.height
    response = structure.analysis.pushover(
        lateral,
        frame.nodes[frame.leading_nodes[-1]],
        "ux",
        target,
        spec.steps,
        channels([*recorded, drifts]),
        progress,
        stop,
        rotation_limits(project, names),
    )
    response, doubts = judged(response, project, names, "displacement")
    coordinate(group, "step", np.arange(response.time.size), "1", "step, 0 is under gravity alone")
    store(group, recorded, response, "step")
    q.store_drift_extremes(group, frame, drifts, response)
    warnings = buckling_warnings(group, project, frame)
    store_warnings(group, [] if doubts is None else [*doubts, *warnings])
    store_run(group, response, "displacement of the controlled node", "m")
    coordinate(group, "loaded_node", list(loads), "", "name of the node with a lateral load")
    label = "share of the node in the lateral load"
    group.add("lateral_load_share", ("loaded_node",), list(loads.values()), "1", label)
    roof = group.variables["floor_displacement"].values[:, -1]
    group.add("roof_displacement", ("step",), roof, "m", "horizontal displacement of the roof, mean over its nodes")
    group.add("roof_drift", ("step",), roof / frame.frame.height, "1", "roof displacement / height of the frame")
    group.attributes |= {"pattern": spec.pattern, "target_roof_displacement_m": target}
    return group


def lateral_loads(project: Project, frame: FrameModel, pattern: str) -> dict[str, float]:
    """Return horizontal loads on the nodes that have a mass, by name; their sum is 1 N.

    Args:
        project: the validated project.
        frame: its model; no analysis is made of it here.
        pattern: "uniform" (proportional to mass), "triangular" (mass times height above the base), or "first_mode"
            (mass times horizontal displacement in the first mode under gravity).

    Raises:
        AnalysisError: no node has a mass, or the first mode does not move horizontally.

    Source: EN 1998-1, 4.3.3.4.2.2 (uniform and modal patterns).
    """
    if not frame.masses:
        raise AnalysisError(f"pattern {pattern}: lateral loads are proportional to masses, and no node has one")
    weights = dict(frame.masses)
    if pattern == "triangular":
        weights = {name: weight * frame.frame.nodes[name][1] for name, weight in weights.items()}
    elif pattern == "first_mode":
        structure = make_structure(project)  # a second model, which has no lateral loads yet
        structure.apply_gravity()
        shape = structure.modes(1).shapes[0, :, 0]
        weights = {name: weight * shape[structure.frame.nodes[name]] for name, weight in weights.items()}
    total = sum(weights.values())
    if abs(total) <= 1e-6 * sum(abs(weight) for weight in weights.values()):
        raise AnalysisError(f"pattern {pattern}: the lateral loads have no resultant, the first mode is not lateral")
    return {name: float(weight / total) for name, weight in weights.items()}
