"""Modal analysis: periods, shapes, participation and effective masses."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Modes
from edesign.errors import AnalysisError
from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.project import Project
from edesign.study.analysis.damper_stiffness import damped_modes, store_damper_stiffness
from edesign.study.analysis.footings import interaction, store_footings, store_interaction
from edesign.study.analysis.isolation_estimate import store_isolation_estimate
from edesign.study.analysis.structure import Structure, frame_alone, make_structure
from edesign.study.results.recording import coordinate

_NEGLIGIBLE = 1e-6  # horizontal part of a mode that is a vertical one


def run_modal(project: Project, spec: ModalAnalysis) -> Group:
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
    _store_modes(group, structure, modes)
    store_footings(group, structure.frame)
    only_braces = all(device.restrained for device in structure.frame.devices) and not structure.frame.attached
    if structure.frame.footings and only_braces:
        store_interaction(group, interaction(project, structure, modes, spec.state == "gravity"))
    store_isolation_estimate(group, project, structure)
    group.attributes |= {"status": "completed", "reason": "", "state": spec.state, "mass_kg": structure.frame.mass}
    return group


def fundamental_period(project: Project, fixed_base: bool = False) -> float | None:
    """Return the first period of the frame under gravity, s; None if it has no masses.

    The frame has its buckling-restrained braces and isolators, and no other dampers.

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
        return float(structure.modes(1).period[0])
    except AnalysisError as error:
        raise AnalysisError(f"{project.path}: the first period cannot be found: {error}") from error


def mode_count(project: Project) -> int:
    """Return the number of modes of a frame, which is that of its degrees of freedom with mass."""
    return int(np.count_nonzero(frame_alone(project).analysis.masses()))


def _store_modes(group: Group, structure: Structure, modes: Modes) -> None:
    """Add periods, frequencies, effective masses, and shapes of floors and nodes to a group.

    Args:
        structure: the frame and its analysis.
        modes: as the core returns them.
    """
    frame = structure.frame
    nodes = [[node for ((_, node, _),) in floor.movers[0]] for floor in frame.floors]
    floors = np.array([modes.shapes[:, there, 0].mean(axis=1) for there in nodes]).T
    scale = _scale(floors, modes.shapes)
    shapes = modes.shapes / scale[:, None, None]
    coordinate(group, "mode", np.arange(1, modes.omega.size + 1), "1", "number of the mode")
    coordinate(group, "floor", [floor.number for floor in frame.floors], "1", "floor, the highest is the roof")
    coordinate(group, "node", list(frame.nodes), "", "name of the node")
    group.add("period", ("mode",), modes.period, "s", "natural period")
    group.add("frequency", ("mode",), 1.0 / modes.period, "Hz", "natural frequency")
    group.add("circular_frequency", ("mode",), modes.omega, "rad/s", "natural circular frequency")
    ratios = modes.effective_mass_ratio_x
    label = "effective modal mass for horizontal ground motion / mass that moves horizontally"
    group.add("effective_mass_ratio_x", ("mode",), ratios, "1", label)
    group.add("cumulative_mass_ratio_x", ("mode",), np.cumsum(ratios), "1", f"sum up to this mode of: {label}")
    factors = modes.participation_x * scale
    group.add("participation_factor_x", ("mode",), factors, "1", "participation factor for horizontal ground motion")
    label = "horizontal displacement of the floor in the mode, mean over its nodes"
    group.add("floor_shape", ("mode", "floor"), floors / scale[:, None], "1", label)
    if frame.isolated is not None:
        base = modes.shapes[:, frame.nodes[frame.isolated.isolators[0].column_base], 0] / scale
        group.add("base_shape", ("mode",), base, "1", "horizontal displacement of the isolated base in the mode")
    where = list(frame.nodes.values())
    group.add("node_shape_x", ("mode", "node"), shapes[:, where, 0], "1", "horizontal displacement in the mode")
    group.add("node_shape_y", ("mode", "node"), shapes[:, where, 1], "1", "vertical displacement in the mode")


def _scale(floors: np.ndarray, shapes: np.ndarray) -> np.ndarray:
    """What each mode is divided by, (n,); `floors` is (n, floors), `shapes` (n, nodes, 3)."""
    found = []
    for floor, shape in zip(floors, shapes, strict=True):
        translations = shape[:, :2].ravel()
        largest = translations[np.argmax(np.abs(translations))]
        across = floor[np.argmax(np.abs(floor))]
        found.append(across if abs(across) > _NEGLIGIBLE * abs(largest) else largest)
    return np.array(found)
