"""Dampers as elements without length between nodes that follow their ends."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass, field
from math import hypot

from edesign.exchange.opensees.commands import Command, command
from edesign.exchange.opensees.materials import Material, NoSuchMaterial, damper_materials
from edesign.exchange.opensees.structure import NotTranslated, NotTranslatedParts, Structure
from edesign.exchange.recorded_model import Call

STIFF = 1e4
"""Stiffness of bars that carry a point along, over the largest E A / L of the members."""
_CLOSE = 1e-12  # of coefficients


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
    """

    def __init__(self, structure: Structure, largest: float) -> None:
        self._to, self._stiff = structure, STIFF * largest

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
            raise NotTranslated(name, "its brace has `play` in its pins; leave this key out of a copy")
        if call["pressed_by"] is not None:
            raise NotTranslated(name, "its force follows the compression of a spring (`weight: varying`)")
        try:
            scales = call["force_scale"], call["deformation_scale"]
            at_rest, moving, braced = damper_materials(call["law"], *scales, brace)
        except NoSuchMaterial as error:
            raise NotTranslated(name, str(error)) from error
        brace = 0.0 if braced else brace
        first, second, along = self._ends(name, call["terms"], found)
        if brace > 0.0 and along.degree != 1:
            raise NotTranslated(name, "it has a brace in another direction than its own")
        if brace > 0.0:
            first = self._brace(name, first, brace, along, found)
        for materials, group in ((at_rest, found.at_rest), (moving, found.moving)):
            to = found.carrying if call["carries"] else group
            for material in materials:
                self._spring(name, first, second, material, along, to)

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
        """Add a brace in series; across it the node is held to the brace's end, where no force acts."""
        s = self._to
        far = s.add_node(f"{name}, between brace and damper", s.places[node])
        s.joined.hold((far, 2))
        material, tag = s.tags.next("material"), s.tags.next("element")
        found.place.append(command("uniaxialMaterial", "Elastic", material, stiffness, comment=f"{name}: brace"))
        words = (
            "zeroLength",
            tag,
            s.nodes[node],
            s.nodes[far],
            "-mat",
            material,
            material,
            "-dir",
            1,
            2,
            *along.orient,
        )
        found.place.append(command("element", *words, comment=f"{name}: brace"))
        return far

    def _ends(self, name: str, terms: Terms, found: Dampers) -> tuple[int, int, Direction]:
        """Nodes at one place whose distance is the deformation, and its direction."""
        axial = _axial(terms)
        if axial is not None:
            start, end, along = axial
            copy = self._to.tied_copy(
                f"{name}, moving with {self._to.names[start]}", start, (0, 1), self._to.places[end]
            )
            self._to.joined.hold((copy, 2))
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
            below = self._mean(f"{name}, foot", low, found, place)
        return below, above, _ALONG[0]

    def _single(self, name: str, terms: Terms) -> tuple[int, int]:
        """Nodes at one place of a damper in one direction between two nodes, or between a node and the ground."""
        s = self._to
        ends = {round(c): node for c, node, _ in terms}
        if any(abs(abs(c) - 1.0) > _CLOSE for c, _, _ in terms) or 1 not in ends:
            raise NotTranslated(name, "it couples displacements as no element of OpenSees does")
        far = ends[1]
        if -1 not in ends:
            near = s.add_node(f"{name}, ground", s.places[far])
            for at in range(3):
                s.joined.hold((near, at))
            return near, far
        if s.places[ends[-1]] == s.places[far]:
            return ends[-1], far
        return s.tied_copy(f"{name}, moving with {s.names[ends[-1]]}", ends[-1], (0, 1, 2), s.places[far]), far

    def _mean(
        self, name: str, parts: list[tuple[float, int]], found: Dampers, place: tuple[float, float] | None = None
    ) -> int:
        """A node that moves along x with the mean of others; with a diaphragm they are one."""
        s, nodes = self._to, [node for _, node in parts]
        if place is None:
            places = [s.places[node] for node in nodes]
            place = (sum(x for x, _ in places) / len(places), places[0][1])
        if len({s.joined.leader((node, 0)) for node in nodes}) == 1 or all(s.joined.is_held((n, 0)) for n in nodes):
            mean = s.tied_copy(name, nodes[0], (0,), place)
        else:
            mean = s.add_node(name, place)
            material = s.tags.next("material")
            found.place.append(command("uniaxialMaterial", "Elastic", material, self._stiff, comment=f"{name}: stiff"))
            for node in nodes:
                copy = s.tied_copy(f"{name}, moving with {s.names[node]}", node, (0,), place)
                s.joined.hold((copy, 1))
                s.joined.hold((copy, 2))
                words = (
                    "zeroLength",
                    s.tags.next("element"),
                    s.nodes[copy],
                    s.nodes[mean],
                    "-mat",
                    material,
                    "-dir",
                    1,
                )
                found.place.append(command("element", *words, comment=f"{name}: mean of its sides"))
        s.joined.hold((mean, 1))
        s.joined.hold((mean, 2))
        return mean

    def _apex(self, name: str, feet: list[int], place: tuple[float, float], found: Dampers) -> int:
        """The point at which stiff bars from the feet of a chevron meet."""
        s = self._to
        apex = s.add_node(f"{name}, apex of the chevron", place)
        s.joined.hold((apex, 2))
        material = s.tags.next("material")
        length = hypot(place[0] - s.places[feet[0]][0], place[1] - s.places[feet[0]][1])
        words = ("Elastic", material, self._stiff * length)
        found.place.append(command("uniaxialMaterial", *words, comment=f"{name}: stiff; the brace is a spring"))
        for foot in feet:
            bar = ("truss", s.tags.next("element"), s.nodes[foot], s.nodes[apex], 1.0, material)
            found.place.append(command("element", *bar, comment=f"{name}: from {s.names[foot]}"))
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
    if any(abs(a + b) > _CLOSE for a, b in zip(along, back, strict=True)) or abs(hypot(*along) - 1.0) > 1e-9:
        return None
    return start, end, (along[0], along[1])
