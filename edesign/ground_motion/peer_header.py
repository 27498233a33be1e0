"""What the title of a PEER .AT2 file says about the recording, and whether that is the recording that is meant."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from edesign.ground_motion.formats.text import read_lines

_DATE = re.compile(r"(?<![0-9/])[0-9]{1,2}/[0-9]{1,2}/([0-9]{4}|[0-9]{2})(?![0-9/])")
_AZIMUTH = re.compile(r"[0-9]{1,3}(?![0-9.])")
_LAST_AZIMUTH = re.compile(r"([012][0-9]{2}|3[0-5][0-9]|360)$")
_WORD = re.compile(r"[a-z0-9]+")


@dataclass(frozen=True)
class PeerHeader:
    """The second line of an .AT2 file, `Imperial Valley-02, 5/19/1940, El Centro Array #9, 180`, as far as it is so.

    Attributes:
        title: the line.
        event: name of the earthquake; empty if it is not said, as is the station.
        year: of the earthquake; of two digits in older files.
        station: its name.
        azimuth: of the component, degrees; None if it is not said, or in words such as L or UP.
    """

    title: str
    event: str
    year: int | None
    station: str
    azimuth: int | None


def read_peer_header(path: Path) -> PeerHeader:
    """Read the title of an .AT2 file.

    Raises:
        InputError: the file cannot be read.
    """
    lines = read_lines(path)
    title = " ".join(lines[1].split()) if len(lines) > 1 else ""
    date = _DATE.search(title)
    if date is None:
        return PeerHeader(title, "", None, "", None)
    # older titles give the time of day after the date, and the station's number in brackets after the azimuth
    parts = [part.strip() for part in title[date.end() :].split(",")[1:]]
    azimuth = _AZIMUTH.match(parts[-1]) if len(parts) > 1 else None
    event, station = title[: date.start()].strip(" ,"), ", ".join(parts[:-1])
    return PeerHeader(title, event, int(date[1]), station, int(azimuth[0]) if azimuth else None)


def same_year(header: PeerHeader, year: int) -> bool:
    """Say whether the title gives this year, with four or two digits.

    Args:
        year: of the earthquake.
    """
    return header.year in (year, year % 100)


def contradictions(
    header: PeerHeader,
    event: str | None = None,
    year: int | None = None,
    station: str | None = None,
    component: str | None = None,
) -> list[str]:
    """List what the title says otherwise; what one side does not say contradicts nothing.

    Args:
        event: name of the earthquake; spelling and additions may differ, all words or all numbers may not.
        year: of the earthquake.
        station: its name, compared in this way too.
        component: PEER's code, whose last three digits are the azimuth in degrees: H-E07140 is 140.

    Returns:
        One text a contradiction.
    """
    found = []
    if event and header.event and _differ(header.event, event):
        found.append(f"the earthquake `{header.event}` instead of `{event}`")
    if year is not None and header.year is not None and not same_year(header, year):
        found.append(f"the year {header.year} instead of {year}")
    if station and header.station and _differ(header.station, station):
        found.append(f"the station `{header.station}` instead of `{station}`")
    azimuth = _LAST_AZIMUTH.search(component or "")
    if azimuth and header.azimuth is not None and (int(azimuth[0]) - header.azimuth) % 360 != 0:
        found.append(f"the azimuth {header.azimuth} instead of {int(azimuth[0])}")
    return found


def _differ(one: str, other: str) -> bool:
    first, second = (set(_WORD.findall(name.lower())) for name in (one, other))
    numbers = [{int(word) for word in words if word.isdigit()} for words in (first, second)]
    if all(numbers):
        return not numbers[0] & numbers[1]  # Array #7 is not Array #8, whatever words they share
    return not first & second
