"""The tables of the elastic design of a building, from its archive."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from edesign.archive.reader import Archive
from edesign.errors import ArchiveError
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.building.check_table import check_words
from edesign.report.building.deflection_table import deflection_table
from edesign.report.building.foundation_table import foundation_table, reaction_table
from edesign.report.building.results import BuildingResults
from edesign.report.tables.table import Table, finite, marked, number, whole
from edesign.space.structure.frame import AXES

MODES_SHOWN = 12
_SIGN_OF_HORIZONTAL = re.compile(r"[+-] (?=(?:[0-9.]+ )?(?:E_[xyz]|S_[xy]|SRSS\())")

Make = Callable[[BuildingResults], list[Table]]


def building_tables(archive: Archive) -> list[Table]:
    """Return the tables of a building: modes, base shear, storeys, rules, members by group, combinations, verdict.

    Of a damaged archive, or one of another version, they are those whose groups are there; the others are named.

    Raises:
        ArchiveError: nothing of the building is there.
    """
    return _made(archive, TABLES)


def short_building_tables(archive: Archive) -> list[Table]:
    """Return base shear, the governing check of each group of members, and the verdict; see `building_tables`."""
    return _made(archive, SHORT_TABLES)


def _made(archive: Archive, makes: tuple[Make, ...]) -> list[Table]:
    results = BuildingResults(archive)
    results.group()
    missing = Table("Missing", name="missing")
    tables = [table for make in makes for table in or_missing(make, results, missing)]
    return [*tables, missing] if missing.notes else tables


def or_missing(make: Make, results: BuildingResults, missing: Table) -> list[Table]:
    """Return tables, or none where a group that they need cannot be read, which is noted in `missing`.

    Args:
        make: makes the tables.
        results: the results of the building.
        missing: the table whose notes name what cannot be read.
    """
    try:
        return make(results)
    except ArchiveError as error:
        if str(error) not in missing.notes:
            missing.notes.append(str(error))
        return []


@dataclass(frozen=True)
class Worst:
    """The largest utilisation of a group of members.

    Attributes:
        group, section: their names.
        count: number of its members.
        number, check: of the member and the check that govern, as they are numbered in the archive.
        utilisation: effect over resistance; nan if no check applies.
        name, clause: of the check.
        member: name of the member.
        combination: number of the combination, from 1; 0 if no check applies.
    """

    group: str
    section: str
    count: int
    number: int
    check: int
    utilisation: float
    name: str
    clause: str
    member: str
    combination: int


def worst_of_groups(results: BuildingResults) -> Iterator[Worst]:
    """Yield the governing check of each group, in the order of the members."""
    groups, utilisation = results.values("members", "group"), results.values("members", "utilisation")
    for group in dict.fromkeys(groups.tolist()):
        chosen = np.flatnonzero(groups == group)
        filled = np.where(np.isnan(utilisation[chosen]), -1.0, utilisation[chosen])
        which, check = (int(place) for place in np.unravel_index(int(filled.argmax()), filled.shape))
        member = int(chosen[which])
        yield Worst(
            group=str(group),
            section=str(results.values("members", "section")[member]),
            count=chosen.size,
            number=member,
            check=check,
            utilisation=float(utilisation[member, check]),
            name=str(results.values("members", "check")[check]),
            clause=str(results.values("members", "clause")[check]),
            member=str(results.values("members", "member")[member]),
            combination=int(results.values("members", "combination")[member, check]),
        )


def modes_table(results: BuildingResults) -> Table:
    """Return periods, effective masses and design accelerations of the first modes."""
    period = results.values("modes", "period")
    ratios = [results.values("modes", f"effective_mass_ratio_{name}") for name in ("x", "y", "rz")]
    S_d = [results.values("modes", f"design_acceleration_{axis}") for axis in AXES]
    bound = [results.values("modes", f"lower_bound_{axis}") for axis in AXES]
    table = Table(
        "Natural modes",
        ("mode", "T [s]", "mass x [%]", "mass y [%]", "mass rz [%]", "S_d x [m/s2]", "S_d y [m/s2]"),
        name="natural_modes",
    )
    table.units = ("",) * 5 + ("m/s2", "m/s2")
    table.formulas = ()
    for k in range(min(MODES_SHOWN, period.size)):
        table.rows.append(
            [
                whole(k + 1),
                number(period[k]),
                *(number(ratio[k], 3, 0.01, negligible=1e-5) for ratio in ratios),
                *(marked(number(of[k], 3), "*" * bool(lower[k])) for of, lower in zip(S_d, bound, strict=True)),
            ]
        )
    if period.size > MODES_SHOWN:
        table.notes.append(f"the first {MODES_SHOWN} of {period.size} modes")
    if any("*" in cell for row in table.rows for cell in row):
        table.notes.append("*: the lower bound beta a_g governs (EN 1998-1, 3.2.2.5(4)P)")
    return table


def base_shear_table(results: BuildingResults) -> Table:
    """Return base shear and overstrength of both directions."""
    mass = results.number("mass_kg")
    table = Table(
        "Seismic action",
        ("direction", "q", "V [kN]", "by weight", "without beta", "F_b [kN]", "Omega", "of"),
        name="seismic_action",
    )
    table.formulas = ()
    lateral = "F_b_x_N" in results.group().attributes  # not in all archives
    for axis in AXES:
        shear = results.number(f"base_shear_{axis}_N")
        table.rows.append(
            [
                axis,
                number(results.number(f"q_{axis}"), 3),
                number(shear, 4, 1e3),
                number(shear / (mass * STANDARD_GRAVITY), 3),
                number(results.number(f"base_shear_without_beta_{axis}_N"), 4, 1e3),
                number(results.number(f"F_b_{axis}_N"), 4, 1e3) if lateral else "-",
                number(results.number(f"Omega_{axis}"), 3),
                results.text(f"Omega_member_{axis}"),
            ]
        )
    table.notes.append(f"mass {number(mass, 4, 1e3)} t; Omega: least overstrength of dissipative members")
    table.notes.append("V: base shear, combined from the modes")
    if lateral:
        table.notes.append(
            "F_b = S_d(T_1) m lambda: of the lateral force method, whose forces F_i give static moments of accidental "
            "torsion (EN 1998-1, 4.3.3.2.2 and 4.3.3.3.3)"
        )
    return table


def storeys_table(results: BuildingResults, axis: str) -> Table:
    """Return shear, gravity, drifts and theta of the storeys under the action along an axis, from the roof down.

    Args:
        results: the results of the building.
        axis: direction of the seismic action, x or y.
    """
    name = f"storeys_{axis}"
    columns = (
        ("V [kN]", "shear", 4, 1e3),
        ("P [kN]", "gravity", 4, 1e3),
        ("d_r [mm]", "drift", 3, 1e-3),
        ("q d_e", "drift_q", 3, 1e-3),
        ("theta", "theta", 3, 1.0),
        ("theta_q", "theta_q", 3, 1.0),
        ("factor", "amplification", 3, 1.0),
        ("nu d_r/h", "reduced", 3, 1.0),
    )
    table = Table(f"Storeys, direction {axis}", ("storey", *(header for header, *_ in columns)), formulas=())
    found = [(results.values(name, variable), digits, unit) for _, variable, digits, unit in columns]
    for k in reversed(range(found[0][0].size)):
        table.rows.append([whole(k + 1), *(number(of[k], digits, unit) for of, digits, unit in found)])
    table.notes.append("theta_q: with q d_e; factor: on the effects of the action, for second order.")
    if (limit := results.group(name).attributes.get("limit")) is not None:
        table.notes.append(f"Limit of nu d_r/h: {number(float(str(limit)), 3)} (EN 1998-1, 4.4.3.2(1))")
    return table


def criteria_table(results: BuildingResults) -> Table:
    """Return the rules for the whole building, with the values and places found."""
    table = Table(
        "Rules for the building, clauses of EN 1998-1 where no other code is named",
        ("clause", "rule", "value", "limit", ""),
        left=2,
        name="building_rules",
    )
    table.sentences, table.formulas = 1, (1,)
    columns = [results.values("criteria", of) for of in ("clause", "text", "detail", "value", "required", "passed")]
    for clause, text, detail, value, limit, passed in zip(*columns, strict=True):
        rule = f"{text}: {detail}" if detail else str(text)
        found = {1: "met", 0: "NOT MET"}.get(int(passed), "-")
        table.rows.append([str(clause), rule, number(finite(value), 3), number(finite(limit), 3), found])
    return table


def groups_table(results: BuildingResults, say: Callable[[str], str] = str) -> Table:
    """Return the governing check of each group of members.

    Args:
        results: the results of the building.
        say: gives the name of a group of members.
    """
    table = Table(
        "Members: the governing check of each group",
        ("group", "section", "members", "use", "check", "member", "combination"),
        left=2,
        name="members",
    )
    clauses: dict[str, str] = {}
    for worst in worst_of_groups(results):
        use = "inf" if math.isinf(worst.utilisation) else number(finite(worst.utilisation), 3)
        cells = [worst.group, worst.section, whole(worst.count), use]
        table.rows.append([*cells, say(worst.name), worst.member, whole(worst.combination)])
        clauses.setdefault(say(worst.name), worst.clause)
    table.notes.append("use: effect over resistance; combination: its number among those below")
    if any(row[3] == "inf" for row in table.rows):
        table.notes.append(
            "inf: there is no resistance, as beyond a critical force, or beside so much shear or axial force"
        )
    table.notes += [f"{name}: {clause}" for name, clause in clauses.items()]
    return table


def combinations_table(results: BuildingResults) -> Table:
    """Return the combinations of actions; those that differ in signs of horizontal actions stand in one row."""
    table = Table(
        "Combinations of actions",
        ("no.", "combination", "situation", "EN 1990"),
        left=4,
        name="combinations",
    )
    table.sentences, table.formulas = 1, (1, 2)
    columns = [results.values("combinations", of) for of in ("name", "set", "equation", "static", "seismic")]
    alike: dict[tuple[object, ...], list[int]] = {}
    for k, (_, kind, equation, static, seismic) in enumerate(zip(*columns, strict=True)):
        alike.setdefault((kind, equation, *np.abs(static), *np.abs(seismic)), []).append(k)
    for numbers in alike.values():
        name, kind, equation, _, seismic = (column[numbers[0]] for column in columns)
        name = _SIGN_OF_HORIZONTAL.sub("+- ", str(name)) if len(numbers) > 1 else str(name)
        situation = f"{kind}, 1.1 gamma_ov Omega" if np.abs(seismic).max(initial=0.0) > 1.0 else str(kind)
        table.rows.append([_numbers(numbers), name, situation, str(equation)])
    if any("S_x" in row[1] for row in table.rows):
        table.notes.append(
            "S_x, S_y: sway imperfections, of the combination that they stand in; P_Delta: its sway amplified"
        )
    return table


def _numbers(places: list[int]) -> str:
    """Numbers from 1 of places in rising order: 2-5, or 2, 4."""
    first, last = places[0] + 1, places[-1] + 1
    if len(places) > 1 and last - first == len(places) - 1:
        return f"{first}-{last}"
    return ", ".join(str(place + 1) for place in places)


def verdict_table(results: BuildingResults) -> Table:
    """Return the checks that are not met and remarks for the engineer as a table without columns."""
    verdict = [f"not met: {text}" for text in failures(results)]
    if results.number("passed"):
        verdict = ["all checks and rules are met"]
    return Table("Verdict", notes=[*verdict, *remarks(results)], name="verdict")


def remarks(results: BuildingResults) -> list[str]:
    """Return one sentence for each remark for the engineer."""
    notes = results.group().attributes.get("notes")
    return [str(note) for note in notes] if isinstance(notes, list) else []


def failures(results: BuildingResults) -> list[str]:
    """Return the checks and rules that are not met, checks of groups first."""
    over = [worst for worst in worst_of_groups(results) if worst.utilisation > 1.0]
    columns = ("text", "detail", "value", "required", "passed", "clause")
    rules = zip(*(results.values("criteria", name) for name in columns), strict=True)
    found = [
        f"{worst.group} {worst.section}: {check_words(worst.name)} {worst.utilisation:.3f} ({worst.clause})"
        for worst in over
    ]
    for text, detail, value, limit, passed, clause in rules:
        if passed == 0:
            about = f"{text} ({detail})" if detail else str(text)
            code = f"EN 1998-1, {clause}" if str(clause)[:1].isdigit() else str(clause)
            found.append(f"{about}: {number(finite(value), 3)}, limit {number(finite(limit), 3)} ({code})")
    return found


TABLES: tuple[Make, ...] = (
    lambda results: [modes_table(results)],
    lambda results: [base_shear_table(results)],
    *(lambda results, axis=axis: [storeys_table(results, axis)] for axis in AXES),
    lambda results: [criteria_table(results)],
    lambda results: [groups_table(results)],
    lambda results: [deflection_table(results.group("deflections"))],
    lambda results: [reaction_table(results.group("foundations")), foundation_table(results.group("foundations"))],
    lambda results: [combinations_table(results)],
    lambda results: [verdict_table(results)],
)
SHORT_TABLES: tuple[Make, ...] = (
    lambda results: [base_shear_table(results)],
    lambda results: [groups_table(results)],
    lambda results: [verdict_table(results)],
)
