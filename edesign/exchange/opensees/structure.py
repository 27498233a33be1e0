"""A frame as commands of OpenSees, that builders fill."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from edesign.exchange.opensees.commands import Command, command, heading
from edesign.exchange.opensees.joined import Degree, JoinedDegrees
from edesign.exchange.recorded_model import Call
from edesign.frame.frame_model import FrameModel

GRAVITY = 1
"""Tag of the pattern of the gravity loads, and of its time series."""


class NotTranslated(Exception):
    """OpenSees lacks something; the text says what, of which part.

    Attributes:
        subject: name of the element or damper.
    """

    def __init__(self, subject: str, reason: str) -> None:
        super().__init__(reason)
        self.subject = subject


class NotTranslatedParts(Exception):
    """OpenSees lacks something of several parts.

    Attributes:
        problems: of each.
    """

    def __init__(self, problems: Sequence[NotTranslated]) -> None:
        super().__init__("; ".join(map(str, problems)))
        self.problems = problems


@dataclass
class Tags:
    """Tags that are still free; nodes, elements and materials of the core have its ids plus one."""

    node: int
    element: int
    material: int
    section: int
    friction: int = 1

    def next(self, kind: str) -> int:
        """Return a tag of a kind that nothing has yet."""
        found: int = getattr(self, kind)
        setattr(self, kind, found + 1)
        return found


@dataclass
class Structure:
    """A frame as commands.

    Attributes:
        frame: the model in the core.
        joined: what moves as one; nodes that are added are tied here.
        tags: that are free.
        nodes: tags by id; ids of added nodes are below 0.
        names: of nodes by id.
        places: of nodes by id, 2 or 3 coordinates, m.
        copies: nodes that stand for a released end or an end of a damper, by the id of the node that they move with:
            what a support carries is on all of them.
        below: by the number of an isolator in the core the node of the ground that it stands on.
        pressing: calls of springs that are part of an isolator, by their numbers in the core.
        kept: nodes whose supports and ties are written by `commands`.
        divided: names of members that OpenSees has as several.
        shifted: names of members whose loads along them stand at their ends.
        moving: independent degrees of freedom with mass.
        damping_factors: of stiffness-proportional damping, by tag of the element. Others have none: they only help to
            express the structure in OpenSees.
    """

    frame: FrameModel
    joined: JoinedDegrees
    tags: Tags
    nodes: dict[int, int] = field(default_factory=dict)
    names: dict[int, str] = field(default_factory=dict)
    places: dict[int, tuple[float, ...]] = field(default_factory=dict)
    copies: dict[int, list[int]] = field(default_factory=lambda: defaultdict(list))
    below: dict[int, int] = field(default_factory=dict)
    pressing: dict[int, Call] = field(default_factory=dict)
    kept: list[int] = field(default_factory=list)
    damping_factors: dict[int, float] = field(default_factory=dict)
    divided: list[str] = field(default_factory=list)
    shifted: list[str] = field(default_factory=list)
    moving: set[Degree] = field(default_factory=set)
    node_commands: list[Command] = field(default_factory=list)
    masses: list[Command] = field(default_factory=list)
    materials: list[Command] = field(default_factory=list)
    sections: list[Command] = field(default_factory=list)
    elements: list[Command] = field(default_factory=list)
    springs: list[Command] = field(default_factory=list)
    loads: list[Command] = field(default_factory=list)

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self.frame.model.dimension

    def add_node(self, name: str, place: tuple[float, ...], node: int | None = None) -> int:
        """Add a node and return its id; without an id it gets one that the core does not have."""
        own = node if node is not None else -1 - len(self.nodes)
        self.nodes[own] = own + 1 if node is not None else self.tags.next("node")
        self.names[own], self.places[own] = name, place
        self.node_commands.append(command("node", self.nodes[own], *place, comment=name))
        self.kept.append(own)
        return own

    def tied_copy(self, name: str, node: int, degrees: Iterable[int], place: tuple[float, ...] | None = None) -> int:
        """Add a node that moves with another one in some degrees, at its place if no other is given."""
        copy = self.add_node(name, place or self.places[node])
        for at in degrees:
            self.joined.tie((copy, at), (node, at))
        self.copies[node].append(copy)
        return copy

    def damp(self, element: int, factor: float = 1.0) -> None:
        """Give an element stiffness-proportional damping, that of its stiffness times a factor."""
        if factor > 0.0:
            self.damping_factors[element] = factor

    def add_material(self, *words: str | float, comment: str = "") -> int:
        """Add a uniaxial material and return its tag."""
        tag = self.tags.next("material")
        self.materials.append(command("uniaxialMaterial", words[0], tag, *words[1:], comment=comment))
        return tag

    def commands(self) -> tuple[Command, ...]:
        """Return the model without loads, of a building without rigid floors and masses."""
        in_space, masters = self.dimension == 3, self.joined.masters
        kept = [node for node in self.kept if node not in masters]
        nodes = [one for node, one in zip(self.kept, self.node_commands, strict=True) if node not in masters]
        parts = (
            (f"nodes: tag, x, y{', z' * in_space} [m]", nodes),
            ("supports and ties", self.joined.commands(kept, self.nodes, self.names)),
            ("masses: along x, y [kg], about z [kg m2]", [] if in_space else self.masses),
            ("materials [Pa]; of springs and dampers [N/m, N m/rad, N, N m]", self.materials),
            ("sections: fibres at y [m], z, area [m2]", self.sections),
            ("members", self.elements),
            ("springs without length", self.springs),
        )
        words = ("basic", "-ndm", self.dimension, "-ndf", len(self.joined.degrees))
        return (command("wipe"), command("model", *words), *_titled(parts))

    def floor_commands(self) -> tuple[Command, ...]:
        """Return the rigid floors and the masses of a building."""
        nodes = [one for node, one in zip(self.kept, self.node_commands, strict=True) if node in self.joined.masters]
        held = self.joined.commands(list(self.joined.masters), self.nodes, self.names)
        parts = (
            ("centres of mass: tag, x, y, z [m]", nodes),
            ("what does not move there", held),
            ("rigid floors: the centre, and what moves with it", self.joined.floors(self.nodes, self.names)),
            ("masses: along x, y, z [kg], about x, y, z [kg m2]", self.masses),
        )
        return tuple(_titled(parts))


def _titled(parts: Iterable[tuple[str, Sequence[Command]]]) -> list[Command]:
    return [one for title, commands in parts if commands for one in (heading(title), *commands)]
