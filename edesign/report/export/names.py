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


def table_names(titles: Sequence[str], given: Sequence[str] = ()) -> list[str]:
    """Return a name for each table: its own, or the words of its title up to the first bracket or colon.

    Where these do not distinguish titles, all words are taken; titles that are the same get `_2`, `_3` in their order.

    Args:
        given: their own names, "" where a table has none; () if none has one.
    """
    own = given or [""] * len(titles)
    found = [name or slug(_beginning(title)) for name, title in zip(own, titles, strict=True)]
    for shorten in (lambda title: title.partition(" (")[0], lambda title: title):
        counts = Counter(found)
        found = [
            slug(shorten(title)) if counts[name] > 1 and not kept else name
            for title, name, kept in zip(titles, found, own, strict=True)
        ]
    counts = Counter(own)
    for i, (title, name) in enumerate(zip(titles, own, strict=True)):
        if name and counts[name] > 1 and len({t for t, n in zip(titles, own, strict=True) if n == name}) > 1:
            rest = slug(title, LONGEST_FILE).removeprefix(name)
            found[i] = slug(f"{name} {rest}", LONGEST + len(name))
    return unique_names(found)


def unique_names(
    names: Sequence[str], between: str = "_", taken: Iterable[str] = (), longest: int | None = None
) -> list[str]:
    """Return names of which no two are the same in any case of letters; the second of equal ones gets 2, and so on.

    Args:
        names: as wanted.
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
