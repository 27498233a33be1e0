"""Selections of nodes on the grid of a frame."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.project import names
from edesign.project.project import Project
from edesign.project.selections import LineSelection, NumberSelection


def chosen_nodes(
    project: Project, lines: LineSelection, floors: NumberSelection, keys: tuple[str | int, ...]
) -> list[str]:
    """Return the names of the selected nodes, floor by floor from the left.

    Places of the grid where no member ends have no node. A selection that says `all` passes over them; one that names
    them is wrong.

    Args:
        project: the validated project.
        lines, floors: the selection.
        keys: where it stands in the project file, for the message.

    Raises:
        InputError: a named node does not exist.
    """
    frame = project.frame
    chosen = [names.node_name(*place) for place in frame.node_places(lines, floors)]
    if lines.is_all or floors.is_all:
        return chosen
    for floor in floors.numbers(1, frame.n_storeys):
        for line in lines.names(frame.lines):
            if names.node_name(line, floor) not in frame.nodes:
                where = f"{project.where(*keys)}: {'.'.join(map(str, keys))}"
                raise InputError(f"{where}: there is no node {names.node_name(line, floor)}: no member ends there")
    return chosen
