"""The deflections of the beams of a building: the worst beam of each group."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.rule_check import first_of_largest
from edesign.report.building.results import BuildingResults
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import MM, ONE, M


@dataclass(frozen=True)
class WorstBeam:
    """The beam of a group with the largest deflection over its span.

    Attributes:
        group: its name.
        load: `total` or `live`.
        beam: name.
        span, deflection: m.
        combination: number of the combination; of the variable loads in it for `live`.
        limit: share of the span; None: no limit.
    """

    group: str
    load: str
    beam: str
    span: float
    deflection: float
    combination: int
    limit: float | None


def _span_over_deflection(worst: WorstBeam) -> float | None:
    return worst.span / worst.deflection if worst.deflection > 0.0 else None


DEFLECTIONS = TableSpec[WorstBeam](
    "beam_deflections",
    "Deflections of beams, characteristic combinations",
    (
        text("group"),
        text("loads", lambda worst: {"total": "all", "live": "variable"}[worst.load]),
        text("beam"),
        col("span", M, digits=3),
        col("deflection", MM, digits=3),
        col("span over it", ONE, _span_over_deflection, 3),
        col("limit", ONE, lambda worst: None if worst.limit is None else 1.0 / worst.limit, 3),
    ),
    notes=("from the chord between the ends of the beam; without camber",),
    keys=3,
)


def worst_beams(deflections: Group) -> Iterator[WorstBeam]:
    """Yield the worst beams of the groups, under all loads and under variable loads alone."""
    of = {name: variable.values for name, variable in deflections.variables.items()}
    for group in dict.fromkeys(of["group"].tolist()):
        for load in ("total", "live"):
            share = np.where(of["group"] == group, of[load] / of["span"], -1.0)
            worst = first_of_largest(share)
            limit = deflections.attributes.get(f"limit_{load}")
            yield WorstBeam(
                group=str(group),
                load=load,
                beam=str(deflections.coords["beam"].values[worst]),
                span=float(of["span"][worst]),
                deflection=float(of[load][worst]),
                combination=int(of["combination"][worst]),
                limit=None if limit is None else float(str(limit)),
            )


def deflection_table(results: BuildingResults) -> Table:
    """Return the table of the worst beams."""
    return DEFLECTIONS.of(worst_beams(results.group("deflections")))
