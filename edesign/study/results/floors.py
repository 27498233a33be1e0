"""Motions of floors, and of an isolated base.

Horizontal displacements are relative to the ground and include those under gravity. Displacement and acceleration of a
floor are means over its nodes (with a diaphragm all are the same).
"""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel, Sum
from edesign.study.results.recording import Quantity, Terms, coordinate, directed, recorded

_BASE = "floor.0"
"""The node at the centre of mass of an isolated base of a building."""


def floor_displacements(frame: FrameModel, history: bool) -> Quantity:
    """Return the horizontal displacement of each floor as a quantity to be recorded, m.

    Args:
        history: whether values over time are kept.
    """
    cells = _floor_means(frame, "displacement")
    name = "horizontal displacement of the floor relative to the ground, mean over its nodes"
    return Quantity("floor_displacement", *directed(frame, "floor"), cells, "m", name, history)


def floor_accelerations(frame: FrameModel, history: bool) -> Quantity:
    """Return the total horizontal acceleration of each floor as a quantity to be recorded, m/s2.

    Args:
        history: whether values over time are kept.
    """
    cells = _floor_means(frame, "total_acceleration")
    name = "total horizontal acceleration of the floor, mean over its nodes"
    return Quantity(
        "floor_acceleration",
        *directed(frame, "floor"),
        cells,
        "m/s^2",
        name,
        history,
        ("max", "min"),
    )


def floor_relative_accelerations(frame: FrameModel) -> Quantity:
    """Return the horizontal acceleration of each floor relative to the ground, m/s2, as some programs report it."""
    cells = _floor_means(frame, "acceleration")
    name = "horizontal acceleration of the floor relative to the ground, mean over its nodes"
    keep = ("max", "min")
    return Quantity("floor_relative_acceleration", *directed(frame, "floor"), cells, "m/s^2", name, keep=keep)


def floor_rotations(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the turn of each rigid floor about the vertical, rad; nothing for a plane frame.

    Args:
        history: whether values over time are kept.
    """
    cells = tuple(recorded(floor.turn) for floor in frame.floors)
    name = "turn of the floor about the vertical; 0: it does not turn as one"
    return [Quantity("floor_rotation", ("floor",), (len(cells),), cells, "rad", name, history)] if any(cells) else []


def diaphragm_motions(frame: FrameModel, group: Group, history: bool, accelerations: bool = False) -> list[Quantity]:
    """Return the motions of the diaphragms of floors that have several, and add their names to a group.

    Args:
        group: of the analysis.
        history: whether values over time are kept.
        accelerations: whether total accelerations are among them.
    """
    parts = [(floor.number, part) for floor in frame.floors for part in floor.parts]
    if not parts:
        return []
    coordinate(group, "diaphragm", [part.name for _, part in parts], "", "diaphragm as floor.number on it")
    group.add("diaphragm_floor", ("diaphragm",), [floor for floor, _ in parts], "1", "floor of the diaphragm")
    dims, shape = ("diaphragm", "direction"), (len(parts), len(frame.directions))
    moved = [mover for _, part in parts for (mover,) in part.movers]
    label = "horizontal displacement of the diaphragm relative to the ground, at its centre of mass"
    cells = tuple(recorded(mover) for mover in moved)
    found = [Quantity("diaphragm_displacement", dims, shape, cells, "m", label, history)]
    cells = tuple(recorded(part.turn) for _, part in parts)
    label = "turn of the diaphragm about the vertical"
    found.append(Quantity("diaphragm_rotation", dims[:1], shape[:1], cells, "rad", label, history))
    if accelerations:
        cells = tuple(recorded(mover, "total_acceleration") for mover in moved)
        label = "total horizontal acceleration of the diaphragm, at its centre of mass"
        keep = ("max", "min")
        found.append(Quantity("diaphragm_acceleration", dims, shape, cells, "m/s^2", label, history, keep))
    return found


def point_motions(frame: FrameModel, group: Group, history: bool) -> list[Quantity]:
    """Return displacement and total acceleration of named places of floors, and add their names to a group.

    Args:
        group: of the analysis.
        history: whether values over time are kept.
    """
    places = {f"{name}.{floor.number}": moved for floor in frame.floors for name, moved in floor.points.items()}
    if not places:
        return []
    coordinate(group, "point", list(places), "", "place of a floor as column line.floor")
    numbers = [floor.number for floor in frame.floors for _ in floor.points]
    group.add("point_floor", ("point",), numbers, "1", "floor of the place")
    shape = (len(places), len(frame.directions))
    extremes = ("max", "min")
    of_points: tuple[tuple[str, str, str, str, tuple[str, ...]], ...] = (
        ("displacement", "displacement", "m", "displacement of the place from the ground", (*extremes, "final")),
        ("acceleration", "total_acceleration", "m/s^2", "total acceleration of the place", extremes),
    )
    return [
        Quantity(
            f"point_{what}",
            ("point", "direction"),
            shape,
            tuple(recorded(of, kind) for moved in places.values() for of in moved),
            unit,
            label,
            history,
            keep,
        )
        for what, kind, unit, label, keep in of_points
    ]


def base_displacement(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the horizontal displacement of an isolated base, m; nothing for a frame on its supports.

    Args:
        history: whether values over time are kept.
    """
    name = "horizontal displacement of the isolated base relative to the ground"
    terms = _of_base(frame, "displacement")
    return [Quantity("base_displacement", *directed(frame), terms, "m", name, history, tail=True)] if terms else []


def base_rotation(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the turn of an isolated base of a building about the vertical, rad; nothing for other frames.

    Args:
        history: whether values over time are kept.
    """
    if frame.isolated is None or frame.model.dimension == 2:
        return []
    terms = (((1.0, "displacement", frame.nodes[_BASE], len(frame.model.degrees) - 1),),)
    return [Quantity("base_rotation", (), (), terms, "rad", "turn of the isolated base about the vertical", history)]


def base_acceleration(frame: FrameModel, history: bool) -> list[Quantity]:
    """Return the total horizontal acceleration of an isolated base, m/s2; nothing for a frame on its supports.

    Args:
        history: whether values over time are kept.
    """
    name, keep = "total horizontal acceleration of the isolated base", ("max", "min")
    terms = _of_base(frame, "total_acceleration")
    return [Quantity("base_acceleration", *directed(frame), terms, "m/s^2", name, history, keep)] if terms else []


def of_base(frame: FrameModel) -> tuple[Sum, ...]:
    """Return the displacements of an isolated base by direction, at the centre of mass of a building's."""
    if frame.isolated is None:
        return ()
    node = frame.nodes[frame.isolated.isolators[0].column_base if frame.model.dimension == 2 else _BASE]
    return tuple(((1.0, node, direction.degree),) for direction in frame.directions)


def _of_base(frame: FrameModel, kind: str) -> tuple[Terms, ...]:
    """A horizontal quantity of an isolated base; none of a frame on its supports."""
    return tuple(recorded(moved, kind) for moved in of_base(frame))


def _floor_means(frame: FrameModel, kind: str) -> tuple[Terms, ...]:
    """For each floor the mean over its nodes of a horizontal quantity."""
    return tuple(
        tuple(term for mover in movers for term in recorded(mover, kind, 1.0 / len(movers)))
        for floor in frame.floors
        for movers in floor.movers
    )
