"""Messages for names that a code does not know."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

from edesign.errors import InputError


def unknown(what: str, seen: object, allowed: Iterable[object]) -> InputError:
    """Return an error that names what was seen, what is allowed, and the nearest of it.

    Args:
        what: kind of the thing.
        allowed: names there are.
    """
    names = [str(name) for name in allowed]
    folded = {name.lower(): name for name in names}
    near = get_close_matches(str(seen).lower(), folded, n=1, cutoff=0.5)
    hint = f"; did you mean `{folded[near[0]]}`?" if near else ""
    known = ", ".join(f"`{name}`" for name in names) or "none"
    return InputError(f"there is no {what} `{seen}`{hint} (there are: {known}) [E-NAME-01]")
