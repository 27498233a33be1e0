"""Capacity design: overstrength of the dissipative members, and columns stronger than beams.

EN 1998-1:2004, 6.6.3(1)P, 6.7.4(1) and 4.4.2.3(4).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3.cross_section import (
    axial_resistance,
    moment_resistance,
    moment_resistance_with_axial_force_round,
    moment_resistance_with_axial_force_y,
    moment_resistance_with_axial_force_z,
    web_share,
)
from edesign.codes.ec8.verification.capacity import overstrength as strength_over_demand
from edesign.codes.ec8.verification.strong_column import LEAST_RATIO, is_exempt, strength_ratio
from edesign.codes.en1990.combinations import Combination
from edesign.codes.ntc2018.capacity import overstrength_beside_gravity
from edesign.codes.rule_check import first_of_largest
from edesign.frame.sections.steel_section import SteelSection
from edesign.project.building.building import Steel
from edesign.space.analysis.effects import Effects, distinct
from edesign.space.structure.design_block import ECCENTRIC, MOMENT_FRAME
from edesign.space.structure.frame import AXES, Axis, Member, SpaceFrame

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
        hardening: what members yet gain beyond Omega as they yield: the largest beta omega R_y of buckling-restrained
            braces; None: 1.1 gamma_ov.
    """

    axis: Axis
    members: np.ndarray
    ratios: np.ndarray
    Omega: float
    governing: str
    hardening: float | None = None


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
        """True if the columns are strong enough, or the joint is exempt."""
        return self.exempt or self.ratio >= LEAST_RATIO


def by_section(
    frame: SpaceFrame, materials: Mapping[str, Steel], value: Callable[[SteelSection, Steel], float]
) -> np.ndarray:
    """Return a value of section and steel for each member, (n_members,); each pair of them is asked once."""
    pairs, of_members = frame.sections
    return np.array([value(frame.section(name), materials[steel]) for name, steel in pairs])[of_members]


def dissipative_members(frame: SpaceFrame, axis: Axis, system: str) -> np.ndarray:
    """Return the numbers of the members in which a system dissipates energy: beams with hinges, diagonals or links.

    Args:
        axis: direction of the action.
        system: `moment_frame`, `concentric_diagonal`, `concentric_v`, `eccentric` or `buckling_restrained`.

    Returns:
        (n,) numbers.
    """
    kind = "beam" if system in (MOMENT_FRAME, ECCENTRIC) else "brace"
    return np.array(
        [
            number
            for number, member in enumerate(frame.members)
            if member.kind == kind
            and any(name.startswith(axis.upper()) for name in member.frame)
            and (kind == "brace" or member.link or (system == MOMENT_FRAME and max(member.ends[0], member.ends[2]) > 0))
        ],
        dtype=int,
    )


def overstrength(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    acting: np.ndarray,
    members: np.ndarray,
    axis: Axis,
    system: str,
    gamma_M0: float,
    beside: tuple[Effects, Sequence[Combination]] | None = None,
) -> Overstrength:
    """Return Omega of one direction: the least of M_pl,Rd / M_Ed of beams, or of N_pl,Rd / N_Ed of diagonals.

    Args:
        materials: its steels, by name.
        acting: (n_members, n_stations, 6) largest effects in the seismic design situation, by `largest`.
        members: numbers of the dissipative members of this direction.
        system: structural type in this direction.
        gamma_M0: partial factor.
        beside: effects and seismic combinations, where gravity takes its part of the resistance of beams first.

    Returns:
        Omega and the ratio of every dissipative member.

    Source: EN 1998-1:2004, 6.6.3(1)P for moment frames, 6.7.4(1) for concentric bracings; NTC 2018, 7.5.4.2 and 7.5.5.
    """
    if not members.size:
        return Overstrength(axis, members, np.zeros(0), 1.0, "")
    if system == "moment_frame":
        resistance = by_section(frame, materials, lambda of, steel: moment_resistance(of.W_pl_y, steel.fy, gamma_M0))
        if beside is not None:
            ratios = _beside_gravity(frame, resistance[members], members, *beside)
            least = first_of_largest(-ratios)
            return Overstrength(axis, members, ratios, float(ratios[least]), frame.members[members[least]].name)
        effect = np.where(frame.passes_moment[members], acting[members][:, [0, -1], M_Y], 0.0).max(axis=1)
    else:
        resistance = by_section(frame, materials, lambda of, steel: axial_resistance(of.A, steel.fy, gamma_M0))
        effect = acting[members, :, N].max(axis=1)
    ratios = strength_over_demand(resistance[members], effect)
    least = first_of_largest(-ratios)
    return Overstrength(axis, members, ratios, float(ratios[least]), frame.members[members[least]].name)


