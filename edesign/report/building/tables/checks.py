"""Every check of every group of members: ratio of demand and capacity, clause, verdict, and where it governs."""

from __future__ import annotations

import math

import numpy as np

from edesign.codes.rule_check import first_of_largest
from edesign.report.building.results import MET, NOT_MET, BuildingResults
from edesign.report.tables.cell import Value
from edesign.report.tables.column import col, count, text, verdict
from edesign.report.tables.number import finite
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE

CHECKS = TableSpec[dict[str, Value]](
    "checks_of_members",
    "Checks of members: largest ratio of demand and capacity in each group",
    (
        text("group"),
        text("section"),
        text("check"),
        text("clause", broken=1),
        col("D/C", ONE, digits=3),
        verdict("verdict"),
        text("member"),
        count("combination"),
        col("x / L", ONE, form=".3g"),
    ),
    notes=(
        "Combinations are numbered in the table of combinations; x / L is the place along the member.",
        "The worked calculation of the governing check of each group, with demand and capacity, is under Members.",
    ),
    keys=4,
)


def group_checks_table(results: BuildingResults) -> Table:
    """Return for each group and each check that applies to it the member in which the ratio is largest.

    Raises:
        ArchiveError: the members of the archive cannot be read.
    """
    members, rows = results.rows("members", "member"), []
    groups, utilisation = results.values("members", "group"), results.values("members", "utilisation")
    combinations = results.values("members", "combination")
    for group in dict.fromkeys(groups.tolist()):
        chosen = np.flatnonzero(groups == group)
        for check in results.rows("members", "check"):
            k = check.number
            applies = combinations[chosen, k] > 0
            if not applies.any():
                continue
            ratios = np.where(applies, np.nan_to_num(utilisation[chosen, k], nan=-1.0), -1.0)
            member = members[int(chosen[first_of_largest(ratios)])]
            ratio = float(member["utilisation"][k])
            row: dict[str, Value] = {name: member[name] for name in ("group", "section", "member")}
            row |= {"check": check_words(str(check["check"])), "clause": check["clause"], "D/C": use(ratio)}
            row["verdict"] = MET if ratio <= 1.0 else NOT_MET
            row |= {"combination": member["combination"][k], "x / L": member["station"][k]}
            rows.append(row)
    return CHECKS.of(rows)


def use(utilisation: float) -> float | str | None:
    """Return a utilisation as tables have it: `inf` without resistance, None where no check applies."""
    return "inf" if math.isinf(utilisation) else finite(utilisation)


_WORDS = {
    "N": "axial force",
    "V_Y": "shear along y",
    "V_Z": "shear along z",
    "M_Y": "bending about y",
    "M_Z": "bending about z",
    "N_M": "bending and axial force",
    "N_B": "flexural buckling",
    "M_B": "lateral-torsional buckling",
    "EQ_6_61": "buckling, Eq. 6.61",
    "EQ_6_62": "buckling, Eq. 6.62",
    "BEAM_M": "moment of dissipative beams",
    "BEAM_N": "axial force of dissipative beams",
    "BEAM_V": "shear of dissipative beams",
    "COLUMN_V": "shear of columns",
}


def check_words(name: str) -> str:
    """Return a check of the archive in words; one that has none here stays as it is."""
    return _WORDS.get(name, name)
