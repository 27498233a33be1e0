"""Input files with one or two places changed, to see that any of them ends in a message."""

from __future__ import annotations

import copy
import random
from typing import Any

ODD: tuple[Any, ...] = (None, True, 0, -1.5, "", "all", "none", "nan", "1e999 s", "35 degC", [], {}, [[]], {"a": {}})


def spoiled(whole: Any, rng: random.Random, odd: tuple[Any, ...] = ODD, name: str = "x") -> Any:
    """A copy in which keys are left out, values replaced by odd ones, keys renamed.

    Args:
        whole: what the file holds.
        rng: draws the places and what is done there.
        odd: values to draw from.
        name: one of the names that keys get; the others are x and their own less the last letter.
    """
    changed = copy.deepcopy(whole)
    for _ in range(rng.choice((1, 1, 2))):
        places = list(_places(changed))
        if not places:
            break
        parent, key = rng.choice(places)
        how = rng.randrange(3)
        if how == 0:
            del parent[key]
        elif how == 1 or isinstance(parent, list):
            parent[key] = copy.deepcopy(rng.choice(odd))
        else:
            parent[rng.choice(("x", name, str(key)[:-1]))] = parent.pop(key)
    return changed


def _places(value: Any) -> list[tuple[Any, Any]]:
    keys = list(value) if isinstance(value, dict) else range(len(value)) if isinstance(value, list) else ()
    found = [(value, key) for key in keys]
    for key in keys:
        found += _places(value[key])
    return found
