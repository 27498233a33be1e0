"""Panel zones of a building: joints that shear where the columns bend about their strong axis, as in plane frames.

About the weak axis of its column a joint has no panel of a web: there it is rigid, as high as the panel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import dist
from typing import TYPE_CHECKING

from edesign.frame.hinges import Axis, tie_but, turn_terms, turned_degree
from edesign.frame.panel_zones import ARM_STIFFNESS, BuiltPanel, Panel, panel_at
from edesign.frame.sections.i_shape import plates_of
from edesign.project.building.building import Building
from edesign.project.building.names import Direction, node_name
from edesign.space.nonlinear.rigid_ends import beams_at

if TYPE_CHECKING:
    from edesign.core import Model

TURNS: dict[Direction, Axis] = {"x": (0.0, -1.0, 0.0), "y": (1.0, 0.0, 0.0)}
"""About which frames of a direction turn anticlockwise, seen with their axis to the right."""
IN_PLAN = ("ux", "uy", "rz")


def panels_of(building: Building) -> dict[str, tuple[Direction, Panel]]:
    """Return the panel zones by the node of their joint, each with the direction of the frames in which it shears.

    A later entry overrides an earlier one. A joint without a beam in that direction has nothing to distort.

    Args:
        building: from `load_building`.

    Raises:
        InputError: a joint has no I sections, or its column's steel does not yield.
    """
    layout = building.layout
    found: dict[str, tuple[Direction, Panel]] = {}
    for i, zones in enumerate(building.panel_zones):
        for floor in zones.floors.numbers(1, building.n_storeys):
            for line in building.lines_of(zones.at):
                runs = [layout.column_at[line, s] for s in (floor, floor + 1) if (line, s) in layout.column_at]
                beams = beams_at(building, line, floor, [runs[0].strong]) if runs else []
                if not beams:
                    continue
                node, column = node_name(line, floor), plates_of(runs[0].section, building.sections)
                shapes = [plates_of(layout.beam_at[place].section, building.sections) for place in beams]
                found[node] = runs[0].strong, panel_at(building, i, node, shapes, column, runs[0].material)
    return found


class SpacePanels:
    """Adds panel zones to a model in space, and the nodes at their edges.

    Args:
        model: with the rigid floors.
        nodes: ids of the joints by name.
        places: of all nodes by their ids, m; nodes that are added are noted.
        panels: by the node of their joint.

    Attributes:
        built: panels by the node of their joint.
    """

    def __init__(
        self,
        model: Model,
        nodes: dict[str, int],
        places: dict[int, tuple[float, ...]],
        panels: dict[str, tuple[Direction, Panel]],
    ) -> None:
        self._model, self._nodes, self._places, self._panels = model, nodes, places, panels
        self._of_columns: dict[str, int] = {}
        self.built: dict[str, BuiltPanel] = {}
        for name, (along, panel) in panels.items():
            node, axis = nodes[name], TURNS[along]
            turning = self._node(f"{name}.panel", places[node])
            tie_but(model, turning, node, turned_degree(axis))
            self._of_columns[name] = turning
            spring = model.spring(f"{name}.panel", turning, node, turn_terms(axis), panel.law())
            self.built[name] = BuiltPanel(panel, spring)

    def arm(self, joint: str, along: Direction | None) -> float:
        """Return how far from a joint's node a member ends, m.

        Args:
            along: direction of a beam; None: of a column.
        """
        of, panel = self._panels.get(joint, (None, None))
        if panel is None or along not in (None, of):
            return 0.0
        return 0.5 * (panel.height if along is None else panel.width)

    def ends(
        self,
        member: str,
        joints: tuple[str, str],
        along: Direction | None,
        stiffness: Sequence[float],
        geometry: str,
        web: Axis,
    ) -> tuple[int, int]:
        """Return the nodes at which a member ends: the joints', or some at the edges of their panels.

        Args:
            joints: names of the nodes at its start and end.
            along: direction of a beam; None: of a column.
            stiffness: E I about local z and y, G J, N m2, for the stiffness of the arms.
            web: direction of its local z.

        Returns:
            Numbers of the nodes at its start and its end.
        """
        first, last = (self._places[self._nodes[joint]] for joint in joints)
        length = dist(first, last)
        found = []
        for joint, sign in zip(joints, (1.0, -1.0), strict=True):
            arm = self.arm(joint, along)
            way = tuple(sign * (b - a) / length for a, b in zip(first, last, strict=True))
            edge = _Edge(member, joint, along, arm, way, length, stiffness, geometry, web)
            found.append(self._edge(edge) if arm else self._nodes[joint])
        return found[0], found[1]

    def _edge(self, edge: _Edge) -> int:
        """Add the node at which a member ends at the edge of a panel."""
        model, node, turning = self._model, self._nodes[edge.joint], self._of_columns[edge.joint]
        frames, _ = self._panels[edge.joint]
        apart = turned_degree(TURNS[frames])
        upright, name = edge.along is None, f"{edge.member}.{edge.joint}"
        arm = tuple(edge.arm * part for part in edge.way)
        end = self._node(name, tuple(a + b for a, b in zip(self._places[node], arm, strict=True)))
        floor = model.masters.get(node)
        tied = {degree: at >= 3 and at != apart for at, degree in enumerate(model.degrees)}
        straight = max(range(3), key=lambda at: abs(edge.way[at]))  # the degree along the member
        tied[model.degrees[straight]] = edge.geometry == "linear"
        across = [at for at in range(3) if at != straight]
        if floor is not None and not upright and edge.geometry == "linear":
            model.diaphragm(floor, [end])
            across = [2]
        if floor is not None:
            tied |= dict.fromkeys(IN_PLAN, False)
        model.tie(end, node, **tied)
        # it turns with its own edges and is carried across by the others
        model.tie(end, turning if upright else node, **{model.degrees[apart]: True})
        about_z, about_y, twist = edge.stiffness
        upwards = edge.web[2] != 0.0  # of a beam the strong axis carries what is upright
        for at in across:
            in_panel = at == 2 or (upright and at == "xy".index(frames))
            strong = at == 2 if upwards else edge.web[at] != 0.0
            stiff = ARM_STIFFNESS * 12.0 * (about_y if strong else about_z) / edge.length**3
            carrier = turning if in_panel and not upright else node
            self._arm_spring(f"{name}.arm_{'xyz'[at]}", carrier, end, arm, at, stiff)
        if floor is not None and not (not upright and edge.geometry == "linear"):
            self._follow_turn(f"{name}.turn", node, end, ARM_STIFFNESS * twist / edge.length)
        if edge.geometry != "linear":  # a strut, in which the axial force acts over the drift as it does in the member
            stiff = ARM_STIFFNESS * 12.0 * about_y / edge.length**3
            strut = model.elastic_section(stiff * edge.arm, about_z, about_y, twist)
            pair = (node, end) if sum(edge.way) > 0.0 else (end, node)
            pinned = (True,) * 4
            model.beam_column(f"{name}.strut", *pair, strut, 2, edge.geometry, pinned, web=edge.web)
        return end

    def _arm_spring(self, name: str, carrier: int, end: int, arm: Sequence[float], at: int, stiffness: float) -> None:
        """Carry a node along an axis as a rigid arm does: u_end = u + t x arm."""
        from edesign.core import MultilinearSpring

        way = [float(at == i) for i in range(3)]
        turned = [arm[(i + 1) % 3] * way[(i + 2) % 3] - arm[(i + 2) % 3] * way[(i + 1) % 3] for i in range(3)]
        terms = [*(-part for part in way), *(-part for part in turned), *way, 0.0, 0.0, 0.0]
        self._model.spring(name, carrier, end, terms, MultilinearSpring(stiffness))

    def _follow_turn(self, name: str, node: int, end: int, stiffness: float) -> None:
        """Let a node turn about the vertical with one of a rigid floor, which has no turn of its own."""
        from edesign.core import MultilinearSpring

        self._model.spring(name, node, end, turn_terms((0.0, 0.0, 1.0)), MultilinearSpring(stiffness))

    def _node(self, name: str, place: Sequence[float]) -> int:
        x, y, z = place
        node = self._model.node(name, x, y, z)
        self._places[node] = (x, y, z)
        return node


@dataclass(frozen=True)
class _Edge:
    """The end of a member at a panel: `way` is the unit vector from the joint into the member."""

    member: str
    joint: str
    along: Direction | None
    arm: float
    way: tuple[float, ...]
    length: float
    stiffness: Sequence[float]
    geometry: str
    web: Axis
