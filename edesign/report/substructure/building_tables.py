"""What substructure tests made of the whole building, beside the direct analysis: as histories are told."""

from __future__ import annotations

from collections.abc import Callable, Iterator

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
from edesign.report.tables.table import Table, number
from edesign.report.tables.text import wrapped
from edesign.study.results.kinds import ANALYSES, DIRECT
from edesign.study.results.warnings import warning_lines
from edesign.substructure.archived import building_name

Measure = Callable[[Group], float | None]


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


BALANCE, RESIDUAL = "balance", "residual [%]"
LEFT = (BALANCE, RESIDUAL)
"""What is left of the energies, and of the drift: mostly near zero, so that an error over it says nothing."""
PEAKS: tuple[tuple[str, Measure, float], ...] = (
    ("drift [%]", _measure("interstorey_drift"), 0.01),
    ("drift [mm]", _storey_displacement, 1e-3),
    (RESIDUAL, _measure("residual_interstorey_drift"), 0.01),
    ("floor a [m/s2]", _floor_acceleration, 1.0),
    ("base shear [kN]", _measure("base_shear_N"), 1e3),
    ("plastic rot. [mrad]", _measure("beam_plastic_rotation_rad", "column_plastic_rotation_rad"), 1e-3),
)
"""Header, largest value, and unit of the header in SI."""
ENERGIES: tuple[tuple[str, Measure, float], ...] = (
    ("input", _energy("input"), 1e3),
    ("damping", _energy("damping"), 1e3),
    ("hysteretic", _energy("hysteretic"), 1e3),
    ("dampers", _energy("dampers"), 1e3),
    (BALANCE, _energy("residual"), 1e3),
)
ROUNDING = 1e-9
"""Of SI units; far below what any of them means."""


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
    peaks = _beside("What the building did: largest values, and how far off the test is", found, PEAKS)
    warned = warning_lines({f"{test}, {name}": group for test, name, group in _each(found)})
    peaks.notes += [line for warning in warned for line in wrapped(warning)]
    energies = _beside("Energies of the building at the end [kJ], and how far off the test is", found, ENERGIES)
    if energies.rows:
        energies.notes.append("`dampers` has the work on the specimen, as the numerical part did it.")
    return [peaks, energies, *_levels(archive, found)]


def _building(archive: Archive, name: str) -> Group | None:
    place = f"{ANALYSES}/{name}"
    return archive.group(place).without("time") if archive.has(place) else None


def _each(found: dict[str, list[tuple[str, Group]]]) -> Iterator[tuple[str, str, Group]]:
    for test, several in found.items():
        for name, group in several:
            yield test, name, group


def _beside(
    title: str, found: dict[str, list[tuple[str, Group]]], measures: tuple[tuple[str, Measure, float], ...]
) -> Table:
    """A row for each analysis; errors of tests over the value of the direct one stand behind their values."""
    shown = [m for m in measures if any(m[1](group) is not None for _, _, group in _each(found))]
    table = Table(title, ("test", "compensator", *(header for header, _, _ in shown)), left=2)
    if not shown:
        return table
    for test, several in found.items():
        known = dict(several)
        for name, group in several:
            whole = group.attributes.get("status") == "completed"
            direct = known.get(DIRECT) if name != DIRECT and whole else None
            cells = [
                _cell(of(group), None if direct is None or header in LEFT else of(direct), unit)
                for header, of, unit in shown
            ]
            table.rows.append([test, name if whole else f"{name} *", *cells])
    if any(group.attributes.get("status") != "completed" for _, _, group in _each(found)):
        table.notes.append("* not completed: as far as the test came, and not to be relied on")
    return table


def _cell(value: float | None, direct: float | None, unit: float) -> str:
    """A value, and its error if it is known."""
    shown = number(value, scale=unit, negligible=ROUNDING)
    if value is None or direct is None or abs(direct) < ROUNDING:
        return shown
    error = value / direct - 1.0
    return f"{shown} ({'-' if error < 0.0 else '+'}{number(abs(error), 2, 0.01, ROUNDING)} %)"


def _levels(archive: Archive, found: dict[str, list[tuple[str, Group]]]) -> list[Table]:
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
