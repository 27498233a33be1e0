"""Gravity analysis: the frame under the combination that acts during earthquakes."""

from __future__ import annotations

from dataclasses import replace

from edesign.archive.dataset import Group
from edesign.core import Response
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.analyses import GravityAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.buckling import buckling_warnings
from edesign.study.analysis.structure import make_structure, no_equilibrium
from edesign.study.results.braces import brace_quantities, fracture_warnings
from edesign.study.results.coordinates import bending_members, coordinates
from edesign.study.results.dampers import damper_quantities
from edesign.study.results.floors import base_displacement, diaphragm_motions, floor_displacements, floor_rotations
from edesign.study.results.member_use import gravity_watch
from edesign.study.results.members import axial_forces, leaning_column_forces, member_forces, plastic_rotations
from edesign.study.results.recording import Quantity, channels, coordinate, store, store_run
from edesign.study.results.springs import spring_quantities
from edesign.study.results.storeys import (
    line_drifts,
    store_drift_extremes,
    storey_drifts,
    storey_shears,
    storey_torques,
)
from edesign.study.results.supports import base_shear, isolator_axial_forces
from edesign.study.results.validity import judged, rotation_limits, rotation_names
from edesign.study.results.warnings import store_warnings


def run_gravity(project: AnalysisFile, spec: GravityAnalysis) -> Group:
    """Apply the gravity combination to a frame in equal steps.

    Returns:
        The results; `status` says whether equilibrium was found.

    Raises:
        CoreError: the frame is a mechanism, or a load cannot be applied.
    """
    structure = make_structure(project, dampers=spec.dampers)
    frame = structure.frame
    group = Group()
    coordinates(group, frame)
    coordinate(group, "node", list(frame.nodes), "", "name of the node")
    coordinate(group, "support", list(frame.supports), "", "name of the supported node")
    drifts = line_drifts(frame)
    watch = gravity_watch(project, frame)
    recorded = watch.watching(
        [
            floor_displacements(frame, history=False),
            storey_drifts(frame, history=False),
            *floor_rotations(frame, history=False),
            *diaphragm_motions(frame, group, history=False),
            storey_shears(frame, history=False),
            *storey_torques(frame, history=False),
            base_shear(frame, history=False),
            *member_forces(frame, bending_members(frame), "member", history=False),
            *axial_forces(frame),
            *(damper_quantities(frame, history=False) if any(device.carries for device in frame.devices) else ()),
            *base_displacement(frame, history=False),
            *isolator_axial_forces(frame, keep=("final",)),
            *leaning_column_forces(frame),
            *plastic_rotations(frame),
            *brace_quantities(frame, group),
            *spring_quantities(frame, group),
            *(
                _in_space(frame, group)
                if frame.model.dimension == 3
                else [*_node_displacements(frame), *_reactions(frame)]
            ),
        ]
    )
    names = rotation_names(frame, drifts, recorded)
    response = structure.analysis.static(
        frame.gravity, 1.0, spec.steps, channels([*recorded, drifts]), rotation_limits(project, names), watch
    )
    if response.status == "failed":
        response = replace(response, reason=no_equilibrium(response))
    response, energy_warnings = judged(response, project, names, "load factor")
    reason = _sunk(project, frame, response)
    if response.status == "completed" and reason:
        response, energy_warnings = replace(response, status="failed", reason=reason), None
    store(group, recorded, response, "step")
    store_drift_extremes(group, frame, drifts, response)
    watch.store(group, "load factor", "1")
    warnings = buckling_warnings(group, frame)
    store_warnings(group, [] if energy_warnings is None else [*energy_warnings, *warnings, *fracture_warnings(group)])
    store_run(group, response)
    return group


def _sunk(project: AnalysisFile, frame: FrameModel, response: Response) -> str:
    """Say how far the loads sank if that is meaningless, "" if not.

    The work of loads W that grow in proportion, on a frame that stays elastic, is W d/2 with the mean d of their
    displacements, wherever they stand on the members. That is seen over half a bay, as the slope of a beam that sags.
    """
    of, largest = frame.sinking, project.largest_drift
    if of.loads <= 0.0 or largest is None or not response.energy["input"].size:
        return ""
    sunk = 2.0 * (float(response.energy["input"][-1]) + of.work_inside) / of.loads
    share = 100.0 * sunk / of.half_span
    if sunk <= largest * of.half_span:
        return ""
    return (
        f"the loads sank by {sunk:.3g} m on average, {share:.3g} % of half a bay; the geometry of the model holds up "
        f"to {100.0 * largest:.3g} % (`validity.drift`) [E-GRAV-02]"
    )


def _in_space(frame: FrameModel, group: Group) -> list[Quantity]:
    """Displacements of the nodes of a building and reactions of its supports, by degree."""
    degrees = range(len(frame.model.degrees))
    coordinate(group, "degree", list(frame.model.degrees), "", "displacement along an axis or turn about it")
    moved = tuple(((1.0, "displacement", node, at),) for node in frame.nodes.values() for at in degrees)
    held = tuple(
        frame.reaction(node, at) if fixed[at] else () for node, fixed in frame.supports.items() for at in degrees
    )
    return [
        Quantity(name, (dim, "degree"), (count, len(degrees)), cells, "", label, keep=("final",))
        for name, dim, count, cells, label in (
            ("node_displacement", "node", len(frame.nodes), moved, "displacement (m) or turn (rad) of the node"),
            ("reaction", "support", len(frame.supports), held, "force (N) or moment (N m) of the support"),
        )
    ]


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
            tuple(frame.reaction(node, at) if fixed[at] else () for node, fixed in frame.supports.items()),
            unit,
            label,
            keep=("final",),
        )
        for name, at, unit, label in parts
    ]
