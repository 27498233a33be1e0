"""Plans of a building: grid, columns as they stand, beams with their ends, bracing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import groupby

import numpy as np

from edesign.archive.reader import Archive
from edesign.report.building.figures.elevations import grid_lines, hinges
from edesign.report.building.results import BuildingResults, BuildingValues
from edesign.report.drawing.style import AFTER, TARGET
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Grid, draw_plan_axes
from edesign.report.model.figures import Named
from edesign.report.model.sheet import INK, SMALLEST, TEXT, Entry, Sheet, on_sheet

KINDS = ("column", "beam", "brace")
MARKS = "abcdefghijkl"
"""Of members whose sections change from storey to storey; with more of them plans are drawn apart."""
_Place = tuple[str, tuple[float, ...]]
_BEAM = "#7c8796"
_COLUMN = 0.11  # size of a column in the drawing, by the narrowest bay
_BRACE = 0.05  # how far a brace is drawn beside its beam, by the narrowest bay
_SAME = 1e-6  # inches
_SIZE = 4.8  # of the longer side, inches
_LARGEST = 0.07  # of a column, inches


def plans(archive: Archive) -> Iterator[Named]:
    """Yield the plans of the storeys that differ.

    Yields:
        Name of the file, caption and figure.
    """
    return plans_of(BuildingResults(archive))


def plans_of(results: BuildingValues, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield the plans of the storeys of a building that differ.

    Args:
        results: members and nodes of the building.
        heading: lines above each drawing; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    for storeys, marked in _alike(results):
        which = f"storey {storeys[0]}" if len(storeys) == 1 else f"storeys {_runs(storeys)}"
        letters = " Letters stand for sections that change from storey to storey, as below the plan." * any(
            len(set(sections)) > 1 for _, sections in marked.values()
        )
        caption = (
            f"Plan of {which}, widths in m. Columns with the direction of their webs, the beams above them, circles at "
            f"pinned ends, dashes beside braced bays, crosses at centres of mass.{letters} "
            f"Sections: {_sections(results, storeys)}."
        )
        above = (*heading, f"Plan of {which}") if heading else ()
        draw = partial(_draw, results=results, storeys=storeys, marked=marked)
        yield f"plan_{storeys[0]}", caption, on_sheet(draw, above)


_Marked = dict[_Place, tuple[str, tuple[str, ...]]]
"""Kind and sections by storey of the members at each place of a plan."""


def _alike(results: BuildingValues) -> list[tuple[list[int], _Marked]]:
    """Storeys with members of equal kinds in equal places, from below, and the members of each place.

    Where sections change in more ways than there are `MARKS`, storeys with equal sections are put together.
    """
    layouts: dict[frozenset[_Place], list[int]] = {}
    found = _members_by_storey(results)
    for storey, members in found.items():
        layouts.setdefault(frozenset(members), []).append(storey)
    groups = []
    for storeys in layouts.values():
        marked = _marked(found, storeys)
        if len({one for one in marked.values() if len(set(one[1])) > 1}) <= len(MARKS):
            groups.append((storeys, marked))
            continue
        equal: dict[tuple[tuple[_Place, str], ...], list[int]] = {}
        for storey in storeys:
            equal.setdefault(tuple(sorted(found[storey].items())), []).append(storey)
        groups += [(alike, _marked(found, alike)) for alike in equal.values()]
    return sorted(groups, key=lambda group: group[0])


def _marked(found: dict[int, dict[_Place, str]], storeys: Sequence[int]) -> _Marked:
    return {place: (place[0], tuple(found[storey][place] for storey in storeys)) for place in found[storeys[0]]}


def _members_by_storey(results: BuildingValues) -> dict[int, dict[_Place, str]]:
    """The sections of each storey by the place of their members; those of several in one place are joined."""
    found: dict[int, dict[_Place, str]] = {}
    places = _places(results)
    section, storeys = (results.values("members", name).tolist() for name in ("section", "storey"))
    for place, name, storey in sorted(zip(places, section, storeys, strict=True), key=lambda one: (one[2], one[1])):
        of_storey = found.setdefault(int(storey), {})
        known = of_storey.get(place, "").split(", ")
        of_storey[place] = name if known == [""] else ", ".join(dict.fromkeys([*known, name]))
    return found


def _places(results: BuildingValues) -> list[_Place]:
    """Kind of each member with its place in plan, the web of a column, and its pinned ends."""
    names = ("kind", "start", "end", "web", "ends")
    kind, start, end, web, ends = (results.values("members", name) for name in names)
    turned = (kind == "brace") & (start[:, 0] + start[:, 1] > end[:, 0] + end[:, 1])  # in plan both ways are alike
    start, end = (np.where(turned[:, None], b, a) for a, b in ((start, end), (end, start)))
    web = np.where((kind == "column")[:, None], web, 0.0)
    rows = np.concatenate([start[:, :2], end[:, :2], web, ends > 0.0], axis=1).round(6) + 0.0
    return list(zip(kind.tolist(), map(tuple, rows.tolist()), strict=True))


def _runs(numbers: list[int]) -> str:
    """1-4, 6 of numbers in rising order."""
    runs = [[n for _, n in run] for _, run in groupby(enumerate(numbers), key=lambda pair: pair[1] - pair[0])]
    return ", ".join(str(run[0]) if len(run) == 1 else f"{run[0]}-{run[-1]}" for run in runs)


def _draw(sheet: Sheet, results: BuildingValues, storeys: Sequence[int], marked: _Marked) -> None:
    storey = storeys[0]
    across_x, across_y = grid_lines(results)
    xs, ys = (tuple(place for _, place in lines) for lines in (across_x, across_y))
    scale = _SIZE / max(xs[-1] - xs[0], ys[-1] - ys[0])  # inches a metre
    narrow = scale * float(min(np.diff(xs).min(initial=np.inf), np.diff(ys).min(initial=np.inf)))
    draw_plan_axes(sheet, Grid(tuple(name for name, _ in across_x), xs, ys, scale, scale), [n for n, _ in across_y])
    of_storey = results.values("members", "storey") == storey
    kind = results.values("members", "kind")
    columns, beams, braces = (np.flatnonzero(of_storey & (kind == name)) for name in ("column", "beam", "brace"))
    start, end = (scale * results.values("members", name)[:, :2] for name in ("start", "end"))
    sheet.lines(np.stack([start[beams], end[beams]], axis=1), _BEAM, 1.3, zorder=1.0)
    size = min(_COLUMN * narrow, _LARGEST)
    sheet.dots(scale * hinges(results, beams, 1.3 * size / scale)[:, :2], 2.8, mew=0.6, zorder=2.0)
    sheet.lines([line for n in columns for line in _column_lines(results, int(n), size, scale)], width=1.5, zorder=3.0)
    beside = _BRACE * narrow
    dashes = [line for n in braces if (line := _brace_line(start[n], end[n], beside)) is not None]
    sheet.lines(dashes, AFTER, 1.3, linestyle=(0, (4, 2)), zorder=2.0)
    floors = results.values("floors", "floor").tolist()
    centres = [[scale * float(results.values("floors", of)[floors.index(n)]) for of in "xy"] for n in storeys]
    sheet.dots(
        list(dict.fromkeys((round(x, 2), round(y, 2)) for x, y in centres)), 5.0, edge=TARGET, marker="x", mew=1.0
    )
    kinds = dict.fromkeys(one for one in marked.values() if len(set(one[1])) > 1)
    letters = dict(zip(sorted(kinds, key=lambda one: KINDS.index(one[0])), MARKS, strict=False))
    words = {n: letters.get(one, one[1][0]) for n, place in enumerate(_places(results)) if (one := marked.get(place))}
    leaning = np.array([n for n in braces if np.any(start[n] != end[n])], dtype=int)
    start, end, beams = _wholes(results, start, end, beams, words)
    braced = [n for n in beams if any(_stands_on(start[m], end[m], start[n], end[n]) for m in leaning)]
    along_x = np.abs(end - start)[beams, 0] > np.abs(end - start)[beams, 1]

    def of_beam(n: int) -> Iterable[Spot]:
        spots = list(_along(start[n], end[n], 0.02, -0.02, words[n] in MARKS))
        return spots[1::2] + spots[::2] if n in braced else spots  # dashes stand on the first side

    for numbers, color, spots in (
        (leaning, AFTER, lambda n: _along(start[n], end[n], beside + 0.05, -0.02, words[n] in MARKS)),
        (columns, INK, lambda n: _around(start[n], size + 0.02)),
        (beams[along_x], INK, of_beam),
        (beams[~along_x], INK, of_beam),
    ):
        names = dict.fromkeys(words[int(n)] for n in numbers)
        one_name = len(names) == 1
        for name in names:
            alike = [n for n in map(int, numbers) if words[n] == name][::-1]
            if one_name:
                ways = zip(*(spots(n) for n in alike), strict=True)  # the first choice of all of them comes first
                sheet.place([spot for way in ways for spot in way], name, (SMALLEST,), color)
                continue
            for n in alike:
                sheet.place(spots(n), name, (TEXT if name in MARKS else SMALLEST,), color)
    sheet.legend([Entry(text) for text in _changing(letters, storeys)], sheet.right)


def _wholes(
    results: BuildingValues, start: np.ndarray, end: np.ndarray, beams: np.ndarray, words: Mapping[int, str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Starts and ends with beams whole that braces meet, and one member of each beam: parts of a section are one."""
    start, end, found = start.copy(), end.copy(), dict[tuple[str, str], list[int]]()
    for n in beams:
        bay = "_".join(str(results.values("members", "member")[n]).split("_")[:4])  # BX_2_1_4 of BX_2_1_4_3
        found.setdefault((bay, words[int(n)]), []).append(int(n))
    for parts in found.values():
        both = np.concatenate([start[parts], end[parts]])
        start[parts], end[parts] = both.min(axis=0), both.max(axis=0)
    return start, end, np.array([parts[0] for parts in found.values()], dtype=int)


