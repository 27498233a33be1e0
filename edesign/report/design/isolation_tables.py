"""Tables of an isolated base: the equivalent linear estimate, and what histories made of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import residual
from edesign.assess.sets import HistorySet
from edesign.codes.ec8.analysis.isolation import GAMMA_X
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import label, missing_notes
from edesign.report.response.histories import names_of
from edesign.report.tables.column import col, count, text
from edesign.report.tables.items import Analysis, Place, overall, places
from edesign.report.tables.number import significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, KN_M, M_S2, MM, MRAD, PERCENT, S


class _Statistic(NamedTuple):
    """The histories of a variant at a level, and which statistic of them a row has."""

    found: HistorySet
    name: str


def _residual(analysis: Analysis) -> float | None:
    found = residual(analysis.group, "base_displacement")
    return None if found is None else float(np.linalg.norm(found))


def _resultant(quantity: str) -> Callable[[Analysis], float | None]:
    """The function that gives the largest value of a quantity, in a building of its resultant of both directions."""

    def of(analysis: Analysis) -> float | None:
        stored = analysis.group.variables.get(f"{quantity}_resultant_max")
        return overall(quantity)(analysis) if stored is None else float(np.max(stored.values))

    return of


def _isolators(analysis: Analysis) -> np.ndarray | None:
    """Largest resultant displacement of each isolator of a building."""
    stored = analysis.group.variables.get("isolator_displacement_resultant_max")
    return None if stored is None else np.asarray(stored.values)


def _farthest(analysis: Analysis) -> str | None:
    found = _isolators(analysis)
    return None if found is None else names_of(analysis.group, "isolator")[found.argmax()]


class _Estimate(NamedTuple):
    """The estimate of a modal analysis at a level, in a building along a direction."""

    level: Place
    direction: tuple[int, ...]

    def value(self, name: str) -> float:
        """What the estimate has of a variable."""
        return self.level.known(name, *self.direction)


def _axis(row: _Estimate) -> str | None:
    return str(row.level.group.coords["direction"].values[row.direction[0]]) if row.direction else None


def _largest(values: np.ndarray | None) -> float | None:
    return None if values is None else float(values.max())


def _of(name: str) -> Callable[[_Estimate], float | None]:
    return lambda row: row.value(name)


def _forces(analysis: Analysis, end: str) -> np.ndarray:
    """Axial forces of the isolators, of a gravity analysis those at its end."""
    last = analysis.group.variables["isolator_axial_force_final"]
    return np.asarray(analysis.group.variables.get(f"isolator_axial_force_{end}", last).values)


def _moment(analysis: Analysis) -> float | None:
    """The largest product of compression and displacement of an isolator; they need not come at one moment."""
    of_isolators = _isolators(analysis)
    moved = _resultant("base_displacement")(analysis) if of_isolators is None else of_isolators
    return None if moved is None else float(np.max(np.maximum(-_forces(analysis, "min"), 0.0) * moved))


def _over(measure: Callable[[Analysis], float | None], sign: float = 1.0) -> Callable[[_Statistic], float | None]:
    """The statistic of a measure over histories; with the sign -1 the largest is that of the negative values."""

    def of(row: _Statistic) -> float | None:
        found = row.found.statistics(lambda group: measure(Analysis("", group)))
        if row.name == "mean":
            return found.mean
        return found.maximum if sign > 0.0 else found.minimum

    return of


ESTIMATE = TableSpec[_Estimate](
    "isolated_base_design",
    "{whose}: isolated base, equivalent linear (EN 1998-1, 10.9)",
    (
        text("level", lambda row: row.level.name),
        text("along", _axis, optional=True),
        col("d", MM, _of("isolation_displacement")),
        col(f"{GAMMA_X:g} d", MM, lambda row: GAMMA_X * row.value("isolation_displacement")),
        col("T_eff", S, _of("isolation_period")),
        col("xi_eff", PERCENT, _of("isolation_damping")),
        col("S_e", M_S2, _of("isolation_acceleration")),
        col("F", KN, _of("isolation_shear")),
        col("F/W", PERCENT, lambda row: row.value("isolation_acceleration") / STANDARD_GRAVITY),
    ),
    each="Isolated base, equivalent linear (EN 1998-1, 10.9)",
    formulas=True,
)
_NOTES = (
    "N: axial force of the isolators, gravity included, positive in tension",
    "N u: largest compression times largest displacement of an isolator, a moment that the analysis leaves out: for "
    "rubber half of it acts below and half above, for a dish below or above all of it on that side",
)
ISOLATED_BASE = TableSpec[Analysis](
    "isolated_base",
    "Isolated base",
    (
        text("analysis", "name"),
        col("u", MM, _resultant("base_displacement"), negligible=ROUNDING),
        col("residual u", MM, _residual, negligible=ROUNDING),
        col("base turn", MRAD, overall("base_rotation"), negligible=ROUNDING, optional=True),
        col("isolator u", MM, lambda one: _largest(_isolators(one)), negligible=ROUNDING, optional=True),
        text("farthest", _farthest, optional=True),
        col("base a", M_S2, _resultant("base_acceleration")),
        col("base shear", KN, _resultant("base_shear"), negligible=ROUNDING),
        col("N max", KN, lambda one: _forces(one, "max").max(), negligible=ROUNDING),
        text("isolator", lambda one: names_of(one.group, "isolator")[_forces(one, "max").argmax()]),
        col("N min", KN, lambda one: _forces(one, "min").min()),
        text("isolator", lambda one: names_of(one.group, "isolator")[_forces(one, "min").argmin()]),
        col("N u", KN_M, _moment, negligible=ROUNDING, optional=True),
    ),
    notes=_NOTES,
)
STATISTICS = TableSpec[_Statistic](
    "isolated_base_statistics",
    "Isolated base",
    (
        text("variant, level", lambda row: label(row.found)),
        text("statistic", "name"),
        count("of", lambda row: f"{len(row.found.completed)}/{len(row.found.histories)}"),
        col("u", MM, _over(_resultant("base_displacement")), negligible=ROUNDING),
        col("residual u", MM, _over(_residual), negligible=ROUNDING),
        col("base turn", MRAD, _over(overall("base_rotation")), negligible=ROUNDING, optional=True),
        col("isolator u", MM, _over(lambda one: _largest(_isolators(one))), negligible=ROUNDING, optional=True),
        col("base a", M_S2, _over(_resultant("base_acceleration"))),
        col("base shear", KN, _over(_resultant("base_shear")), negligible=ROUNDING),
        col("N max", KN, _over(lambda one: _forces(one, "max").max()), negligible=ROUNDING),
        col("N min", KN, _over(lambda one: _forces(one, "min").min(), sign=-1.0)),
        col("N u", KN_M, _over(_moment), negligible=ROUNDING, optional=True),
    ),
    notes=_NOTES,
    keys=2,
    named_as="isolated_base",
)


def isolation_estimate_table(name: str, group: Group) -> Table:
    """Return the equivalent linear analysis of an isolated base at each level, and the conditions that it misses.

    Args:
        name: of the modal analysis.
    """
    levels, notes = list(places({name: group}, "hazard_level", "isolation_displacement")), []
    along = range(len(group.coords["direction"].values)) if "direction" in group.coords else ()
    ways: list[tuple[int, ...]] = [(i,) for i in along] or [()]
    rows = [_Estimate(level, way) for level in levels for way in ways]
    if levels:
        period, mass = (float(str(group.attributes[key])) for key in ("fixed_base_period_s", "mass_kg"))
        above = f"a rigid body of {significant(mass / 1e3)} t above the isolators"
        notes.append(f"T_f = {period:.4g} s on a fixed base; {above}")
        missed = group.attributes.get("isolation_not_met")
        notes += [f"not met: {text}" for text in missed] if isinstance(missed, list) else []
    return ESTIMATE.of(rows, whose=name, notes=notes)


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
