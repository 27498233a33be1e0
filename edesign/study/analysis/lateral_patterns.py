"""Lateral forces of pushovers."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from edesign.codes.ec8.analysis.torsion import accidental_eccentricity
from edesign.core import Modes
from edesign.errors import AnalysisError
from edesign.frame.frame_model import FrameModel
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum
from edesign.project.analysis.pushover import GivenPattern, Pattern, pattern_name
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.leading_mode import clusters, leading_mode
from edesign.study.analysis.structure import Structure, frame_alone

NO_RESULTANT = 1e-6  # of the sum of magnitudes: a mode that does not move horizontally


def lateral_loads(
    project: AnalysisFile, frame: FrameModel, pattern: Pattern, dampers: bool = True, direction: int = 0
) -> dict[str, float]:
    """Return the horizontal loads of a pattern on the nodes with mass, by name; their sum is 1 N.

    Args:
        frame: its model; no analysis is made of it here.
        pattern: "uniform" (proportional to mass), "triangular" (mass times height above the base), "first_mode"
            (mass times displacement in the mode under gravity that leads in the direction), or another mode, the
            storey shears of several modes, or shares of the floors.
        dampers: whether it has its dampers, of which buckling-restrained braces count in modes.
        direction: index of that in which they act.

    Raises:
        AnalysisError: no node has a mass, a floor with a share has none, or the loads have no resultant.

    Source: EN 1998-1, 4.3.3.4.2.2 (uniform and modal patterns), Eq. 4.11 (triangular); FEMA 356, 3.3.3.2.3 (storey
    shears of modes).
    """
    if not frame.masses:
        name = pattern_name(pattern)
        raise AnalysisError(
            f"pattern {name}: lateral loads are proportional to masses, and no node has one [E-MODAL-02]"
        )
    if pattern == "uniform":
        weights = dict(frame.masses)
    elif pattern == "triangular":
        weights = {name: mass * frame.places[name][-1] for name, mass in frame.masses.items()}
    elif isinstance(pattern, GivenPattern) and pattern.mode is None:
        floors = (
            pattern.floors
            if pattern.floors is not None
            else _of_modes(project, frame, pattern.modes or 1, dampers, direction)
        )
        weights = _spread(frame, floors, pattern.name)
    else:
        structure, along = _under_gravity(project, dampers), frame.directions[direction]
        if isinstance(pattern, GivenPattern) and pattern.mode is not None:
            shape = structure.modes(pattern.mode).shapes[pattern.mode - 1, :, along.degree]
        else:
            shape = leading_mode(structure, along).shape[:, along.degree]
        weights = {name: mass * shape[frame.nodes[name]] for name, mass in frame.masses.items()}
    total = sum(weights.values())
    if abs(total) <= NO_RESULTANT * sum(abs(weight) for weight in weights.values()):
        what = f"pattern {pattern_name(pattern)}"
        raise AnalysisError(f"{what}: the lateral loads have no resultant, the mode is not lateral [E-PUSH-02]")
    return {name: float(weight / total) for name, weight in weights.items()}


def floor_masses(frame: FrameModel) -> np.ndarray:
    """Return the mass of each floor, from the lowest, (f,) kg."""
    return by_floor(frame, frame.masses)


def by_floor(frame: FrameModel, values: Mapping[str, float]) -> np.ndarray:
    """Return the sums of values of nodes over each floor, without the base.

    Args:
        values: of nodes, by name.

    Returns:
        The sums, (f,), from the lowest floor.
    """
    return np.array([sum(values.get(name, 0.0) for name in floor.nodes) for floor in frame.floors])


def by_body(frame: FrameModel, values: Mapping[str, float]) -> np.ndarray:
    """Return the sums of values of nodes over each floor, or each of its diaphragms and what is beside them.

    Args:
        values: of nodes, by name.

    Returns:
        The sums, (n,), from the lowest floor but for those of the control node, which are last.
    """
    control, bodies = frame.model.node_names[frame.control], []
    for floor in frame.floors:
        tied = {node for part in floor.parts for node in part.nodes}
        bodies += [*(part.nodes for part in floor.parts), tuple(node for node in floor.nodes if node not in tied)]
    bodies.sort(key=lambda nodes: control in nodes)
    return np.array([sum(values.get(name, 0.0) for name in nodes) for nodes in bodies])


def eccentric_moments(
    frame: FrameModel, loads: Mapping[str, float], eccentricity: tuple[float, float], direction: int
) -> dict[str, float]:
    """Return the moments about the vertical of loads that act where accidental eccentricity puts the masses, N m.

    Diaphragms turn about the vertical, and they alone have one. The dimension of a floor is that of its nodes, and of
    one of several diaphragms that of its own.

    Args:
        loads: on the nodes by name, N; those of rigid floors at their centres of mass.
        eccentricity: by what shares of the dimensions of a floor the masses are displaced along x and y.
        direction: index of that in which the loads act.

    Source: EN 1998-1:2004, 4.3.2(1)P, Eq. 4.3, and 4.3.3.4.2.2(2)P.
    """
    across = 1 - direction
    share = eccentricity[across]
    if share == 0.0:
        return {}
    found = {}
    for rigid in (rigid for floor in frame.floors for rigid in floor.rigid):
        for _, node, _ in rigid.turn:
            name = frame.model.node_names[node]
            if name in loads:
                length = float(np.ptp([frame.places[one][across] for one in rigid.nodes]))
                arm = math.copysign(float(accidental_eccentricity(length, abs(share))), share)
                found[name] = (-arm if direction == 0 else arm) * loads[name]
    return found


def _under_gravity(project: AnalysisFile, dampers: bool) -> Structure:
    """A second model under gravity, which has no lateral loads yet, for its modes."""
    structure = frame_alone(project, dampers)
    structure.apply_gravity()
    return structure


def _of_modes(project: AnalysisFile, frame: FrameModel, count: int, dampers: bool, direction: int) -> np.ndarray:
    """Forces of the floors whose storey shears are those of modes, combined by the root of the sum of squares."""
    modes: Modes = _under_gravity(project, dampers).modes(count)
    degree = frame.directions[direction].degree
    S_e = elastic_spectrum(checked_hazard(project)).acceleration(modes.period)
    inertia = [
        by_floor(frame, {name: mass * shape[frame.nodes[name]] for name, mass in frame.masses.items()})
        for shape in modes.shapes[:, :, degree]
    ]
    forces = (modes.participation[:, degree] * S_e)[:, None] * np.array(inertia)
    if frame.directions[direction].name:  # modes of one frequency act as one, whatever way they are turned
        forces = np.array([forces[cluster].sum(axis=0) for cluster in clusters(modes.omega)])
    shears = np.sqrt(np.sum(np.cumsum(forces[:, ::-1], axis=1)[:, ::-1] ** 2, axis=0))
    return shears - np.append(shears[1:], 0.0)


def _spread(frame: FrameModel, floors: tuple[float, ...] | np.ndarray, name: str) -> dict[str, float]:
    """Forces of floors over their nodes, in proportion to the masses."""
    masses = floor_masses(frame)
    found: dict[str, float] = {}
    for floor, force, mass in zip(frame.floors, floors, masses, strict=True):
        if force and not mass:
            raise AnalysisError(
                f"pattern {name}: floor {floor.number} has a share of the lateral loads, and no mass [E-PUSH-02]"
            )
        there = [node for node in floor.nodes if node in frame.masses]
        found |= {node: float(force * frame.masses[node] / mass) for node in there}
    return found
