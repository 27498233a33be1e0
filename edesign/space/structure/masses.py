"""The masses at the nodes of a building."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.analysis.torsion import accidental_eccentricity
from edesign.codes.ec8.national import national_parameters
from edesign.errors import InputError
from edesign.ground_motion.hazard import national_of
from edesign.project.building.building import Building
from edesign.project.building.loads import AddedMass, GivenMass
from edesign.project.building.names import node_name
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.load_cases import on_nodes


def psi_2(building: Building, category: str) -> float:
    """Return psi_2 of a category of loads: that of `masses.from_loads`, otherwise that of the country.

    Without an action by EN 1998-1, which names the country, the recommended one counts.

    Source: EN 1990, Table A1.1.
    """
    masses = building.masses
    given = masses.from_loads.psi_2(category) if masses is not None and masses.from_loads is not None else None
    if given is not None:
        return given
    hazard = building.design_hazard
    national = national_parameters() if hazard is None else national_of(hazard)
    return national.psi[category].psi_2


def gravity_factor(building: Building, category: str) -> float:
    """Return the factor of a load case in the combination that acts before and during histories and pushovers.

    It is that of `loads.gravity`; without one there 1 for permanent loads and psi_2 for variable ones.

    Args:
        building: from `load_building`.
        category: of the load case: "permanent", or that of the use.

    Source: EN 1990:2002, 6.4.3.4, Eq. 6.12b.
    """
    gravity = building.loads.gravity
    if category == "permanent":
        return gravity.G
    given = gravity.psi_2(category)
    return psi_2(building, category) if given is None else given


@dataclass(frozen=True)
class FloorMasses:
    """The masses of the floors, each (n_floors + 1,), the base first.

    Attributes:
        mass: kg.
        x, y: centre of mass, m; nan without mass.
        gyration: radius of gyration about it, m; nan without mass.
    """

    mass: np.ndarray
    x: np.ndarray
    y: np.ndarray
    gyration: np.ndarray


def floor_masses(frame: SpaceFrame) -> FloorMasses:
    """Return the mass of each floor, its centre and its radius of gyration."""
    floors, count = frame.level_of_nodes, frame.n_floors + 1

    def sums(values: np.ndarray) -> np.ndarray:
        return np.bincount(floors, values * frame.node_mass, minlength=count)

    x, y = frame.coordinates[:, 0], frame.coordinates[:, 1]
    total = sums(np.ones_like(x))
    mass = np.where(total > 0.0, total, np.nan)
    centre_x, centre_y = sums(x) / mass, sums(y) / mass
    square = sums((x - centre_x[floors]) ** 2 + (y - centre_y[floors]) ** 2) / mass
    return FloorMasses(total, centre_x, centre_y, np.sqrt(square))


def mass_shift(frame: SpaceFrame, eccentricity: tuple[float, float]) -> np.ndarray:
    """Return by how much the masses of each node stand beside it, (n_nodes, 2) m.

    Those of all diaphragms stand to one side, together. Others are held by the nodes that they stand at.

    Args:
        eccentricity: share of the length of each floor along x and y, of its own where a floor has several diaphragms.

    Source: EN 1998-1:2004, 4.3.2(1)P, Eq. 4.3.
    """
    found = np.zeros((len(frame.node_names), 2))
    for number, lengths in enumerate(frame.diaphragm_sizes):
        for axis, share in enumerate(eccentricity):
            if share != 0.0:
                beside = np.copysign(accidental_eccentricity(lengths[axis], abs(share)), share)
                found[frame.node_diaphragm == number, axis] = beside
    return found


def node_masses(building: Building, frame: SpaceFrame) -> np.ndarray:
    """Return the mass at each node, (n_nodes,) kg; none without `masses`, and of loads none at the base.

    Masses from loads are G times the permanent loads and phi psi_2 times the variable ones, over the acceleration of
    gravity; a load on a member counts at its ends as if it were simply supported.

    Args:
        building: from `load_building`.
        frame: its nodes, members and load cases.

    Raises:
        InputError: loads upwards would give a negative mass.

    Source: EN 1998-1:2004, 3.2.4(2)P, Eq. 3.17, and 4.2.4(2)P, Eq. 4.2.
    """
    found = np.zeros(len(frame.node_names))
    masses = building.masses
    if masses is None:
        return found
    nodes = {name: i for i, name in enumerate(frame.node_names)}
    if masses.from_loads is None:
        for given in masses.given or ():
            for name in _names(building, given):
                found[nodes[name]] = given.mass
        return found
    for case in frame.cases.values():
        if case.own:
            continue
        permanent = case.category == "permanent"
        factor = masses.from_loads.G if permanent else masses.phi * psi_2(building, case.category)
        found -= factor * on_nodes(frame, case)[:, 2] / STANDARD_GRAVITY
    found[frame.coordinates[:, 2] == 0.0] = 0.0
    if (found < 0.0).any():
        worst = int(np.argmin(found))
        where = building.where("masses", "from_loads")
        raise InputError(
            f"{where}: masses.from_loads: node {frame.node_names[worst]} would get the mass of a load upwards, "
            f"{found[worst] * STANDARD_GRAVITY:.6g} N [E-MASS-01]"
        )
    for added in masses.added:
        for name in _names(building, added):
            found[nodes[name]] += added.mass
    return found


def _names(building: Building, of: GivenMass | AddedMass) -> Iterator[str]:
    """Yield the names of the nodes that have a mass."""
    for floor in of.floors.numbers(1, building.n_storeys):
        for line in building.lines_of(of.at):
            if line in building.layout.node_lines[floor]:
                yield node_name(line, floor)
