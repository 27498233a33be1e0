"""The frame: its grid, supports, diaphragms and members, and what follows from them."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import accumulate, pairwise
from typing import Annotated, Any

from pydantic import Field, PrivateAttr

from edesign.project.frame.foundations import Footing, FootingSupport
from edesign.project.frame.leaning_column import LeaningColumn
from edesign.project.frame.members import BeamPlaces, BeamRun, BraceRun, ColumnPlaces, ColumnRun, Missing, Release
from edesign.project.frame.spacing import EqualBays, EqualStoreys, Heights, Storeys, Widths, widths
from edesign.project.frame.supports import Support, SupportKind, SupportSprings
from edesign.project.notation import names
from edesign.project.notation.axes import LETTERED, NUMBERED
from edesign.project.notation.frames import frames_of_line
from edesign.project.notation.grid import BayPlace, InBays
from edesign.project.notation.selections import NO_NUMBERS, LineSelection, NumberSelection, NumbersOrNone
from edesign.project.notation.written import Written, text
from edesign.project.reading.base import Model, refuse
from edesign.project.reading.one_of import OneOf
from edesign.project.reading.problems import as_seen


@dataclass(frozen=True)
class BeamMember:
    """A member of the frame that is a beam, or the half of one that braces or dampers meet in the middle.

    Attributes:
        bay, floor: of the beam.
        start, end: names of its nodes, from the left.
        length: m.
    """

    bay: int
    floor: int
    start: str
    end: str
    length: float


def _axis(value: Any) -> Any:
    if not isinstance(value, str) or not re.fullmatch(names.LINE, value):
        raise refuse(
            f"{as_seen(value)} names no line; write a capital letter, then letters, figures or ', 8 at most, such as "
            "`A1` [E-VALUE-01]"
        )
    return value


Axis = Annotated[str, Written(_axis, text("name of a column line", names.LINE, "A1", "B"))]


def _building_frame(value: Any) -> Any:
    if not isinstance(value, str) or not re.fullmatch(_BUILDING_FRAME, value):
        raise refuse(f"{as_seen(value)} names no frame of a building; write `X2` or `YA` [E-VALUE-01]")
    return value


_BUILDING_FRAME = rf"X{NUMBERED}|Y{LETTERED}"
BuildingFrame = Annotated[
    str, Written(_building_frame, text("name of a frame of a building", _BUILDING_FRAME, "X2", "YA"))
]


class Frame(Storeys, Model):
    """A plane frame on a grid of bays and storeys.

    Lines are named A, B, ...; bays count from 1 at the left, storeys and floors from 1 at the bottom; floor 0 is the
    base. Lengths are in m.

    Attributes:
        bays: widths of the bays from the left, as a list, or `{count, width}` for equal ones, which
            may also stand in a list.
        storeys: heights of the storeys from the bottom, as a list, or `{count, height}` for equal ones,
            which may also stand in a list.
        axes: names of the column lines from the left, as plans have them; without the key A, B, ...
        in_building: frames of a building that it has from the left, such as `[X1]`, with `axes` of the building; beams,
            braces and dampers then have their names there, BX_1_2_5. `edesign extract` writes it.
        left_in_building: what the building has and this frame has not, in words, for reports. `edesign extract`
            writes it.
        supports: support of all columns, or a mapping by line; lines that it does not name take its `default`, else
            `fixed`.
        diaphragms: floors whose nodes share their horizontal displacement.
        columns: runs of columns; every place of the grid needs one, or is `missing`.
        beams: runs of beams; every place of the grid needs one, or is `missing`.
        braces: runs of pin-ended braces.
        missing: members that the regular grid has and this frame has not.
        releases: moment releases at the ends of beams and columns.
        leaning_column: gravity loads beside the frame that it must hold upright.
    """

    bays: Annotated[Widths | EqualBays, OneOf()]
    storeys: Annotated[Heights | EqualStoreys, OneOf()]
    axes: tuple[Axis, ...] | None = None
    in_building: tuple[BuildingFrame, ...] = ()
    left_in_building: tuple[Annotated[str, Field(min_length=1, max_length=200)], ...] = ()
    supports: Annotated[SupportKind | dict[str, Support], OneOf()] = "fixed"
    diaphragms: NumbersOrNone = NO_NUMBERS
    columns: tuple[ColumnRun, ...]
    beams: tuple[BeamRun, ...]
    braces: tuple[BraceRun, ...] = ()
    missing: Missing = Missing()
    releases: tuple[Release, ...] = ()
    leaning_column: LeaningColumn | None = None

    _met_by_dampers: frozenset[tuple[int, int]] = PrivateAttr(default=frozenset())

    def meet_by_dampers(self, beams: Iterable[tuple[int, int]]) -> None:
        """Set in the frame, once, which beams dampers meet in the middle, by (bay, floor)."""
        self._met_by_dampers = frozenset(beams)

    def met_by_dampers(self, beams: Collection[tuple[int, int]]) -> Frame:
        """Return the frame whose dampers meet these beams in the middle, by (bay, floor)."""
        if self._met_by_dampers == frozenset(beams):
            return self
        found = type(self).model_construct(self.model_fields_set, **dict(self))  # a copy would keep what was derived
        found.meet_by_dampers(beams)
        return found

    # --- grid

    @cached_property
    def bay_widths(self) -> tuple[float, ...]:
        """Width of each bay, left to right, m."""
        return widths(self.bays)

    @property
    def n_bays(self) -> int:
        """The number of bays."""
        return len(self.bay_widths)

    @property
    def n_lines(self) -> int:
        """The number of column lines, one more than there are bays."""
        return len(self.bay_widths) + 1

    @cached_property
    def lines(self) -> tuple[str, ...]:
        """Names of the column lines, left to right: ("A", "B", ...), or `axes`."""
        if self.axes is not None and len(self.axes) == self.n_lines:  # the cross checks tell another number
            return self.axes
        return tuple(names.line_name(i) for i in range(self.n_lines))

    @cached_property
    def x(self) -> tuple[float, ...]:
        """Coordinate of each line, m; line A is at 0."""
        return tuple(accumulate(self.bay_widths, initial=0.0))

    def bay_lines(self, bay: int) -> tuple[str, str]:
        """Return the lines at the left and right of a bay (bays count from 1)."""
        return self.lines[bay - 1], self.lines[bay]

    def support(self, line: str) -> SupportKind | SupportSprings | FootingSupport:
        """Return the support at the base of a line; lines without one of their own take `default`, else fixed."""
        if isinstance(self.supports, dict):
            return self.supports.get(line, self.supports.get("default", "fixed"))
        return self.supports

    @property
    def footings(self) -> dict[str, Footing]:
        """The footings by the lines of columns that stand on them."""
        supports = {line: self.support(line) for line in self.lines if (line, 1) in self.column_at}
        return {line: on.footing for line, on in supports.items() if isinstance(on, FootingSupport)}

    @cached_property
    def diaphragm_floors(self) -> tuple[int, ...]:
        """Floors whose nodes share their horizontal displacement."""
        return self.diaphragms.numbers(1, self.n_storeys)

    # --- members: what stands where, after overriding and without what is missing

    @cached_property
    def column_at(self) -> dict[tuple[str, int], ColumnRun]:
        """The run of every column that stands, by (line, storey), storey by storey from the left."""
        absent = {place for item in self.missing.columns for place in self.column_places(item)}
        runs = {place: run for run in self.columns for place in self.column_places(run)}
        grid = ((line, s) for s in range(1, self.n_storeys + 1) for line in self.lines)
        return {place: runs[place] for place in grid if place in runs and place not in absent}

    @cached_property
    def beam_at(self) -> dict[tuple[int, int], BeamRun]:
        """The run of every beam that stands, by (bay, floor), floor by floor from the left."""
        absent = {place for item in self.missing.beams for place in self.beam_places(item)}
        runs = {place: run for run in self.beams for place in self.beam_places(run)}
        grid = ((b, f) for f in range(1, self.n_storeys + 1) for b in range(1, self.n_bays + 1))
        return {place: runs[place] for place in grid if place in runs and place not in absent}

    @cached_property
    def brace_at(self) -> dict[tuple[int, int, str], BraceRun]:
        """The run of every brace, by (bay, storey, "r" rising | "f" falling); all but a single diagonal are two."""
        runs = {}
        for run in self.braces:
            for storey in run.storeys.numbers(1, self.n_storeys):
                for bay in run.bays.numbers(1, self.n_bays):
                    runs[bay, storey] = run
        ways = {"rising": "r", "falling": "f"}
        places = sorted(runs.items(), key=_by_storey)
        return {(b, s, way): run for (b, s), run in places for way in ways.get(run.kind, "rf")}

    @cached_property
    def met_beams(self) -> dict[tuple[int, int], BraceRun | None]:
        """The beams that braces or dampers meet in the middle, by (bay, floor), with the run of braces that meets them.

        The run is None where only dampers meet the beam.
        """
        found: dict[tuple[int, int], BraceRun | None] = dict.fromkeys(sorted(self._met_by_dampers))
        for (bay, storey, _), run in self.brace_at.items():
            if run.kind in ("chevron", "v"):
                found[bay, storey if run.kind == "chevron" else storey - 1] = run
        return found

    @cached_property
    def beam_members(self) -> dict[str, BeamMember]:
        """The members that the beams are, by name, floor by floor from the left."""
        found = {}
        for bay, floor in self.beam_at:
            left, right = (names.node_name(line, floor) for line in self.bay_lines(bay))
            width = self.bay_widths[bay - 1]
            first, last = self.ends_of_beam(bay, floor)
            if first == last:
                found[first] = BeamMember(bay, floor, left, right, width)
                continue
            middle = self.beam_name(bay, floor)
            found[first] = BeamMember(bay, floor, left, middle, 0.5 * width)
            found[last] = BeamMember(bay, floor, middle, right, 0.5 * width)
        return found

    def ends_of_beam(self, bay: int, floor: int) -> tuple[str, str]:
        """Return the names of the first and the last member of a beam, which are its halves if braces meet it.

        Args:
            bay: number of the bay, from 1.
            floor: number of the floor; 0 is the base.
        """
        if (bay, floor) in self.met_beams:
            return names.beam_half_names(*self._named(bay, floor))
        return (self.beam_name(bay, floor),) * 2

    @cached_property
    def bays_in_building(self) -> dict[int, tuple[str, int]]:
        """The frame of the building in which a bay is, and its number there, by its number here.

        Bays between two frames, or to a line of no frame of the building, are in none.
        """
        found = {}
        of_lines = [set(frames_of_line(line)) for line in self.lines]
        for frame in self.in_building:
            first = next((i for i, frames in enumerate(of_lines) if frame in frames), 0)
            for bay, (left, right) in enumerate(pairwise(of_lines), 1):
                if frame in left & right:
                    found[bay] = frame, bay - first
        return found

    def _named(self, bay: int, level: int) -> tuple[int, int, str]:
        """The number of a bay in names, the floor or storey, and the frame of the building that names have."""
        frame, number = self.bays_in_building.get(bay, ("", bay))
        return number, level, frame

    def beam_name(self, bay: int, floor: int) -> str:
        """Return the name of the beam in a bay at a floor: B_2_5, of a frame of a building BX_1_2_5.

        Args:
            bay: number of the bay, from 1.
            floor: number of the floor; 0 is the base.
        """
        return names.beam_name(*self._named(bay, floor))

    def brace_name(self, bay: int, storey: int, way: str) -> str:
        """Return the name of a brace: D_2_5_r, of a frame of a building DX_1_2_5_r.

        Args:
            bay: number of the bay, from 1.
            storey: number of the storey, from 1.
            way: r for rising, f for falling.
        """
        number, level, frame = self._named(bay, storey)
        return names.brace_name(number, level, way, frame)

    def damper_names(self, kind: str, place: BayPlace) -> tuple[str, ...]:
        """Return the names of the dampers of a kind in a bay and storey: V_2_5, of a frame of a building VX_1_2_5."""
        return names.damper_names(kind, *self._named(place.bay, place.storey))

    def bay_named(self, frame: str, bay: int) -> int | None:
        """Return the number of a bay here by a frame of the building and its number there; None: it is not here."""
        if not frame:
            return bay if 1 <= bay <= self.n_bays and bay not in self.bays_in_building else None
        return next((here for here, there in self.bays_in_building.items() if there == (frame, bay)), None)

    def brace_nodes(self, bay: int, storey: int, way: str) -> tuple[str, str]:
        """Return the names of the left and the right node of a brace.

        Args:
            bay: number of the bay, from 1.
            storey: number of the storey, from 1.
            way: r for rising, f for falling.
        """
        left, right = self.bay_lines(bay)
        kind = self.brace_at[bay, storey, way].kind
        below, above = (left, right) if way == "r" else (right, left)
        low = self.beam_name(bay, storey - 1) if kind == "v" else names.node_name(below, storey - 1)
        high = self.beam_name(bay, storey) if kind == "chevron" else names.node_name(above, storey)
        return (low, high) if way == "r" else (high, low)

    @cached_property
    def released(self) -> dict[str, tuple[bool, bool]]:
        """Members with moment releases, by name: (released at the start, released at the end)."""
        found: dict[str, tuple[bool, bool]] = {}
        for release in self.releases:
            for first, last in self.members_in(release.beams, release.columns):
                if release.ends != "end":
                    found[first] = (True, found.get(first, (False, False))[1])
                if release.ends != "start":
                    found[last] = (found.get(last, (False, False))[0], True)
        return found

    @cached_property
    def nodes(self) -> dict[str, tuple[float, float]]:
        """Coordinates (x, y) in m of every node that a member needs, by name, floor by floor from the left."""
        used = {node for beam in self.beam_members.values() for node in (beam.start, beam.end)}
        used |= {node for place in self.brace_at for node in self.brace_nodes(*place)}
        for line, storey in self.column_at:
            used |= {names.node_name(line, storey - 1), names.node_name(line, storey)}
        grid = {}
        for floor, y in enumerate(self.levels):
            for i, line in enumerate(self.lines):
                grid[names.node_name(line, floor)] = (self.x[i], y)
                if i < self.n_bays:
                    grid[self.beam_name(i + 1, floor)] = (0.5 * (self.x[i] + self.x[i + 1]), y)
        return {name: place for name, place in grid.items() if name in used}

    @cached_property
    def members(self) -> dict[str, ColumnRun | BeamRun | BraceRun]:
        """Every member that stands, by name (C_A_1, B_1_1, D_1_1_r): columns, then beams, then braces.

        A beam that braces meet in the middle is two: B_1_1_1, B_1_1_2.
        """
        found: dict[str, ColumnRun | BeamRun | BraceRun] = {}
        found.update({names.column_name(*place): run for place, run in self.column_at.items()})
        found.update({name: self.beam_at[beam.bay, beam.floor] for name, beam in self.beam_members.items()})
        found.update({self.brace_name(*place): run for place, run in self.brace_at.items()})
        return found

    @cached_property
    def ends(self) -> dict[str, tuple[str, str]]:
        """Start and end node of every member, by name: columns, then beams, then braces."""
        found = {}
        for line, storey in self.column_at:
            nodes = names.node_name(line, storey - 1), names.node_name(line, storey)
            found[names.column_name(line, storey)] = nodes
        found |= {name: (beam.start, beam.end) for name, beam in self.beam_members.items()}
        found |= {self.brace_name(*place): self.brace_nodes(*place) for place in self.brace_at}
        return found

    def lines_in(self, name: str) -> tuple[str, ...]:
        """Return the line of a name; nothing where there is none."""
        return (name,) if name in self.lines else ()

    def lines_of(self, chosen: LineSelection) -> tuple[str, ...]:
        """Return the names of the column lines of a selection."""
        return chosen.names(self.lines)

    def line_place(self, line: str) -> tuple[float]:
        """Return the place of a line as a tuple of its x alone, m."""
        return (self.x[self.lines.index(line)],)

    def bay_places(self, chosen: InBays) -> Iterator[BayPlace]:
        """Yield the places of what stands in bays, storey by storey."""
        for storey in chosen.storeys.numbers(1, self.n_storeys):
            for bay in chosen.bays.numbers(1, self.n_bays):
                yield BayPlace("", bay, storey)

    def node_name(self, line: str, floor: int) -> str:
        """Return the name of the node on a line at a floor, whether it exists or not; floor 0 is the base."""
        return names.node_name(line, floor)

    def length(self, member: str) -> float:
        """Return the distance between the nodes of a member, m."""
        start, end = self.ends[member]
        return math.dist(self.nodes[start], self.nodes[end])

    # --- selections on this grid

    def column_places(self, chosen: ColumnPlaces) -> Iterator[tuple[str, int]]:
        """Yield (line, storey) of a selection of columns, whether they exist or not."""
        for storey in chosen.storeys.numbers(1, self.n_storeys):
            for line in chosen.lines.names(self.lines):
                yield line, storey

    def beam_places(self, chosen: BeamPlaces) -> Iterator[tuple[int, int]]:
        """Yield (bay, floor) of a selection of beams, whether they exist or not."""
        for floor in chosen.floors.numbers(1, self.n_storeys):
            for bay in chosen.bays.numbers(1, self.n_bays):
                yield bay, floor

    def standing_beams(self, chosen: BeamPlaces) -> list[tuple[int, int]]:
        """Return (bay, floor) of the selected beams that exist."""
        return [place for place in self.beam_places(chosen) if place in self.beam_at]

    def node_places(self, lines: LineSelection, floors: NumberSelection) -> list[tuple[str, int]]:
        """Return (line, floor) of the selected nodes that exist, floors from 1."""
        return [
            (line, floor)
            for floor in floors.numbers(1, self.n_storeys)
            for line in lines.names(self.lines)
            if names.node_name(line, floor) in self.nodes
        ]

    def leading_node(self, floor: int) -> str:
        """Return the name of the first node of a floor from the left, which stands for the floor."""
        return next(name for line in self.lines if (name := names.node_name(line, floor)) in self.nodes)

    def members_in(self, beams: BeamPlaces | None, columns: ColumnPlaces | None) -> Iterator[tuple[str, str]]:
        """Yield the first and the last member of each selected beam or column that exists; of most they are one.

        Args:
            beams: the selected beams; None: none.
            columns: the selected columns; None: none.
        """
        if beams is not None:
            yield from (self.ends_of_beam(*place) for place in self.standing_beams(beams))
        if columns is not None:
            for line, storey in self.column_places(columns):
                if (line, storey) in self.column_at:
                    yield (names.column_name(line, storey),) * 2


def _by_storey(item: tuple[tuple[int, int], BraceRun]) -> tuple[int, int]:
    (bay, storey), _ = item
    return storey, bay
