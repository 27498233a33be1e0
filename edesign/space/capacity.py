"""Capacity design: overstrength of the dissipative members, and columns stronger than beams.

EN 1998-1:2004, 6.6.3(1)P, 6.7.4(1) and 4.4.2.3(4).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.building.steel_section import SteelSection, steel_section
from edesign.codes.ec3.cross_section import (
    axial_resistance,
    moment_resistance,
    moment_resistance_with_axial_force_round,
    moment_resistance_with_axial_force_y,
    moment_resistance_with_axial_force_z,
    web_share,
)
from edesign.codes.ec8.strong_column import LEAST_RATIO, is_exempt, strength_ratio
from edesign.codes.en1990.combinations import Combination
from edesign.project.building.building import Steel
from edesign.space.effects import Effects, largest
from edesign.space.frame import Member, SpaceFrame
from edesign.space.response import AXES, Axis

N, M_Y = 0, 4  # places in internal forces
_DIAGONAL = 0.7  # cosine: a web is along x or along y


@dataclass(frozen=True)
class Overstrength:
    """Omega of the dissipative members of one direction.

    Attributes:
        axis: direction.
        members: numbers of the dissipative members.
        ratios: resistance over effect of each.
        Omega: the least of them.
        governing: name of the member that has it; "" if there is none.
    """

    axis: Axis
    members: np.ndarray
    ratios: np.ndarray
    Omega: float
    governing: str


@dataclass(frozen=True)
class Joint:
    """Columns and beams that meet at a node, in one vertical plane.

    Attributes:
        node: its name.
        axis: of the beams.
        M_Rc, M_Rb: sums of the resistances of columns and of beams, N m.
        ratio: of both.
        exempt: the rule is not asked here.
    """

    node: str
    axis: Axis
    M_Rc: float
    M_Rb: float
    ratio: float
    exempt: bool

    @property
    def passed(self) -> bool:
        """Whether the columns are strong enough, or the joint is exempt."""
        return self.exempt or self.ratio >= LEAST_RATIO


def dissipative_members(frame: SpaceFrame, axis: Axis, system: str) -> np.ndarray:
    """Return the numbers of the members in which a system dissipates energy: beams with hinges, or diagonals.

    Args:
        frame: of the building.
        axis: direction of the action.
        system: `moment_frame`, `concentric_diagonal` or `concentric_v`.
    """
    kind = "beam" if system == "moment_frame" else "brace"
    return np.array(
        [
            number
            for number, member in enumerate(frame.members)
            if member.kind == kind
            and any(name.startswith(axis.upper()) for name in member.frame)
            and (kind == "brace" or max(member.ends[0], member.ends[2]) > 0.0)
        ],
        dtype=int,
    )


def overstrength(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    effects: Effects,
    combinations: Sequence[Combination],
    axis: Axis,
    system: str,
    gamma_M0: float,
) -> Overstrength:
    """Return Omega of one direction: the least of M_pl,Rd / M_Ed of beams, or of N_pl,Rd / N_Ed of diagonals.

    Args:
        frame, materials: of the building.
        effects: of the actions.
        combinations: of the seismic design situation.
        axis, system: direction and its structural type.
        gamma_M0: partial factor.

    Source: EN 1998-1:2004, 6.6.3(1)P for moment frames, 6.7.4(1) for concentric bracings.
    """
    members = dissipative_members(frame, axis, system)
    if not members.size:
        return Overstrength(axis, members, np.zeros(0), 1.0, "")
    acting = largest(effects, combinations)[members]
    found = []
    for member, of in zip((frame.members[number] for number in members), acting, strict=True):
        section, steel = steel_section(member.section), materials[member.material]
        if system == "moment_frame":
            hinges = [of[end, M_Y] for end, stiffness in ((0, member.ends[0]), (-1, member.ends[2])) if stiffness > 0.0]
            found.append(moment_resistance(section.W_pl_y, steel.fy, gamma_M0) / max(*hinges, 1e-300))
        else:
            found.append(axial_resistance(section.A, steel.fy, gamma_M0) / max(of[:, N].max(), 1e-300))
    ratios = np.array(found)
    least = int(ratios.argmin())
    return Overstrength(axis, members, ratios, float(ratios[least]), frame.members[members[least]].name)


def joints(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    effects: Effects,
    combinations: Sequence[Combination],
    axis: Axis,
    gamma_M0: float,
) -> list[Joint]:
    """Return the joints of moment frames along one direction with sum M_Rc and sum M_Rb.

    The resistance of a column is the least within the axial forces of the seismic design situation (4.4.2.3(4)).

    Args: as `overstrength`.
    """
    force = largest(effects, combinations)[:, :, N].max(axis=1)
    of_columns: dict[int, list[float]] = {}
    of_beams: dict[int, list[float]] = {}
    for number, member in enumerate(frame.members):
        section, steel = steel_section(member.section), materials[member.material]
        if member.kind == "column":
            M_Rc = _column_moment(member, section, steel, axis, float(force[number]), gamma_M0)
            of_columns.setdefault(member.start, []).append(M_Rc)
            of_columns.setdefault(member.end, []).append(M_Rc)
        elif member.kind == "beam" and any(name.startswith(axis.upper()) for name in member.frame):
            for node, stiffness in ((member.start, member.ends[0]), (member.end, member.ends[2])):
                if stiffness > 0.0:
                    of_beams.setdefault(node, []).append(moment_resistance(section.W_pl_y, steel.fy, gamma_M0))
    found = []
    for node in sorted(set(of_columns) & set(of_beams)):
        floor = int(np.searchsorted(frame.levels, frame.coordinates[node, 2] - 1e-9 * frame.levels[-1]))
        ratio = float(strength_ratio(np.array(of_columns[node]), np.array(of_beams[node])))
        exempt = is_exempt(floor, frame.n_floors)
        found.append(Joint(frame.node_names[node], axis, sum(of_columns[node]), sum(of_beams[node]), ratio, exempt))
    return found


def bends_about_y(member: Member, axis: Axis) -> bool:
    """Whether a column bends about its strong axis under horizontal forces along an axis."""
    return abs(member.web[AXES.index(axis)]) > _DIAGONAL


def _column_moment(
    member: Member, section: SteelSection, steel: Steel, axis: Axis, force: float, gamma_M0: float
) -> float:
    """Return M_N,Rd about the axis that horizontal forces bend the column about, N m."""
    n = min(force / axial_resistance(section.A, steel.fy, gamma_M0), 1.0)
    strong = bends_about_y(member, axis)
    M_Rd = moment_resistance(section.W_pl_y if strong else section.W_pl_z, steel.fy, gamma_M0)
    if section.kind == "CHS":
        return moment_resistance_with_axial_force_round(M_Rd, n)
    if section.kind == "I" and not strong:
        return moment_resistance_with_axial_force_z(M_Rd, n, web_share(section.A, 2.0 * section.b * section.tf))
    flanges = 2.0 * (section.b if strong else section.h) * section.tf
    return moment_resistance_with_axial_force_y(M_Rd, n, web_share(section.A, flanges))
