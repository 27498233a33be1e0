"""The masses of a plane frame on a sheet, with the sums of masses and loads by floor."""

from __future__ import annotations

from collections.abc import Iterator

from edesign.frame.isolation import base_loads, base_masses
from edesign.frame.loads import floor_loads
from edesign.frame.masses import node_masses
from edesign.project.frame.leaning_column import of_floors
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation
from edesign.report.model.sheet import SMALLEST, SOFT, Point, Sheet
from edesign.report.model.words import short

MASS = "#d9822b"


def draw_masses(sheet: Sheet, place: Elevation, project: Project) -> list[str]:
    """Draw the masses of the nodes, and write sums by floor: mass, gravity combination, load of the leaning column.

    Args:
        place: where metres of the frame are on the sheet.

    Returns:
        The floors for which there is no room, in words.
    """
    frame = project.frame
    of_node, at_base = node_masses(project), base_masses(project)
    floors = {names.node_name(line, f): f for line in frame.lines for f in range(frame.n_storeys + 1)}
    floors |= {frame.beam_name(b, f): f for b in range(1, frame.n_bays + 1) for f in range(frame.n_storeys + 1)}
    mass = [0.0] * (frame.n_storeys + 1)
    for name, value in (*of_node.items(), *at_base.items()):
        mass[floors[name]] += value
    _dots(sheet, place, {**of_node, **at_base})
    gravity = [float(value) for value in floor_loads(project)]
    if project.isolation is not None:
        gravity[0] += sum(base_loads(frame, project.isolation, project.loads.gravity).values())
    columns: list[tuple[str, list[float], float]] = []
    if any(mass):
        columns.append(("mass [t]", mass, 1e3))
    if any(gravity):
        columns.append(("gravity [kN]", gravity, 1e3))
    leaning = frame.leaning_column
    if leaning is not None:
        for case, values in (("G", leaning.G), ("Q", leaning.Q)):
            columns.append((f"leaning {case} [kN]", [0.0, *of_floors(values, frame.n_storeys)], 1e3))
        if leaning.mass is not None:
            columns.append(("leaning [t]", [0.0, *of_floors(leaning.mass, frame.n_storeys)], 1e3))
    return list(_table(sheet, place, columns))


def _dots(sheet: Sheet, place: Elevation, of_node: dict[str, float]) -> None:
    """Circles with areas proportional to the masses."""
    most = max(of_node.values(), default=0.0)
    sizes: dict[float, list[Point]] = {}
    for name, mass in of_node.items():
        if mass > 0.0:
            sizes.setdefault(round(max(2.0, 6.5 * (mass / most) ** 0.5), 1), []).append(place.node(name))
    for size, at in sizes.items():
        sheet.dots(at, size, MASS, "white", mew=0.4, zorder=2.5)


def _table(sheet: Sheet, place: Elevation, columns: list[tuple[str, list[float], float]]) -> Iterator[str]:
    """Columns of numbers beside the floors, with their sums below."""
    frame = place.frame
    left = max(sheet.right, place.width) + 0.3
    above = place.top + 0.26
    below = -0.32
    order = [frame.n_storeys, *range(frame.n_storeys - 1, -1, -1)]
    unlabelled: dict[int, list[str]] = {}
    for header, values, unit in columns:
        words, _, label = header.rpartition(" ")
        sheet.text(Spot(left + 0.45, above, "right", "bottom"), words, SMALLEST, SOFT)
        sheet.text(Spot(left + 0.45, above - 0.1, "right", "bottom"), label, SMALLEST, SOFT)
        for floor in order:
            if values[floor]:
                text = short(values[floor] / unit)
                if not sheet.place([Spot(left + 0.45, place.up * frame.levels[floor], "right")], text):
                    unlabelled.setdefault(floor, []).append(f"{words} {text} {label[1:-1]}")
        sheet.line((left, below + 0.1), (left + 0.45, below + 0.1), color=SOFT, width=0.5)
        sheet.text(Spot(left + 0.45, below, "right"), short(sum(values) / unit))
        left += 0.72
    if columns:
        sheet.text(Spot(left - 0.1, below, "left"), "in all", SMALLEST, SOFT)
    for floor, texts in unlabelled.items():
        yield f"floor {floor}: {', '.join(texts)}"
