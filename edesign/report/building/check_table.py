"""Every check of every group of members: ratio of demand and capacity, clause, verdict, and where it governs."""

from __future__ import annotations

import math

import numpy as np

from edesign.report.building.results import BuildingResults
from edesign.report.tables.table import Table, finite, formatted, number, whole


def group_checks_table(results: BuildingResults) -> Table:
    """Return for each group and each check that applies to it the member in which the ratio is largest.

    Raises:
        ArchiveError: the members of the archive cannot be read.
    """
    table = Table(
        "Checks of members: largest ratio of demand and capacity in each group",
        ("group", "section", "check", "clause", "D/C", "verdict", "member", "combination", "x / L"),
        left=4,
        sentences=3,
        name="checks_of_members",
    )
    groups, utilisation = results.values("members", "group"), results.values("members", "utilisation")
    names, clauses = results.values("members", "check"), results.values("members", "clause")
    combinations, stations = results.values("members", "combination"), results.values("members", "station")
    for group in dict.fromkeys(groups.tolist()):
        chosen = np.flatnonzero(groups == group)
        for check, (name, clause) in enumerate(zip(names, clauses, strict=True)):
            applies = combinations[chosen, check] > 0
            if not applies.any():
                continue
            ratios = np.where(applies, np.nan_to_num(utilisation[chosen, check], nan=-1.0), -1.0)
            member = int(chosen[int(ratios.argmax())])
            ratio = float(utilisation[member, check])
            shown = "inf" if math.isinf(ratio) else number(finite(ratio), 3)
            about = [str(group), str(results.values("members", "section")[member]), check_words(str(name)), str(clause)]
            verdict = "met" if ratio <= 1.0 else "not met"
            place = [str(results.values("members", "member")[member]), whole(combinations[member, check])]
            table.rows.append([*about, shown, verdict, *place, formatted(float(stations[member, check]), ".3g")])
    if table.rows:
        table.notes.append(
            "Combinations are numbered in the table of combinations; x / L is the place along the member."
        )
        table.notes.append("The check that governs each group is written out, with demand and capacity, under Members.")
    return table


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
