"""The tables of the elastic design of a building, from its archive."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from edesign.archive.reader import Archive
from edesign.codes.rule_check import first_of_largest, with_standard
from edesign.errors import ArchiveError
from edesign.project.notation.printed_unit import told_apart
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.building.code_in_use import in_code, rules_in_use
from edesign.report.building.results import MET, NOT_MET, BuildingResults, Row
from edesign.report.building.tables.checks import check_words, use
from edesign.report.building.tables.combinations import combinations_table, sway_table
from edesign.report.building.tables.deflections import deflection_table
from edesign.report.building.tables.foundations import foundation_table, persistent_table, reaction_table
from edesign.report.building.tables.lateral import drifts_table, lateral_cases_table
from edesign.report.building.tables.links import link_details_table, links_table
from edesign.report.building.tables.steel_list import beside_table, doublers_table, every_member_table, steel_list_table
from edesign.report.tables.cell import Rounded, Value
from edesign.report.tables.column import bounded, col, count, formula, text, verdict
from edesign.report.tables.number import finite, significant
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, M_S2, MM, ONE, PERCENT, S, Unit
from edesign.space.structure.frame import AXES, Axis

Make = Callable[[BuildingResults], Table]


def _at_lower_bound(axis: Axis) -> Callable[[Row], str]:
    return lambda mode: "*" * bool(mode[f"lower_bound_{axis}"])


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


NATURAL_MODES = TableSpec[Row](
    "natural_modes",
    "Natural modes",
    (
        count("mode"),
        col("T", S, "period"),
        *(
            col(f"mass {name}", PERCENT, f"effective_mass_ratio_{name}", 3, negligible=1e-5)
            for name in ("x", "y", "rz")
        ),
        *(col(f"S_d {of}", M_S2, f"design_acceleration_{of}", 3, mark=_at_lower_bound(of)) for of in AXES),
    ),
    signs=("*: the lower bound beta a_g governs (EN 1998-1, 3.2.2.5(4)P)",),
    formulas=True,
    most=12,
    cut="the first {shown} of {all} modes",
)
SEISMIC_ACTION = TableSpec[dict[str, Value]](
    "seismic_action",
    "Seismic action",
    (
        text("direction"),
        col("q", ONE, digits=3),
        col("V", KN),
        col("by weight", ONE, digits=3),
        col("without beta", Unit("", 1e3)),  # kN, as V
        col("F_b", KN),
        col("Omega", ONE, digits=3),
        text("of"),
    ),
    notes=(
        "mass {mass} t; Omega: least overstrength of dissipative members",
        "V: base shear, combined from the modes",
    ),
    formulas=True,
)
STOREYS = TableSpec[Row](
    "building_storeys",
    "Storeys, direction {axis}",
    (
        count("storey"),
        col("V", KN, "shear"),
        col("P", KN, "gravity"),
        col("d_r", MM, "drift", 3),
        col("q d_e", Unit("", 1e-3), "drift_q", 3),  # mm, as d_r
        col("theta", ONE, digits=3),
        col("theta_q", ONE, digits=3),
        col("factor", ONE, "amplification", 3),
        col("nu d_r/h", ONE, "reduced", 3),
    ),
    notes=("theta_q: with q d_e; factor: on the effects of the action, for second order.",),
    formulas=True,
    named_by_title=True,
)


def _of_rule(name: str) -> Callable[[Row], Value]:
    """The value or the limit of a rule; of one that is not met with the digits that tell them apart."""

    def of(rule: Row) -> Value:
        shown = bounded(name)(rule)
        pair = finite(rule["value"]), finite(rule["required"])
        if shown is None or rule["passed"] != 0 or None in pair or significant(pair[0], 3) != significant(pair[1], 3):
            return shown
        return Rounded(told_apart(*pair, significant)[name == "required"], float(shown))

    return of


RULES = TableSpec[Row](
    "building_rules",
    "Rules for the building, clauses of EN 1998-1 where no other code is named",
    (
        text("clause"),
        formula("rule", lambda rule: ": ".join(filter(None, (rule["text"], rule["detail"]))), broken=1),
        col("value", ONE, _of_rule("value"), 3),
        col("limit", ONE, _of_rule("required"), 3),
        verdict("", lambda rule: {1: MET, 0: NOT_MET}.get(int(rule["passed"]))),
    ),
    keys=2,
)
MEMBERS = TableSpec[Worst](
    "members",
    "Members: the governing check of each group",
    (
        text("group"),
        text("section"),
        count("members", "count"),
        col("use", ONE, lambda worst: use(worst.utilisation), 3),
        text("check", "name"),
        text("member"),
        count("combination"),
    ),
    notes=("use: effect over resistance; combination: its number among those below",),
    keys=2,
)
VERDICT = TableSpec[None]("verdict", "Verdict", ())
MISSING = TableSpec[None]("missing", "Missing", ())


def building_tables(archive: Archive) -> list[Table]:
    """Return the tables of a building: modes, base shear, storeys, rules, members by group, combinations, verdict.

    Of a damaged archive, or one of another version, they are those whose groups are there; the others are named.
    Tables without rows, as of own load cases, are left out.

    Raises:
        ArchiveError: nothing of the building is there.
    """
    return _made(archive, TABLES)


def short_building_tables(archive: Archive) -> list[Table]:
    """Return verdict, base shear, the governing check of each group of members, and steel; see `building_tables`."""
    return _made(archive, SHORT_TABLES)


def _made(archive: Archive, makes: tuple[Make, ...]) -> list[Table]:
    results = BuildingResults(archive)
    results.group()
    tables: list[Table] = []
    missing: list[str] = []
    for make in makes:
        with or_missing(missing):
            table = in_code(make(results), rules_in_use(results))
            tables += [table] if table.rows or not table.columns else []
    return [*tables, MISSING.of((), notes=missing)] if missing else tables


@contextmanager
def or_missing(missing: list[str]) -> Iterator[None]:
    """Go on where a group that is needed cannot be read.

    Args:
        missing: what cannot be read; it is added.
    """
    try:
        yield
    except ArchiveError as error:
        if str(error) not in missing:
            missing.append(str(error))


def worst_of_groups(results: BuildingResults) -> Iterator[Worst]:
    """Yield the governing check of each group, in the order of the members."""
    groups, utilisation = results.values("members", "group"), results.values("members", "utilisation")
    for group in dict.fromkeys(groups.tolist()):
        chosen = np.flatnonzero(groups == group)
        filled = np.where(np.isnan(utilisation[chosen]), -1.0, utilisation[chosen])
        which, check = (int(place) for place in np.unravel_index(first_of_largest(filled), filled.shape))
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
    shares = [results.values("modes", f"effective_mass_ratio_{name}") for name in ("x", "y", "rz")]
    periods = results.values("modes", "period")
    leading = [
        f"{name} mode {int(of.argmax()) + 1} ({periods[of.argmax()]:.4g} s, {100.0 * of.max():.1f} %)"
        for name, of in zip(("along x", "along y", "about z"), shares, strict=True)
    ]
    return NATURAL_MODES.of(
        results.rows("modes", "mode"), notes=[f"leading by effective mass of the whole: {', '.join(leading)}"]
    )


def base_shear_table(results: BuildingResults) -> Table:
    """Return base shear and overstrength of both directions."""
    mass = results.number("mass_kg")
    lateral = "F_b_x_N" in results.group().attributes  # not in all archives
    rows: list[dict[str, Value]] = []
    for axis in AXES:
        shear = results.number(f"base_shear_{axis}_N")
        rows.append(
            {
                "direction": axis,
                "q": results.number(f"q_{axis}"),
                "V": shear,
                "by weight": shear / (mass * STANDARD_GRAVITY),
                "without beta": results.number(f"base_shear_without_beta_{axis}_N"),
                "F_b": results.number(f"F_b_{axis}_N") if lateral else None,
                "Omega": results.number(f"Omega_{axis}"),
                "of": results.text(f"Omega_member_{axis}"),
            }
        )
    by_forces = (
        "F_b = S_d(T_1) m lambda: of the lateral force method, whose forces F_i give static moments of accidental "
        "torsion (EN 1998-1, 4.3.3.2.2 and 4.3.3.3.3)"
    )
    return SEISMIC_ACTION.of(rows, mass=significant(mass / 1e3), notes=[by_forces] if lateral else [])


def storeys_table(results: BuildingResults, axis: str) -> Table:
    """Return shear, gravity, drifts and theta of the storeys under the action along an axis, from the roof down.

    Args:
        axis: direction of the seismic action, x or y.
    """
    name = f"storeys_{axis}"
    limit = results.group(name).attributes.get("limit")
    limits = (
        [] if limit is None else [f"Limit of nu d_r/h: {significant(float(str(limit)), 3)} (EN 1998-1, 4.4.3.2(1))"]
    )
    return STOREYS.of(reversed(results.rows(name, "storey")), axis=axis, notes=limits)


def criteria_table(results: BuildingResults) -> Table:
    """Return the rules for the whole building, with the values and places found."""
    return RULES.of(results.rows("criteria", "rule"))


def groups_table(results: BuildingResults, say: Callable[[str], str] = str) -> Table:
    """Return the governing check of each group of members.

    Args:
        say: gives the name of a group of members.
    """
    groups = [replace(worst, name=say(worst.name)) for worst in worst_of_groups(results)]
    notes = []
    if any(use(worst.utilisation) == "inf" for worst in groups):
        notes.append("inf: there is no resistance, as beyond a critical force, or beside so much shear or axial force")
    clauses = {worst.name: worst.clause for worst in groups}
    return MEMBERS.of(groups, notes=[*notes, *(f"{name}: {clause}" for name, clause in clauses.items())])


def verdict_table(results: BuildingResults) -> Table:
    """Return the checks that are not met and remarks for the engineer as a table without columns."""
    found = [f"not met: {failure}" for failure in failures(results)]
    if results.number("passed"):
        found = ["all checks and rules are met"]
    return VERDICT.of((), notes=[*found, *remarks(results)])


def remarks(results: BuildingResults) -> list[str]:
    """Return one sentence for each remark for the engineer."""
    notes = results.group().attributes.get("notes")
    return [str(note) for note in notes] if isinstance(notes, list) else []


def failures(results: BuildingResults) -> list[str]:
    """Return the checks and rules that are not met, checks of groups first."""
    found = [
        f"{worst.group} {worst.section}: {check_words(worst.name)} {worst.utilisation:.3f} ({worst.clause})"
        for worst in worst_of_groups(results)
        if worst.utilisation > 1.0
    ]
    for rule in results.rows("criteria", "rule"):
        if rule["passed"] == 0:
            about = f"{rule['text']} ({rule['detail']})" if rule["detail"] else rule["text"]
            code = with_standard(rule["clause"])
            value, limit = told_apart(finite(rule["value"]), finite(rule["required"]), significant)
            found.append(f"{about}: {value}, limit {limit} ({code})")
    return found


TABLES: tuple[Make, ...] = (
    modes_table,
    base_shear_table,
    *(partial(storeys_table, axis=axis) for axis in AXES),
    criteria_table,
    links_table,
    link_details_table,
    groups_table,
    steel_list_table,
    beside_table,
    doublers_table,
    every_member_table,
    deflection_table,
    lateral_cases_table,
    drifts_table,
    reaction_table,
    persistent_table,
    foundation_table,
    sway_table,
    combinations_table,
    verdict_table,
)
SHORT_TABLES: tuple[Make, ...] = (verdict_table, base_shear_table, groups_table, steel_list_table)