def _stands_on(start: np.ndarray, end: np.ndarray, first: np.ndarray, last: np.ndarray) -> bool:
    """Whether a line between two points in plan lies on another one."""
    low, high = np.minimum(first, last) - _SAME, np.maximum(first, last) + _SAME
    return bool(np.all([(low <= point) & (point <= high) for point in (start, end)]))


def _changing(letters: Mapping[tuple[str, tuple[str, ...]], str], storeys: Sequence[int]) -> Iterator[str]:
    """What each letter stands for: a: columns HEB300 in storeys 1-2, HEB240 in storey 3."""
    for (kind, sections), letter in letters.items():
        by_section = {
            name: [n for n, other in zip(storeys, sections, strict=True) if other == name] for name in sections
        }
        place = "on floor" if kind == "beam" else "in storey"
        parts = (f"{name} {place}{'s' * (len(of) > 1)} {_runs(of)}" for name, of in by_section.items())
        yield f"{letter}: {kind}s {', '.join(parts)}"


def _along(start: np.ndarray, end: np.ndarray, above: float, below: float, letter: bool) -> Iterable[Spot]:
    """Places of a text on the two sides of a line: above and below, or at the left and the right, inches.

    There it is turned, if it is not one letter.
    """
    level = abs(end[0] - start[0]) > abs(end[1] - start[1])
    found = []
    for x, y in (start + share * (end - start) for share in (0.5, 0.35, 0.65)):
        if level:
            found += [Spot(x, y + above, "center", "bottom"), Spot(x, y + below, "center", "top")]
        elif letter:
            found += [Spot(x - above, y, "right"), Spot(x - below, y, "left")]
        else:
            found += [Spot(x - above, y, "center", "bottom", 90.0), Spot(x - below, y, "center", "top", 90.0)]
    return found


