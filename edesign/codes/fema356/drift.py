"""Structural performance levels of steel moment frames by drift."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.codes.names import unknown

PERFORMANCE_LEVELS = {"IO": "Immediate Occupancy", "LS": "Life Safety", "CP": "Collapse Prevention"}
"""Structural performance levels from the least damage to the most."""

NEGLIGIBLE = 0.002
"""Permanent drift ratio that counts as negligible.

FEMA 356 gives no number. Storeys are built out of plumb by up to 1/500 (AISC Code of Standard Practice, 7.13.1.1), and
FEMA P-58-1, Table C-1, puts the residual drift below which no realignment is needed at the same 0.2 %.
"""


@dataclass(frozen=True)
class DriftLimits:
    """Ratios of transient and permanent drift that a performance level allows."""

    transient: float
    permanent: float


def drift_limits(level: str) -> DriftLimits:
    """Return the drifts that a performance level of steel moment frames allows.

    FEMA 356 gives them as what is typical of each level, not as acceptance criteria.

    Args:
        level: IO, LS or CP.

    Raises:
        InputError: there is no such level.

    Source: FEMA 356, Table C1-3, steel moment frames (thesis Table 5.5).
    """
    limits = {
        "IO": DriftLimits(0.007, NEGLIGIBLE),
        "LS": DriftLimits(0.025, 0.01),
        "CP": DriftLimits(0.05, 0.05),
    }
    if level not in limits:
        raise unknown("performance level", level, limits)
    return limits[level]
