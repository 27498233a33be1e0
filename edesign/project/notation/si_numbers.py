"""Numbers of files that are made in Python: they are in SI, and learn their unit when they are read as a quantity."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from numbers import Integral, Real
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from edesign.project.notation.quantities import Kind


class SiNumber(float):
    """A number in SI.

    Attributes:
        kind: the quantity that it was read as; None: a number without dimension.
    """

    kind: Kind | None = None


class SiCount(int):
    """A whole number, which is in SI where a quantity is needed; its attribute is that of `SiNumber`."""

    kind: Kind | None = None


def in_si(value: Any) -> Any:
    """Return mappings, lists, arrays and values with each number as one in SI.

    Raises:
        TypeError: a key of a mapping or a value is of a kind that no file can have.
    """
    if value is None or isinstance(value, (str, bool)):
        return value
    if isinstance(value, Integral):
        return SiCount(value)
    if isinstance(value, Real):
        return SiNumber(value)
    if isinstance(value, Mapping):
        return {_key(key): in_si(below) for key, below in value.items()}
    if hasattr(value, "tolist"):  # of numpy
        return in_si(value.tolist())
    if isinstance(value, Sequence | range):
        return tuple(in_si(below) for below in value)
    raise TypeError(f"a {type(value).__name__} cannot stand in a file")


def _key(key: object) -> str:
    if isinstance(key, bool) or not isinstance(key, (str, int)):
        raise TypeError(f"a {type(key).__name__} cannot be a key of a file")
    return str(key)
