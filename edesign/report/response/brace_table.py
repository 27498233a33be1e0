"""What the braces that buckle went through, analysis by analysis."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.tables.column import col, text
from edesign.report.tables.items import Place, at
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, MM, ONE, Unit


def _extreme(variable: str, sign: float = 1.0) -> Callable[[Place], float | None]:
    """An extreme, as a positive number; 0 if it is of the other sign: never in tension, or in compression."""

    def of(brace: Place) -> float | None:
        value = brace.value(variable)
        return None if value is None else max(sign * value, 0.0)

    return of


BUCKLING_BRACES = TableSpec[Place](
    "buckling_braces",
    "Braces that buckle",
    (
        text("analysis", "analysis"),
        text("brace", "name"),
        col("compression", KN, _extreme("brace_axial_force_min", -1.0), optional=True),
        col("tension", KN, _extreme("brace_axial_force_max"), optional=True),
        col("shortening / yield", ONE, _extreme("brace_ductility_min", -1.0), optional=True),
        col("elongation / yield", ONE, _extreme("brace_ductility_max"), optional=True),
        col("deflection", MM, _extreme("brace_deflection_max"), optional=True),
        col("damage", ONE, at("brace_damage_final"), optional=True),
        col("broken", Unit("% of the section", 0.01), at("brace_broken_share_final"), optional=True),
    ),
    notes=("The brace of each analysis that shortened most, and those of which fibres have broken. Yield: f_y L / E.",),
    keys=2,
)


def brace_table(groups: Mapping[str, Group]) -> Table:
    """Return the extremes of the brace of each analysis that shortened most over its yield elongation.

    Args:
        groups: results of analyses by name; those without braces that buckle are left out.
    """
    return BUCKLING_BRACES.of(
        Place(analysis, group, "buckling_brace", number)
        for analysis, group in groups.items()
        if "brace_ductility_min" in group.variables
        for number in dict.fromkeys((int(np.argmin(group.variables["brace_ductility_min"].values)), *_broken(group)))
    )


def _broken(group: Group) -> list[int]:
    """Positions of the braces of which fibres have broken."""
    share = group.variables.get("brace_broken_share_final")
    return [] if share is None else np.flatnonzero(share.values > 0.0).tolist()
