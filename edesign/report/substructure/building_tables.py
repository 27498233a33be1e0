"""What substructure tests made of the whole building, beside the direct analysis: as histories are reported."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.energy import final_energies
from edesign.assess.envelopes import peak
from edesign.assess.measures import located_measure
from edesign.assess.members import VariantMembers
from edesign.assess.profile import storey_profile
from edesign.assess.sets import HistorySet
from edesign.errors import EdesignError
from edesign.report.archived import archived_project
from edesign.report.assessment.verdict_tables import performance_tables
from edesign.report.tables.cell import Listed, Marked, Quantity, Value
from edesign.report.tables.column import Column, col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, M_S2, MM, MRAD, PERCENT, Unit
from edesign.study.results.kinds import ANALYSES, DIRECT
from edesign.study.results.warnings import warning_lines
from edesign.substructure.archived import building_name

Measure = Callable[[Group], float | None]
KILO = Unit("", 1e3)
"""Of energies in kJ, as the title says."""
ROUNDING = 1e-9
"""Of SI units; far below what any of them means."""


class _Beside(NamedTuple):
    """A building in a test, and in the direct analysis, which errors are over; None: there is none to compare."""

    test: str
    compensator: str
    group: Group
    direct: Group | None

    @property
    def completed(self) -> bool:
        return self.group.attributes.get("status") == "completed"


def _measure(*names: str) -> Measure:
    """The largest of measures of a history."""

    def of(group: Group) -> float | None:
        found = [place.value for name in names if (place := located_measure(group, name)) is not None]
        return max(found, default=None)

    return of


def _floor_acceleration(group: Group) -> float | None:
    found = storey_profile(group).get("floor_acceleration")
    return None if found is None else float(np.max(found))


def _storey_displacement(group: Group) -> float | None:
    found = peak(group, "storey_displacement")
    return None if found is None else float(np.max(found))


def _energy(*terms: str) -> Measure:
    """The sum of terms of the energy at the end."""

    def of(group: Group) -> float | None:
        final = final_energies(group)
        return None if final is None else sum(final[term] for term in terms)

    return of


def _alone(measure: Measure) -> Callable[[_Beside], Value]:
    """The value without an error: what is left of energies and drifts is mostly near zero."""
    return lambda row: measure(row.group)


def _off(measure: Measure) -> Callable[[_Beside], Value]:
    """The value, and its error if it is known."""

    def of(row: _Beside) -> Value:
        value, direct = measure(row.group), measure(row.direct) if row.direct is not None else None
        if value is None or direct is None or abs(direct) < ROUNDING:
            return value
        error = value / direct - 1.0
        size = Quantity(abs(error), PERCENT, 2, negligible=ROUNDING)
        return Listed((value, Marked(size, ")", "(-" if error < 0.0 else "(+")), " ")

    return of


_NAMES: tuple[Column[_Beside], ...] = (
    text("test"),
    text("compensator", mark=lambda row: "" if row.completed else " *"),
)
_NOT_COMPLETED = "* not completed: as far as the test came, and not to be relied on"
_ROTATIONS = ("beam_plastic_rotation_rad", "column_plastic_rotation_rad")
PEAKS = TableSpec[_Beside](
    "building_peaks",
    "What the building did: largest values, and how far off the test is",
    (
        *_NAMES,
        col("drift", PERCENT, _off(_measure("interstorey_drift")), negligible=ROUNDING, optional=True),
        col("drift", MM, _off(_storey_displacement), negligible=ROUNDING, optional=True),
        col("residual", PERCENT, _alone(_measure("residual_interstorey_drift")), negligible=ROUNDING, optional=True),
        col("floor a", M_S2, _off(_floor_acceleration), negligible=ROUNDING, optional=True),
        col("base shear", KN, _off(_measure("base_shear_N")), negligible=ROUNDING, optional=True),
        col("plastic rot.", MRAD, _off(_measure(*_ROTATIONS)), negligible=ROUNDING, optional=True),
    ),
    signs=(_NOT_COMPLETED,),
    keys=2,
    named_by_title=True,
)
ENERGIES = TableSpec[_Beside](
    "building_energies",
    "Energies of the building at the end [kJ], and how far off the test is",
    (
        *_NAMES,
        col("input", KILO, _off(_energy("input")), negligible=ROUNDING, optional=True),
        col("damping", KILO, _off(_energy("damping")), negligible=ROUNDING, optional=True),
        col("hysteretic", KILO, _off(_energy("hysteretic")), negligible=ROUNDING, optional=True),
        col("dampers", KILO, _off(_energy("dampers")), negligible=ROUNDING, optional=True),
        col("balance", KILO, _alone(_energy("residual")), negligible=ROUNDING, optional=True),
    ),
    signs=(_NOT_COMPLETED,),
    keys=2,
    named_by_title=True,
)


def building_tables(archive: Archive) -> list[Table]:
    """Return peaks, energies, and performance levels of the building in each test and in the direct analysis.

    Raises:
        ArchiveError: a group is damaged.
    """
    from edesign.report.substructure.tables import runs

    found: dict[str, list[tuple[str, Group]]] = {}
    for run in runs(archive):
        group = _building(archive, building_name(run.test, run.compensator))
        if group is None:
            continue
        if run.test not in found:
            direct = _building(archive, building_name(run.test))
            found[run.test] = [(DIRECT, direct)] if direct is not None else []
        found[run.test].append((run.compensator, group))
    warned = warning_lines({f"{test}, {name}": group for test, name, group in _each(found)})
    peaks = PEAKS.of(_beside(found), notes=[line for warning in warned for line in wrapped(warning)])
    work = "`dampers` has the work on the specimen, as the numerical part did it."
    energies = ENERGIES.of(_beside(found), notes=[work])
    return [_without_empty_rows(peaks), _without_empty_rows(energies), *_levels(archive, found)]


def _building(archive: Archive, name: str) -> Group | None:
    place = f"{ANALYSES}/{name}"
    return archive.group(place).without("time") if archive.has(place) else None


def _each(found: dict[str, list[tuple[str, Group]]]) -> Iterator[tuple[str, str, Group]]:
    for test, several in found.items():
        for name, group in several:
            yield test, name, group


def _beside(found: dict[str, list[tuple[str, Group]]]) -> Iterator[_Beside]:
    """Each analysis, those of tests that were completed beside the direct one."""
    for test, name, group in _each(found):
        row = _Beside(test, name, group, None)
        yield row._replace(direct=dict(found[test]).get(DIRECT)) if name != DIRECT and row.completed else row


def _without_empty_rows(table: Table) -> Table:
    """The table; without rows where no analysis has a value."""
    return table if len(table.columns) > table.keys else replace(table, rows=[])


def _levels(archive: Archive, found: dict[str, list[tuple[str, Group]]]) -> Sequence[Table]:
    """Performance levels, of frames that may yield."""
    yielding = [
        (test, name, group) for test, name, group in _each(found) if "column_plastic_rotation_max" in group.variables
    ]
    try:
        project = archived_project(archive) if yielding else None
    except EdesignError:  # of another version
        return []
    if project is None:
        return []
    sets = [HistorySet(name, test, {test: group}) for test, name, group in yielding]
    return performance_tables(sets, VariantMembers(project))
