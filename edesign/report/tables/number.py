"""Numbers as people read them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

SCIENTIFIC = 1e7  # from here on a number is no measure of a building, only a sign that something went wrong


def significant(value: float | None, digits: int = 4) -> str:
    """Return a number with significant digits, "-" for None.

    Args:
        value: in the unit that is shown.
        digits: significant digits; whole numbers keep all of theirs below 1e7.
    """
    if value is None:
        return "-"
    if abs(value) >= SCIENTIFIC:
        return f"{value:.{digits - 1}e}"
    return f"{value:.0f}" if abs(value) >= 10**digits - 0.5 else f"{value:#.{digits}g}".rstrip(".")


def finite(value: Any) -> Any:
    """Return `value` with None in place of every number that is not finite, which JSON cannot hold."""
    if isinstance(value, Mapping):
        return {key: finite(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [finite(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value
