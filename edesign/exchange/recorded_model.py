"""A model of the core that remembers how it was built."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import wraps
from typing import Any

from edesign.core import Model


@dataclass(frozen=True)
class Call:
    """A method of a model that was called.

    Attributes:
        name: of the method.
        values: its arguments by name, with the defaults.
        result: what it returned, mostly the id of what it added.
    """

    name: str
    values: Mapping[str, Any]
    result: Any

    def __getitem__(self, argument: str) -> Any:
        return self.values[argument]


class RecordedModel(Model):
    """A model of the core that remembers how it was built, in order: a translation misses nothing of it.

    Attributes:
        calls: every method that added something.
    """

    def __init__(self, dimension: int = 2) -> None:
        super().__init__(dimension)
        self.calls: list[Call] = []


def _recorded(name: str) -> Callable[..., Any]:
    method = getattr(Model, name)
    signature = inspect.signature(method)

    @wraps(method)
    def call(self: RecordedModel, *args: Any, **keywords: Any) -> Any:
        result = method(self, *args, **keywords)
        bound = signature.bind(self, *args, **keywords)
        bound.apply_defaults()
        values = {key: value for key, value in bound.arguments.items() if key != "self"}
        self.calls.append(Call(name, values, result))
        return result

    return call


_ASKING = {"freeze", "layers", "levers", "on_masters"}
for _name, _method in vars(Model).items():
    if inspect.isfunction(_method) and not _name.startswith("_") and _name not in _ASKING:
        setattr(RecordedModel, _name, _recorded(_name))
