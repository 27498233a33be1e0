"""Elevations of the plane frames of a building before its analysis: grid, sections, ends, supports, dampers."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from functools import partial
from itertools import groupby

import numpy as np

from edesign.project.building import Building
from edesign.project.building.layout import DIRECTIONS
from edesign.project.building.names import ColumnLine, Direction, frame_name, line_label
from edesign.project.building.supports import DIRECTIONS as DEGREES
from edesign.project.building.supports import FIXED, PINNED, Springs
from edesign.project.frame.foundations import FootingSupport
from edesign.report.building.figures.elevations import LINK
from edesign.report.building.figures.model_ends import EndsOfFrame, is_weak
from edesign.report.drawing.building_drawing import BuildingElevation
from edesign.report.drawing.captions import file_name, some_names
from edesign.report.model.boxes import Spot
from edesign.report.model.devices import DevicesOnSheet
from edesign.report.model.elevation import Grid, draw_axes
from edesign.report.model.ends import Line
from edesign.report.model.figures import Named
from edesign.report.model.members import name_column
from edesign.report.model.sheet import Entry, Sheet, on_sheet, unwritten
from edesign.report.model.supports import SIGNS, axes, draw_isolation, footing_words, support_entry
from edesign.report.model.words import section_words, several_steels, short, steels_of
from edesign.space.structure.frame import Member, SpaceFrame

_EQUAL = 1.0 - 1e-9  # a square or round column has no weak axis: its I_z is I_y but for rounding
WIDTH = 6.6  # of the legend, inches


def model_elevations(
    building: Building, frame: SpaceFrame, heading: Sequence[str] = (), variant: str = ""
) -> Iterator[Named]:
    """Yield an elevation of each plane frame that differs from the others.

    Args:
        building: its grid and supports.
        heading: lines above each drawing; (): none.
        variant: of a study, of which the frames with dampers are drawn; "": all frames are.

    Yields:
        Name of the file, caption and figure.
    """
    for along in DIRECTIONS:
        groups: dict[tuple[object, ...], list[int]] = {}
        for number in range(building.n_frames(along)):
            members = _members(frame, frame_name(along, number, building.axes))
            if members and not (variant and not _devices(building, along, number).look):
                groups.setdefault(_look(building, frame, along, number, members), []).append(number)
        for numbers in groups.values():
            names = [frame_name(along, number, building.axes) for number in numbers]
            caption = (
                f"Frame{'s' * (len(names) > 1)} {some_names(names, 6)} along {along}: spans, heights and levels in m, "
            )
            there = bool(_devices(building, along, numbers[0]).look)
            caption += f"sections, ends of beams, supports{', dampers' * there}."
            if variant:
                caption = f"Variant {variant}: {caption[0].lower()}{caption[1:]}"
            above = (*heading, caption.rstrip(".")) if heading else ()
            draw = partial(_draw, building=building, frame=frame, along=along, number=numbers[0])
            yield file_name("model", *([variant] if variant else []), names[0]), caption, on_sheet(draw, above)


def _members(frame: SpaceFrame, name: str) -> list[Member]:
    return [member for member in frame.members if name in member.frame]


def _look(
    building: Building, frame: SpaceFrame, along: Direction, number: int, members: Sequence[Member]
) -> tuple[object, ...]:
    """What distinguishes an elevation from another one."""
    k = DIRECTIONS.index(along)
    found = frozenset(
        (
            one.kind,
            one.section,
            one.material,
            one.ends,
            one.web if one.kind == "column" else (),
            tuple(frame.coordinates[one.start][[k, 2]].round(6).tolist()),
            tuple(frame.coordinates[one.end][[k, 2]].round(6).tolist()),
        )
        for one in members
    )
    bases = tuple(repr(support) for _, support in _bases(building, along, number))
    ends = EndsOfFrame(building, along, members).look
    return found, bases, _devices(building, along, number).look, _under(building, along, number), ends


def _grid(building: Building, along: Direction) -> Grid:
    xs = building.coordinates(along)
    other: Direction = "y" if along == "x" else "x"
    return Grid.of([line_label(other, i, building.axes) for i in range(len(xs))], xs, building.levels)


def _devices(building: Building, along: Direction, number: int) -> DevicesOnSheet:
    elevation = BuildingElevation(building, frame_name(along, number, building.axes))
    return DevicesOnSheet(building, _grid(building, along), elevation.damper, elevation.name)


def _bases(building: Building, along: Direction, number: int) -> list[tuple[float, Springs | FootingSupport]]:
    """Places along a frame of its column bases, m, with their supports."""
    k = DIRECTIONS.index(along)
    return [(building.place(line)[k], building.support(line)) for line in _lines_of(building, along, number)]


def _draw(sheet: Sheet, building: Building, frame: SpaceFrame, along: Direction, number: int) -> None:
    k = DIRECTIONS.index(along)
    grid = _grid(building, along)
    members = _members(frame, frame_name(along, number, building.axes))
    places = {one.name: [grid.at(*frame.coordinates[n][[k, 2]]) for n in (one.start, one.end)] for one in members}
    ends = {name: (start, end) for name, (start, end) in places.items()}
    draw_axes(sheet, grid)
    for kinds, width in (("column beam", 1.6), ("brace", 1.1)):
        sheet.lines([ends[one.name] for one in members if one.kind in kinds.split()], width=width)
    at = frame.coordinates
    links = {one.name: short(math.dist(at[one.start], at[one.end])) for one in members if one.link}
    sheet.lines([ends[name] for name in links], width=LINK)
    if building.isolation is None:
        entries = _supports(sheet, grid, building, along, number)
    else:
        entries = list(_isolators(sheet, grid, building, along, number))
    nodes = building.grid.nodes
    ends_of_frame = EndsOfFrame(building, along, members)
    entries += ends_of_frame.draw(sheet, ends, lambda node: grid.at(nodes[node][k], nodes[node][2]))
    devices = _devices(building, along, number)
    drawn = devices.draw(sheet)
    if any(one.kind == "brace" for one in members):
        resting = any(one.kind == "brace" and not one.compression for one in members)
        what = ", those that are compressed do not count" if resting else ""
        entries.append(Entry(f"braces have pinned ends{what}"))
    if links:
        text = f"seismic link, e = {', '.join(sorted(set(links.values())))} m"
        entries.append(Entry(text, lambda on, x, y: on.line((x, y), (x + 0.28, y), width=LINK)))
    shapes = {one.section: frame.section(one.section) for one in members}
    weak = {
        one.name
        for one in members
        if is_weak(one, along) and shapes[one.section].I_z < _EQUAL * shapes[one.section].I_y
    }
    left_out = list(_sections(sheet, members, ends, weak)) + devices.draw_sizes(sheet)
    entries += drawn
    entries += _steels(building, members)
    own = dict.fromkeys(one.section for one in members if one.section in building.sections)
    entries += [Entry(section_words(name, building.sections[name])) for name in own]
    if weak:
        entries.append(Entry("(weak): bends about its weak axis in this frame"))
    sheet.legend([*entries, *unwritten(left_out)], WIDTH)


def _steels(building: Building, members: Sequence[Member]) -> Iterator[Entry]:
    """The steels, with the kinds of members that each is of."""
    for name, kinds in steels_of((one.kind, one.material) for one in members).items():
        steel = building.materials[name]
        yield Entry(f"{name}: E = {short(steel.E / 1e9)} GPa, f_y = {short(steel.fy / 1e6)} MPa, {kinds}")


def _lines_of(building: Building, along: Direction, number: int) -> dict[ColumnLine, str]:
    """The column lines of a frame that have a column at the base, with the names of their axes."""
    across: Direction = "y" if along == "x" else "x"
    lines = [line for line in building.layout.node_lines[0] if line.frame(along) == number]
    return {line: line_label(across, line.frame(across), line.axes) for line in lines}


def _under(building: Building, along: Direction, number: int) -> tuple[object, ...]:
    """What distinguishes the isolators below a frame, and what acts beside them along it, from those of others."""
    if building.isolation is None:
        return ()
    lines = {str(line): axis for line, axis in _lines_of(building, along, number).items()}
    items, grid = (*building.isolation.isolators, *building.isolation.beside), building.grid
    return tuple(tuple(lines[line] for line in one.under(tuple(lines), grid)) for one in items if along in one.axes)


def _isolators(sheet: Sheet, grid: Grid, building: Building, along: Direction, number: int) -> Iterator[Entry]:
    lines, k = _lines_of(building, along, number), DIRECTIONS.index(along)
    labels = {str(line): axis for line, axis in lines.items()}
    at = {str(line): grid.across * building.place(line)[k] for line in lines}

    def words(lines: tuple[str, ...]) -> str:
        return axes([labels[line] for line in lines], grid.names)

    return draw_isolation(sheet, building, at, words, "rigid in plan", along)


def _supports(sheet: Sheet, grid: Grid, building: Building, along: Direction, number: int) -> list[Entry]:
    entries = []
    by_kind: dict[str, tuple[Springs | FootingSupport, list[float]]] = {}
    for x, support in _bases(building, along, number):
        by_kind.setdefault(repr(support), (support, []))[1].append(x)
    for support, places in by_kind.values():
        if isinstance(support, FootingSupport):
            kind, words = "footing", footing_words(support.footing)
        else:
            kind = "fixed" if support == FIXED else "pinned" if support == PINNED else "springs"
            words = f"{kind} support" if kind != "springs" else _springs(support)
        for x in places:
            SIGNS[kind](sheet, grid.across * x, 0.0)
        entries.append(support_entry(words, kind))
    return entries


def _springs(support: Springs) -> str:
    parts = [f"{key} {_restraint(key, value)}" for key, value in zip(DEGREES, support.all(), strict=True)]
    return f"support: {', '.join(parts)}"


def _restraint(key: str, value: str | float) -> str:
    if isinstance(value, str):
        return value
    return f"{short(value / 1e6)} MN{'/m' if key.startswith('u') else ' m/rad'}"


def _sections(sheet: Sheet, members: Sequence[Member], ends: dict[str, Line], weak: Collection[str]) -> Iterator[str]:
    """Write the section of equal columns above each other, of equal beams of a floor, and of each brace."""
    several = several_steels((one.kind, one.material) for one in members)

    def words(one: Member) -> str:
        steel = f" {one.material}" if one.kind in several else ""
        return f"{one.section}{steel}{' (weak)' if one.name in weak else ''}"

    def middle(one: Member) -> tuple[float, float]:
        (x0, y0), (x1, y1) = ends[one.name]
        return round(0.5 * (x0 + x1), 6), round(0.5 * (y0 + y1), 6)

    columns = sorted((one for one in members if one.kind == "column"), key=middle)
    for (x, text), run in groupby(columns, key=lambda one: (middle(one)[0], words(one))):
        alike = list(run)
        ys = [middle(one)[1] for one in alike]
        high = min(abs(end[1] - start[1]) for start, end in (ends[one.name] for one in alike))
        order = sorted(ys, key=lambda y: abs(y - 0.5 * (ys[0] + ys[-1])))
        if not name_column(sheet, [(x, y) for y in order], text, high):
            yield f"column {next(one.name for one in columns if middle(one) == (x, ys[0]))}: {text}"
    beams = sorted((one for one in members if one.kind == "beam"), key=lambda one: middle(one)[::-1])
    for (y, text), run in groupby(beams, key=lambda one: (middle(one)[1], words(one))):
        alike = list(run)
        xs = [middle(one)[0] for one in alike if not (one.link and {*one.part} & {0.0, 1.0})]  # not beside a column
        order = sorted(xs, key=lambda x: abs(x - float(np.mean(xs))))
        sides = (("bottom", 0.025), ("top", -0.03))
        spots = [Spot(x + d, y + dy, "center", va) for va, dy in sides for d in (0.0, 0.15) for x in order]
        if not sheet.place(spots, text):
            yield f"beams from {alike[0].name}: {text}"
    seen: set[str] = set()
    for one in (one for one in members if one.kind == "brace"):
        (x0, y0), (x1, y1) = ends[one.name]
        place = one.name.rpartition("_")[0]
        if place in seen:  # the other one of a pair
            continue
        seen.add(place)
        if x1 < x0:
            (x0, y0), (x1, y1) = (x1, y1), (x0, y0)
        angle = math.degrees(math.atan2(y1 - y0, x1 - x0))
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        spots = [
            Spot(
                x0 + share * (x1 - x0) - 0.03 * side * s, y0 + share * (y1 - y0) + 0.03 * side * c, "center", va, angle
            )
            for side, va in ((1.0, "bottom"), (-1.0, "top"))
            for share in ((0.3, 0.7, 0.24, 0.76, 0.2, 0.8, 0.5) if one.bracing == "cross" else (0.5, 0.35, 0.65))
        ]
        if not sheet.place(spots, words(one)):
            yield f"brace {one.name}: {words(one)}"
