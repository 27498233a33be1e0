"""Where the vertical component of the seismic action counts, NTC 2018, 7.2.2."""

from __future__ import annotations

LONG_SPAN = 20.0
"""Span of nearly horizontal members above which it counts, m. Source: NTC 2018, 7.2.2."""
LONG_CANTILEVER = 4.0
"""Length of cantilevers above which it counts, m. Source: NTC 2018, 7.2.2."""


def vertical_component_counts(a_vg: float, span: float = 0.0, cantilever: float = 0.0) -> bool:
    """Return whether a member needs the vertical component of the seismic action, whatever its size.

    Args:
        a_vg: peak vertical ground acceleration, m/s2; does not count.
        span: of a nearly horizontal member between supports, m.
        cantilever: its length if it is a cantilever, m.

    Source: NTC 2018, 7.2.2.
    """
    return span > LONG_SPAN or cantilever > LONG_CANTILEVER
