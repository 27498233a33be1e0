"""Which degrees of freedom move as one, and which are fixed."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence

from edesign.core.model import PLANE_DEGREES
from edesign.exchange.opensees.commands import Command, command
from edesign.exchange.recorded_model import Call

VERTICAL = 3
"""The axis at right angles to rigid floors."""
IN_PLAN = (0, 1, 5)
"""Degrees of a node in space that a rigid floor takes along."""
Degree = tuple[int, int]
"""Id of a node, and the place of the degree among those of a node."""


class JoinedDegrees:
    """Degrees of freedom that are tied to one another, chains and stars alike, each group under one leader.

    OpenSees wants every tied degree to name a free one. A group with a fixed degree is fixed as a whole.

    Args:
        calls: that built the model.
        degrees: names of the degrees of a node.

    Attributes:
        masters: nodes of rigid floors by the id of the node that they move with.
    """

    def __init__(self, calls: Iterable[Call], degrees: Sequence[str] = PLANE_DEGREES) -> None:
        self.degrees = degrees
        self._above: dict[Degree, Degree] = {}
        self._fixed: set[Degree] = set()
        self.masters: dict[int, list[int]] = {}
        for call in calls:
            if call.name == "tie":
                for at, name in enumerate(degrees):
                    if call[name]:
                        self.tie((call["node"], at), (call["master"], at))
            elif call.name == "fix":
                for at, name in enumerate(degrees):
                    if call[name]:
                        self.fix((call["node"], at))
            elif call.name == "diaphragm":
                self.masters.setdefault(call["master"], []).extend(call["nodes"])

    def leader(self, degree: Degree) -> Degree:
        """Return the degree that a degree moves with."""
        while degree in self._above:
            degree = self._above[degree]
        return degree

    def tie(self, degree: Degree, other: Degree) -> None:
        """Let a degree move with another one."""
        first, second = self.leader(degree), self.leader(other)
        if first != second:
            self._above[first] = second

    def fix(self, degree: Degree) -> None:
        """Fix a degree, and all that move with it."""
        self._fixed.add(degree)

    def is_fixed(self, degree: Degree) -> bool:
        """Say whether a degree, or one that it moves with, is fixed."""
        return self.leader(degree) in {self.leader(one) for one in self._fixed}

    def independent(self, nodes: Iterable[int]) -> int:
        """Return how many degrees of freedom nodes have that are neither fixed nor tied to others."""
        fixed = {self.leader(one) for one in self._fixed}
        carried = {(node, at) for nodes in self.masters.values() for node in nodes for at in IN_PLAN}
        return len({self.leader((node, at)) for node in nodes for at in range(len(self.degrees))} - fixed - carried)

    def commands(self, nodes: Iterable[int], tags: dict[int, int], names: dict[int, str]) -> list[Command]:
        """Return the supports and ties of nodes.

        Args:
            nodes: ids.
            tags: of OpenSees, by id.
            names: by id.
        """
        supported = {self.leader(one) for one in self._fixed}
        fixes, ties = [], []
        for node in nodes:
            leaders = [self.leader((node, at)) for at in range(len(self.degrees))]
            fixed = [int(leader in supported) for leader in leaders]
            if any(fixed):
                fixes.append(command("fix", tags[node], *fixed, comment=names[node]))
            to: dict[int, list[int]] = defaultdict(list)
            for at, leader in enumerate(leaders):
                if leader != (node, at) and not fixed[at]:
                    to[leader[0]].append(at + 1)
            for other, degrees in to.items():
                what = f"{names[node]} with {names[other]}: {', '.join(self.degrees[at - 1] for at in degrees)}"
                ties.append(command("equalDOF", tags[other], tags[node], *degrees, comment=what))
        return [*fixes, *ties]

    def floors(self, tags: Mapping[int, int], names: Mapping[int, str]) -> list[Command]:
        """Return the rigid floors of a model in space, each with its master first; arguments as of `commands`."""
        return [
            command("rigidDiaphragm", VERTICAL, tags[master], *(tags[node] for node in nodes), comment=names[master])
            for master, nodes in self.masters.items()
        ]
