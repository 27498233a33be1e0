"""Which nodes the results of a script are of."""

from __future__ import annotations

from collections.abc import Iterator

from edesign.exchange.opensees.commands import Value
from edesign.exchange.opensees.structure import Structure
from edesign.frame.frame_model import Floor, FrameModel, RigidPart, Sum

Outputs = dict[str, Value | dict[str, Value]]


def outputs(frame: FrameModel, structure: Structure) -> Outputs:
    """Return the constants of a script that say which nodes its results are of."""
    reactions: dict[str, Value] = {
        name: tuple(
            tuple(_reacting(frame, structure, name, degree)) if held else () for degree, held in enumerate(restrained)
        )
        for name, restrained in frame.supports.items()
    }
    nodes: Outputs = {"NODES": {name: structure.nodes[node] for name, node in frame.nodes.items()}}
    return (
        nodes | (_of_building if structure.dimension == 3 else _of_frame)(frame, structure) | {"REACTIONS": reactions}
    )


def bases(frame: FrameModel, structure: Structure) -> tuple[tuple[int, ...], ...]:
    """Tags of the nodes whose reactions are the base shear by direction, that of the leaning column among them."""
    found = []
    for direction in frame.directions:
        supports = [name for name, fixed in frame.supports.items() if fixed[direction.degree]]
        tags = [tag for name in supports for tag in _reacting(frame, structure, name, direction.degree)]
        if frame.leaning is not None:
            tags += [structure.nodes[one] for one in (frame.leaning.base, *structure.copies[frame.leaning.base])]
        found.append(tuple(tags))
    return tuple(found)


def _of_frame(frame: FrameModel, structure: Structure) -> Outputs:
    return {
        "FLOORS": tuple(tuple(structure.nodes[node] for ((_, node, _),) in floor.movers[0]) for floor in frame.floors),
        "STOREY_HEIGHTS": tuple(storey.height for storey in frame.storeys),
        "CONTROL": structure.nodes[frame.control],
    }


def _of_building(frame: FrameModel, structure: Structure) -> Outputs:
    drifts = tuple(
        (storey.number, direction.name, tuple(_sum(line.ratio, structure) for line in lines))
        for storey in frame.storeys
        for direction, lines in zip(frame.directions, storey.drifts, strict=True)
    )
    return {"FLOORS": tuple(_floors(frame, structure)), "DRIFTS": drifts, "CONTROL": structure.nodes[frame.control]}


def _floors(frame: FrameModel, structure: Structure) -> Iterator[Value]:
    """Name, way, unit and sum of what a floor of a building does, which its first mover leads, and its diaphragms."""
    for floor in frame.floors:
        named: list[tuple[int | str, Floor | RigidPart]] = [(floor.number, floor)]
        named += [(part.name, part) for part in floor.parts]
        for name, of in named:
            for direction, (mover, *_) in zip(frame.directions, of.movers, strict=True):
                yield name, direction.name, "m", _sum(mover, structure)
            if of.turn:
                yield name, "turn", "rad", _sum(of.turn, structure)


def _sum(terms: Sum, structure: Structure) -> Value:
    return tuple((factor, structure.nodes[node], degree + 1) for factor, node, degree in terms)


def _reacting(frame: FrameModel, structure: Structure, support: str, degree: int) -> list[int]:
    """Tags of the nodes whose reactions are that of a support."""
    terms = frame.reaction(support, degree)
    nodes = [node for _, kind, node, _ in terms if kind == "reaction"]
    nodes += [
        structure.below[number] for _, kind, number, _ in terms if kind == "damper_force" and number in structure.below
    ]
    moving = degree <= frame.up
    return [structure.nodes[one] for node in nodes for one in (node, *(structure.copies[node] if moving else ()))]
