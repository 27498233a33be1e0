"""The neutral form of results: named dimensions, values, units. It knows neither HDF5 nor engineering."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np


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


@dataclass
class Group:
    """Variables that share dimensions; every dimension has a coordinate of the same name in `coords`."""

    coords: dict[str, Variable] = field(default_factory=dict)
    variables: dict[str, Variable] = field(default_factory=dict)
    attributes: dict[str, Any] = field(default_factory=dict)

    def add(self, name: str, dims: tuple[str, ...], values: Any, unit: str, long_name: str) -> None:
        """Add a variable; `values` is anything `numpy.asarray` takes."""
        self.variables[name] = Variable(dims, np.asarray(values), unit, long_name)

    def without(self, *dims: str) -> Group:
        """The same group without what lies along dimensions."""
        coords, variables = (
            {name: item for name, item in items.items() if not set(dims) & set(item.dims)}
            for items in (self.coords, self.variables)
        )
        return Group(coords, variables, self.attributes)
