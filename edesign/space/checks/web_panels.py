"""Web panels of columns at the joints of moment frames, EN 1998-1:2004, 6.6.3(6) with EN 1993-1-8, 6.2.6.1."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.codes.ec3.cross_section import moment_resistance
from edesign.codes.ec8.steel.moment_frames import (
    web_panel_area_with_doubler,
    web_panel_resistance,
    web_panel_shear,
    web_panel_slenderness,
)
from edesign.codes.rule_check import RuleCheck, at_most
from edesign.project.building.building import Steel
from edesign.space.checks.capacity import bend_about_y, by_section
from edesign.space.structure.frame import Axis, SpaceFrame

V_Z = 2  # place in internal forces


@dataclass(frozen=True)
class Panel:
    """The web panel of a column between the flanges of the beams of one direction.

    Attributes:
        node: its name.
        axis: of the beams.
        V_wp_Ed: shear when the beams have their hinges, N.
        V_wp_Rd: resistance of the web of the column, N; 0 of a web so slender that its shear buckles.
        V_wp_Rd_doubled: with a supplementary web plate, N.
        doubler: thickness of that plate, m; 0 where none is needed.
    """

    node: str
    axis: Axis
    V_wp_Ed: float
    V_wp_Rd: float
    V_wp_Rd_doubled: float
    doubler: float

    def utilisation(self, doubler_plates: bool) -> float:
        """Return V_wp,Ed / V_wp,Rd.

        Args:
            doubler_plates: a plate is allowed where one is needed.
        """
        resistance = self.V_wp_Rd_doubled if doubler_plates and self.doubler > 0.0 else self.V_wp_Rd
        return self.V_wp_Ed / resistance if resistance > 0.0 else np.inf


def web_panels(
    frame: SpaceFrame,
    materials: Mapping[str, Steel],
    seismic: np.ndarray,
    beams: np.ndarray,
    Omega: float,
    axis: Axis,
    gamma_M0: float,
) -> list[Panel]:
    """Return the web panels of the joints of one direction whose columns are I sections bent about their strong axis.

    The panel belongs to the column below the joint. The beams have M_pl,Rd on both sides, or as much of it as M_pl,Rd
    of the columns balances. The columns relieve the panel by the mean of the shears above and below at the time of
    the first hinge: Omega times those of the seismic action. Axial force and bending of the column do not count
    (6.6.3(6)).

    Args:
        materials: its steels, by name.
        seismic: (n_members, n_stations, 6) effects of the seismic action along the axis.
        beams: numbers of the beams with hinges in this direction.
        Omega: overstrength of the beams.
        gamma_M0: partial factor.

    Returns:
        The panels.
    """
    start, end = frame.ends
    n = len(frame.node_names)
    M_pl = by_section(frame, materials, lambda of, steel: moment_resistance(of.W_pl_y, steel.fy, gamma_M0))
    arm = by_section(frame, materials, lambda of, steel: of.h - of.tf)
    rigid = frame.passes_moment[beams]
    M_b, M_over_z, M_c, shear = np.zeros((4, n))
    below = np.full(n, -1)
    columns = frame.columns[bend_about_y(frame, frame.columns, axis)]
    for side, nodes in enumerate((start, end)):
        np.add.at(M_b, nodes[beams], np.where(rigid[:, side], M_pl[beams], 0.0))
        np.add.at(M_over_z, nodes[beams], np.where(rigid[:, side], M_pl[beams] / arm[beams], 0.0))
        np.add.at(M_c, nodes[columns], M_pl[columns])
        np.add.at(shear, nodes[columns], 0.5 * Omega * seismic[columns, 0, V_Z])
    below[end[columns]] = columns
    sections = {
        "A": by_section(frame, materials, lambda of, steel: of.A_vz if of.kind == "I" else 0.0),
        "doubled": by_section(
            frame,
            materials,
            lambda of, steel: (
                web_panel_area_with_doubler(of.A_vz, of.h - 2.0 * (of.tf + of.r), of.tw) if of.kind == "I" else 0.0
            ),
        ),
        "d": by_section(frame, materials, lambda of, steel: of.h - 2.0 * (of.tf + of.r)),
        "t_w": by_section(frame, materials, lambda of, steel: of.tw),
        "f_y": by_section(frame, materials, lambda of, steel: steel.fy),
    }
    nodes = np.flatnonzero((below >= 0) & (M_b > 0.0) & ~np.isnan(M_c))  # without columns that have no class
    nodes = nodes[sections["A"][below[nodes]] > 0.0]
    if not nodes.size:
        return []
    A, doubled, d, t_w, f_y = (values[below[nodes]] for values in sections.values())
    share = np.minimum(M_c[nodes] / M_b[nodes], 1.0)
    V_Ed = web_panel_shear(share * M_over_z[nodes], shear[nodes])
    holds = web_panel_slenderness(d, t_w, f_y) <= 1.0
    V_Rd, V_doubled = (np.where(holds, web_panel_resistance(area, f_y, gamma_M0), 0.0) for area in (A, doubled))
    plate = np.where(V_Ed > V_Rd, t_w, 0.0)
    return [
        Panel(frame.node_names[node], axis, *map(float, values))
        for node, *values in zip(nodes, V_Ed, V_Rd, V_doubled, plate, strict=True)
    ]


def panel_criteria(panels: Sequence[Panel], joints: int, axis: Axis, doubler_plates: bool) -> list[RuleCheck]:
    """Return whether the web panels of one direction resist the hinges of their beams; the worst joint counts.

    Args:
        panels: of this direction.
        joints: how many joints the direction has; those without a panel here are reported.
        doubler_plates: whether a supplementary web plate may stand where the web alone is too weak.
    """
    text = f"V_wp,Ed / V_wp,Rd of web panels, direction {axis}"
    if not panels:
        return [RuleCheck("6.6.3(6)", text, None, None, "", None, "columns bent about their weak axis, or hollow")]
    worst = max(panels, key=lambda panel: panel.utilisation(doubler_plates))
    plates = [panel.doubler for panel in panels if panel.doubler > 0.0]
    detail = worst.node
    if plates:
        detail += f"; {'with' if doubler_plates else 'without'} doubler plates up to {1e3 * max(plates):.3g} mm"
        detail += f" at {len(plates)} of {joints} joints"
    if len(panels) < joints:
        detail += (
            f"; {joints - len(panels)} joints to weak axes, hollow columns or sections without class are not checked"
        )
    return [at_most("6.6.3(6)", text, 1.0, worst.utilisation(doubler_plates), detail)]
