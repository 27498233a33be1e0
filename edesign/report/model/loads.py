"""The gravity loads of a plane frame on a sheet by load cases."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby

from edesign.frame.loads import floor_loads
from edesign.project.actions.loads import BeamLoad, FloorLoad
from edesign.project.project import Project
from edesign.report.drawing.style import AFTER
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation
from edesign.report.model.masses import MASS
from edesign.report.model.sheet import Entry, Sheet
from edesign.report.model.supports import axes
from edesign.report.model.words import chosen, in_two_lines, short

G_Q = tuple[float, float]
BAND, ARROW = 0.1, 0.2  # height of line loads and of forces, inches
AREA = "#e3ecf6"
MOST_GIVEN = 4  # masses that the legend lists; of more the sums by floor are printed


@dataclass
class Loaded:
    """The loads of a frame by where they act, G and Q in N and N/m.

    Attributes:
        uniform: on beams, by bay and floor.
        points: on beams: bay, floor, place (m from the start of the beam), load.
        parts: on beams: bay, floor, from and to (m from the start of the beam), G and Q at both ends.
        columns: on columns, to the right, by line and storey.
        nodes: by line and floor.
    """

    uniform: dict[tuple[int, int], G_Q] = field(default_factory=dict)
    points: list[tuple[int, int, float, G_Q]] = field(default_factory=list)
    parts: list[tuple[int, int, float, float, G_Q, G_Q]] = field(default_factory=list)
    columns: dict[tuple[str, int], G_Q] = field(default_factory=dict)
    nodes: dict[tuple[str, int], G_Q] = field(default_factory=dict)


def loads_of(project: Project) -> Loaded:
    """Return the loads on each member and node, those at one place added up."""
    frame, loads, found = project.frame, project.loads, Loaded()
    sums: dict[tuple[int, int], list[float]] = defaultdict(lambda: [0.0, 0.0])
    strips: list[tuple[BeamLoad | FloorLoad, float]] = [(load, 1.0) for load in loads.beams]
    strips += [(load, load.width) for load in loads.floors]
    for strip, width in strips:
        for place in frame.standing_beams(strip):
            sums[place][0] += width * strip.G
            sums[place][1] += width * strip.Q
    found.uniform = {place: (G, Q) for place, (G, Q) in sums.items() if G or Q}
    for load in loads.beams:
        for bay, floor in frame.standing_beams(load):
            span = frame.bay_widths[bay - 1]
            found.points += [(bay, floor, at.along(span), (p.G, p.Q)) for p in load.points for at in p.at]
            for part in load.partial:
                ends = part.start.along(span), part.end.along(span)
                found.parts.append((bay, floor, *ends, part.G, part.Q))
    for one in loads.columns:
        for at in frame.column_places(one):
            if at in frame.column_at:
                G, Q = found.columns.get(at, (0.0, 0.0))
                found.columns[at] = G + one.G, Q + one.Q
    for node in loads.nodes:
        for at in frame.node_places(node.lines, node.floors):
            G, Q = found.nodes.get(at, (0.0, 0.0))
            found.nodes[at] = G + node.G, Q + node.Q
    return found


def draw_loads(sheet: Sheet, place: Elevation, project: Project) -> list[str]:
    """Draw the loads of a project; return values for which there is no room, in words.

    Args:
        place: where metres of the frame are on the sheet.
    """
    found = loads_of(project)
    labels = [  # all signs are drawn before the first label looks for its place; those with few spots come first
        *_nodes(sheet, place, found),
        *_points(sheet, place, found),
        *_parts(sheet, place, found),
        *_uniform(sheet, place, found),
        *_columns(sheet, place, found),
        *_base(sheet, place, project),
    ]
    return [f"{label.where}: {label.text} {label.unit}" for label in labels if not _in_drawing(sheet, label)]


@dataclass(frozen=True)
class _Label:
    """The values of a load, where they may stand, and where the load is, in words."""

    spots: list[Spot]
    text: str
    where: str
    unit: str = "kN/m"


def _in_drawing(sheet: Sheet, label: _Label) -> bool:
    return sheet.place(label.spots, in_two_lines(label.text, ", "), color=AFTER)  # G above Q where the room is narrow


def _g_and_q(load: G_Q) -> str:
    """Return a load by its cases, in kN or kN/m: G 23, Q 9.6; of none of Q the G alone."""
    parts = [f"{case} {short(value / 1e3)}" for case, value in zip("GQ", load, strict=True) if value]
    return ", ".join(parts) or "0"


def _uniform(sheet: Sheet, place: Elevation, found: Loaded) -> Iterator[_Label]:
    frame = place.frame
    xs = [place.across * x for x in frame.x]
    bands = [(xs[b - 1], xs[b], place.up * frame.levels[floor], _high(place, floor)) for b, floor in found.uniform]
    _bands(sheet, bands)
    for floor in range(1, frame.n_storeys + 1):
        loaded = [bay for bay in range(1, frame.n_bays + 1) if (bay, floor) in found.uniform]
        for load, run in groupby(loaded, key=lambda bay, f=floor: found.uniform[bay, f]):  # type: ignore[misc]
            bays = list(run)
            middle = bays[(len(bays) - 1) // 2]
            order = sorted(bays, key=lambda bay, m=middle: abs(bay - m))[:8]  # type: ignore[misc]
            spots = [_above(place, bay, share, floor) for share in (0.5, 0.3, 0.7) for bay in order]
            below = (place.at(frame.x[bay - 1] + 0.5 * frame.bay_widths[bay - 1], frame.levels[floor]) for bay in order)
            spots += [Spot(x, y - 0.03, "center", "top") for x, y in below]
            yield _Label(spots, _g_and_q(load), f"floor {floor}, bays {bays[0]}-{bays[-1]}")


def _high(place: Elevation, floor: int) -> float:
    """Height of the band of a line load on a floor, inches."""
    above = place.storey(floor + 1) if floor < place.frame.n_storeys else BAND / 0.3
    return min(BAND, 0.3 * above)


def _above(place: Elevation, bay: int, share: float, floor: int, lift: float = 0.02) -> Spot:
    x = place.frame.x[bay - 1] + share * place.frame.bay_widths[bay - 1]
    at = place.at(x, place.frame.levels[floor])
    return Spot(at[0], at[1] + _high(place, floor) + lift, "center", "bottom")


def _bands(sheet: Sheet, bands: Sequence[tuple[float, float, float, float]]) -> None:
    """Line loads downwards: rectangles (left, right, low, height in inches) with arrows."""
    boxes = [[(left, y), (right, y), (right, y + high), (left, y + high)] for left, right, y, high in bands]
    sheet.shapes(boxes, AREA, AFTER, 0.5, 1.0)
    arrows = []
    for left, right, y, high in bands:
        count = max(2, round((right - left) / 0.16))
        arrows += [(left + (i + 0.5) * (right - left) / count, y, high) for i in range(count)]
    sheet.lines([((x, y + high), (x, y + 0.01)) for x, y, high in arrows], AFTER, 0.4)
    sheet.dots([(x, y + 0.02) for x, y, _ in arrows], 1.6, AFTER, AFTER, marker="v", mew=0.2)


def _parts(sheet: Sheet, place: Elevation, found: Loaded) -> Iterator[_Label]:
    frame = place.frame
    most = max((G[k] + Q[k] for *_, G, Q in found.parts for k in (0, 1)), default=0.0, key=abs)
    for bay, floor, start, end, G, Q in found.parts:
        y = place.up * frame.levels[floor] + (_high(place, floor) if (bay, floor) in found.uniform else 0.0)
        left, right = (place.across * (frame.x[bay - 1] + at) for at in (start, end))
        heights = [1.3 * BAND * abs((G[k] + Q[k]) / most) if most else BAND for k in (0, 1)]
        sheet.shape([(left, y), (right, y), (right, y + heights[1]), (left, y + heights[0])], "#cfdcec", AFTER, 0.5)
        ends = [_g_and_q((G[k], Q[k])) for k in (0, 1)]
        text = ends[0] if ends[0] == ends[1] else f"{ends[0]} to {ends[1]}"
        middle = 0.5 * (left + right)
        spots = [Spot(middle, y + max(heights) + lift, "center", "bottom") for lift in (0.02, 0.14, 0.26)]
        sheet.block(middle, y + 0.5 * max(heights), right - left, max(heights))
        yield _Label(spots, text, f"floor {floor}, bay {bay}, {start:g} m to {end:g} m")


def _points(sheet: Sheet, place: Elevation, found: Loaded) -> Iterator[_Label]:
    """Forces on beams; equal ones of beams beside each other are labelled once, with the axes between which they act.

    The axes stand there where the beam next to them has other forces.
    """
    frame = place.frame
    on: dict[tuple[int, int], list[tuple[float, G_Q]]] = defaultdict(list)
    for bay, floor, at, load in found.points:
        on[floor, bay].append((round(at, 6), load))
        x, y = place.at(frame.x[bay - 1] + at, frame.levels[floor])
        _force(sheet, x, y + _band(place, found, bay, floor))
    for (floor, forces), bays in _beside_each_other(on):
        touches = any((floor, bay) in on for bay in (bays[0] - 1, bays[-1] + 1))
        where = f"{frame.lines[bays[0] - 1]}-{frame.lines[bays[-1]]}: " if touches and bays[1:] else ""
        middle = 0.5 * (bays[0] + bays[-1])
        for load in dict.fromkeys(load for _, load in forces):
            places = [at for at, one in forces if one == load]
            tips = [
                (x, y + _band(place, found, bay, floor))
                for bay in sorted(bays, key=lambda bay, m=middle: abs(bay - m))  # type: ignore[misc]
                for x, y in (place.at(frame.x[bay - 1] + at, frame.levels[floor]) for at in places)
            ]
            spots = [Spot(x, y + ARROW + 0.02, "center", "bottom") for x, y in tips]
            spots += [Spot(x + 0.03, y + 0.12, "left") for x, y in tips]
            spots += [Spot(x - 0.03, y + 0.12, "right") for x, y in tips]
            spots += [Spot(x, y + ARROW + 0.13, "center", "bottom") for x, y in tips]
            each = " each" if len(places) * len(bays) > 1 else ""
            said = f"bays {bays[0]}-{bays[-1]}" if bays[1:] else f"bay {bays[0]}"
            yield _Label(spots, f"{where}{_g_and_q(load)}{each}", f"floor {floor}, {said}", "kN")


def _beside_each_other(
    on: dict[tuple[int, int], list[tuple[float, G_Q]]],
) -> Iterator[tuple[tuple[int, tuple[tuple[float, G_Q], ...]], list[int]]]:
    """Floor and forces of beams with equal ones, and their bays, which follow each other."""
    order = sorted(on)
    runs = groupby(enumerate(order), key=lambda one: (one[1][0], one[1][1] - one[0], tuple(sorted(on[one[1]]))))
    for (floor, _, forces), run in runs:
        yield (floor, forces), [bay for _, (_, bay) in run]


def _band(place: Elevation, found: Loaded, bay: int, floor: int) -> float:
    """Height of what stands between a beam and the forces on it, inches."""
    return _high(place, floor) if (bay, floor) in found.uniform else 0.0


def _force(sheet: Sheet, x: float, y: float) -> None:
    sheet.line((x, y + ARROW), (x, y + 0.02), color=AFTER, width=0.9, zorder=3.0)
    sheet.dots([(x, y + 0.035)], 3.6, AFTER, AFTER, marker="v")
    sheet.block(x, y + 0.5 * ARROW, 0.05, ARROW)


def _nodes(sheet: Sheet, place: Elevation, found: Loaded) -> Iterator[_Label]:
    """Forces on nodes; equal ones of a floor are labelled once."""
    frame = place.frame
    by_load: dict[tuple[int, G_Q], list[str]] = {}
    for (line, floor), load in found.nodes.items():
        by_load.setdefault((floor, load), []).append(line)
    for (floor, load), lines in by_load.items():
        text = f"{_g_and_q(load)}{' each' if len(lines) > 1 else ''}"
        spots = []
        for line in lines:
            x, y = place.at(frame.x[frame.lines.index(line)], frame.levels[floor])
            _force(sheet, x, y)
            for lift in (0.0, 0.17, 0.24):
                beside = [Spot(x + 0.05, y + ARROW + lift, "left"), Spot(x - 0.05, y + ARROW + lift, "right")]
                spots += beside if line != frame.lines[0] else beside[::-1]
            spots += [Spot(x, y + ARROW + 0.02, "center", "bottom")]
        yield _Label(spots, text, f"floor {floor}, nodes {axes(lines, frame.lines)}", "kN")


def _columns(sheet: Sheet, place: Elevation, found: Loaded) -> Iterator[_Label]:
    frame = place.frame
    for (line, storey), load in found.columns.items():
        x, low = place.at(frame.x[frame.lines.index(line)], frame.levels[storey - 1])
        high = low + place.storey(storey)
        levels = [low + (i + 0.5) * (high - low) / 6.0 for i in range(6)]
        sheet.shape([(x, low), (x, high), (x - BAND, high), (x - BAND, low)], AREA, AFTER, 0.5, zorder=1.0)
        sheet.lines([((x - BAND, y), (x - 0.01, y)) for y in levels], AFTER, 0.4)
        sheet.dots([(x - 0.02, y) for y in levels], 1.6, AFTER, AFTER, marker=">", mew=0.2)
        middle = 0.5 * (low + high)
        text = _g_and_q(load)
        spots = [Spot(x - BAND - 0.02, middle, "center", "bottom", 90.0), Spot(x + 0.03, middle, "center", "top", 90.0)]
        yield _Label(spots, text, f"column {line}, storey {storey}")


def _base(sheet: Sheet, place: Elevation, project: Project) -> Iterator[_Label]:
    """Loads of an isolated base."""
    if project.isolation is None:
        return
    base = project.isolation.base
    if base.G or base.Q:
        _bands(sheet, [(0.0, place.width, 0.0, BAND)])
        text = _g_and_q((base.G, base.Q))
        spots = [Spot(share * place.width, BAND + 0.02, "center", "bottom") for share in (0.5, 0.4, 0.6)]
        yield _Label(spots, text, "isolated base")


def load_entries(project: Project) -> list[Entry]:
    """Return the lines of the legend on the signs and numbers of the loads that occur."""
    found, loads, masses = loads_of(project), project.loads, project.masses
    gravity = loads.gravity
    entries = []
    if found.uniform or found.parts or found.columns or project.isolation is not None:
        entries.append(Entry("line load [kN/m], by load case", _band_sign))
    if found.points or found.nodes:
        entries.append(Entry("force [kN], by load case", lambda on, x, y: _force(on, x + 0.14, y - 0.1), 0.22))
    if masses is not None:
        if masses.from_loads is not None:
            of = f"from {masses.from_loads.G:g} G + {masses.from_loads.Q:g} Q"
        else:
            given = [
                f"{short(item.mass / 1e3)} t at {chosen('line', item.lines)}, {chosen('floor', item.floors)}"
                for item in masses.given or ()
            ]
            of = f"given: {'; '.join(given)}" if len(given) <= MOST_GIVEN else "given node by node"
        of += ", horizontal only" if masses.directions == "horizontal" else ", in both directions"
        entries.append(Entry(f"mass of a node, {of}", lambda on, x, y: on.dots([(x + 0.14, y)], 5.5, MASS, "white")))
    if any(floor_loads(project)) or project.isolation is not None:
        entries.append(Entry(f"gravity: {gravity.G:g} G + {gravity.Q:g} Q, acts before and during earthquakes"))
    return entries


def _band_sign(sheet: Sheet, x: float, y: float) -> None:
    _bands(sheet, [(x, x + 0.28, y - 0.04, 0.09)])
