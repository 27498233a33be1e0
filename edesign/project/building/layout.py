"""What stands where in a building, after overriding, setbacks and missing members."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from pydantic_core import PydanticCustomError

from edesign.project.building.members import CHEVRONS, BeamPlaces, BeamRun, BraceRun, ColumnPlaces, ColumnRun, End
from edesign.project.building.names import (
    BeamPlace,
    BracePlace,
    ColumnLine,
    Direction,
    column_name,
    frame_name,
    node_name,
)
from edesign.project.building.own_cases import Side, facing
from edesign.project.building.places import ColumnLineSelection, panels_in, parse_column_lines
from edesign.project.frame.spacing import Storeys
from edesign.project.notation.axes import GridAxes
from edesign.project.notation.frames import ALL_FRAMES
from edesign.project.notation.grid import BayPlace, InBays
from edesign.project.notation.names import damper_names

if TYPE_CHECKING:
    from edesign.project.building.building import Building

Panel = tuple[int, int]
"""A bay of the plan: its bay along x and along y, from 1."""
DIRECTIONS: tuple[Direction, Direction] = ("x", "y")


class Diaphragm(NamedTuple):
    """A floor that is rigid in its plane, or one of several rigid parts of a floor.

    Attributes:
        floor: its number; 0 is an isolated base.
        part: its number among those of the floor, from 1; 0: the floor has no other.
    """

    floor: int
    part: int = 0

    def __str__(self) -> str:
        return f"{self.floor}.{self.part}" if self.part else str(self.floor)


class Layout(Storeys):
    """The nodes and members of a building at the places of its grid.

    Args:
        building: read without schema problems.
    """

    def __init__(self, building: Building) -> None:
        self._building = building
        self.storeys = building.storeys
        self.axes = building.axes

    # --- floors

    @cached_property
    def floors(self) -> dict[int, frozenset[Panel]]:
        """The bays that each floor covers; floors count from 1."""
        n_x, n_y = self._building.n_bays("x"), self._building.n_bays("y")
        whole = frozenset((i, j) for i in range(1, n_x + 1) for j in range(1, n_y + 1))
        found = {floor: whole for floor in range(1, self.n_storeys + 1)}
        for setback in self._building.setbacks:
            covered = panels_in(setback.bays, n_x, n_y)
            for floor in setback.floors.numbers(1, self.n_storeys):
                found[floor] = covered
        return found

    @cached_property
    def floor_lines(self) -> dict[int, tuple[ColumnLine, ...]]:
        """The column lines at the corners of the bays that each floor covers, in the order of the grid."""
        return {
            floor: tuple(sorted({line for p in panels for line in corners(p, self.axes)}))
            for floor, panels in self.floors.items()
        }

    @cached_property
    def floor_edges(self) -> dict[int, Counter[BeamPlace]]:
        """The number of covered bays at each place of a beam, by floor: 1 at the perimeter, 2 inside."""
        return {
            floor: Counter(edge for panel in sorted(panels) for edge in edges(panel, floor, self.axes))
            for floor, panels in self.floors.items()
        }

    # --- members

    @cached_property
    def column_at(self) -> dict[tuple[ColumnLine, int], ColumnRun]:
        """The run of every column that stands, by (line, storey), storey by storey."""
        runs = {place: run for run in self._building.columns for place in self.column_places(run)}
        absent = {place for item in self._building.missing.columns for place in self.column_places(item)}
        return {place: runs[place] for place in self.column_grid if place in runs and place not in absent}

    @cached_property
    def column_grid(self) -> tuple[tuple[ColumnLine, int], ...]:
        """Every place (line, storey) at which the floors above want a column."""
        return tuple((line, floor) for floor, lines in self.floor_lines.items() for line in lines)

    @cached_property
    def beam_at(self) -> dict[BeamPlace, BeamRun]:
        """The run of every beam that stands, floor by floor, those along x first."""
        runs = {place: run for run in self._building.beams for place in self.beam_places(run)}
        absent = {place for item in self._building.missing.beams for place in self.beam_places(item)}
        return {place: runs[place] for place in self.beam_grid if place in runs and place not in absent}

    @cached_property
    def beam_grid(self) -> tuple[BeamPlace, ...]:
        """Every place at which the edge of a covered bay wants a beam."""
        return tuple(place for floor in self.floor_edges.values() for place in sorted(floor))

    @cached_property
    def brace_at(self) -> dict[BracePlace, BraceRun]:
        """The run of the brace or braces in every braced bay, storey by storey."""
        runs = {place: run for run in self._building.braces for place in self.brace_places(run)}
        return {place: runs[place] for place in sorted(runs, key=lambda p: (p.storey, p))}

    @cached_property
    def halved_beams(self) -> frozenset[BeamPlace]:
        """The beams that chevrons or V braces meet in the middle, or dampers in place of chevrons."""
        met = {
            met_beam(place, run) for place, run in self.brace_at.items() if run.kind in CHEVRONS and run.link is None
        }
        halves = self._building.halves
        if halves is not None:
            return frozenset(met | {beam for beam in self.beam_at if f"{beam}_1" in halves and beam not in self.links})
        for damper in self._building.in_place_of_chevrons:
            beams = (BeamPlace(*place) for place in self.brace_places(damper))
            met |= {beam for beam in beams if beam in self.beam_at}
        return frozenset(met)

    @cached_property
    def links(self) -> dict[BeamPlace, tuple[BracePlace, tuple[float, float]]]:
        """The place of the braces beside the link of each beam that has one, and its ends as fractions of the beam."""
        found = {}
        for place, run in self.brace_at.items():
            if run.link is not None:
                share = run.link / self._building.widths(place.along)[place.bay - 1]
                if run.kind in CHEVRONS:
                    ends = 0.5 - 0.5 * share, 0.5 + 0.5 * share
                else:
                    ends = (1.0 - share, 1.0) if "r" in ways(place, run) else (0.0, share)
                found[met_beam(place, run)] = place, ends
        return found

    def cuts(self, place: BeamPlace) -> dict[str, float]:
        """Return the nodes inside of a beam, which braces meet, and their places as fractions of its length."""
        if place in self.links:
            inside = [share for share in self.links[place][1] if 0.0 < share < 1.0]
            return {link_node(place, number): share for number, share in enumerate(inside, start=1)}
        return {str(place): 0.5} if place in self.halved_beams else {}

    @cached_property
    def cut_beams(self) -> tuple[BeamPlace, ...]:
        """The beams that have nodes between their ends."""
        return tuple(sorted({*self.halved_beams, *self.links}))

    @cached_property
    def node_lines(self) -> dict[int, tuple[ColumnLine, ...]]:
        """The column lines that have a node at each floor, floor 0 first."""
        used: dict[int, set[ColumnLine]] = {floor: set() for floor in range(self.n_storeys + 1)}
        for line, storey in self.column_at:
            used[storey - 1].add(line)
            used[storey].add(line)
        for place in self.beam_at:
            used[place.floor].update(place.lines)
        for brace, run in self.brace_at.items():
            for end, floor in (point for points in ways(brace, run).values() for point in points):
                used[floor].update(() if end is None else (end,))
        return {floor: tuple(sorted(lines)) for floor, lines in used.items()}

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """Names of the column lines at the corners of the bays that floors cover: A1, A2, ..."""
        return tuple(str(line) for line in sorted({line for lines in self.floor_lines.values() for line in lines}))

    @cached_property
    def nodes(self) -> dict[str, tuple[float, float, float]]:
        """Coordinates in m of every node, by name, floor by floor; on a floor those inside of beams come last."""
        found = {}
        for floor, lines in self.node_lines.items():
            level = self.levels[floor]
            for line in lines:
                found[node_name(line, floor)] = (*self._building.place(line), level)
            for beam in (beam for beam in self.cut_beams if beam.floor == floor):
                (x0, y0), (x1, y1) = (self._building.place(line) for line in beam.lines)
                for name, at in self.cuts(beam).items():
                    found[name] = ((1.0 - at) * x0 + at * x1, (1.0 - at) * y0 + at * y1, level)
        return found

    @cached_property
    def diaphragms(self) -> dict[Diaphragm, frozenset[str]]:
        """The names of the nodes that each rigid floor ties, or each rigid part of one, from below."""
        found = {}
        for floor in self._building.rigid_floors:
            parts = self._building.rigid_parts(floor)
            for number, panels in enumerate(parts, start=1):
                lines = {line for panel in panels for line in corners(panel, self.axes)} & set(self.node_lines[floor])
                beams = {edge for panel in panels for edge in edges(panel, floor, self.axes)}
                if panels == self.floors[floor]:
                    lines = set(self.node_lines[floor])
                    beams = {beam for beam in self.cut_beams if beam.floor == floor}
                inside = (name for beam in beams for name in self.cuts(beam))
                if names := frozenset([*(node_name(line, floor) for line in lines), *inside]):
                    found[Diaphragm(floor, number if len(parts) > 1 else 0)] = names
        return found

    @cached_property
    def tied(self) -> dict[str, Diaphragm]:
        """What ties a node, by the name of each node that a rigid floor ties, or a rigid part of one."""
        return {name: diaphragm for diaphragm, names in self.diaphragms.items() for name in names}

    def beam_members(self, place: BeamPlace) -> tuple[str, ...]:
        """Return the name of a beam, or those of the parts of one that braces meet."""
        parts = len(self.cuts(place)) + 1
        return tuple(f"{place}_{part}" for part in range(1, parts + 1)) if parts > 1 else (str(place),)

    def link_member(self, place: BeamPlace) -> str | None:
        """Return the name of the part of a beam that is a seismic link; None of a beam without one."""
        if place not in self.links:
            return None
        return f"{place}_{1 if self.links[place][1][0] == 0.0 else 2}"

    @cached_property
    def members(self) -> dict[str, ColumnRun | BeamRun | BraceRun]:
        """The run of every member, by name: columns, then beams, then braces."""
        found: dict[str, ColumnRun | BeamRun | BraceRun] = {}
        found.update({column_name(*place): run for place, run in self.column_at.items()})
        found.update({name: run for place, run in self.beam_at.items() for name in self.beam_members(place)})
        found.update({p.name(way): run for p, run in self.brace_at.items() for way in ways(p, run)})
        return found

    @cached_property
    def ends(self) -> dict[str, tuple[str, str]]:
        """Start and end node of every member, by name; columns and braces start below."""
        found = {}
        for line, storey in self.column_at:
            found[column_name(line, storey)] = node_name(line, storey - 1), node_name(line, storey)
        for beam in self.beam_at:
            members, (start, end) = self.beam_members(beam), (node_name(line, beam.floor) for line in beam.lines)
            found.update(zip(members, pairwise((start, *self.cuts(beam), end)), strict=True))
        for place, run in self.brace_at.items():
            for way, ((low, below), (high, above)) in ways(place, run).items():
                number = 0 if run.link is None else met_end(run, way)
                found[place.name(way)] = (
                    _point_name(place, low, below, number),
                    _point_name(place, high, above, number),
                )
        return found

    def lines_in(self, name: str) -> tuple[str, ...]:
        """Return the column lines of a selection that stand; nothing where it is none, or goes beyond the plan."""
        try:
            chosen = parse_column_lines(name)
        except PydanticCustomError:
            return ()
        ends = [end for item in chosen.items for end in item.spans(self.axes)]
        if any(span is None or span[1] > self._building.n_bays(across) for across, span in ends):
            return ()
        return tuple(line for line in map(str, self._building.lines_of(chosen)) if line in self.lines)

    def lines_of(self, chosen: ColumnLineSelection) -> tuple[str, ...]:
        """Return the names of the column lines of a selection."""
        return tuple(map(str, self._building.lines_of(chosen)))

    def line_place(self, line: str) -> tuple[float, float]:
        """Return the place of a column line in plan by its name, m."""
        (found,) = self._building.lines_of(parse_column_lines(line))
        return self._building.place(found)

    def damper_names(self, kind: str, place: BayPlace) -> tuple[str, ...]:
        """Return the names of the dampers of a kind in a bay and storey."""
        return damper_names(kind, place.bay, place.storey, place.frame)

    def node_name(self, line: str, floor: int) -> str:
        """Return the name of the node on a line at a floor, whether it exists or not; floor 0 is the base."""
        return node_name(line, floor)

    # --- selections on this grid

    def column_places(self, chosen: ColumnPlaces) -> Iterator[tuple[ColumnLine, int]]:
        """Yield (line, storey) of a selection of columns, whether they exist or not."""
        lines = self._building.lines_of(chosen.at)
        for storey in chosen.storeys.numbers(1, self.n_storeys):
            for line in lines:
                yield line, storey

    def beam_places(self, chosen: BeamPlaces) -> Iterator[BeamPlace]:
        """Yield the places of a selection of beams, whether they exist or not."""
        along = chosen.along
        for floor in chosen.floors.numbers(1, self.n_storeys):
            for frame in chosen.frames.numbers(self._building.n_frames(along), self.axes):
                for bay in chosen.bays.numbers(1, self._building.n_bays(along)):
                    yield BeamPlace(along, frame, bay, floor, self.axes)

    def members_in(self, beams: BeamPlaces | None, columns: ColumnPlaces | None) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each selected beam or column that exists; of most they are one.

        Args:
            beams: the selected beams; None: none.
            columns: the selected columns; None: none.
        """
        for place in self.beam_places(beams) if beams is not None else ():
            if place in self.beam_at:
                parts = self.beam_members(place)
                yield parts[0], parts[-1]
        for at in self.column_places(columns) if columns is not None else ():
            if at in self.column_at:
                yield (column_name(*at),) * 2

    @cached_property
    def released(self) -> dict[str, tuple[bool, bool]]:
        """Beams with pinned ends, by name: (pinned at the start, pinned at the end)."""
        ends = {name: (start == "pinned", end == "pinned") for name, (start, end) in self.beam_ends.items()}
        return {name: pinned for name, pinned in ends.items() if any(pinned)}

    @cached_property
    def beam_ends(self) -> dict[str, tuple[End, End]]:
        """How the start and the end of every beam are joined, by name; parts of one are rigid between them."""
        found: dict[str, tuple[End, End]] = {}
        for place, run in self.beam_at.items():
            members = self.beam_members(place)
            for name in members:
                start, end = name == members[0], name == members[-1]
                found[name] = run.ends.start if start else "rigid", run.ends.end if end else "rigid"
        return found

    def brace_places(self, chosen: InBays) -> Iterator[BracePlace]:
        """Yield the places of braces, or of dampers in the place of some; none of what has no direction."""
        along = chosen.along
        if along is None:
            return
        frames = (chosen.frames or ALL_FRAMES).numbers(self._building.n_frames(along), self.axes)
        for storey in chosen.storeys.numbers(1, self.n_storeys):
            for frame in frames:
                for bay in chosen.bays.numbers(1, self._building.n_bays(along)):
                    yield BracePlace(along, frame, bay, storey, self.axes)

    def faces(self, storey: int, side: Side) -> Iterator[tuple[tuple[ColumnLine, ColumnLine], float]]:
        """Yield the column lines at both ends of each bay of a storey whose side looks into the open, and its width.

        Args:
            storey: counted from 1; it has the bays of the floor above it.
            side: which way the side looks.
        """
        axis, inwards = facing(side)
        widths = self._building.widths("y" if axis == 0 else "x")
        panels = self.floors[storey]
        for i, j in sorted(panels):
            outside = (i - int(inwards), j) if axis == 0 else (i, j - int(inwards))
            if outside in panels:
                continue
            at = (i, j)[axis] - (inwards > 0.0)
            if axis == 0:
                yield (ColumnLine(at, j - 1, self.axes), ColumnLine(at, j, self.axes)), widths[j - 1]
            else:
                yield (ColumnLine(i - 1, at, self.axes), ColumnLine(i, at, self.axes)), widths[i - 1]

    def bay_places(self, chosen: InBays) -> Iterator[BayPlace]:
        """Yield the places of what stands in bays, storey by storey, by the names of their frames."""
        for place in self.brace_places(chosen):
            yield BayPlace(frame_name(place.along, place.frame, place.axes), place.bay, place.storey)


