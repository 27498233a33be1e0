"""Attributes of groups: plain numbers and text stay as they are, anything else becomes JSON text that reads back."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

JSON_MARK = "json:"


def encode(value: Any) -> Any:
    """Return `value` as netCDF-4 readers understand it: a number, a text, an array of numbers, or marked JSON.

    Args:
        value: number, text, None, truth value, array, list or mapping of such.

    Raises:
        TypeError: `value` holds something that has no such form.
    """
    if isinstance(value, str) and not value.startswith(JSON_MARK) and "\0" not in value:
        return value
    if isinstance(value, (int, float, np.number)) and not isinstance(value, bool):
        return value
    if isinstance(value, np.ndarray) and value.dtype.kind in "iuf" and value.ndim == 1 and value.size:
        return value
    return JSON_MARK + json.dumps(value, default=_plain)


def decode(value: Any) -> Any:
    """Return the value that `encode` was given; numbers come back as Python's int and float.

    Raises:
        ValueError: marked JSON that is none.
    """
    if isinstance(value, str) and value.startswith(JSON_MARK):
        return json.loads(value[len(JSON_MARK) :])
    if isinstance(value, np.generic):
        return value.item()
    return value


def _plain(value: Any) -> Any:
    if isinstance(value, (np.generic, np.ndarray)):
        return value.tolist()
    if isinstance(value, (set, frozenset)):
        return sorted(value)
    raise TypeError(f"an archive cannot hold an attribute of type {type(value).__name__}")
