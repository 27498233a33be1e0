"""The results of a building in its archive, read group by group; what is not there is named."""

from __future__ import annotations

from typing import Protocol

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.errors import ArchiveError, InputError
from edesign.space.archived import PLACE
from edesign.study.results.kinds import BUILDING

UNITS = {
    "N": ("kN", 1e3),
    "N*m": ("kN*m", 1e3),
    "Pa": ("MPa", 1e6),
    "m2": ("cm2", 1e-4),
    "m3": ("cm3", 1e-6),
    "m4": ("cm4", 1e-8),
    "m6": ("cm6", 1e-12),
    "1": ("", 1.0),
}
"""Unit of the archive: the one that is shown, and how much it is."""


class BuildingValues(Protocol):
    """Values of a building for its drawings, from an archive or from the model alone."""

    def values(self, name: str, variable: str) -> np.ndarray:
        """Return the values of a variable or coordinate of a group.

        Args:
            name: name of the group.
            variable: name of the variable.
        """


class BuildingResults:
    """The groups of a building below its place in an archive, each read once.

    Args:
        archive: open, of a building.
    """

    def __init__(self, archive: Archive) -> None:
        self.archive = archive
        self._groups: dict[str, Group] = {}

    def has(self, name: str) -> bool:
        """Return whether a readable group is there."""
        return self.archive.has(_place(name))

    def group(self, name: str = "") -> Group:
        """Return a group by its name below that of the building, which is "".

        Raises:
            ArchiveError: it is missing or damaged.
        """
        if name not in self._groups:
            self._groups[name] = self.archive.group(_place(name))
        return self._groups[name]

    def values(self, name: str, variable: str) -> np.ndarray:
        """Return the values of a variable or coordinate of a group.

        Args:
            name: name of the group.
            variable: name of the variable.

        Raises:
            ArchiveError: there is none.
        """
        group = self.group(name)
        found = group.variables.get(variable) or group.coords.get(variable)
        if found is None:
            raise self._incomplete(name, variable)
        return found.values

    def number(self, attribute: str, name: str = "") -> float:
        """Return a number among the attributes of a group.

        Args:
            attribute: name of the attribute.
            name: name of the group.

        Raises:
            ArchiveError: there is none.
        """
        try:
            return float(str(self.group(name).attributes[attribute]))
        except (KeyError, ValueError) as error:
            raise self._incomplete(name, attribute) from error

    def text(self, attribute: str, name: str = "") -> str:
        """Return a text among the attributes of a group, "" if there is none.

        Args:
            attribute: name of the attribute.
            name: name of the group.
        """
        return str(self.group(name).attributes.get(attribute, ""))

    def _incomplete(self, name: str, what: str) -> ArchiveError:
        return ArchiveError(
            f"{self.archive.path}: {_place(name)} has no `{what}`: the archive is damaged, or of another version; "
            "`edesign run` makes it anew"
        )


def building_results(archive: Archive) -> BuildingResults:
    """Return the results of a building.

    Raises:
        InputError: the archive is not that of a building.
    """
    if archive.attributes.get("kind") != BUILDING:
        raise InputError(f"{archive.path}: this is not the archive of a building, and has no members to show")
    return BuildingResults(archive)


def _place(name: str) -> str:
    return f"{PLACE}/{name}" if name else PLACE
