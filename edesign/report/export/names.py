"""Names of tables: short, made of their titles, by which people choose them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence

LONGEST = 48  # letters of a name that is made of a title
LONGEST_FILE = 200  # of one that is made of names of the archive; names of files may have 255


def slug(text: str, longest: int = LONGEST) -> str:
    """Return a text as a name of small letters, digits and underscores, of at most so many letters.

    Args:
        text: the text.
        longest: largest number of letters.
    """
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
    return unique_names(found)


def unique_names(
    names: Sequence[str], between: str = "_", taken: Iterable[str] = (), longest: int | None = None
) -> list[str]:
    """Return names of which no two are the same in any case of letters; the second of equal ones gets 2, and so on.

    Args:
        names: as wanted.
        between: the name and its number.
        taken: names that none may have.
        longest: letters of a name with its number; longer ones are cut. None: as long as they are.
    """
    have = {name.casefold() for name in taken}
    found = []
    for name in names:
        made, count = name[:longest], 1
        while made.casefold() in have:
            count += 1
            end = f"{between}{count}"
            made = f"{name if longest is None else name[: longest - len(end)]}{end}"
        have.add(made.casefold())
        found.append(made)
    return found


def _beginning(title: str) -> str:
    return re.split(r" \(|: | -> ", title)[0]
