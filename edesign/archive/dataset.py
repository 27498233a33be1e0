"""The neutral form of results: named dimensions, values, units. It knows neither HDF5 nor engineering."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, MutableMapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from edesign.notebook import facts_html, table_html


@dataclass(frozen=True)
class Variable:
    """An array with named dimensions.

    Attributes:
        dims: one name per axis of `values`, () for a scalar.
        values: numbers or text.
        unit: SI unit as text, "1" for a ratio, "" for text.
        long_name: one line for labels and for people who open the file elsewhere.
    """

    dims: tuple[str, ...]
    values: np.ndarray
    unit: str
    long_name: str

    def __post_init__(self) -> None:
        if np.ndim(self.values) != len(self.dims):
            raise ValueError(f"{self.long_name}: {np.ndim(self.values)} axes for dimensions {self.dims}")


class StoredVariable(Variable):
    """A variable whose unit and long name are read on their first access, as sums and extremes need neither.

    Args:
        dims: one name per axis of `values`.
        read: returns unit and long name.
    """

    _read: Callable[[], tuple[str, str]]

    def __init__(self, dims: tuple[str, ...], values: np.ndarray, read: Callable[[], tuple[str, str]]) -> None:
        vars(self).update(dims=dims, values=values, _read=read)
        self.__post_init__()

    @cached_property
    def _labels(self) -> tuple[str, str]:
        return self._read()

    @property
    def unit(self) -> str:
        """The unit of the values, "1" for a ratio; it is read on first access."""
        return self._labels[0]

    @property
    def long_name(self) -> str:
        """The description of the variable for readers; it is read on first access."""
        return self._labels[1]


class Unread(MutableMapping[str, Variable]):
    """Variables by name, each of which is read on its first access.

    Args:
        dims: dimensions of each variable, by its name.
        read: returns a variable by its name.
    """

    def __init__(self, dims: Mapping[str, tuple[str, ...]], read: Callable[[str], Variable]) -> None:
        self._dims = dict(dims)
        self._read = read
        self._have: dict[str, Variable] = {}

    def __getitem__(self, name: str) -> Variable:
        if name in self._dims and name not in self._have:
            self._have[name] = self._read(name)
        return self._have[name]

    def __setitem__(self, name: str, variable: Variable) -> None:
        self._dims[name], self._have[name] = variable.dims, variable

    def __delitem__(self, name: str) -> None:
        del self._dims[name]
        self._have.pop(name, None)

    def __contains__(self, name: object) -> bool:
        return name in self._dims

    def __iter__(self) -> Iterator[str]:
        return iter(self._dims)

    def __len__(self) -> int:
        return len(self._dims)

    def without(self, *dims: str) -> Unread:
        """Return the variables without those along some dimensions; nothing is read."""
        return Unread({name: own for name, own in self._dims.items() if not set(dims) & set(own)}, self.__getitem__)


def dims_of(items: Mapping[str, Variable]) -> dict[str, tuple[str, ...]]:
    """Return the dimensions of variables by their names; nothing is read."""
    return dict(items._dims) if isinstance(items, Unread) else {name: item.dims for name, item in items.items()}


@dataclass
class Group:
    """Variables that share dimensions; every dimension has a coordinate of the same name in `coords`."""

    coords: MutableMapping[str, Variable] = field(default_factory=dict)
    variables: MutableMapping[str, Variable] = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self.variables)} variables along {', '.join(self.coords) or 'nothing'}>"

    def _repr_html_(self) -> str:
        rows = [
            [name, " x ".join(variable.dims), variable.unit, variable.long_name]
            for name, variable in self.variables.items()
        ]
        about = {name: value for name, value in self.attributes.items() if isinstance(value, (str, int, float))}
        return facts_html("", about.items()) + table_html("", ("variable", "along", "unit", "meaning"), rows, left=4)

    def add(self, name: str, dims: tuple[str, ...], values: Any, unit: str, long_name: str) -> None:
        """Add a variable to the group.

        Args:
            dims: names of its dimensions, each of which has a coordinate in the group.
            values: anything that `numpy.asarray` takes.
            unit: SI unit; "1" for ratios and counts, "" for texts.
            long_name: description for readers.
        """
        self.variables[name] = Variable(dims, np.asarray(values), unit, long_name)

    def without(self, *dims: str) -> Group:
        """Return the group without the variables and coordinates along some dimensions."""
        coords, variables = (
            items.without(*dims)
            if isinstance(items, Unread)
            else {name: item for name, item in items.items() if not set(dims) & set(item.dims)}
            for items in (self.coords, self.variables)
        )
        return Group(coords, variables, self.attributes)
