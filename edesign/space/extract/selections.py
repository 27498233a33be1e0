"""Values by places of a frame as the runs of a project file."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeVar

V = TypeVar("V")


def runs(
    values: Mapping[tuple[int, int], V], along: Sequence[int], n_storeys: int, name: Callable[[int], str]
) -> list[tuple[str, str, V]]:
    """Return selections along and up the frame that together say where each value stands.

    Args:
        values: by (line from 0 or bay from 1, storey or floor); places may be missing.
        along: numbers of all lines or bays.
        name: of a line or bay.
    """
    rows: dict[tuple[tuple[int, ...], V], list[int]] = {}
    for storey in range(1, n_storeys + 1):
        row: dict[V, list[int]] = {}
        for place in along:
            if (place, storey) in values:
                row.setdefault(values[place, storey], []).append(place)
        for value, places in row.items():
            rows.setdefault((tuple(places), value), []).append(storey)
    every = list(range(1, n_storeys + 1))
    return [
        (selection(list(places), list(along), name), selection(storeys, every, str), value)
        for (places, value), storeys in rows.items()
    ]


def selection(chosen: list[int], everything: list[int], name: Callable[[int], str]) -> str:
    """Return a selection as a file writes it: `all`, `3`, `1-4`, `[1, 3-5]`.

    Args:
        everything: all numbers there are.
        name: gives the name of a number.
    """
    if chosen == everything:
        return "all"
    spans: list[list[int]] = []
    for number in chosen:
        if spans and number == spans[-1][1] + 1:
            spans[-1][1] = number
        else:
            spans.append([number, number])
    texts = [name(a) if a == b else f"{name(a)}-{name(b)}" for a, b in spans]
    return texts[0] if len(texts) == 1 else f"[{', '.join(texts)}]"


def value(number: float, unit: str) -> str:
    """Return a number with its unit, six digits.

    Args:
        unit: its symbol.
    """
    return f"{number:.6g} {unit}"
