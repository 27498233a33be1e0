"""Items of tables that are read from results: an analysis, or one name along a dimension, such as a damper of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak


@dataclass(frozen=True)
class Analysis:
    """An analysis with its results.

    Attributes:
        name: of the analysis.
        group: its results.
    """

    name: str
    group: Group

    def attribute(self, name: str) -> float | None:
        """Return a number of the group's attributes; None without it."""
        value = self.group.attributes.get(name)
        return None if value is None else float(np.asarray(value))


@dataclass(frozen=True)
class Place:
    """One name along a dimension of the results of an analysis: a damper, a hinge, a footing.

    Attributes:
        analysis: whose results these are.
        group: the results.
        dimension: such as `damper`.
        number: of the name along the dimension, from 0.
    """

    analysis: str
    group: Group
    dimension: str
    number: int

    @property
    def name(self) -> str:
        """The name, such as that of the damper."""
        return str(self.group.coords[self.dimension].values[self.number])

    def value(self, variable: str, *further: int) -> float | None:
        """Return the number that a variable has here, SI, also along another dimension with this name; None without.

        Args:
            variable: whose first dimension names the place.
            *further: numbers along its further dimensions, from 0.
        """
        stored = self.group.variables.get(variable)
        return None if stored is None else float(stored.values[(self._along(stored.dims[0]), *further)])

    def known(self, variable: str, *further: int) -> float:
        """Return the number that a variable has here, of one that every such analysis has."""
        value = self.value(variable, *further)
        assert value is not None, variable
        return value

    def finite(self, variable: str, *further: int) -> float | None:
        """Return the number that a variable has here; None also where it is infinite or not determined."""
        value = self.value(variable, *further)
        return value if value is not None and np.isfinite(value) else None

    def word(self, variable: str) -> str:
        """Return the text that a variable has here."""
        return str(self.group.variables[variable].values[self.number])

    def largest(self, quantity: str) -> float | None:
        """Return the largest absolute value over time of a quantity, SI; None where the analysis has it not."""
        ends = [value for end in ("max", "min") if (value := self.value(f"{quantity}_{end}")) is not None]
        return float(np.max(np.abs(ends))) if ends else None

    def _along(self, dimension: str) -> int:
        if dimension == self.dimension:
            return self.number
        return list(map(str, self.group.coords[dimension].values)).index(self.name)


def places(groups: Mapping[str, Group], dimension: str, *variables: str) -> Iterator[Place]:
    """Yield the names along a dimension, of all analyses that have it.

    Args:
        groups: results by the name of the analysis.
        dimension: such as `damper`.
        *variables: that an analysis must have.
    """
    for analysis, group in groups.items():
        if dimension in group.coords and all(name in group.variables for name in variables):
            for number in range(len(group.coords[dimension].values)):
                yield Place(analysis, group, dimension, number)


def most_in_any(groups: Mapping[str, Group], dimension: str, quantity: str) -> list[Place]:
    """Return each name along a dimension in the analysis where a quantity is largest, the largest first.

    Args:
        dimension: such as `joint`.
        quantity: such as `joint_rotation`.
    """
    found: dict[str, tuple[float, Place]] = {}
    for place in places(groups, dimension):
        value = place.largest(quantity)
        if value is not None and (place.name not in found or value > found[place.name][0]):
            found[place.name] = value, place
    return [found[name][1] for name in sorted(found, key=lambda name: (-found[name][0], name))]


def at(variable: str, *further: int) -> Callable[[Place], float | None]:
    """Return the function that gives a variable's number of a place; see `Place.value`."""
    return lambda place: place.value(variable, *further)


def largest(quantity: str) -> Callable[[Place], float | None]:
    """Return the function that gives a quantity's largest absolute value over time of a place."""
    return lambda place: place.largest(quantity)


def overall(quantity: str) -> Callable[[Analysis], float | None]:
    """Return the function that gives a quantity's largest absolute value over time and over all places."""

    def of(analysis: Analysis) -> float | None:
        values = peak(analysis.group, quantity)
        return None if values is None else float(np.max(values))

    return of


def attribute(name: str) -> Callable[[Analysis], float | None]:
    """Return the function that gives a number of the attributes of an analysis."""
    return lambda analysis: analysis.attribute(name)
