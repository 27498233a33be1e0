"""The tables of the elastic design of a building, from its archive."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.project.units import STANDARD_GRAVITY
from edesign.report.deflection_table import deflection_table, worst_beams
from edesign.report.table import Table, number
from edesign.space.archived import PLACE
from edesign.space.response import AXES

MODES_SHOWN = 12
WORST_SHOWN = 3


def building_tables(archive: Archive) -> list[Table]:
    """Return the tables of a building: modes, base shear, storeys, rules, members by group, combinations.

    Raises:
        ArchiveError: a group is missing or damaged.
    """
    summary = archive.group(PLACE)
    tables = [_modes(archive.group(f"{PLACE}/modes")), _base_shear(summary)]
    tables += [_storeys(axis, archive.group(f"{PLACE}/storeys_{axis}")) for axis in AXES]
    tables += [_criteria(archive.group(f"{PLACE}/criteria"))]
    members, rows = archive.group(f"{PLACE}/members"), archive.group(f"{PLACE}/combinations")
    tables += [_groups(members), deflection_table(archive.group(f"{PLACE}/deflections")), _combinations(rows)]
    verdict = ["all checks and rules are met"] if summary.attributes["passed"] else _failures(members, archive)
    tables.append(Table("Verdict", notes=[*verdict, *map(str, _list(summary.attributes.get("notes")))]))
    return tables


def building_summary(archive: Archive) -> dict[str, object]:
    """Return the results of a building for JSON, SI units: modes, base shears, storeys, rules, groups, verdict."""
    summary = archive.group(PLACE)
    modes, members = archive.group(f"{PLACE}/modes"), archive.group(f"{PLACE}/members")
    found: dict[str, object] = dict(summary.attributes) | {"passed": bool(summary.attributes["passed"])}
    found["modes"] = [
        {
            "period_s": float(modes.variables["period"].values[k]),
            **{name: float(modes.variables[f"effective_mass_ratio_{name}"].values[k]) for name in ("x", "y", "rz")},
        }
        for k in range(modes.coords["mode"].values.size)
    ]
    for axis in AXES:
        group = archive.group(f"{PLACE}/storeys_{axis}")
        names = list(group.variables)
        found[f"storeys_{axis}"] = [
            {"storey": k + 1, **{name: float(group.variables[name].values[k]) for name in names}}
            for k in range(group.coords["storey"].values.size)
        ]
    rules = archive.group(f"{PLACE}/criteria")
    found["rules"] = [
        {
            "clause": str(rules.variables["clause"].values[k]),
            "text": str(rules.variables["text"].values[k]),
            "required": _finite(rules.variables["required"].values[k]),
            "value": _finite(rules.variables["value"].values[k]),
            "passed": {1: True, 0: False}.get(int(rules.variables["passed"].values[k])),
            "detail": str(rules.variables["detail"].values[k]),
        }
        for k in range(rules.coords["rule"].values.size)
    ]
    rows = archive.group(f"{PLACE}/combinations").variables["name"].values
    found["groups"] = [
        {
            "group": worst.group,
            "section": worst.section,
            "utilisation": _finite(worst.utilisation),
            "passed": not worst.utilisation > 1.0,
            "check": worst.check,
            "clause": worst.clause,
            "member": worst.member,
            "combination": str(rows[worst.combination - 1]) if worst.combination else "",
        }
        for worst in _worst_of_groups(members)
    ]
    found["deflections"] = [
        {
            "group": worst.group,
            "loads": worst.load,
            "beam": worst.beam,
            "span_m": worst.span,
            "deflection_m": worst.deflection,
            "limit": worst.limit,
        }
        for worst in worst_beams(archive.group(f"{PLACE}/deflections"))
    ]
    return found


class _Worst:
    """The largest utilisation of a group of members."""

    def __init__(self, members: Group, group: str) -> None:
        of = members.variables
        chosen = np.flatnonzero(of["group"].values == group)
        utilisation = of["utilisation"].values[chosen]
        filled = np.where(np.isnan(utilisation), -1.0, utilisation)
        which, check = np.unravel_index(int(filled.argmax()), filled.shape)
        number_of = chosen[which]
        self.group, self.count = group, chosen.size
        self.section = str(of["section"].values[number_of])
        self.utilisation = float(utilisation[which, check])
        self.check = str(members.coords["check"].values[check])
        self.clause = str(of["clause"].values[check])
        self.member = str(members.coords["member"].values[number_of])
        self.combination = int(of["combination"].values[number_of, check])


def _worst_of_groups(members: Group) -> Iterator[_Worst]:
    for group in dict.fromkeys(members.variables["group"].values.tolist()):
        yield _Worst(members, str(group))


def _modes(group: Group) -> Table:
    of = group.variables
    table = Table(
        "Natural modes", ("mode", "T [s]", "mass x [%]", "mass y [%]", "mass rz [%]", "S_d x", "S_d y [m/s2]")
    )
    for k in range(min(MODES_SHOWN, group.coords["mode"].values.size)):
        ratios = [of[f"effective_mass_ratio_{name}"].values[k] for name in ("x", "y", "rz")]
        S_d = [of[f"design_acceleration_{axis}"].values[k] for axis in AXES]
        bound = ["*" if of[f"lower_bound_{axis}"].values[k] else "" for axis in AXES]
        table.rows.append(
            [
                str(k + 1),
                number(of["period"].values[k]),
                *(number(ratio, 3, 0.01, negligible=1e-5) for ratio in ratios),
                *(f"{number(value, 3)}{mark}" for value, mark in zip(S_d, bound, strict=True)),
            ]
        )
    if any("*" in cell for row in table.rows for cell in row):
        table.notes.append("*: the lower bound beta a_g governs (EN 1998-1, 3.2.2.5(4)P)")
    return table


def _base_shear(summary: Group) -> Table:
    of = summary.attributes
    weight = float(str(of["mass_kg"])) * STANDARD_GRAVITY
    table = Table(
        "Seismic action", ("direction", "q", "base shear [kN]", "by weight", "without beta [kN]", "Omega", "of")
    )
    for axis in AXES:
        shear = float(str(of[f"base_shear_{axis}_N"]))
        table.rows.append(
            [
                axis,
                number(float(str(of[f"q_{axis}"])), 3),
                number(shear, 4, 1e3),
                number(shear / weight, 3),
                number(float(str(of[f"base_shear_without_beta_{axis}_N"])), 4, 1e3),
                number(float(str(of[f"Omega_{axis}"])), 3),
                str(of[f"Omega_member_{axis}"]),
            ]
        )
    table.notes.append(
        f"mass {number(float(str(of['mass_kg'])), 4, 1e3)} t; Omega: least overstrength of dissipative members"
    )
    return table


def _storeys(axis: str, group: Group) -> Table:
    of = group.variables
    limit = group.attributes.get("limit")
    table = Table(
        f"Storeys, direction {axis}",
        ("storey", "V [kN]", "P [kN]", "d_r [mm]", "q d_e [mm]", "theta", "theta q d_e", "factor", "nu d_r/h [%]"),
    )
    for k in reversed(range(group.coords["storey"].values.size)):
        row = [str(k + 1), number(of["shear"].values[k], 4, 1e3), number(of["gravity"].values[k], 4, 1e3)]
        row += [number(of[name].values[k], 3, 1e-3) for name in ("drift", "drift_q")]
        row += [number(of[name].values[k], 3) for name in ("theta", "theta_q", "amplification")]
        table.rows.append([*row, number(of["reduced"].values[k], 3, 0.01)])
    if limit is not None:
        table.notes.append(f"limit of nu d_r/h: {number(float(str(limit)), 3, 0.01)} % (EN 1998-1, 4.4.3.2(1))")
    return table


def _criteria(group: Group) -> Table:
    of = group.variables
    table = Table("Rules for the building", ("clause", "rule", "value", "limit", "", "where"), left=2)
    for k in range(group.coords["rule"].values.size):
        passed = {1: "met", 0: "NOT MET"}.get(int(of["passed"].values[k]), "-")
        numbers = [number(_finite(of[name].values[k]), 3) for name in ("value", "required")]
        table.rows.append(
            [str(of["clause"].values[k]), str(of["text"].values[k]), *numbers, passed, str(of["detail"].values[k])]
        )
    return table


def _groups(members: Group) -> Table:
    table = Table(
        "Members: the governing check of each group",
        ("group", "section", "members", "use", "check", "member", "combination"),
        left=2,
    )
    for worst in _worst_of_groups(members):
        table.rows.append(
            [
                worst.group,
                worst.section,
                str(worst.count),
                number(_finite(worst.utilisation), 3),
                f"{worst.check} ({worst.clause})",
                worst.member,
                str(worst.combination),
            ]
        )
    table.notes.append("use: effect over resistance; combination: its number below")
    return table


def _combinations(group: Group) -> Table:
    of = group.variables
    table = Table("Combinations of actions", ("no.", "combination", "situation", "EN 1990"), left=4)
    for k in range(group.coords["combination"].values.size):
        table.rows.append([str(k + 1), *(str(of[name].values[k]) for name in ("name", "set", "equation"))])
    return table


def _failures(members: Group, archive: Archive) -> list[str]:
    over = [worst for worst in _worst_of_groups(members) if worst.utilisation > 1.0]
    rules = archive.group(f"{PLACE}/criteria").variables
    broken = [str(rules["text"].values[k]) for k in np.flatnonzero(rules["passed"].values == 0)]
    found = [f"not met: {worst.group} {worst.section}: {worst.check} {worst.utilisation:.3f}" for worst in over]
    return found + [f"not met: {rule}" for rule in broken]


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None


def _list(value: object) -> list[object]:
    return value if isinstance(value, list) else []
