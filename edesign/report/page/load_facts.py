"""The loads of a project in words and key numbers."""

from __future__ import annotations

from edesign.project.actions.loads import BeamLoad, ColumnLoad, FloorLoad
from edesign.project.frame.leaning_column import LeaningColumn
from edesign.project.project import Project
from edesign.report.drawing.captions import plain

Rows = list[tuple[str, str]]


def load_rows(project: Project) -> Rows:
    """Return a row for each kind of load, and the gravity combination; absent ones have an empty text."""
    loads = project.loads
    on_nodes = sum(len(project.frame.node_places(load.lines, load.floors)) for load in loads.nodes)
    combination = f"{loads.gravity.G:g} G + {loads.gravity.Q:g} Q"
    return [
        ("Floor loads", "; ".join(map(_floor, loads.floors))),
        ("Beam loads", "; ".join(map(_beam, loads.beams))),
        ("Column loads", "; ".join(map(_column, loads.columns))),
        ("Nodal loads", f"at {on_nodes} nodes" if on_nodes else ""),
        ("Leaning column", _leaning(project.frame.leaning_column)),
        ("Gravity", combination if loads.are_vertical or loads.columns or project.frame.leaning_column else ""),
    ]


def _floor(load: FloorLoad) -> str:
    values = f"G = {plain(load.G / 1e3)} kN/m², Q = {plain(load.Q / 1e3)} kN/m²"
    return f"{_beams(load)}: {values} on a tributary width of {load.width:g} m"


def _beam(load: BeamLoad) -> str:
    parts = []
    if load.G or load.Q or not (load.points or load.partial):
        parts.append(f"G = {plain(load.G / 1e3)} kN/m, Q = {plain(load.Q / 1e3)} kN/m")
    for point in load.points:
        places = ", ".join(str(at) for at in point.at)
        parts.append(f"G = {plain(point.G / 1e3)} kN, Q = {plain(point.Q / 1e3)} kN at {places}")
    for part in load.partial:
        parts.append(f"G = {_ends(part.G)} kN/m, Q = {_ends(part.Q)} kN/m from {part.start} to {part.end}")
    return f"{_beams(load)}: {'; '.join(parts)}"


def _leaning(column: LeaningColumn | None) -> str:
    if column is None:
        return ""
    parts = [f"G = {_of_floors(column.G, 1e3)} kN, Q = {_of_floors(column.Q, 1e3)} kN"]
    if column.mass is not None:
        parts.append(f"mass = {_of_floors(column.mass, 1e3)} t")
    return f"at each floor {', '.join(parts)}"


def _of_floors(values: float | tuple[float, ...], unit: float) -> str:
    several = values if isinstance(values, tuple) else (values,)
    return " / ".join(plain(value / unit) for value in several)


def _ends(values: tuple[float, float]) -> str:
    first, second = (plain(value / 1e3) for value in values)
    return first if first == second else f"{first} to {second}"


def _column(load: ColumnLoad) -> str:
    where = f"{_named('line', load.lines)}, {_named('storey', load.storeys)}"
    where = where.replace("lines all, storeys all", "all columns").removesuffix(", storeys all")
    return f"{where}: G = {plain(load.G / 1e3)} kN/m, Q = {plain(load.Q / 1e3)} kN/m to the right"


def _beams(load: FloorLoad | BeamLoad) -> str:
    where = f"{_named('floor', load.floors)}, {_named('bay', load.bays)}"
    return where.replace("floors all, bays all", "all beams").removesuffix(", bays all")


def _named(kind: str, chosen: object) -> str:
    """One place, or the places, of a selection, as `floor 1` and `floors 1-3`."""
    text = str(chosen)
    return f"{kind} {text}" if text.isalnum() and text != "all" else f"{kind}s {text}"
