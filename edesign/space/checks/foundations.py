"""Reactions at the supports, and the design actions on foundations, EN 1998-1:2004, 4.4.2.6."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec8.verification.capacity import foundation_factor
from edesign.codes.ec8.verification.capacity import overstrength as strength_over_demand
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import first_of_largest
from edesign.core.space import combine
from edesign.project.building.building import Building
from edesign.space.analysis.bracing import Bracing
from edesign.space.analysis.response import SeismicResponse, StaticResponse
from edesign.space.analysis.storeys import Storeys
from edesign.space.checks.capacity import Overstrength, bend_about_y, column_moments
from edesign.space.checks.column_bases import M_Y, M_Z, N, hinged_bases
from edesign.space.structure.design_block import MOMENT_FRAME, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis, SpaceFrame

COMPONENTS = ("F_x", "F_y", "F_z", "M_x", "M_y", "M_z")
"""Of a support on the frame, global; F_z is positive upwards."""


@dataclass(frozen=True)
class Supports:
    """The supports of a frame and the members that end at them; sections do not change it.

    Attributes:
        nodes: (s,) numbers of the nodes.
        member, at_end, support: (p,) members, whether it is their end, and which of `nodes` it is.
        rotation: (p, 3, 3) rows are the local axes.
        to_reactions: (s 6, b) change of the reactions by a unit of tension in a brace beyond the linear model.
    """

    nodes: np.ndarray
    member: np.ndarray
    at_end: np.ndarray
    support: np.ndarray
    rotation: np.ndarray
    to_reactions: np.ndarray

    def modal(self, end_forces: np.ndarray) -> np.ndarray:
        """Return the reactions of each mode in the linear model, (k, s, 6), N and N m.

        Args:
            end_forces: (k, n_members, 12) of all members, N and N m.
        """
        k = len(end_forces)
        local = np.where(self.at_end[:, None], end_forces[:, self.member, 6:], end_forces[:, self.member, :6])
        turned = np.einsum("kpci,pij->kpcj", local.reshape(k, -1, 2, 3), self.rotation).reshape(k, -1, 6)
        of_supports = self.support == np.arange(self.nodes.size)[:, None]
        return np.asarray(np.einsum("sp,kpj->ksj", of_supports.astype(float), turned, optimize=True))

    def combined(self, bracing: Bracing, reactions: np.ndarray, axial: np.ndarray, rho: np.ndarray) -> np.ndarray:
        """Return the combined reactions without sign, (s, 6), those of the worse sense of braces in tension.

        Args:
            bracing: of the building.
            reactions: (k, s, 6) of each mode in the linear model.
            axial: (k, n_members) axial forces.
            rho: (k, k) correlation of the modes, scaled by their amplitudes.
        """
        values = reactions.reshape(len(reactions), -1).T
        force = axial[:, bracing.braces]
        each = [combine(values + self.to_reactions @ (force * more).T, rho) for more in bracing.beyond_the_model()]
        return np.asarray(np.max(each, axis=0).reshape(-1, 6))


@dataclass(frozen=True)
class Foundations:
    """Reactions and design actions of all supports.

    Attributes:
        nodes: (s,) names.
        cases: (c,) load cases.
        static: (c, s, 6) reactions to the load cases, in the order of `COMPONENTS`, N and N m.
        seismic: (2, s, 6) to the seismic action along x and y, without sign, with second-order effects.
        factor: (2, s) gamma_Rd Omega of either direction.
        of_base: (2, s) whether this Omega is that of the hinge at the column base; otherwise it is that of the
            direction.
        combinations: (r,) names of the combinations.
        least, largest: (r, s, 6) E_F,G -+ gamma_Rd Omega E_F,E.
        persistent: (n,) names of the persistent combinations, without sway imperfections.
        acting: (n, s, 6) reactions in these.
    """

    nodes: tuple[str, ...]
    cases: tuple[str, ...]
    static: np.ndarray
    seismic: np.ndarray
    factor: np.ndarray
    of_base: np.ndarray
    combinations: tuple[str, ...]
    least: np.ndarray
    largest: np.ndarray
    persistent: tuple[str, ...]
    acting: np.ndarray

    @property
    def uplift(self) -> list[str]:
        """Sentences on supports that are pulled upwards, or none."""
        found = []
        for least, when in (
            (self.least[:, :, 2].min(axis=0), "with gamma_Rd Omega (EN 1998-1, 4.4.2.6(4))"),
            (self.acting[:, :, 2].min(axis=0), "in persistent combinations"),
        ):
            if lifted := int((least < 0.0).sum()):
                found.append(
                    f"{lifted} of {least.size} foundations are pulled upwards {when}, most at "
                    f"{self.nodes[first_of_largest(-least)]}, by {-least.min() / 1e3:.0f} kN"
                )
        return found


def supports(frame: SpaceFrame, bracing: Bracing) -> Supports:
    """Return the supports of a frame at its base."""
    supported = frame.fixed.any(axis=1) | (frame.springs > 0.0).any(axis=1)
    nodes = np.flatnonzero(supported & (frame.level_of_nodes == 0))
    place = {int(node): number for number, node in enumerate(nodes)}
    ends = [
        (number, at_end, place[node])
        for number, member in enumerate(frame.members)
        for at_end, node in ((False, member.start), (True, member.end))
        if node in place
    ]
    member, at_end, support = (np.array(values) for values in zip(*ends, strict=True))
    start, end = frame.ends
    x = (frame.coordinates[end] - frame.coordinates[start]) / frame.length[:, None]
    z = frame.webs[member]
    to_reactions = np.zeros((nodes.size, 6, bracing.braces.size))
    for row, number in enumerate(bracing.columns):
        if start[number] in place:
            to_reactions[place[start[number]], 2] -= bracing.to_columns[row]
    for column, number in enumerate(bracing.braces):
        if start[number] in place:
            to_reactions[place[start[number]], :3, column] -= x[number]
    rotation = np.stack([x[member], np.cross(z, x[member]), z], axis=1)
    return Supports(nodes, member, at_end, support, rotation, to_reactions.reshape(6 * nodes.size, bracing.braces.size))


def foundation_factors(
    building: Building,
    frame: SpaceFrame,
    of: Supports,
    acting: np.ndarray,
    overstrength: Mapping[Axis, Overstrength],
    q: Mapping[Axis, float],
) -> tuple[np.ndarray, np.ndarray]:
    """Return gamma_Rd Omega of both directions at each support, and whether Omega is that of the column base; (2, s).

    In ductility class low the factor is 1.

    Along buckling-restrained braces the factor is at least beta omega R_y Omega, and at most q.

    Where a column line of a moment frame has a hinge at its base, or above the basement, Omega is the least
    M_Rd / M_Ed there of both directions; elsewhere that of the dissipative members of the direction.

    Args:
        building: with the design block of the file.
        acting: (n_members, n_stations, 6) largest effects in the seismic design situation.
        q: behaviour factors of both directions.

    Returns:
        gamma_Rd Omega, (2, s); whether Omega is that of the column base, (2, s).

    Source: EN 1998-1:2004, 4.4.2.6(4)-(6); NTC 2018, 7.2.5: 1.1 in class B, 1.3 in class A, whatever Omega is.
    """
    design = design_of(building)
    if of_class := rules_of(design).foundations:
        factor = np.full((2, of.nodes.size), of_class[design.ductility_class])
        return factor, np.zeros((2, of.nodes.size), dtype=bool)
    if design.ductility_class == "low":
        return np.ones((2, of.nodes.size)), np.zeros((2, of.nodes.size), dtype=bool)
    frames = [axis for axis in AXES if system_of(design, axis).type == MOMENT_FRAME]
    of_line = {frame.node_names[node].partition(".")[0]: number for number, node in enumerate(of.nodes)}
    own = np.full(of.nodes.size, np.inf)
    force = acting[:, :, N].max(axis=1)
    for axis in frames:
        bases = hinged_bases(frame, axis)
        M_Rd = column_moments(frame, building.materials, bases, axis, force, design.partial_factors.M0)
        M_Ed = np.where(bend_about_y(frame, bases, axis), acting[bases, 0, M_Y], acting[bases, 0, M_Z])
        Omega = np.where(M_Rd > 0.0, strength_over_demand(np.maximum(M_Rd, 1.0), M_Ed), 1.0)
        below = [of_line[frame.node_names[foot].partition(".")[0]] for foot in frame.ends[0][bases]]
        np.minimum.at(own, below, Omega)
    of_base = np.array([np.isfinite(own) & (axis in frames) for axis in AXES])
    of_direction = np.array([[overstrength[axis].Omega] for axis in AXES])
    Omega = np.where(of_base, own, of_direction)
    found = []
    for axis, values in zip(AXES, Omega, strict=True):
        of_axis = foundation_factor(values, q[axis])
        if (gained := overstrength[axis].hardening) is not None:
            of_axis = np.maximum(of_axis, np.minimum(gained * np.maximum(values, 1.0), q[axis]))
        found.append(of_axis)
    return np.array(found), of_base


def foundations(
    frame: SpaceFrame,
    of: Supports,
    static: StaticResponse,
    response: Mapping[Axis, SeismicResponse],
    storeys: Mapping[Axis, Storeys],
    seismic: Sequence[Combination],
    persistent: Sequence[Combination],
    factor: np.ndarray,
    of_base: np.ndarray,
    whole: bool = False,
) -> Foundations:
    """Return the reactions at all supports and the design actions on foundations.

    Args:
        static: effects of load cases.
        response: effects of the seismic action, by direction.
        storeys: with the factors for second-order effects, of which that of the lowest storey counts.
        persistent: combinations for persistent design situations, without sway imperfections.
        factor: gamma_Rd Omega, by `foundation_factors`.
        of_base: whether it is that of the column base, by `foundation_factors`.
        whole: the factor is on all that the superstructure brings; gravity has it where that is worse.

    Returns:
        Reactions and design actions at the supports.

    Source: EN 1998-1:2004, 4.4.2.6(4), Eq. 4.30; NTC 2018, 7.2.5.
    """
    reactions = static.reactions[:, of.nodes]
    acting = np.stack([response[axis].reactions * storeys[axis].amplification[0] for axis in AXES])
    raised = acting * factor[:, :, None]
    alike = {(tuple(map(abs, row.seismic[:2])), tuple(sorted(row.static.items()))): row for row in reversed(seismic)}
    rows = list(reversed(alike.values()))
    least, largest, names = [], [], []
    for row in rows:
        steady = np.tensordot([row.static.get(case, 0.0) for case in static.names], reactions, 1)
        x, y = (abs(share) * of_axis for share, of_axis in zip(row.seismic[:2], raised, strict=True))
        alternating = np.sqrt(x**2 + y**2) if row.directions == "srss" else x + y
        also = steady * factor.max() if whole else steady
        least.append(np.minimum(steady, also) - alternating)
        largest.append(np.maximum(steady, also) + alternating)
        names.append(row.name)
    nodes = tuple(frame.node_names[node] for node in of.nodes)
    return Foundations(
        nodes=nodes,
        cases=static.names,
        static=reactions,
        seismic=acting,
        factor=factor,
        of_base=of_base,
        combinations=tuple(names),
        least=np.array(least),
        largest=np.array(largest),
        persistent=tuple(row.name for row in persistent),
        acting=np.tensordot([[row.static.get(case, 0.0) for case in static.names] for row in persistent], reactions, 1),
    )
