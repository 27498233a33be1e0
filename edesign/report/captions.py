"""Words of captions and names of files."""

from __future__ import annotations

import re


def plain(value: float, digits: int = 3) -> str:
    """A number with so many significant digits, and all that stand before the point: 0.0123, 1.20, 1098."""
    rounded = abs(float(f"{value:.{digits}g}"))
    places = 0
    while 0.0 < rounded * 10.0**places < 10.0 ** (digits - 1) and places < digits + 1:
        places += 1
    return f"{value:.{places}f}"


def record_label(reference: str) -> str:
    """A record in words: table_5_6/ImperialValley1979_H-EMO000 is Imperial Valley 1979 H-EMO000."""
    name = reference.rpartition("/")[2].replace("_", " ")
    return re.sub(r"(?<=[a-z])(?=[A-Z]|[0-9]{4})", " ", name)


def file_name(*parts: str) -> str:
    """A name of a file of words, those that are empty left out."""
    return "_".join(re.sub(r"[^A-Za-z0-9_.-]+", "-", part.rpartition("/")[2]) for part in parts if part)


def at_level(level: str) -> str:
    """ " at DBE", or nothing where there are no levels."""
    return f" at {level}" if level else ""
