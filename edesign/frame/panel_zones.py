"""Panel zones: joints of beams and columns that shear as parallelograms.

The edges of the panel stay straight and keep their lengths. Beams turn with the vertical edges, the flanges of the
column; columns turn with the horizontal ones. The middle of each edge is carried along by the other pair. So a joint
has one degree more than a rigid one.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, sqrt
from typing import TYPE_CHECKING

from edesign.errors import InputError
from edesign.frame.hinges import TURN
from edesign.frame.sections.i_shape import IShape, i_shape
from edesign.project.analysis_file import AnalysisFile
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.notation import names
from edesign.project.project import Project

if TYPE_CHECKING:
    from edesign.core import Model, MultilinearSpring

POISSON = 0.3
"""Of steel: G = E / 2.6 (EN 1993-1-1, 3.2.6)."""
SHEAR_DEPTH = 0.95
"""Share of the column's depth over which the web has its shear (Krawinkler 1978)."""
FULL_SHEAR = 4.0
"""Distortion at which the flanges have yielded too, over that at yield (Krawinkler 1978)."""
ARM_STIFFNESS = 1e5
"""Stiffness of the arms that carry the ends of members, over that of the member against a shift of its end.

The arms so make members softer by 1e-5. Stiffer ones would cost digits of equilibrium: double precision has 16, the
tolerance takes 7.
"""


@dataclass(frozen=True)
class Panel:
    """A panel zone.

    Attributes:
        height, width: d_b and d_c, m.
        stiffness: moment over distortion before yield, N m/rad.
        yield_moment, full_moment: at yield of the web and at FULL_SHEAR times its distortion, N m.
        hardening: slope beyond over `stiffness`.
    """

    height: float
    width: float
    stiffness: float
    yield_moment: float
    full_moment: float
    hardening: float

    def law(self) -> MultilinearSpring:
        """Return the core's law of moment and distortion."""
        from edesign.core import MultilinearSpring

        at_yield = self.yield_moment / self.stiffness
        flanges = (self.full_moment - self.yield_moment) / ((FULL_SHEAR - 1.0) * at_yield)
        first, second = (at_yield, self.yield_moment), (FULL_SHEAR * at_yield, self.full_moment)
        beyond = self.hardening * self.stiffness
        if beyond < flanges:
            return MultilinearSpring(beyond, (first, second))
        return MultilinearSpring(flanges, (first,))  # thin flanges: it does not get stiffer than they make it


def panel_of(beam: float, column: IShape, doubler: float, E: float, fy: float, hardening: float) -> Panel:
    """Return the panel zone of a joint.

    Args:
        beam: depth d_b of the deeper beam, m.
        column: the column's section.
        doubler: thickness of doubler plates, together, m.
        E: modulus of elasticity of the column's steel, Pa.
        fy: yield strength of the column's steel, Pa.
        hardening: slope beyond the full shear over that before yield.

    Returns:
        Sizes, stiffness and moments of the panel.

    Source: Krawinkler 1978, Engineering Journal AISC 15(3), 82-91; FEMA 355C, 2.4.2: V_y = 0.55 F_y d_c t_p (there 0.95
    d_c / sqrt 3), K_e = 0.95 d_c t_p G, V_p = V_y (1 + 3 K_p / K_e) with K_p = 0.95 b_c t_cf^2 G / d_b.
    """
    thickness = column.web + doubler
    G = E / (2.0 * (1.0 + POISSON))
    area = SHEAR_DEPTH * column.height * thickness
    shear = fy / sqrt(3.0) * area
    flanges = SHEAR_DEPTH * column.width * column.flange**2 / beam
    full = shear * (1.0 + (FULL_SHEAR - 1.0) * flanges / area)
    return Panel(beam, column.height, G * area * beam, shear * beam, full * beam, hardening)


def panels_of(project: Project) -> dict[str, Panel]:
    """Return the panel zones of a project by the node of their joint; a later entry overrides an earlier one.

    Raises:
        InputError: a joint has no I sections, or its column's steel does not yield.
    """
    found = {}
    frame = project.frame
    for i, zones in enumerate(project.panel_zones):
        for line, floor in frame.node_places(zones.lines, zones.floors):
            node = names.node_name(line, floor)
            beams = [run for place, run in frame.beam_at.items() if node in _beam_nodes(project, place)]
            runs = [frame.column_at[line, storey] for storey in (floor, floor + 1) if (line, storey) in frame.column_at]
            if not beams or not runs:
                continue  # nothing to distort
            shapes = [i_shape(project, run) for run in beams]
            found[node] = panel_at(project, i, node, shapes, i_shape(project, runs[0]), runs[0].material)
    return found