def _beside_gravity(
    frame: SpaceFrame,
    resistance: np.ndarray,
    members: np.ndarray,
    effects: Effects,
    combinations: Sequence[Combination],
) -> np.ndarray:
    """Return the least (M_pl,Rd - M_Ed,G) / M_Ed,E of both ends of beams over combinations, (n,)."""
    of = Effects(effects.cases, effects.static[:, members], effects.seismic[:, members])
    rigid = frame.passes_moment[members]
    found = np.full(members.size, np.inf)
    for row in distinct(combinations):
        gravity, seismic = (values[:, [0, -1], M_Y] for values in (of.of_static(row), of.of_seismic(row)))
        ratios = overstrength_beside_gravity(resistance[:, None], gravity, np.where(rigid, seismic, 0.0))
        np.minimum(found, ratios.min(axis=1), out=found)
    return found


def joints(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    acting: np.ndarray,
    beams: np.ndarray,
    axis: Axis,
    gamma_M0: float,
) -> list[Joint]:
    """Return the joints of moment frames along one direction with sum M_Rc and sum M_Rb.

    Joints with a column whose section has no class are left out: M_Rc is not known.

    The resistance of a column is the least within the axial forces of the seismic design situation (4.4.2.3(4)).

    Args:
        materials: its steels, by name.
        acting: as for `overstrength`.
        beams: numbers of the beams with hinges in this direction.
        gamma_M0: partial factor.

    Returns:
        The joints in the order of their nodes.

    Source: EN 1998-1:2004, 4.4.2.3(4), Eq. 4.29.
    """
    start, end = frame.ends
    force = acting[:, :, N].max(axis=1)
    M_Rc, M_Rb, columns_at, beams_at = np.zeros((4, len(frame.node_names)))
    of_columns = column_moments(frame, materials, frame.columns, axis, force, gamma_M0)
    M_pl = by_section(frame, materials, lambda of, steel: moment_resistance(of.W_pl_y, steel.fy, gamma_M0))[beams]
    rigid = frame.passes_moment[beams]
    for side, nodes in enumerate((start, end)):
        np.add.at(M_Rc, nodes[frame.columns], of_columns)
        np.add.at(columns_at, nodes[frame.columns], 1.0)
        np.add.at(M_Rb, nodes[beams], np.where(rigid[:, side], M_pl, 0.0))
        np.add.at(beams_at, nodes[beams], rigid[:, side])
    found = []
    ratio = strength_ratio(M_Rc[:, None], M_Rb[:, None])
    for node in np.flatnonzero((columns_at > 0.0) & (beams_at > 0.0) & ~np.isnan(M_Rc)):
        exempt = is_exempt(int(frame.level_of_nodes[node]), frame.n_floors)
        sums = float(M_Rc[node]), float(M_Rb[node])
        found.append(Joint(frame.node_names[node], axis, *sums, float(ratio[node]), exempt))
    return found


def bends_about_y(member: Member, axis: Axis) -> bool:
    """Say whether a column bends about its strong axis under horizontal forces along an axis."""
    return abs(member.web[AXES.index(axis)]) > _DIAGONAL


def bend_about_y(frame: SpaceFrame, columns: np.ndarray, axis: Axis) -> np.ndarray:
    """Return which columns bend about their strong axis under horizontal forces along an axis, (n_columns,).

    Args:
        columns: (n_columns,) numbers.
    """
    return np.asarray(np.abs(frame.webs[columns, AXES.index(axis)]) > _DIAGONAL)


def column_moments(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    columns: np.ndarray,
    axis: Axis,
    force: np.ndarray,
    gamma_M0: float,
) -> np.ndarray:
    """Return M_N,Rd of columns about the axis that horizontal forces bend them about, (n_columns,) N m.

    Args:
        materials: its steels, by name.
        columns: (n_columns,) numbers.
        force: (n_members,) largest axial forces, N, without sign.
        gamma_M0: partial factor.

    Returns:
        M_N,Rd, (n_columns,) N m.

    Source: EN 1993-1-1:2005, 6.2.9.1.
    """
    pairs, of_members = frame.sections
    kinds, found = 2 * of_members[columns] + bend_about_y(frame, columns, axis), np.zeros(columns.size)
    for kind in np.unique(kinds):
        (name, material), about_y = pairs[kind // 2], bool(kind % 2)
        section, steel = frame.section(name), materials[material]
        which = kinds == kind
        if not section.has_class:
            found[which] = np.nan
            continue
        n = np.minimum(force[columns[which]] / axial_resistance(section.A, steel.fy, gamma_M0), 1.0).tolist()
        M_Rd = moment_resistance(section.W_pl_y if about_y else section.W_pl_z, steel.fy, gamma_M0)
        if section.kind == "CHS":
            reduced = [moment_resistance_with_axial_force_round(M_Rd, of) for of in n]
        elif section.kind == "I" and not about_y:
            a = web_share(section.A, 2.0 * section.b * section.tf)
            reduced = [moment_resistance_with_axial_force_z(M_Rd, of, a) for of in n]
        else:
            walls = section.b * section.tf if about_y else section.h * section.tw
            a = web_share(section.A, 2.0 * walls)
            reduced = [moment_resistance_with_axial_force_y(M_Rd, of, a) for of in n]
        found[which] = reduced
    return found
