"""Words of captions and names of files."""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Collection

LONGEST = 64  # characters of a part of a file name; file systems take 255 bytes for all parts

ROUNDING = 1e-6  # in the units of people: what is smaller is rounding, and is shown as 0


def plain(value: float, digits: int = 3) -> str:
    """Return a number with some significant digits, and all before the point: 0.0123, 1.20, 1098, 2.1e-05."""
    rounded = abs(float(f"{value:.{digits}g}"))
    places = 0
    while 0.0 < rounded * 10.0**places < 10.0 ** (digits - 1) and places < digits + 1:
        places += 1
    if rounded < ROUNDING:
        return "0"
    text = f"{value:.{places}f}"
    return text if float(text) else f"{value:.1e}"


def record_label(reference: str) -> str:
    """Return a record in words: table_5_6/ImperialValley1979_H-EMO000 is Imperial Valley 1979 H-EMO000."""
    name = reference.rpartition("/")[2].replace("_", " ")
    return re.sub(r"(?<=[a-z])(?=[A-Z]|[0-9]{4})", " ", name)


def some_names(names: Collection[str], most: int = 2) -> str:
    """Return the first names, and how many more there are.

    Args:
        most: largest number of names.
    """
    more = len(names) - most
    return ", ".join(list(names)[:most]) + (f" and {more} more" if more > 0 else "")


def file_name(*parts: str) -> str:
    """Return the name of a file made of words without empty ones; it is also an anchor of a page.

    Signs other than letters and digits of ASCII become hyphens; words that lose letters by that, or are too long, get
    a mark of their own, so that they do not become alike.
    """
    return re.sub(r"^\.+", "-", "_".join(_word(part.rpartition("/")[2]) for part in parts if part))


def _word(part: str) -> str:
    plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", part)
    if part.isascii() and len(plain) <= LONGEST:
        return plain
    return f"{plain[:LONGEST]}-{hashlib.sha256(part.encode('utf-8', 'surrogatepass')).hexdigest()[:8]}"


class UniqueNames:
    """Names of files or anchors that differ in more than capitals: of equal ones the second gets -2, and so on."""

    def __init__(self) -> None:
        self._count: Counter[str] = Counter()

    def __call__(self, name: str) -> str:
        """Return the name, with a number if it was there."""
        self._count[name.lower()] += 1
        number = self._count[name.lower()]
        return name if number == 1 else self(f"{name}-{number}")


def at_level(level: str) -> str:
    """Return "at" and the level after a blank, such as " at DBE"; "" where there are no levels."""
    return f" at {level}" if level else ""
