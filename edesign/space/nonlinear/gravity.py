"""The gravity loads of a building during earthquakes."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from edesign.project.building.building import Building
from edesign.space.structure.frame import LoadCase, SpaceFrame
from edesign.space.structure.load_cases import on_nodes
from edesign.space.structure.masses import gravity_factor

Point = tuple[float, np.ndarray]
"""Position, 0 to 1 of the length of a member, and force in its axes, (3,) N."""


@dataclass(frozen=True)
class GravityLoads:
    """The gravity combination on nodes and members.

    Attributes:
        frame: that carries them.
        case: their sum.
        axes: local x, y, z of each member, (n_members, 3, 3).
    """

    frame: SpaceFrame
    case: LoadCase
    axes: np.ndarray

    @cached_property
    def on_nodes(self) -> np.ndarray:
        """Forces and moments on the nodes, those on bars included, which carry none across, (n_nodes, 6) N and N m."""
        found = self.case.nodal.copy()
        found[:, :3] = on_nodes(self.frame, self.case, ~self._bars)
        return found

    @cached_property
    def uniform(self) -> np.ndarray:
        """Loads along the members in their axes, none on bars, (n_members, 3) N/m."""
        local = np.einsum("mij,mj->mi", self.axes, self.case.uniform)
        return np.where(self._bars[:, None], 0.0, local)

    @cached_property
    def points(self) -> dict[int, list[Point]]:
        """Forces at places of members in their axes, in the order of the places; none on bars."""
        found: dict[int, list[Point]] = defaultdict(list)
        case = self.case
        for member, position, force in zip(case.point_member, case.point_position, case.point_force, strict=True):
            if force.any() and not self._bars[member]:
                found[int(member)].append((float(position), self.axes[member] @ force))
        return {member: sorted(points, key=lambda point: point[0]) for member, points in found.items()}

    @cached_property
    def of_levels(self) -> np.ndarray:
        """Loads of each level as if all members were simply supported, from the base, (n_floors + 1,) N downwards."""
        down = -on_nodes(self.frame, self.case)[:, 2]
        return np.bincount(self.frame.level_of_nodes, down, minlength=self.frame.n_floors + 1)

    @cached_property
    def _bars(self) -> np.ndarray:
        return np.array([member.axial_only for member in self.frame.members])


def gravity_loads(building: Building, frame: SpaceFrame) -> GravityLoads:
    """Return the loads that act on a building during earthquakes.

    Args:
        building: from `load_building`.
        frame: its nodes, members and load cases.

    Source: EN 1990:2002, 6.4.3.4, Eq. 6.12b.
    """
    factors = [gravity_factor(building, case.category) for case in frame.cases.values()]
    cases = list(zip(factors, frame.cases.values(), strict=True))
    case = LoadCase(
        name="gravity",
        category="",
        nodal=sum((f * c.nodal for f, c in cases), np.zeros((len(frame.node_names), 6))),
        uniform=sum((f * c.uniform for f, c in cases), np.zeros((len(frame.members), 3))),
        point_member=np.concatenate([c.point_member for _, c in cases]),
        point_position=np.concatenate([c.point_position for _, c in cases]),
        point_force=np.concatenate([f * c.point_force for f, c in cases]),
    )
    return GravityLoads(frame, case, member_axes(frame))


def member_axes(frame: SpaceFrame) -> np.ndarray:
    """Return local x, y and z of the members, (n_members, 3, 3)."""
    start, end = frame.ends
    x = (frame.coordinates[end] - frame.coordinates[start]) / frame.length[:, None]
    return np.stack([x, np.cross(frame.webs, x), frame.webs], axis=1)
