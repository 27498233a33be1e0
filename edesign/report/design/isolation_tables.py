"""Tables of an isolated base: the equivalent linear estimate, and what histories made of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import residual
from edesign.assess.sets import HistorySet
from edesign.codes.ec8.isolation import GAMMA_X
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import label, missing_notes
from edesign.report.response.histories import names_of
from edesign.report.tables.column import col, count, text
from edesign.report.tables.items import Analysis, Place, at, overall, places
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, M_S2, MM, PERCENT, S


class _Statistic(NamedTuple):
    """The histories of a variant at a level, and which statistic of them a row has."""

    found: HistorySet
    name: str


def _residual(analysis: Analysis) -> float | None:
    found = residual(analysis.group, "base_displacement")
    return None if found is None else float(found)


def _forces(analysis: Analysis, end: str) -> np.ndarray:
    """Axial forces of the isolators, of a gravity analysis those at its end."""
    last = analysis.group.variables["isolator_axial_force_final"]
    return np.asarray(analysis.group.variables.get(f"isolator_axial_force_{end}", last).values)


def _over(measure: Callable[[Analysis], float | None], sign: float = 1.0) -> Callable[[_Statistic], float | None]:
    """The statistic of a measure over histories; with the sign -1 the largest is that of the negative values."""

    def of(row: _Statistic) -> float | None:
        found = row.found.statistics(lambda group: measure(Analysis("", group)))
        if row.name == "mean":
            return found.mean
        return found.maximum if sign > 0.0 else found.minimum

    return of


ESTIMATE = TableSpec[Place](
    "isolated_base_design",
    "{whose}: isolated base, equivalent linear (EN 1998-1, 10.9)",
    (
        text("level", "name"),
        col("d", MM, at("isolation_displacement")),
        col(f"{GAMMA_X:g} d", MM, lambda level: GAMMA_X * level.known("isolation_displacement")),
        col("T_eff", S, at("isolation_period")),
        col("xi_eff", PERCENT, at("isolation_damping")),
        col("S_e", M_S2, at("isolation_acceleration")),
        col("F", KN, at("isolation_shear")),
        col("F/W", PERCENT, lambda level: level.known("isolation_acceleration") / STANDARD_GRAVITY),
    ),
    each="Isolated base, equivalent linear (EN 1998-1, 10.9)",
    formulas=True,
)
_NOTE = "N: axial force of the isolators, gravity included, positive in tension"
ISOLATED_BASE = TableSpec[Analysis](
    "isolated_base",
    "Isolated base",
    (
        text("analysis", "name"),
        col("u", MM, overall("base_displacement"), negligible=ROUNDING),
        col("residual u", MM, _residual, negligible=ROUNDING),
        col("base a", M_S2, overall("base_acceleration")),
        col("base shear", KN, overall("base_shear"), negligible=ROUNDING),
        col("N max", KN, lambda one: _forces(one, "max").max(), negligible=ROUNDING),
        text("isolator", lambda one: names_of(one.group, "isolator")[_forces(one, "max").argmax()]),
        col("N min", KN, lambda one: _forces(one, "min").min()),
        text("isolator", lambda one: names_of(one.group, "isolator")[_forces(one, "min").argmin()]),
    ),
    notes=(_NOTE,),
)
STATISTICS = TableSpec[_Statistic](
    "isolated_base_statistics",
    "Isolated base",
    (
        text("variant, level", lambda row: label(row.found)),
        text("statistic", "name"),
        count("of", lambda row: f"{len(row.found.completed)}/{len(row.found.histories)}"),
        col("u", MM, _over(overall("base_displacement")), negligible=ROUNDING),
        col("residual u", MM, _over(_residual), negligible=ROUNDING),
        col("base a", M_S2, _over(overall("base_acceleration"))),
        col("base shear", KN, _over(overall("base_shear")), negligible=ROUNDING),
        col("N max", KN, _over(lambda one: _forces(one, "max").max()), negligible=ROUNDING),
        col("N min", KN, _over(lambda one: _forces(one, "min").min(), sign=-1.0)),
    ),
    notes=(_NOTE,),
    keys=2,
    named_as="isolated_base",
)


def isolation_estimate_table(name: str, group: Group) -> Table:
    """Return the equivalent linear analysis of an isolated base at each level, and the conditions that it misses.

    Args:
        name: of the modal analysis.
    """
    levels, notes = list(places({name: group}, "hazard_level", "isolation_displacement")), []
    if levels:
        period, mass = (float(str(group.attributes[key])) for key in ("fixed_base_period_s", "mass_kg"))
        above = f"a rigid body of {significant(mass / 1e3)} t above the isolators"
        notes.append(f"T_f = {period:.4g} s on a fixed base; {above}")
        missed = group.attributes.get("isolation_not_met")
        notes += [f"not met: {text}" for text in missed] if isinstance(missed, list) else []
    return ESTIMATE.of(levels, whose=name, notes=notes)


def isolation_table(groups: Mapping[str, Group]) -> Table:
    """Return the largest displacement and acceleration of an isolated base, and the forces on its isolators.

    Args:
        groups: results of analyses by name; those without isolated base, and modes, are left out.
    """
    found = (Analysis(name, group) for name, group in groups.items())
    return ISOLATED_BASE.of(one for one in found if "isolator_axial_force_final" in one.group.variables)


def isolation_statistics_table(sets: Sequence[HistorySet]) -> Table:
    """Return mean and largest response of an isolated base in histories, for each variant and level.

    Args:
        sets: histories by variant and level; those without isolated base are left out.
    """
    shown, rows = [], []
    for found in sets:
        isolated = sum("isolator_axial_force_max" in group.variables for group in found.completed.values())
        shown += [found] if isolated else []
        rows += [_Statistic(found, name) for name in ("mean", "largest")[-isolated:] if isolated]
    return STATISTICS.of(rows, notes=missing_notes(shown))
