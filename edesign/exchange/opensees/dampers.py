"""Dampers as elements without length between nodes that follow their ends."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from math import dist, hypot

from edesign.exchange.opensees.commands import Command, command
from edesign.exchange.opensees.materials import OTHER_LAW, Material, NoSuchMaterial, damper_branches
from edesign.exchange.opensees.structure import NotTranslated, NotTranslatedParts, Structure
from edesign.exchange.recorded_model import Call

LEVER = 4
"""Tag of the transformation of levers."""
STIFF = 1e5
"""Stiffness of bars that carry a point along, over the largest E A / L of the members."""
CLOSE = 1e-12  # of coefficients


@dataclass(frozen=True)
class Direction:
    """Along which a damper acts: a degree of an element without length, and how its axes stand."""

    degree: int
    orient: tuple[str | float, ...] = ()


_ALONG = (Direction(1), Direction(2), Direction(6))


def _along(c: float, s: float) -> Direction:
    return Direction(1, ("-orient", c, s, 0.0, -s, c, 0.0))


Terms = tuple[tuple[float, int, int], ...]


@dataclass
class Dampers:
    """Dampers as commands.

    Attributes:
        place: nodes, ties and braces, which stand from the beginning and carry nothing.
        carrying: what acts under the gravity loads too.
        at_rest, moving: set in under the gravity loads: what resists at rest, and what resists speed alone.
    """

    place: list[Command] = field(default_factory=list)
    carrying: list[Command] = field(default_factory=list)
    at_rest: list[Command] = field(default_factory=list)
    moving: list[Command] = field(default_factory=list)


class DamperBuilder:
    """Makes the commands of dampers.

    Args:
        structure: that has their nodes; nodes are added to it.
        largest: E A / L of the members, N/m.

    Attributes:
        TURNS, DIRECTIONS: degrees that turn, and numbers of those that do not, in elements without length.
    """

    TURNS: tuple[int, ...] = (2,)
    DIRECTIONS: tuple[int, ...] = (1, 2)

    def __init__(self, structure: Structure, largest: float) -> None:
        self._to, self._stiff = structure, STIFF * largest
        self._transformed = False
        self._ends_of: dict[str, tuple[int, int, Direction]] = {}

    def springs(self, stiffness: Mapping[str, float]) -> list[Command]:
        """Return linear springs in the place of dampers and their braces.

        Args:
            stiffness: by the name of the damper, N/m; those without any get none.
        """
        commands: list[Command] = []
        for name, k in stiffness.items():
            if k > 0.0:
                first, second, along = self._ends_of[name]
                self._spring(name, first, second, ("Elastic", k), along, commands)
        return commands

    def build(self, calls: Iterable[Call]) -> Dampers:
        """Return the commands of all dampers among the calls.

        Raises:
            NotTranslatedParts: OpenSees lacks something.
        """
        found, problems = Dampers(), []
        for call in calls:
            if call.name == "damper":
                try:
                    self._damper(call, found)
                except NotTranslated as problem:
                    problems.append(problem)
        if problems:
            raise NotTranslatedParts(problems)
        return found

    def _damper(self, call: Call, found: Dampers) -> None:
        name, brace = call["name"], call["brace"]
        if call["play"] > 0.0:
            raise NotTranslated(
                name,
                "its brace has `play` in its pins; leave this key out of a copy, or leave out all dampers with "
                "--without-dampers [E-OPS-02]",
            )
        if call["pressed_by"] is not None:
            raise NotTranslated(
                name, f"its force follows the compression of a spring (`weight: varying`); {OTHER_LAW} [E-OPS-01]"
            )
        try:
            scales = call["force_scale"], call["deformation_scale"]
            branches, braced = damper_branches(call["law"], *scales, brace)
        except NoSuchMaterial as error:
            raise NotTranslated(name, str(error)) from error
        brace = 0.0 if braced else brace
        first, second, along = self._ends(name, call["terms"], found)
        self._ends_of[name] = first, second, along
        if along.degree != 1 and (brace > 0.0 or any(branch.spring for branch in branches)):
            raise NotTranslated(name, f"it has a spring in series in another direction than x; {OTHER_LAW} [E-OPS-02]")
        if brace > 0.0:
            first = self._brace(name, first, brace, along, found)
        for branch in branches:
            near = first if branch.spring == 0.0 else self._brace(name, first, branch.spring, along, found)
            to = found.moving if branch.moves else found.at_rest
            self._spring(name, near, second, branch.material, along, found.carrying if call["carries"] else to)

    def _spring(self, name: str, i: int, j: int, material: Material, along: Direction, to: list[Command]) -> None:
        s, tag = self._to, self._to.tags.next("material")
        to.append(command("uniaxialMaterial", material[0], tag, *material[1:], comment=name))
        words = (
            "zeroLength",
            s.tags.next("element"),
            s.nodes[i],
            s.nodes[j],
            "-mat",
            tag,
            "-dir",
            along.degree,
            *along.orient,
        )
        to.append(command("element", *words, comment=name))

    def _brace(self, name: str, node: int, stiffness: float, along: Direction, found: Dampers) -> int:
        """Add a spring in series; across it the node is tied to the spring's end, where no force acts."""
        s = self._to
        far = s.add_node(f"{name}, behind its spring", s.places[node])
        for turn in self.TURNS:
            s.joined.fix((far, turn))
        material, tag = s.tags.next("material"), s.tags.next("element")
        found.place.append(
            command("uniaxialMaterial", "Elastic", material, stiffness, comment=f"{name}: spring in series")
        )
        words = (
            "zeroLength",
            tag,
            s.nodes[node],
            s.nodes[far],
            "-mat",
            *[material] * len(self.DIRECTIONS),
            "-dir",
            *self.DIRECTIONS,
            *along.orient,
        )
        found.place.append(command("element", *words, comment=f"{name}: spring in series"))
        return far

    def _ends(self, name: str, terms: Terms, found: Dampers) -> tuple[int, int, Direction]:
        """Nodes at one place whose distance is the deformation, and its direction."""
        axial = _axial(terms)
        if axial is not None:
            start, end, along = axial
            copy = self._to.tied_copy(
                f"{name}, moving with {self._to.names[start]}", start, (0, 1), self._to.places[end]
            )
            self._to.joined.fix((copy, 2))
            return copy, end, _along(*along)
        degrees = {degree for _, _, degree in terms}
        if degrees == {2} or (len(degrees) == 1 and len(terms) <= 2):
            return *self._single(name, terms), _ALONG[degrees.pop()]
        top = [(c, node) for c, node, degree in terms if degree == 0 and c > 0.0]
        low = [(-c, node) for c, node, degree in terms if degree == 0 and c < 0.0]
        tilt = [term for term in terms if term[2] == 1]
        above = self._mean(f"{name}, top", top, found)
        place = self._to.places[above]
        if tilt:
            below = self._apex(name, [node for _, node in low], place, found)
        else:
            below = self._mean(f"{name}, lower end", low, found, place)
        return below, above, _ALONG[0]

    def _single(self, name: str, terms: Terms) -> tuple[int, int]:
        """Nodes at one place of a damper in one direction between two nodes, or between a node and the ground."""
        s = self._to
        ends = {round(c): node for c, node, _ in terms}
        if any(abs(abs(c) - 1.0) > CLOSE for c, _, _ in terms) or 1 not in ends:
            raise NotTranslated(
                name, f"it couples displacements as no element of OpenSees does; {OTHER_LAW} [E-OPS-02]"
            )
        far = ends[1]
        if -1 not in ends:
            near = s.add_node(f"{name}, ground", s.places[far])
            for at in range(3):
                s.joined.fix((near, at))
            return near, far
        if s.places[ends[-1]] == s.places[far]:
            return ends[-1], far
        return s.tied_copy(f"{name}, moving with {s.names[ends[-1]]}", ends[-1], (0, 1, 2), s.places[far]), far

    def _mean(
        self, name: str, parts: list[tuple[float, int]], found: Dampers, place: tuple[float, ...] | None = None
    ) -> int:
        """A node that moves along x with the mean of others; with a diaphragm they are one."""
        s, nodes = self._to, [node for _, node in parts]
        if place is None:
            places = [s.places[node] for node in nodes]
            place = (sum(x for x, _ in places) / len(places), places[0][1])
        if len({s.joined.leader((node, 0)) for node in nodes}) == 1 or all(s.joined.is_fixed((n, 0)) for n in nodes):
            mean = s.tied_copy(name, nodes[0], (0,), place)
        else:
            mean = self._lever(name, nodes, place, found)
            s.joined.fix((mean, 1))
            return mean
        s.joined.fix((mean, 1))
        s.joined.fix((mean, 2))
        return mean

    def _lever(self, name: str, nodes: list[int], place: tuple[float, ...], found: Dampers) -> int:
        """The middle of a stiff upright bar whose ends follow two nodes along x, and which turns freely."""
        s = self._to
        mean = s.add_node(name, place)
        if not self._transformed:
            self._transformed = True
            found.place.append(command("geomTransf", "Linear", LEVER, comment="of stiff levers"))
        for node, side in zip(nodes, (-1.0, 1.0), strict=True):
            end = s.tied_copy(f"{name}, moving with {s.names[node]}", node, (0,), (place[0], place[1] + side))
            s.joined.fix((end, 1))
            pair = (end, mean) if side < 0.0 else (mean, end)
            tag, i, j = s.tags.next("element"), s.nodes[pair[0]], s.nodes[pair[1]]
            words = ("elasticBeamColumn", tag, i, j, self._stiff, 1.0, self._stiff, LEVER)
            found.place.append(command("element", *words, comment=f"{name}: mean of its sides"))
        return mean

    def _apex(
        self,
        name: str,
        lower_ends: list[int],
        place: tuple[float, ...],
        found: Dampers,
        fixed: Sequence[int] = (2,),
    ) -> int:
        """The point at which stiff bars from the lower ends of a chevron meet."""
        s = self._to
        apex = s.add_node(f"{name}, apex of the chevron", place)
        for degree in fixed:
            s.joined.fix((apex, degree))
        material = s.tags.next("material")
        length = dist(place, s.places[lower_ends[0]])
        words = ("Elastic", material, self._stiff * length)
        found.place.append(command("uniaxialMaterial", *words, comment=f"{name}: stiff; the brace is a spring"))
        for lower_end in lower_ends:
            bar = ("truss", s.tags.next("element"), s.nodes[lower_end], s.nodes[apex], 1.0, material)
            found.place.append(command("element", *bar, comment=f"{name}: from {s.names[lower_end]}"))
        return apex


def _axial(terms: Terms) -> tuple[int, int, tuple[float, float]] | None:
    """Start, end and direction of a damper along the line between two nodes; None if it is another one."""
    of: dict[int, list[float]] = defaultdict(lambda: [0.0, 0.0])
    for c, node, degree in terms:
        if degree == 2:
            return None
        of[node][degree] += c
    if len(terms) != 4 or len(of) != 2:
        return None
    (end, along), (start, back) = of.items()
    if any(abs(a + b) > CLOSE for a, b in zip(along, back, strict=True)) or abs(hypot(*along) - 1.0) > 1e-9:
        return None
    return start, end, (along[0], along[1])