def panel_at(
    file: AnalysisFile, i: int, node: str, beams: Sequence[IShape | None], column: IShape | None, material: str
) -> Panel:
    """Return the panel zone of one joint.

    Args:
        i: number of the entry of `panel_zones`.
        beams: sections of its beams in the plane of the panel, None: no I section.
        column: section of its column in that plane.
        material: name of the steel of the column.

    Raises:
        InputError: the joint has no I sections, or its column's steel does not yield.
    """
    where, zones, steel = file.where("panel_zones", i), file.panel_zones[i], file.steels[material]
    depths = [shape.height for shape in beams if shape is not None]
    if column is None or len(depths) < len(beams):
        raise InputError(
            f"{where}: the joint {node} has a member without I section; panel zones need them [E-HINGE-04]"
        )
    if isinstance(steel, ElasticMaterial):
        raise InputError(f"{where}: the column at {node} is of `{material}`, which has no yield stress [E-HINGE-04]")
    return panel_of(max(depths), column, zones.doubler or 0.0, steel.E, steel.fy, zones.hardening)


def _beam_nodes(project: Project, place: tuple[int, int]) -> tuple[str, str]:
    bay, floor = place
    left, right = project.frame.bay_lines(bay)
    return names.node_name(left, floor), names.node_name(right, floor)


@dataclass(frozen=True)
class BuiltPanel:
    """A panel zone in the core: its values and the element that is its spring."""

    panel: Panel
    element: int


class PanelBuilder:
    """Adds panel zones to a model, and the nodes at their edges.

    Args:
        nodes: ids of the joints by name.
        places: of all nodes by their ids, m; nodes that are added are noted.
        panels: by the node of their joint.

    Attributes:
        built: panels by the node of their joint.
    """

    def __init__(
        self, model: Model, nodes: dict[str, int], places: dict[int, tuple[float, ...]], panels: dict[str, Panel]
    ) -> None:
        self._model, self._nodes, self._places, self._panels = model, nodes, places, panels
        self._of_columns: dict[str, int] = {}
        self.built: dict[str, BuiltPanel] = {}
        for name, panel in panels.items():
            node = nodes[name]
            turning = model.node(f"{name}.panel", *places[node])
            places[turning] = places[node]
            model.tie(turning, node, ux=True, uy=True)
            self._of_columns[name] = turning
            spring = model.spring(f"{name}.panel", turning, node, TURN, panel.law())
            self.built[name] = BuiltPanel(panel, spring)

    def arm(self, joint: str, kind: str) -> float:
        """Return how far from a joint's node a column or beam ends, m.

        Args:
            kind: "column" or "beam".
        """
        panel = self._panels.get(joint)
        return 0.0 if panel is None else 0.5 * (panel.height if kind == "column" else panel.width)

    def ends(self, member: str, joints: tuple[str, str], EI: float, geometry: str) -> tuple[int, int]:
        """Return the nodes at which a member ends: the joints', or some at the edges of their panels.

        Args:
            joints: names of the nodes at its start and end.
            EI: bending stiffness, N m2.

        Returns:
            Numbers of the nodes at its start and its end.
        """
        (x0, y0), (x1, y1) = (self._places[self._nodes[joint]] for joint in joints)
        length = hypot(x1 - x0, y1 - y0)
        along = ((x1 - x0) / length, (y1 - y0) / length)
        back = (-along[0], -along[1])
        first = self._edge(joints[0], member, along, EI, length, geometry)
        return first, self._edge(joints[1], member, back, EI, length, geometry)

    def _edge(
        self, joint: str, member: str, towards: tuple[float, float], EI: float, length: float, geometry: str
    ) -> int:
        """Return the node at which a member ends: the joint's, or one at the edge of its panel.

        Args:
            towards: unit vector from the joint into the member.
            EI: bending stiffness of the member, N m2, for the stiffness of the arm.
            length: of the member, m.
        """
        panel = self._panels.get(joint)
        if panel is None:
            return self._nodes[joint]
        model, node, turning = self._model, self._nodes[joint], self._of_columns[joint]
        upright = abs(towards[1]) > abs(towards[0])
        x, y = self._places[node]
        arm = 0.5 * (panel.height if upright else panel.width)
        place = (x + arm * towards[0], y + arm * towards[1])
        end = model.node(f"{member}.{joint}", *place)
        self._places[end] = place
        # it turns with its own edges and is carried across by the others
        model.tie(end, turning if upright else node, rz=True)
        carrier = node if upright else turning
        across = arm * (towards[1] if upright else towards[0])
        terms = (-1.0, 0.0, across, 1.0, 0.0, 0.0) if upright else (0.0, -1.0, -across, 0.0, 1.0, 0.0)
        from edesign.core import MultilinearSpring

        stiffness = ARM_STIFFNESS * 12.0 * EI / length**3
        model.spring(f"{member}.{joint}.arm", carrier, end, terms, MultilinearSpring(stiffness))
        if geometry == "linear":  # along its axis it moves with the joint
            model.tie(end, node, ux=not upright, uy=upright)
        else:  # a strut, in which the axial force acts over the drift as it does in the member
            strut = model.elastic_section(stiffness * arm, EI)
            pair = (node, end) if sum(towards) > 0.0 else (end, node)
            model.beam_column(
                f"{member}.{joint}.strut", *pair, strut, points=2, geometry=geometry, release=(True, True)
            )
        return end
