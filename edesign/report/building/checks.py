"""Worked calculations of the checks of members of a building, from the archive alone."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace

import numpy as np

from edesign.codes.ec3.member import Member, Stability
from edesign.codes.ec3.utilisation import ForcesAlong, FreeBeam, utilisation
from edesign.codes.rule_check import first_of_largest
from edesign.codes.trace import Step, Trace
from edesign.errors import InputError
from edesign.project.reading.problems import did_you_mean
from edesign.report.building.code_in_use import rules_in_use
from edesign.report.building.results import UNITS, BuildingResults
from edesign.report.building.tables.all import Worst, worst_of_groups
from edesign.report.tables.cell import Marked, Quantity, Value
from edesign.report.tables.column import Column, col, count, formula, text
from edesign.report.tables.number import finite, significant
from edesign.report.tables.table import ROUNDING, Table, TableSpec
from edesign.report.tables.unit import ONE, Unit
from edesign.space.archived import IMPERFECTION

SAME = 1e-6
"""Share by which a calculation may miss the utilisation: above rounding, below the digits that are shown."""
NOTHING = 1e-4
"""Of the largest force or moment of a table, the last of its four digits: what is less is shown as 0."""


def _shown(step: Step) -> Value:
    if isinstance(step.value, str):
        return step.value
    return Quantity(finite(step.value), UNITS.get(step.unit, Unit(step.unit)))


CALCULATION = TableSpec[Step](
    "member_checks_in_numbers",
    "{found.group}: {found.member}, {found.kind} {found.section} of {found.material}, {found.length:.4g} m: "
    "{found.check}",
    (
        formula("quantity", "symbol"),
        formula("from", "expression", broken=1),
        text("clause"),
        formula("value", _shown),
    ),
    keys=3,
    each="Worked calculations of checks",
)
CHECKS = TableSpec[dict[str, Value]](
    "checks",
    "{whose}: checks",
    (
        text("check"),
        col("use", ONE, digits=3, negligible=ROUNDING),
        count("combination"),
        col("x / L", ONE, form=".3g"),
        text("clause"),
    ),
    each="Checks",
)
FORCES = TableSpec[dict[str, Value]](
    "member_forces",
    "{whose}: internal forces of each action at x = {place:.3g} L",
    (formula("action"),),  # and each force
    notes=("E with accidental torsion and second order; N positive in tension",),
    each="Internal forces of each action where a check governs",
)
NO_FORCES = TableSpec[None]("no_member_forces", "{whose}: internal forces", (), named_by_title=True)


@dataclass(frozen=True)
class WorkedCheck:
    """A check of a member with the worked calculation of its utilisation.

    Attributes:
        member, group, kind, section, material: names.
        length: of the member, m.
        check, clause: name of the check and its clause.
        utilisation: of the archive.
        combination, number: name and number of the governing combination; "" and 0 if the check does not apply.
        steps: of the calculation; none if the check does not apply, has no calculation here, or one that does not lead
            to the utilisation of the archive, as one of another version might.
    """

    member: str
    group: str
    kind: str
    section: str
    material: str
    length: float
    check: str
    clause: str
    utilisation: float
    combination: str
    number: int
    steps: tuple[Step, ...]


def worked_check(results: BuildingResults, member: int, check: int) -> WorkedCheck:
    """Return a check of a member with its worked calculation.

    Args:
        member: number of the member in the archive, from 0.
        check: number of the check in the archive, from 0.

    Returns:
        The check; without steps where they do not lead to the archived utilisation.

    Raises:
        ArchiveError: a group or a variable is missing.
    """
    of = {name: results.values("members", name)[member] for name in ("member", "group", "kind", "section", "material")}
    combination = int(results.values("members", "combination")[member, check])
    name = str(results.values("members", "check")[check])
    trace, found = Trace(), None
    if combination:
        forces = forces_along(results, member, combination - 1)
        place = results.values("members", "station")[member, check]
        station = int(np.abs(forces.stations - place).argmin())
        beam = _free_beam(results, member, combination - 1)
        found = utilisation(_member(results, member), forces, name, station, beam, trace)
    archived, rules = float(results.values("members", "utilisation")[member, check]), rules_in_use(results)
    if found is None or not math.isclose(found, archived, rel_tol=SAME, abs_tol=SAME**2):
        trace.steps.clear()
    return WorkedCheck(
        **{key: str(value) for key, value in of.items()},
        length=float(results.values("members", "length")[member]),
        check=name,
        clause=str(results.values("members", "clause")[check]),
        utilisation=archived,
        combination=str(results.values("combinations", "name")[combination - 1]) if combination else "",
        number=combination,
        steps=tuple(replace(step, clause=rules.told(step.clause)) for step in trace.steps),
    )


def worked_worst(results: BuildingResults) -> list[tuple[Worst, WorkedCheck]]:
    """Return the governing check of each group with its worked calculation."""
    return [(worst, worked_check(results, worst.number, worst.check)) for worst in worst_of_groups(results)]


def worked_table(found: WorkedCheck) -> Table:
    """Return the worked calculation of a check as a table."""
    notes = ["the check does not apply"]
    if found.number:
        met = "met" if found.utilisation <= 1.0 else "not met"
        notes = [f"combination {found.number}: {found.combination}"]
        notes += [] if found.steps else ["this version has no worked calculation of this check as it was made"]
        notes.append(f"utilisation {significant(finite(found.utilisation))}: {met} ({found.clause})")
    whose = f"{found.group}: {found.member}, {found.check}"
    return CALCULATION.of(found.steps, whose=whose, found=found, notes=notes)


def worked_data(found: WorkedCheck) -> list[dict[str, object]]:
    """Return the worked calculation of a check for JSON, in SI units."""
    return [
        {
            "symbol": step.symbol,
            "value": step.value if isinstance(step.value, str) else finite(step.value),
            "unit": step.unit,
            "from": step.expression,
            "clause": step.clause,
        }
        for step in found.steps
    ]


def _member_number(results: BuildingResults, name: str) -> int:
    """Return the number of a member, from 0.

    Raises:
        InputError: there is no such member.
    """
    names = [str(of) for of in results.values("members", "member")]
    if name not in names:
        raise InputError(f"{results.archive.path}: no member is named {name!r}{did_you_mean(name, names)} [E-ARCH-07]")
    return names.index(name)


def governing(results: BuildingResults, member: int) -> int:
    """Return the number of the check of a member that is used most, from 0.

    Args:
        member: number of the member, from 0.
    """
    return first_of_largest(np.nan_to_num(results.values("members", "utilisation")[member], nan=-1.0))


def member_tables(results: BuildingResults, name: str) -> list[Table]:
    """Return all checks of a member, and the worked calculation of the one that governs.

    Raises:
        InputError: there is no such member.
        ArchiveError: a group is missing.
    """
    member = _member_number(results, name)
    of = results.rows("members", "member")[member]
    rows: list[dict[str, Value]] = [
        {"check": check, "use": finite(use), "combination": combination, "x / L": place, "clause": clause}
        for check, clause, use, combination, place in zip(
            results.values("members", "check"),
            results.values("members", "clause"),
            *(of[name] for name in ("utilisation", "combination", "station")),
            strict=True,
        )
        if combination
    ]
    check = governing(results, member)
    checks = CHECKS.of(rows, whose=name)
    return [checks, effects_table(results, member, check), worked_table(worked_check(results, member, check))]


def effects_table(results: BuildingResults, member: int, check: int) -> Table:
    """Return the internal forces of each action on a member at the place where a check governs.

    Sway imperfections of other combinations are left out.

    Args:
        member: number of the member, from 0.
        check: number of the check, from 0.
    """
    name = str(results.values("members", "member")[member])
    place = results.values("members", "station")[member, check]
    if not np.isfinite(place):
        return NO_FORCES.of((), whose=name, notes=["no check applies"])
    station = int(np.abs(results.values("forces", "station") - place).argmin())
    every = np.concatenate([results.values("forces", of)[:, member, station] for of in ("static", "seismic")])
    forces = [str(of) for of in results.values("forces", "force")]
    moments = np.array([of.startswith(("M", "T")) for of in forces])
    top = np.where(moments, np.abs(every[:, moments]).max(), np.abs(every[:, ~moments]).max())
    every[np.abs(every) < NOTHING * top] = 0.0
    columns: list[Column[dict[str, Value]]] = [
        Column(of, of, unit=UNITS["N*m" if moment else "N"], negligible=np.finfo(float).tiny, symbols=True)
        for of, moment in zip(forces, moments, strict=True)
    ]
    idle = idle_sway(results, int(results.values("members", "combination")[member, check]))
    signs = {str(case): "" for case in results.values("forces", "case")}
    signs |= {f"E_{axis}": "+-" for axis in results.values("forces", "axis")}
    notes = ["S: sway imperfections; those of other combinations are left out."] if idle else []
    notes += _of_one_sense(results, member)
    rows: list[dict[str, Value]] = [
        {"action": action}
        | {force: Marked(value, before=sign if value else "") for force, value in zip(forces, values, strict=True)}
        for (action, sign), values in zip(signs.items(), every.tolist(), strict=True)
        if action not in idle
    ]
    return FORCES.of(rows, more=columns, notes=notes, whose=name, place=place)


def _of_one_sense(results: BuildingResults, member: int) -> list[str]:
    """What the forces of a brace are that does not count in compression."""
    group = str(results.values("members", "group")[member])
    runs = results.building.braces if results.building is not None else ()
    if not any(run.group == group and not run.in_compression for run in runs):
        return []
    return [
        "Of the pair the brace in tension carries all (EN 1998-1, 6.7.2(2)P): E and S are twice those of the model, "
        "with both signs; own load cases have it in one sense, and 0 in the other."
    ]


def idle_sway(results: BuildingResults, combination: int) -> set[str]:
    """Return the cases of sway imperfections that do not act in a combination.

    Args:
        combination: its number, from 1; 0 where no check governs.
    """
    group = results.group("combinations")
    if "alternative" not in group.variables or not combination:
        return set()
    cases = [str(case) for case in results.values("combinations", "case")]
    kinds = [str(kind) for kind in results.values("combinations", "alternative")]
    factors = results.values("combinations", "static")[combination - 1]
    return {
        case for case, kind, factor in zip(cases, kinds, factors, strict=True) if kind == IMPERFECTION and factor == 0.0
    }


def member_data(results: BuildingResults, name: str) -> dict[str, object]:
    """Return all checks of a member for JSON, each with its calculation; errors as `member_tables`."""
    member = _member_number(results, name)
    every = [worked_check(results, member, check) for check in range(results.values("members", "check").size)]
    checks = [
        {
            "check": found.check,
            "clause": found.clause,
            "utilisation": finite(found.utilisation),
            "combination": found.combination,
            "calculation": worked_data(found),
        }
        for found in every
        if found.number
    ]
    first = every[0]
    about = {key: getattr(first, key) for key in ("member", "group", "kind", "section", "material")}
    return {**about, "length_m": first.length, "checks": checks}


def _member(results: BuildingResults, member: int) -> Member:
    """A member as its checks saw it."""

    def of(name: str) -> float:
        return float(results.values("members", name)[member])

    flags = {name: bool(of(name)) for name in ("twists", "general")}
    lengths = {part.name: of(part.name) for part in fields(Stability) if part.name not in flags}
    return Member(
        section=results.section(str(results.values("members", "section")[member])),
        fy=of("fy"),
        stability=Stability(**lengths, **flags),  # type: ignore[arg-type]
        section_class=min(int(of("class")), 3),
        V_M=of("V_M"),
        E=of("E"),
        G=of("G"),
        gamma_M0=results.number("gamma_M0"),
        gamma_M1=results.number("gamma_M1"),
        annex_a=bool(of("annex_a")),
    )


def _free_beam(results: BuildingResults, member: int, combination: int) -> FreeBeam | None:
    """What holds and loads a beam that no slab holds; None of other members."""
    if not results.has("free_beams"):
        return None
    of = results.values("free_beams", "beam") == results.values("members", "member")[member]
    if not of.any():
        return None
    loads = results.values("free_beams", "load")[:, of][:, 0]
    load = float(results.values("combinations", "static")[combination] @ loads)
    span, uniform = (results.values("free_beams", name)[of][0] for name in ("span", "uniform"))
    return FreeBeam(float(span), load, bool(uniform))


def forces_along(results: BuildingResults, member: int, combination: int) -> ForcesAlong:
    """Return the forces of a member under a combination.

    Args:
        member: number of the member, from 0.
        combination: number of the combination, from 0.
    """
    steady = np.tensordot(
        results.values("combinations", "static")[combination], results.values("forces", "static")[:, member], 1
    )
    factors = np.abs(results.values("combinations", "seismic")[combination])
    seismic = results.values("forces", "seismic")[:, member]
    if results.values("combinations", "directions")[combination] == "srss":
        alternating = np.sqrt(np.tensordot(factors**2, seismic**2, 1))
    else:
        alternating = np.tensordot(factors, seismic, 1)
    moments = np.array([str(of).startswith(("M", "T")) for of in results.values("forces", "force")])
    top = np.where(moments, *(np.abs([steady[:, of], alternating[:, of]]).max() for of in (moments, ~moments)))
    steady = np.where(np.abs(steady) < ROUNDING * top, 0.0, steady)
    alternating = np.where(np.abs(alternating) < ROUNDING * top, 0.0, alternating)
    return ForcesAlong(results.values("forces", "station"), steady, alternating)
