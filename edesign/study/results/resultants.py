"""Resultants of what a building does along x and y at one instant."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from edesign.archive.dataset import Group
from edesign.core import Channel, Response
from edesign.project.criteria.measures import RESULTANTS
from edesign.study.results.recording import Quantity


class Resultants:
    """The largest resultants over all steps, with their directions; a plane frame has none.

    Args:
        recorded: what a history records.
    """

    def __init__(self, recorded: Iterable[Quantity]) -> None:
        self._of = [one for one in recorded if one.name in RESULTANTS and one.dims[-1:] == ("direction",)]

    def channels(self) -> list[Channel]:
        """Return the channels, which come after those of the quantities."""
        return [
            Channel(f"{keys[i]}_resultant", history=False, beside=(keys[i], keys[i + 1]))
            for keys in (one.keys for one in self._of)
            for i in range(0, len(keys), 2)
        ]

    def store(self, group: Group, response: Response) -> None:
        """Add the largest resultants and their directions to a group.

        Args:
            group: of the history.
            response: with the channels.
        """
        for one in self._of:
            names = [f"{one.keys[i]}_resultant" for i in range(0, len(one.keys), 2)]
            parts = (
                ("max", response.maximum, one.unit, "largest resultant of both directions"),
                ("angle", response.angle, "rad", "direction of its largest resultant, from x towards y"),
            )
            for ending, found, unit, words in parts:
                values = np.array([found[name] for name in names]).reshape(one.shape[:-1])
                group.add(f"{one.name}_resultant_{ending}", one.dims[:-1], values, unit, f"{one.long_name}, {words}")
