"""Modal analysis: periods, shapes, participation and effective masses."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Modes
from edesign.project.analyses import ModalAnalysis
from edesign.project.project import Project
from edesign.study.recording import coordinate
from edesign.study.structure import Structure, make_structure

_NEGLIGIBLE = 1e-6  # horizontal part of a mode that is a vertical one


def run_modal(project: Project, spec: ModalAnalysis) -> Group:
    """Find the first modes of a frame, unloaded or under gravity.

    Shapes are scaled so that the largest horizontal displacement of a floor is 1 (of vertical modes the largest
    displacement), and participation factors belong to these shapes.

    Raises:
        AnalysisError: there are not so many modes, or the structure is unstable.
    """
    structure = make_structure(project)
    if spec.state == "gravity":
        structure.apply_gravity()
    group = Group()
    store_modes(group, structure, structure.modes(spec.modes))
    group.attributes |= {"status": "completed", "reason": "", "state": spec.state, "mass_kg": structure.frame.mass}
    return group


def store_modes(group: Group, structure: Structure, modes: Modes) -> None:
    """Add modes to a group: period, frequency, masses, shapes of floors and nodes."""
    frame = structure.frame
    leading = [frame.nodes[name] for name in frame.leading_nodes]
    scale = _scale(modes.shapes, leading)
    shapes = modes.shapes / scale[:, None, None]
    storeys = np.arange(1, frame.frame.n_storeys + 1)
    coordinate(group, "mode", np.arange(1, modes.omega.size + 1), "1", "number of the mode")
    coordinate(group, "floor", storeys, "1", "floor, the highest is the roof")
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
    label = "horizontal displacement of the floor's leading node in the mode"
    group.add("floor_shape", ("mode", "floor"), shapes[:, leading, 0], "1", label)
    where = list(frame.nodes.values())
    group.add("node_shape_x", ("mode", "node"), shapes[:, where, 0], "1", "horizontal displacement in the mode")
    group.add("node_shape_y", ("mode", "node"), shapes[:, where, 1], "1", "vertical displacement in the mode")


def _scale(shapes: np.ndarray, leading: list[int]) -> np.ndarray:
    """What each mode is divided by, (n,)."""
    found = []
    for shape in shapes:
        floors, translations = shape[leading, 0], shape[:, :2].ravel()
        largest = translations[np.argmax(np.abs(translations))]
        across = floors[np.argmax(np.abs(floors))]
        found.append(across if abs(across) > _NEGLIGIBLE * abs(largest) else largest)
    return np.array(found)
