"""Names of tables: short, made of their titles, by which people choose them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

LONGEST = 48  # letters of a name that is made of a title
LONGEST_FILE = 200  # of one that is made of names of the archive; names of files may have 255


def slug(text: str, longest: int = LONGEST) -> str:
    """Return a text as a name of small letters, digits and underscores, of at most so many letters."""
    words = re.findall(r"[a-z0-9]+", text.casefold())
    name = ""
    for word in words:
        longer = f"{name}_{word}" if name else word[:longest]
        if len(longer) > longest:
            break
        name = longer
    return name or "table"


def table_names(titles: Sequence[str]) -> list[str]:
    """Return a name for each title: its words up to the first bracket or colon.

    Where these do not tell titles apart, all words are taken; titles that are the same get `_2`, `_3` in their order.
    """
    found = [slug(_beginning(title)) for title in titles]
    for shorten in (lambda title: title.partition(" (")[0], lambda title: title):
        counts = Counter(found)
        found = [slug(shorten(t)) if counts[name] > 1 else name for t, name in zip(titles, found, strict=True)]
    return numbered(found)


def numbered(names: Sequence[str]) -> list[str]:
    """Return names with `_2`, `_3` behind those that an earlier one has."""
    have: set[str] = set()
    found = []
    for name in names:
        made, count = name, 1
        while made in have:
            count += 1
            made = f"{name}_{count}"
        have.add(made)
        found.append(made)
    return found


def _beginning(title: str) -> str:
    return re.split(r" \(|: | -> ", title)[0]
