"""Standards whose performance levels criteria ask for: their names, levels and tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

Standard = Literal["fema356", "asce41-17", "en1998-3"]
PerformanceLevel = Literal["IO", "LS", "CP", "DL", "SD", "NC"]
By = Literal["drift", "members", "both"]


@dataclass(frozen=True)
class PerformanceStandard:
    """What criteria have to know of a standard.

    Attributes:
        name: as it is written.
        levels: names of its levels by their short ones, from the least damage to the most.
        tables: clause of the limits by what is judged; a standard without limits of drift has none of it.
    """

    name: str
    levels: Mapping[str, str]
    tables: Mapping[By, str]


_AMERICAN = {"IO": "Immediate Occupancy", "LS": "Life Safety", "CP": "Collapse Prevention"}
PERFORMANCE_STANDARDS: Mapping[Standard, PerformanceStandard] = {
    "fema356": PerformanceStandard(
        "FEMA 356", _AMERICAN, {"drift": "Table C1-3", "members": "Table 5-6", "both": "Tables C1-3 and 5-6"}
    ),
    "asce41-17": PerformanceStandard("ASCE/SEI 41-17", _AMERICAN, {"members": "Table 9-7.1"}),
    "en1998-3": PerformanceStandard(
        "EN 1998-3:2005",
        {"DL": "Damage Limitation", "SD": "Significant Damage", "NC": "Near Collapse"},
        {"members": "Table B.1"},
    ),
}
