"""Gravity analysis: the frame under the combination that acts during earthquakes."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.building.frame import FrameModel
from edesign.project.analyses import GravityAnalysis
from edesign.project.project import Project
from edesign.study import quantities as q
from edesign.study.buckling import buckling_warnings
from edesign.study.recording import Quantity, channels, coordinate, store, store_run
from edesign.study.structure import make_structure
from edesign.study.validity import judged, rotation_limits, rotation_names
from edesign.study.warnings import store_warnings


def run_gravity(project: Project, spec: GravityAnalysis) -> Group:
    """Apply the gravity combination in equal steps.

    Raises:
        CoreError: the frame is a mechanism, or a load cannot be applied.
    """
    structure = make_structure(project, dampers=spec.dampers)
    frame = structure.frame
    group = Group()
    q.coordinates(group, frame)
    coordinate(group, "node", list(frame.nodes), "", "name of the node")
    coordinate(group, "support", list(frame.supports), "", "name of the supported node")
    drifts, rotations = q.line_drifts(frame), q.chord_rotations(frame)
    recorded = [
        q.floor_displacements(frame, history=False),
        q.storey_drifts(frame, history=False),
        q.storey_shears(frame, history=False),
        q.base_shear(frame, history=False),
        *q.member_forces(frame, q.bending_members(frame), "member", history=False),
        *q.axial_forces(frame),
        *q.plastic_rotations(frame),
        *_node_displacements(frame),
        *_reactions(frame),
    ]
    names = rotation_names(frame, drifts, [*recorded, rotations])
    response = structure.analysis.static(
        frame.gravity, 1.0, spec.steps, channels([*recorded, drifts, rotations]), rotation_limits(project, names)
    )
    response, doubts = judged(response, project, names, "load factor")
    store(group, recorded, response, "step")
    q.store_drift_extremes(group, frame, drifts, response)
    store_warnings(group, [*doubts, *buckling_warnings(group, project, frame)])
    store_run(group, response)
    return group


def _node_displacements(frame: FrameModel) -> list[Quantity]:
    parts = (("x", 0, "horizontal displacement of the node"), ("y", 1, "vertical displacement of the node, upwards"))
    return [
        Quantity(
            f"node_displacement_{axis}",
            ("node",),
            (len(frame.nodes),),
            tuple(((1.0, "displacement", node, at),) for node in frame.nodes.values()),
            "m",
            label,
            keep=("final",),
        )
        for axis, at, label in parts
    ]


def _reactions(frame: FrameModel) -> list[Quantity]:
    parts = (
        ("reaction_x", 0, "N", "horizontal reaction"),
        ("reaction_y", 1, "N", "vertical reaction, upwards"),
        ("reaction_moment", 2, "N*m", "moment of the support, anticlockwise"),
    )
    return [
        Quantity(
            name,
            ("support",),
            (len(frame.supports),),
            tuple(
                ((1.0, "reaction", frame.nodes[node], at),) if fixed[at] else ()
                for node, fixed in frame.supports.items()
            ),
            unit,
            label,
            keep=("final",),
        )
        for name, at, unit, label in parts
    ]
