"""Where in the building file the members, nodes and blocks stand that an error names."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager

from edesign.core.errors import CoreError
from edesign.errors import InputError
from edesign.project.building.building import Building
from edesign.project.building.layout import ways
from edesign.project.building.names import column_name, node_name
from edesign.project.reading.problems import Keys, keys_text
from edesign.space.free_motion import free_motion

_OF_THE_FILE = ("ED_E_MECHANISM", "ED_E_DISCONNECTED", "ED_E_NOT_FINITE", "ED_E_ARGUMENT", "ED_E_SINGULAR")
"""What the core refuses because of what the file says; memory, for instance, is another matter."""
_NAME = re.compile(r"[A-Z][A-Za-z0-9_']*(?:\.[0-9]+)?")


@contextmanager
def telling_place(building: Building, *keys: str | int) -> Iterator[None]:
    """Give errors of the input inside the place of a block.

    Raises:
        InputError: that of the input, with file, line and column.
    """
    try:
        yield
    except InputError as error:
        raise InputError(f"{building.where(*keys)}: {keys_text(keys)}: {error}") from error


@contextmanager
def telling_member(building: Building) -> Iterator[None]:
    """Give errors of the numerical core inside the place of the first member, node or support that they name.

    Raises:
        InputError: the core refuses what the file says; with file, line and column.
        CoreError: the core cannot go on for another reason.
    """
    try:
        yield
    except CoreError as error:
        if error.status not in _OF_THE_FILE:
            raise
        raise InputError(f"{place_and_motion(building, str(error))}: {error}") from error


def place_and_motion(building: Building, text: str) -> str:
    """Return the place of the first member, node or support that an error names, and what moves of a mechanism.

    Args:
        text: of an error of the numerical core.
    """
    keys = keys_named(building, text)
    motion = free_motion(building, text)
    return f"{building.where(*keys)}: {keys_text(keys)}{f': {motion}' if motion else ''}"


def keys_named(building: Building, text: str) -> Keys:
    """Return the entry of the first member or node that a text names; of none of them that of the supports.

    Args:
        text: of an error.
    """
    places = _members(building)
    places |= {name: keys for name, keys in _nodes(building, places).items() if name not in places}
    found = next((places[name] for name in _NAME.findall(text) if name in places), None)
    return found if found is not None else ("supports",)


def keys_of_member(building: Building, name: str) -> Keys:
    """Return the entry of `columns`, `beams` or `braces` that gives a member."""
    return _members(building)[name]


def _members(building: Building) -> dict[str, Keys]:
    layout = building.layout
    numbers: dict[int, Keys] = {
        id(run): (kind, i) for kind in ("columns", "beams", "braces") for i, run in enumerate(getattr(building, kind))
    }
    found = {column_name(*place): numbers[id(run)] for place, run in layout.column_at.items()}
    for beam, of_beam in layout.beam_at.items():
        found |= dict.fromkeys((str(beam), *layout.beam_members(beam)), numbers[id(of_beam)])
    for brace, of_brace in layout.brace_at.items():
        found |= {brace.name(way): numbers[id(of_brace)] for way in ways(brace, of_brace)}
    return found


def _nodes(building: Building, members: dict[str, Keys]) -> dict[str, Keys]:
    """Of a node at the base its support, of others the column below, or above, or a beam that ends there."""
    layout = building.layout
    found: dict[str, Keys] = {}
    for beam in layout.beam_at:
        for line in beam.lines:
            found[node_name(line, beam.floor)] = members[str(beam)]
    for storeys in (1, 0):  # of two columns the one below counts
        for line, storey in layout.column_at:
            found[node_name(line, storey - storeys)] = members[column_name(line, storey)]
    if building.root.child("supports") is not None:
        found |= {node_name(line, 0): building.support_keys(str(line)) for line in layout.node_lines[0]}
    return found
