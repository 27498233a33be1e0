"""Modal analysis: periods, shapes, participation and effective masses."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Modes
from edesign.errors import AnalysisError
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.damper_stiffness import damped_modes, store_damper_stiffness
from edesign.study.analysis.footings import interaction, store_footings, store_interaction
from edesign.study.analysis.isolation_estimate import store_isolation_estimate
from edesign.study.analysis.leading_mode import leading_mode, torsional_ratios
from edesign.study.analysis.structure import Structure, frame_alone, make_structure
from edesign.study.results.coordinates import direction_coordinate
from edesign.study.results.floors import of_base
from edesign.study.results.recording import coordinate, directed

_NEGLIGIBLE = 1e-6  # horizontal part of a mode that is a vertical one


def run_modal(project: AnalysisFile, spec: ModalAnalysis) -> Group:
    """Find the first natural modes of a frame, unloaded or under gravity.

    Shapes are scaled so that the largest horizontal displacement of a floor is 1 (of vertical modes the largest
    displacement), and participation factors belong to these shapes.

    Returns:
        Periods, shapes and effective masses of the modes.

    Raises:
        AnalysisError: there are not so many modes, or the structure is unstable.
    """
    structure = make_structure(project, dampers=spec.dampers)
    if spec.state == "gravity":
        structure.apply_gravity()
    group = Group()
    if structure.frame.devices:
        damped = damped_modes(project, structure, spec)
        modes = damped.modes
        store_damper_stiffness(group, structure, damped)
    else:
        modes = structure.modes(spec.modes)
    store_modes(group, structure, modes)
    store_footings(group, structure.frame)
    only_braces = all(device.restrained for device in structure.frame.devices) and not structure.frame.attached
    if structure.frame.footings and only_braces:
        store_interaction(group, interaction(project, structure, modes, spec.state == "gravity"))
    store_isolation_estimate(group, project, structure)
    group.attributes |= {"status": "completed", "reason": "", "state": spec.state, "mass_kg": structure.frame.mass}
    return group


def fundamental_period(project: AnalysisFile, fixed_base: bool = False) -> tuple[float, ...] | None:
    """Return the first period in each direction under gravity, s; None without masses.

    A plane frame has one; of a building they are those of the modes in which most of the mass moves along x and along
    y. The frame has its buckling-restrained braces and isolators, and no other dampers.

    Args:
        fixed_base: whether an isolated base is fixed horizontally, in place of its isolators.

    Raises:
        AnalysisError: the frame is unstable, or the period cannot be found.
    """
    if project.masses is None:
        return None
    try:
        structure = frame_alone(project, fixed_base=fixed_base)
        structure.apply_gravity()
        return tuple(leading_mode(structure, direction).period for direction in structure.frame.directions)
    except AnalysisError as error:
        where = f"{project.where('loads')}: loads" if "[E-GRAV-" in str(error) else project.path
        raise AnalysisError(f"{where}: the first period cannot be found: {error}") from error


def mode_count(project: AnalysisFile) -> int:
    """Return the number of modes of a frame, which is that of its degrees of freedom with mass."""
    return frame_alone(project).most_modes


def store_modes(group: Group, structure: Structure, modes: Modes) -> None:
    """Add periods, frequencies, effective masses, and shapes of floors and nodes to a group.

    Args:
        structure: the frame and its analysis.
        modes: as the core returns them.
    """
    frame = structure.frame
    movers = [movers for floor in frame.floors for movers in floor.movers]
    floors = np.array([np.mean([modes.moved(one) for one in alike], axis=0) for alike in movers]).T
    scale = _scale(floors, modes.shapes[:, :, : frame.model.dimension])
    shapes = modes.shapes / scale[:, None, None]
    coordinate(group, "mode", np.arange(1, modes.omega.size + 1), "1", "number of the mode")
    coordinate(group, "floor", [floor.number for floor in frame.floors], "1", "floor, the highest is the roof")
    direction_coordinate(group, frame)
    coordinate(group, "node", list(frame.nodes), "", "name of the node")
    group.add("period", ("mode",), modes.period, "s", "natural period")
    group.add("frequency", ("mode",), 1.0 / modes.period, "Hz", "natural frequency")
    group.add("circular_frequency", ("mode",), modes.omega, "rad/s", "natural circular frequency")
    for direction in frame.directions:
        axis, at = direction.name or "x", direction.degree
        motion = f"ground motion along {direction.name}" if direction.name else "horizontal ground motion"
        ratios = modes.effective_mass_ratio[:, at]
        label = f"effective modal mass for {motion} / mass that moves horizontally"
        group.add(f"effective_mass_ratio_{axis}", ("mode",), ratios, "1", label)
        label = f"sum up to this mode of: {label}"
        group.add(f"cumulative_mass_ratio_{axis}", ("mode",), np.cumsum(ratios), "1", label)
        factors = modes.participation[:, at] * scale
        group.add(f"participation_factor_{axis}", ("mode",), factors, "1", f"participation factor for {motion}")
    if frame.turning:
        _store_torsion(group, frame, modes, scale)
    label = "horizontal displacement of the floor in the mode, mean over its nodes"
    dims, shape = directed(frame, "floor")
    group.add("floor_shape", ("mode", *dims), (floors / scale[:, None]).reshape(-1, *shape), "1", label)
    if frame.isolated is not None:
        moved = np.array([modes.moved(one) for one in of_base(frame)]).T / scale[:, None]
        along, shape = directed(frame)
        label = "horizontal displacement of the isolated base in the mode"
        group.add("base_shape", ("mode", *along), moved.reshape(-1, *shape), "1", label)
    where = list(frame.nodes.values())
    if frame.model.dimension == 3:
        coordinate(group, "degree", list(frame.model.degrees), "", "displacement along an axis or turn about it")
        label = "displacement in the mode, of turns in rad a m of the scale"
        group.add("node_shape", ("mode", "node", "degree"), shapes[:, where], "1", label)
        return
    group.add("node_shape_x", ("mode", "node"), shapes[:, where, 0], "1", "horizontal displacement in the mode")
    group.add("node_shape_y", ("mode", "node"), shapes[:, where, 1], "1", "vertical displacement in the mode")


def _store_torsion(group: Group, frame: FrameModel, modes: Modes, scale: np.ndarray) -> None:
    """Add the turns of rigid floors in the modes, and the part of each mode in turns about the vertical."""
    ratios = torsional_ratios(frame, modes)
    label = "effective modal moment of inertia for a turn about the vertical / moment of inertia of all masses"
    group.add("effective_mass_ratio_rz", ("mode",), ratios, "1", label)
    group.add("cumulative_mass_ratio_rz", ("mode",), np.cumsum(ratios), "1", f"sum up to this mode of: {label}")
    turns = np.array([modes.moved(floor.turn) if floor.turn else np.zeros(scale.size) for floor in frame.floors]).T
    label = "turn of the floor about the vertical in the mode, per m of the scale"
    group.add("floor_rotation_shape", ("mode", "floor"), turns / scale[:, None], "rad/m", label)
    parts = [part for floor in frame.floors for part in floor.parts]
    if not parts:
        return
    coordinate(group, "diaphragm", [part.name for part in parts], "", "diaphragm as floor.number on it")
    moved = np.array([[modes.moved(mover) / scale for (mover,) in part.movers] for part in parts])
    label = "horizontal displacement of the diaphragm in the mode, at its centre of mass"
    group.add("diaphragm_shape", ("mode", "diaphragm", "direction"), np.moveaxis(moved, -1, 0), "1", label)
    turns = np.array([modes.moved(part.turn) / scale for part in parts]).T
    label = "turn of the diaphragm about the vertical in the mode, per m of the scale"
    group.add("diaphragm_rotation_shape", ("mode", "diaphragm"), turns, "rad/m", label)


def _scale(floors: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """What each mode is divided by, (n,), by displacements of floors and of nodes, (n, any) each."""
    found = []
    for floor, shape in zip(floors, shapes, strict=True):
        translations = shape.ravel()
        largest = translations[np.argmax(np.abs(translations))]
        across = floor[np.argmax(np.abs(floor))]
        found.append(across if abs(across) > _NEGLIGIBLE * abs(largest) else largest)
    return np.array(found)