def _around(at: np.ndarray, gap: float) -> Iterable[Spot]:
    """Places of a text beside a column, inches."""
    return tuple(
        Spot(at[0] + u * gap, at[1] + v * gap, "left" if u > 0 else "right", "bottom" if v > 0 else "top")
        for u, v in ((1, 1), (1, -1), (-1, 1), (-1, -1))
    )


def _brace_line(start: np.ndarray, end: np.ndarray, beside: float) -> np.ndarray | None:
    """The line of a brace, (2, 2) inches, beside the beam above it; None of an upright one."""
    way = end - start
    length = float(np.hypot(*way))
    if length == 0.0:
        return None
    side = beside * np.array([-abs(way[1]), abs(way[0])]) / length
    return np.array([start + 0.12 * way + side, end - 0.12 * way + side])


def _column_lines(results: BuildingValues, number: int, size: float, scale: float) -> list[np.ndarray]:
    """An I with its web as it stands, a circle, or a rectangle like the section, as lines of points, inches."""
    section = results.section(str(results.values("members", "section")[number]))
    middle = scale * results.values("members", "start")[number][:2]
    web = results.values("members", "web")[number][:2]
    web = web / max(float(np.hypot(*web)), 1e-12)
    flange = np.array([-web[1], web[0]])
    if section.kind == "CHS":
        turn = np.linspace(0.0, 2.0 * np.pi, 25)
        return [middle + 0.8 * size * np.column_stack([np.cos(turn), np.sin(turn)])]
    if section.kind == "RHS":
        sides = size / max(section.h, section.b) * np.array([section.h, section.b])
        corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1)]) * sides
        return [middle + corners @ np.array([web, flange])]
    ends = [middle + size * web, middle - size * web]
    return [np.array(ends), *(np.array([of + size * flange, of - size * flange]) for of in ends)]


def _sections(results: BuildingValues, storeys: Sequence[int]) -> str:
    """The sections of storeys in words."""
    of_storeys = np.isin(results.values("members", "storey"), storeys)
    kind, section = (results.values("members", name)[of_storeys] for name in ("kind", "section"))
    kinds = [(name, dict.fromkeys(section[kind == name].tolist())) for name in KINDS]
    return "; ".join(f"{name}s {', '.join(sections)}" for name, sections in kinds if sections)