def corners(panel: Panel, axes: GridAxes) -> tuple[ColumnLine, ...]:
    """Return the column lines at the corners of a bay of the plan.

    Args:
        panel: the bay: its numbers along x and along y, from 1.
    """
    i, j = panel
    return tuple(ColumnLine(a, b, axes) for b in (j - 1, j) for a in (i - 1, i))


def edges(panel: Panel, floor: int, axes: GridAxes) -> tuple[BeamPlace, BeamPlace, BeamPlace, BeamPlace]:
    """Return the places of the beams at the edges of a bay of the plan: two along x, two along y.

    Args:
        panel: the bay: its numbers along x and along y, from 1.
        floor: number of the floor; 0 is the base.
    """
    i, j = panel
    return (
        BeamPlace("x", j - 1, i, floor, axes),
        BeamPlace("x", j, i, floor, axes),
        BeamPlace("y", i - 1, j, floor, axes),
        BeamPlace("y", i, j, floor, axes),
    )


def met_beam(place: BracePlace, run: BraceRun) -> BeamPlace:
    """Return the place of the beam that braces meet between its ends: V braces the one below, others that above.

    Args:
        place: the place of the brace: frame, bay and storey.
        run: the run of braces, with their kind.
    """
    floor = place.storey - 1 if run.kind == "v" else place.storey
    return BeamPlace(*place[:3], floor, place.axes)


