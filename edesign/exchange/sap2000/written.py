"""Numbers and names as a project file writes them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

_SCALES = {"GPa": 1e9, "MPa": 1e6, "kN": 1e3, "kN/m": 1e3, "kN*m/rad": 1e3, "kN*s/m": 1e3, "t": 1e3}
_MOST = 60  # characters; project files allow 64


def number_text(value: float) -> str:
    """Return a number with twelve digits: a file that is read back gives the same results to 1e-11."""
    return f"{value:.12g}"


def quantity(value: float, unit: str) -> str:
    """Return a value in SI with a unit."""
    return f"{number_text(value / _SCALES.get(unit, 1.0))} {unit}"


def equal_or_list(lengths: Iterable[float], key: str) -> str:
    """Return lengths in m as a list, or those that are all alike as `{count, KEY}`."""
    texts = [quantity(float(length), "m") for length in lengths]
    if len(texts) > 2 and len(set(texts)) == 1:
        return f"{{count: {len(texts)}, {key}: {texts[0]}}}"
    return f"[{', '.join(texts)}]"


def free_identifier(name: str, taken: Collection[str]) -> str:
    """Return a name that project files allow, near another one, and that no other part has."""
    found = re.sub(r"[^A-Za-z0-9_.+-]+", "_", name).strip("_.")[:_MOST] or "x"
    plain = re.match(r"[A-Za-z]", found) and found.lower() not in ("true", "false", "null")
    found = found if plain else f"m_{found}"  # YAML takes others for numbers or truth values
    k, free = 2, found
    while free in taken:
        free, k = f"{found}_{k}", k + 1
    return free
