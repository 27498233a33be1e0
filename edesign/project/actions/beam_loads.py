"""Where the loads of beams stand on the members that the beams are, and where members are integrated piece by piece."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from edesign.project.actions.loads import Loads
from edesign.project.frame.elements import Elements
from edesign.project.frame.frame import Frame

MOST_POINTS = 64
"""Integration points that a member can have, all its pieces together (core_c/src/system/model.h)."""


@dataclass(frozen=True)
class PointOnMember:
    """A force across a member, N downwards, at `position` (0 to 1) of its length."""

    member: str
    position: float
    G: float
    Q: float


@dataclass(frozen=True)
class PartOnMember:
    """A load across a part of a member (`start`, `end`: 0 to 1 of its length), N/m downwards, linear in between."""

    member: str
    start: float
    end: float
    G: tuple[float, float]
    Q: tuple[float, float]


def points_on_members(frame: Frame, loads: Loads) -> Iterator[PointOnMember]:
    """Yield the point loads on each member that is part of a beam.

    A load over the middle of a divided beam is on the end of its first half.
    """
    for load in loads.beams:
        for place in frame.standing_beams(load) if load.points else ():
            width = frame.bay_widths[place[0] - 1]
            for point in load.points:
                for share in (at.share(width) for at in point.at):
                    pieces = [piece for piece in _pieces(frame, place) if share <= piece[2]]
                    if pieces:  # what is beyond the beam is refused by a check
                        name, first, last = pieces[0]
                        yield PointOnMember(name, (share - first) / (last - first), point.G, point.Q)


def parts_on_members(frame: Frame, loads: Loads) -> Iterator[PartOnMember]:
    """Yield the partial loads on each member that is part of a beam."""
    for load in loads.beams:
        for place in frame.standing_beams(load) if load.partial else ():
            width = frame.bay_widths[place[0] - 1]
            for part in load.partial:
                start, end = part.start.share(width), part.end.share(width)
                for name, first, last in _pieces(frame, place):
                    low, high = max(start, first), min(end, last)
                    if low < high:
                        shares = (low - start) / (end - start), (high - start) / (end - start)
                        ends = ((low - first) / (last - first), (high - first) / (last - first))
                        yield PartOnMember(name, *ends, _between(part.G, shares), _between(part.Q, shares))


def breaks_of_members(frame: Frame, loads: Loads) -> dict[str, tuple[float, ...]]:
    """Return the places inside members where loads begin, end or act, ascending, as shares of the length.

    Returns:
        The places, 0 to 1, by name of the member; members without such places are left out.
    """
    found: dict[str, set[float]] = {}
    for point in points_on_members(frame, loads):
        found.setdefault(point.member, set()).add(point.position)
    for part in parts_on_members(frame, loads):
        found.setdefault(part.member, set()).update((part.start, part.end))
    inside = {name: tuple(sorted(at for at in places if 0.0 < at < 1.0)) for name, places in found.items()}
    return {name: places for name, places in inside.items() if places}


def points_of_member(elements: Elements, breaks: tuple[float, ...]) -> int:
    """Return the number of integration points of a fibre member that is integrated piece by piece between breaks.

    Args:
        elements: integration points and geometry of the members.
        breaks: places inside the member, 0 to 1 of its length, ascending.
    """
    return (len(breaks) + 1) * (elements.integration_points - 1) + 1


def _pieces(frame: Frame, place: tuple[int, int]) -> list[tuple[str, float, float]]:
    """Members that a beam is, from the left, with the shares of its length where they begin and end."""
    first, last = frame.ends_of_beam(*place)
    return [(first, 0.0, 1.0)] if first == last else [(first, 0.0, 0.5), (last, 0.5, 1.0)]


def _between(values: tuple[float, float], shares: tuple[float, float]) -> tuple[float, float]:
    """A linear load at two shares of its length."""
    first, second = (values[0] + share * (values[1] - values[0]) for share in shares)
    return first, second