Point = tuple[ColumnLine | None, int]
"""A column line, or None for a place inside of the bay, and a floor."""


def link_node(place: BeamPlace, number: int) -> str:
    """Return the name of a node at an end of a seismic link: `BX_2_1_5.1`.

    Args:
        number: of the node along the beam, from 1.
    """
    return f"{place}.{number}"


def met_end(run: BraceRun, way: str) -> int:
    """Return which of the nodes of a beam with a link a brace meets, from 1.

    Args:
        way: `r` rising, `f` falling.
    """
    left = {"chevron": "r", "v": "f"}.get(run.kind, way)
    return 1 if way == left else 2


def ways(place: BracePlace, run: BraceRun) -> dict[str, tuple[Point, Point]]:
    """Return the lower and upper point of each brace of one place by its way, `r` rising and `f` falling.

    Args:
        place: the place of the brace: frame, bay and storey.
        run: the run of braces, with their kind.
    """
    left, right = place.lines
    low, high = place.storey - 1, place.storey
    rising: tuple[Point, Point] = (left, low), (right, high)
    falling: tuple[Point, Point] = (right, low), (left, high)
    if run.kind == "chevron":
        return {"r": ((left, low), (None, high)), "f": ((right, low), (None, high))}
    if run.kind == "v":
        return {"f": ((None, low), (left, high)), "r": ((None, low), (right, high))}
    if run.kind == "cross":
        return {"r": rising, "f": falling}
    alternate = "rising" if (place.bay + place.storey) % 2 == 0 else "falling"
    kind = alternate if run.kind == "alternating" else run.kind
    if run.link is not None:
        rising, falling = (rising[0], (None, high)), (falling[0], (None, high))
    return {"r": rising} if kind == "rising" else {"f": falling}


def _point_name(place: BracePlace, line: ColumnLine | None, floor: int, number: int) -> str:
    """Name of the node at a point of a braced bay; `number`: of the node of a beam with a link, from 1."""
    if line is not None:
        return node_name(line, floor)
    beam = BeamPlace(*place[:3], floor, place.axes)
    return link_node(beam, number) if number else str(beam)
