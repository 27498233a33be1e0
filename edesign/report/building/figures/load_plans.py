"""Loads of the floors of a building on their plans, and sums and masses of the floors."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

from edesign.project.building import Building
from edesign.project.building.isolation import IsolatedBase
from edesign.project.building.loads import Areas, BeamLoad, NodeLoad, PerimeterLoad
from edesign.project.building.places import panels_in
from edesign.report.drawing.captions import file_name
from edesign.report.drawing.style import AFTER
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import BELOW, Grid, draw_plan_axes
from edesign.report.model.figures import Named
from edesign.report.model.sheet import INK, SOFT, Entry, Sheet, on_sheet, unwritten
from edesign.report.model.words import short
from edesign.space.check import floor_loads
from edesign.space.nonlinear.isolation import base_mass
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.masses import floor_masses
from edesign.space.structure.model import masters

WIDTH = 6.4  # of the legend, inches
AREA = "#eaf1f8"

Panel = tuple[int, int]


def load_plans(building: Building, frame: SpaceFrame, heading: Sequence[str] = ()) -> Iterator[Named]:
    """Yield a plan of the loads of each floor that differs from the others.

    Args:
        building: its grid and loads.
        frame: its load cases and masses.
        heading: lines above each drawing; (): none.

    Yields:
        Name of the file, caption and figure.
    """
    groups: dict[str, list[int]] = {}
    for floor in range(1, building.n_storeys + 1):
        look = repr((sorted(building.layout.floors[floor]), _of_floor(building, floor)))
        groups.setdefault(look, []).append(floor)
    if building.isolation is not None:
        caption = "Loads of the isolated base, floor 0, in kN/m² by load case, on the bays that the first floor covers."
        above = (*heading, caption.rstrip(".")) if heading else ()
        draw = partial(_draw_base, building=building, base=building.isolation.base)
        yield file_name("model_loads", "0"), caption, on_sheet(draw, above)
    for floors in groups.values():
        which = f"floor {floors[0]}" if len(floors) == 1 else f"floors {_listed(floors)}"
        caption = f"Loads of {which}: area loads in kN/m² by load case, the arrow along the span of the floor."
        above = (*heading, caption.rstrip(".")) if heading else ()
        draw = partial(_draw, building=building, frame=frame, floors=floors)
        yield file_name("model_loads", str(floors[0])), caption, on_sheet(draw, above)


def _listed(floors: Sequence[int]) -> str:
    whole = floors[-1] - floors[0] + 1 == len(floors)
    return f"{floors[0]}-{floors[-1]}" if whole else ", ".join(map(str, floors))


def _of_floor(building: Building, floor: int) -> list[str]:
    items = (item for item in building.loads.items if floor in item.floors.numbers(1, building.n_storeys))
    return [repr(item.model_copy(update={"floors": None})) for item in items]


def _draw(sheet: Sheet, building: Building, frame: SpaceFrame, floors: Sequence[int]) -> None:
    floor = floors[0]
    panels = building.layout.floors[floor]
    left_out = list(_areas(sheet, building, _bays(sheet, building, panels), floor, panels))
    sheet.legend([*_others(building, floor), *_sums(frame, floors), *unwritten(left_out)], WIDTH)


def _draw_base(sheet: Sheet, building: Building, base: IsolatedBase) -> None:
    panels = building.layout.floors[1]
    grid = _bays(sheet, building, panels)
    text = _case_values(base.G, base.Q, base.category, 1e3)
    for i, j in panels:
        x, y = grid.at(0.5 * (grid.xs[i - 1] + grid.xs[i]), 0.5 * (grid.ys[j - 1] + grid.ys[j]))
        if sheet.fits(text, grid.across * (grid.xs[i] - grid.xs[i - 1]), 6.0):
            sheet.place([Spot(x, y)], text, (6.0,), AFTER)
    area = sum(building.widths("x")[i - 1] * building.widths("y")[j - 1] for i, j in panels)
    sums = [f"{case} {short(load * area / 1e3)} kN" for case, load in (("G", base.G), (f"Q_{base.category}", base.Q))]
    mass = base_mass(building)
    sums = [one for one, load in zip(sums, (base.G, base.Q), strict=True) if load]
    sums += [f"mass {short(mass / 1e3)} t"] * (mass > 0.0)
    sheet.legend([Entry(f"all bays: {text} kN/m²"), Entry(f"floor 0: {', '.join(sums) or 'no load'}")], WIDTH)


def _bays(sheet: Sheet, building: Building, panels: frozenset[Panel]) -> Grid:
    """Draw the axes and the bays that a floor covers, and return where they are."""
    xs, ys = building.coordinates("x"), building.coordinates("y")
    grid = Grid.of([building.axes.name("x", i) for i in range(len(xs))], xs, ys)
    draw_plan_axes(sheet, grid, [building.axes.name("y", j) for j in range(len(ys))])
    for i, j in panels:
        (x0, y0), (x1, y1) = grid.at(xs[i - 1], ys[j - 1]), grid.at(xs[i], ys[j])
        sheet.shape([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], AREA, "#9aa3ae", 0.6, zorder=1.0)
    return grid


def _areas(sheet: Sheet, building: Building, grid: Grid, floor: int, panels: frozenset[Panel]) -> Iterator[str]:
    """Write the loads of each bay; of bays with the same loads in one row once where there is no room for each."""
    n_x, n_y = building.n_bays("x"), building.n_bays("y")
    found: dict[Panel, list[Areas]] = {}
    for load in building.loads.areas:
        if floor in load.floors.numbers(1, building.n_storeys):
            for panel in panels_in(load.bays, n_x, n_y) & panels:
                found.setdefault(panel, []).append(load)
    marks: dict[str, str] = {}
    unlabelled: list[str] = []
    for (i, j), loads in sorted(found.items()):
        text = " + ".join(_case_values(load.G, load.Q, load.category, 1e3, load.G2) for load in loads)
        x0, x1, y0, y1 = grid.xs[i - 1], grid.xs[i], grid.ys[j - 1], grid.ys[j]
        x, y = grid.at(0.5 * (x0 + x1), 0.5 * (y0 + y1))
        wide, high = grid.across * (x1 - x0), grid.up * (y1 - y0)
        fits = sheet.fits(text, wide, 6.0)
        word = text if fits else marks.setdefault(text, f"q{len(marks) + 1}")
        if not sheet.place([Spot(x, y + 0.07)], word, (6.0,), AFTER):
            unlabelled.append(f"bay {i}, {j}: {text}")
        _span(sheet, x, y - 0.07, loads[0], min(0.3 * wide, 0.28), min(0.25 * high, 0.12))
    below = -BELOW - 0.2
    for text, mark in marks.items():
        sheet.text(Spot(0.0, below, "left"), f"{mark}: {text} kN/m²", color=AFTER)
        below -= 0.13
    yield from unlabelled


def _case_values(G: float, Q: float, category: str | None, unit: float, G2: float = 0.0) -> str:
    parts = [f"{name} {short(value / unit)}" for name, value in (("G", G), ("G2", G2)) if value]
    parts += [f"Q_{category} {short(Q / unit)}"] if Q else []
    return ", ".join(parts) or "0"


def _span(sheet: Sheet, x: float, y: float, load: Areas, reach: float, up: float) -> None:
    """Arrows along the span of a floor, and the secondary beams across it as ticks."""
    if load.spans in ("x", "two_way"):
        sheet.line((x - reach, y), (x + reach, y), color=SOFT, width=0.6)
        sheet.dots([(x + reach, y)], 2.6, SOFT, SOFT, marker=">")
        sheet.dots([(x - reach, y)], 2.6, SOFT, SOFT, marker="<")
    if load.spans in ("y", "two_way"):
        sheet.line((x, y - up), (x, y + 0.3 * up), color=SOFT, width=0.6)
        sheet.dots([(x, y + 0.3 * up)], 2.6, SOFT, SOFT, marker="^")
        sheet.dots([(x, y - up)], 2.6, SOFT, SOFT, marker="v")
    for k in range(load.secondary_beams):
        share = -1.0 + 2.0 * (k + 1) / (load.secondary_beams + 1)
        at = (x + share * reach, y) if load.spans == "x" else (x, y - 0.35 * up + 0.65 * share * up)
        across = ((0.0, -0.04), (0.0, 0.04)) if load.spans == "x" else ((-0.04, 0.0), (0.04, 0.0))
        sheet.line(*((at[0] + a, at[1] + b) for a, b in across), color=INK, width=0.8)


def _others(building: Building, floor: int) -> Iterator[Entry]:
    """What the signs mean, and the loads that are no areas, in words."""
    last = building.n_storeys
    if any(floor in load.floors.numbers(1, last) for load in building.loads.areas):
        yield Entry("area load of a bay, kN/m²; arrow: span of the floor, ticks: its secondary beams")
    for load in building.loads.items:
        if isinstance(load, Areas) or floor not in load.floors.numbers(1, last):
            continue
        values = _case_values(load.G, load.Q, load.category, 1e3, load.G2)
        if isinstance(load, PerimeterLoad):
            yield Entry(f"beams at the edge: {values} kN/m")
        elif isinstance(load, BeamLoad):
            places = f"beams along {load.along}, frames {load.frames}, bays {load.bays}"
            if load.G or load.G2 or load.Q or not (load.points or load.partial):
                yield Entry(f"{places}: {values} kN/m")
            for point in load.points:
                forces = _case_values(point.G, point.Q, load.category, 1e3)
                yield Entry(f"{places}, at {', '.join(map(str, point.at))}: {forces} kN")
            for part in load.partial:
                ends = (_case_values(G, Q, load.category, 1e3) for G, Q in zip(part.G, part.Q, strict=True))
                yield Entry(f"{places}, from {part.start} to {part.end}: {' to '.join(dict.fromkeys(ends))} kN/m")
        elif isinstance(load, NodeLoad):
            yield Entry(f"nodes of column lines {load.at}: {values} kN")
    if building.loads.self_weight:
        yield Entry("and the self-weight of the members")


def _sums(frame: SpaceFrame, floors: Sequence[int]) -> Iterator[Entry]:
    """Load of each case and mass of the floors."""
    loads, masses = floor_loads(frame), floor_masses(frame)
    for floor in floors:
        parts = [
            f"{_in_words(case)} {short(values[floor] / 1e3)} kN" for case, values in loads.items() if values[floor]
        ]
        if masses.mass[floor] > 0.0:
            centre = f"at x = {masses.x[floor]:.2f} m, y = {masses.y[floor]:.2f} m"
            parts.append(f"mass {short(masses.mass[floor] / 1e3)} t {centre}")
        yield Entry(f"floor {floor}: {', '.join(parts) or 'no load'}")
        for number, at in enumerate(frame.diaphragms):
            mass = frame.node_mass[frame.node_diaphragm == number].sum()
            if at.part and at.floor == floor and mass > 0.0:
                x, y = masters(frame)[number]
                yield Entry(f"its diaphragm {at}: mass {short(mass / 1e3)} t at x = {x:.2f} m, y = {y:.2f} m")


def _in_words(case: str) -> str:
    """A load case as it is called: the one that has no symbol is the self-weight."""
    return case.replace("_", "-") if case == "self_weight" else case
