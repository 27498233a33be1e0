"""The results of a building in its archive, read group by group; what is not there is named."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.archive.reader import Archive
from edesign.codes.ec3.section import SteelSection
from edesign.errors import ArchiveError, InputError
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.steel_section import steel_section
from edesign.project.building.building import Building
from edesign.report.archived import archived_building
from edesign.report.tables.cell import Verdict
from edesign.report.tables.unit import CM2, CM3, CM4, CM6, KN, MPA, ONE, Unit
from edesign.space.archived import PLACE
from edesign.study.results.kinds import BUILDING

UNITS = {
    "N": KN,
    "N*m": Unit("kN*m", 1e3),
    "Pa": MPA,
    "m2": CM2,
    "m3": CM3,
    "m4": CM4,
    "m6": CM6,
    "1": ONE,
}
"""Unit of the archive: the one that is shown."""


MET, NOT_MET = Verdict("met", "good"), Verdict("not met", "bad")
"""Of the rules for the building."""


class Row(dict[str, Any]):
    """The values at one place along a dimension of a group, by variable; each is read when it is asked for.

    Args:
        dimension: such as `storey`.
        number: of the place, from 0.
    """

    def __init__(self, results: BuildingResults, name: str, dimension: str, number: int) -> None:
        super().__init__()
        self.number = number
        self._of = results, name, dimension

    def __missing__(self, variable: str) -> Any:
        """Return the value of a variable here, or its values along its other dimensions.

        Raises:
            ArchiveError: there is none.
        """
        results, name, dimension = self._of
        found = results.variable(name, variable)
        here = found.values.take(self.number, found.dims.index(dimension))
        return here if here.ndim else here.item()


def part(variable: str, *numbers: int) -> Callable[[Any], Any]:
    """Return the function that gives the value of a row at numbers along the other dimensions of a variable."""
    return lambda row: row[variable][numbers]


class BuildingValues(Protocol):
    """Values of a building for its drawings, from an archive or from the model alone."""

    def values(self, name: str, variable: str) -> np.ndarray:
        """Return the values of a variable or coordinate of a group."""

    def section(self, name: str) -> SteelSection:
        """Return a section of a member by its name."""


class BuildingResults:
    """The groups of a building below its place in an archive, each read once.

    Args:
        archive: open, of a building.
    """

    def __init__(self, archive: Archive) -> None:
        self.archive = archive
        self._groups: dict[str, Group] = {}

    @cached_property
    def building(self) -> Building | None:
        """The building, None where its file is not archived."""
        return archived_building(self.archive)

    def section(self, name: str) -> SteelSection:
        """Return a section of a member by its name in the archive.

        Args:
            name: own section of the building, or one of the catalogue.
        """
        return steel_section(name) if self.building is None else section_of(self.building, name)

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

        Raises:
            ArchiveError: there is none.
        """
        return self.variable(name, variable).values

    def variable(self, name: str, variable: str) -> Variable:
        """Return a variable or coordinate of a group; see `values`."""
        group = self.group(name)
        found = group.variables.get(variable) or group.coords.get(variable)
        if found is None:
            raise self._incomplete(name, variable)
        return found

    def rows(self, name: str, dimension: str) -> list[Row]:
        """Return what there is at each place along a dimension.

        Args:
            name: name of the group.
            dimension: such as `storey`.

        Raises:
            ArchiveError: there is none.
        """
        return [Row(self, name, dimension, number) for number in range(self.values(name, dimension).size)]

    def number(self, attribute: str, name: str = "") -> float:
        """Return a number among the attributes of a group.

        Raises:
            ArchiveError: there is none.
        """
        try:
            return float(str(self.group(name).attributes[attribute]))
        except (KeyError, ValueError) as error:
            raise self._incomplete(name, attribute) from error

    def text(self, attribute: str, name: str = "") -> str:
        """Return a text among the attributes of a group, "" if there is none."""
        return str(self.group(name).attributes.get(attribute, ""))

    def _incomplete(self, name: str, what: str) -> ArchiveError:
        return ArchiveError(
            f"{self.archive.path}: {_place(name)} has no `{what}`: the archive is damaged, or of another version; "
            "`edesign run` makes it anew [E-ARCH-03]"
        )


def has_members(archive: Archive) -> bool:
    """Return whether an archive has the members of the elastic design of a building."""
    return archive.attributes.get("kind") == BUILDING and archive.has(_place("members"))


def building_results(archive: Archive) -> BuildingResults:
    """Return the results of a building.

    Raises:
        InputError: the archive is not that of a building.
    """
    if archive.attributes.get("kind") != BUILDING:
        raise InputError(
            f"{archive.path}: this is not the archive of a building, and has no members to show [E-ARCH-08]"
        )
    return BuildingResults(archive)


def _place(name: str) -> str:
    return f"{PLACE}/{name}" if name else PLACE
