"""Loads of a project: combinations, loads of each beam, column and node."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate, pairwise

import numpy as np

from edesign.frame.leaning_column import leaning_loads
from edesign.project.actions.beam_loads import PointOnMember, parts_on_members, points_on_members
from edesign.project.actions.loads import BeamLoad, ColumnLoad, Combination, FloorLoad, NodeLoad
from edesign.project.notation import names
from edesign.project.project import Project

_AT = 1e-6
"""Share of a length within which a point load stands at a place."""


def combined(load: BeamLoad | FloorLoad | ColumnLoad | NodeLoad | PointOnMember, factors: Combination) -> float:
    """Return factors.G * G + factors.Q * Q of a load, positive downwards.

    Args:
        load: with its permanent and variable part, N or N/m.
        factors: on the permanent and the variable part.
    """
    return factors.G * load.G + factors.Q * load.Q


@dataclass(frozen=True)
class Stretches:
    """Elements and rigid arms along a member between its nodes.

    Attributes:
        arms: lengths that belong to the joints at its start and end, as halves of panel zones do, m.
        lengths: of the elements between, m.
    """

    arms: tuple[float, float]
    lengths: tuple[float, ...]

    @cached_property
    def length(self) -> float:
        """Length of all elements and arms together, m."""
        return self._edges[-1] + self.arms[1]

    @cached_property
    def places(self) -> list[float]:
        """Shares of the length at which the elements begin, and at which the last one ends."""
        return [edge / self.length for edge in self._edges]

    @cached_property
    def _edges(self) -> list[float]:
        return list(accumulate(self.lengths, initial=self.arms[0]))

    def on_only_element(self, positions: Sequence[float]) -> tuple[float, ...]:
        """Return the positions that are inside the only element, as shares of its length.

        Args:
            positions: rising, as shares of the length of the member.
        """
        begin, end = self.places
        return tuple(_within(position, begin, end) for position in positions if begin < position < end)


@dataclass
class MemberLoads:
    """Loads across a member, positive downwards.

    Attributes:
        uniform: N/m.
        points: (position, force): share of the length from the start, N.
        parts: (start, end, at_start, at_end): shares of the length, N/m.
    """

    uniform: float = 0.0
    points: list[tuple[float, float]] = field(default_factory=list)
    parts: list[tuple[float, float, float, float]] = field(default_factory=list)

    @property
    def is_zero(self) -> bool:
        """The member carries no load."""
        return self.uniform == 0.0 and not self.points and not self.parts

    def split(self, stretches: Stretches) -> tuple[list[MemberLoads], tuple[float, float]]:
        """Return the loads on each element of a member, and the sums on the joints at its start and end, N.

        Returns:
            Loads of each element; sums at the start and at the end, N.
        """
        places = stretches.places
        parts = [MemberLoads(self.uniform) for _ in stretches.lengths]
        joints = [self.uniform * arm for arm in stretches.arms]
        for position, force in self.points:
            if position < places[0]:
                joints[0] += force
            elif position > places[-1]:
                joints[1] += force
            else:
                at = next(k for k in range(len(parts)) if position <= places[k + 1])
                parts[at].points.append((_within(position, places[at], places[at + 1]), force))
        for first, last, at_first, at_last in self.parts:
            shares = [0.0, *places, 1.0]
            for k, (begin, end) in enumerate(pairwise(shares)):
                low, high = max(first, begin), min(last, end)
                if not low < high:
                    continue
                slope = (at_last - at_first) / (last - first)
                at_low = at_first if low == first else at_first + slope * (low - first)
                at_high = at_last if high == last else at_first + slope * (high - first)
                if k in (0, len(parts) + 1):
                    joints[k > 0] += 0.5 * (at_low + at_high) * (high - low) * stretches.length
                else:
                    local = _within(low, begin, end), _within(high, begin, end)
                    parts[k - 1].parts.append((*local, at_low, at_high))
        return parts, (joints[0], joints[1])

    def at_ends(self, length: float) -> tuple[float, float]:
        """Return what the ends of a simply supported member carry of the loads, N.

        Args:
            length: m.

        Returns:
            At the start and at the end, N.
        """
        start = end = self.uniform * 0.5 * length
        for position, force in self.points:
            start += (1.0 - position) * force
            end += position * force
        for first, last, at_first, at_last in self.parts:
            part = (last - first) * length
            whole = 0.5 * (at_first + at_last) * part
            centre = first * whole + (last - first) * part * (at_first + 2.0 * at_last) / 6.0
            start += whole - centre
            end += centre
        return start, end

    def total(self, length: float) -> float:
        """Return the sum of the loads on a member, N.

        Args:
            length: m.
        """
        parts = sum(0.5 * (a + b) * (last - first) for first, last, a, b in self.parts)
        return self.uniform * length + sum(force for _, force in self.points) + parts * length

    def squared_moment(self, length: float) -> float:
        """Return the integral of M^2 over a simply supported member, N^2 m^3.

        The moment is a polynomial of at most the third degree between the places where loads begin, end or stand;
        Gauss-Legendre with four points integrates its square exactly.

        Args:
            length: m.
        """
        inside = [position for position, _ in self.points] + [at for part in self.parts for at in part[:2]]
        places = np.unique([0.0, 1.0, *inside])
        points, weights = np.polynomial.legendre.leggauss(4)
        half, middle = 0.5 * np.diff(places)[:, None], 0.5 * (places[1:] + places[:-1])[:, None]
        moments = self.moments(middle + half * points, length)
        return float(length * np.sum(half * weights * moments**2))

    def moments(self, x: np.ndarray, length: float) -> np.ndarray:
        """Bending moments at shares x of the length of a simply supported member, N m."""
        moments = x * length * self.at_ends(length)[0] - 0.5 * self.uniform * (x * length) ** 2
        for position, force in self.points:
            moments -= force * length * np.maximum(x - position, 0.0)
        for first, last, at_first, at_last in self.parts:
            slope = (at_last - at_first) / (last - first)
            before, behind = np.maximum(x - first, 0.0), np.maximum(x - last, 0.0)
            begun = at_first * before**2 / 2.0 + slope * before**3 / 6.0
            ended = at_last * behind**2 / 2.0 + slope * behind**3 / 6.0
            moments -= length**2 * (begun - ended)
        return moments

    def before(self, x: np.ndarray, length: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the loads from the start to shares x of the length, N, without and with points that stand there."""
        found = self.uniform * x * length
        for first, last, at_first, at_last in self.parts:
            reached = np.clip(x, first, last) - first
            found = found + length * (at_first + 0.5 * (at_last - at_first) / (last - first) * reached) * reached
        points = [np.multiply.outer(force, (x - at > -_AT, x - at > _AT)) for at, force in self.points]
        with_them, without = np.sum([np.zeros((2, x.size)), *points], axis=0)
        return found + without, found + with_them


