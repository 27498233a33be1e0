"""What files and tables say of a recording beside its samples."""

from __future__ import annotations

import re
from dataclasses import dataclass, fields, replace

_NUMBER = re.compile(r"[0-9]+(\.[0-9]+)?")


@dataclass(frozen=True)
class Facts:
    """Facts on a recording beside its samples; None where one is not known.

    Attributes:
        event, year, station: what was recorded, and where.
        rsn: record sequence number of PEER.
        magnitude: moment magnitude.
        distance: closest to the rupture, m.
        v_s30: m/s.
        pulse: whether its velocity has a pulse.
    """

    event: str | None = None
    year: int | None = None
    station: str | None = None
    rsn: int | None = None
    magnitude: float | None = None
    distance: float | None = None
    v_s30: float | None = None
    pulse: bool | None = None

    def over(self, other: Facts) -> Facts:
        """Return these facts, and those of others where they say nothing.

        Args:
            other: facts on the recording from elsewhere.
        """
        said = {field.name: getattr(self, field.name) for field in fields(self)}
        return replace(other, **{name: value for name, value in said.items() if value is not None})


def positive(text: str) -> float | None:
    """Return the number that a text begins with; None: none, or one that is not greater than zero.

    Args:
        text: from a header.
    """
    match = _NUMBER.match(text)
    return float(match[0]) or None if match else None