def _within(position: float, begin: float, end: float) -> float:
    """A place of the whole as a share of the part from `begin` to `end`."""
    return min(max((position - begin) / (end - begin), 0.0), 1.0)


def beam_loads(project: Project, factors: Combination) -> dict[str, MemberLoads]:
    """Return the loads on every loaded beam, by name; loads on one beam add up.

    The halves of a beam that braces meet in the middle have their names.

    Args:
        factors: on the permanent and the variable part.
    """
    frame, loads = project.frame, project.loads
    found: dict[str, MemberLoads] = {}
    strips: list[tuple[BeamLoad | FloorLoad, float]] = [(load, 1.0) for load in loads.beams]
    strips += [(load, load.width) for load in loads.floors]
    for load, width in strips:
        for place in frame.standing_beams(load):
            for name in dict.fromkeys(frame.ends_of_beam(*place)):
                found.setdefault(name, MemberLoads()).uniform += width * combined(load, factors)
    for point in points_on_members(frame, loads):
        if (force := combined(point, factors)) != 0.0:
            found[point.member].points.append((point.position, force))
    for part in parts_on_members(frame, loads):
        at_start, at_end = (factors.G * G + factors.Q * Q for G, Q in zip(part.G, part.Q, strict=True))
        if at_start != 0.0 or at_end != 0.0:
            found[part.member].parts.append((part.start, part.end, at_start, at_end))
    return {name: loads for name, loads in found.items() if not loads.is_zero}


def column_loads(project: Project, factors: Combination) -> dict[str, float]:
    """Return the horizontal load along every loaded column in N/m, positive to the right, by name.

    Args:
        factors: on the permanent and the variable part.
    """
    found: dict[str, float] = {}
    for load in project.loads.columns:
        for place in project.frame.column_places(load):
            if place in project.frame.column_at:
                name = names.column_name(*place)
                found[name] = found.get(name, 0.0) + combined(load, factors)
    return {name: value for name, value in found.items() if value != 0.0}


def node_loads(project: Project, factors: Combination) -> dict[str, float]:
    """Return the load on every loaded node in N, positive downwards, by name; loads on one node add up.

    Args:
        factors: on the permanent and the variable part.
    """
    found: dict[str, float] = {}
    for load in project.loads.nodes:
        for place in project.frame.node_places(load.lines, load.floors):
            name = names.node_name(*place)
            found[name] = found.get(name, 0.0) + combined(load, factors)
    return {name: value for name, value in found.items() if value != 0.0}


def horizontal_load(project: Project) -> float:
    """Return the sum of the magnitudes of the horizontal loads of the gravity combination on columns, N."""
    heights, on_columns = project.frame.storey_heights, column_loads(project, project.loads.gravity)
    return sum(
        abs(on_columns.get(names.column_name(line, storey), 0.0)) * heights[storey - 1]
        for line, storey in project.frame.column_at
    )


def floor_loads(project: Project) -> np.ndarray:
    """Return the loads of the gravity combination on beams, nodes and the leaning column, by floor.

    Returns:
        N downwards, shape (storeys + 1,): nodes on the ground, then the floors from the lowest.
    """
    frame, factors = project.frame, project.loads.gravity
    found = np.zeros(frame.n_storeys + 1)
    for name, on_beam in beam_loads(project, factors).items():
        beam = frame.beam_members[name]
        found[beam.floor] += on_beam.total(beam.length)
    for load in project.loads.nodes:
        for _, floor in frame.node_places(load.lines, load.floors):
            found[floor] += combined(load, factors)
    for floor, leaning in enumerate(leaning_loads(project, factors), start=1):
        found[floor] += leaning
    return found


def gravity_load(project: Project) -> float:
    """Return the sum of the loads of the gravity combination on beams, nodes and the leaning column, N downwards."""
    return float(floor_loads(project).sum())
