"""Every folder here is a case: a project and the results expected of it (measures.csv, storeys.csv, periods.csv).

The expected files were written by this program (EDESIGN_REWRITE_CASES=1 writes them again, see docs/develop/cases.md).
They show when results change; that the results are right is shown beside them, in test_case_statics.py and
test_case_dynamics.py, and in tests/verification.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from cases.conftest import CASES, HERE

from edesign import summarise
from edesign.archive.reader import open_archive
from edesign.assess.profile import storey_profile

Rows = list[dict[str, str]]
REWRITE = os.environ.get("EDESIGN_REWRITE_CASES") == "1"
KEYS = ("analysis", "status", "storey", "mode")  # must agree to the letter
DIGITS = 7  # written

# Relative and absolute tolerance by column. Iterations stop at a relative unbalance of 1e-8 or tighter, and another
# machine rounds differently; what depends on the instant of yielding magnifies this, most of all what is left over.
TOLERANCES = {
    "period_s": (1e-6, 0.0),  # linear algebra on the state under gravity
    "effective_mass_ratio_x": (1e-5, 1e-8),  # a shape is less exact than its period; some modes are nearly vertical
    "roof_displacement_m": (5e-4, 1e-9),
    "roof_drift": (5e-4, 1e-9),
    "interstorey_drift": (5e-4, 1e-9),
    "base_shear_N": (5e-4, 1e-3),  # N: gravity alone gives rounding
    "column_base_shear_N": (5e-4, 1e-3),
    "column_axial_force_N": (5e-4, 1e-3),
    "floor_displacement_m": (5e-4, 1e-9),
    "storey_drift": (5e-4, 1e-9),
    "storey_shear_N": (5e-4, 1e-3),
    "roof_acceleration_m_s2": (2e-3, 1e-9),  # a peak of one step, where a member yields
    "floor_acceleration_m_s2": (2e-3, 1e-9),
    "relative_roof_acceleration_m_s2": (2e-3, 1e-9),
    "beam_plastic_rotation_rad": (2e-3, 1e-9),  # differences of total and elastic rotations
    "column_plastic_rotation_rad": (2e-3, 1e-9),
    "residual_roof_displacement_m": (5e-3, 2e-5),  # differences of plastic excursions many times larger
    "residual_interstorey_drift": (5e-3, 1e-5),
    "final_roof_displacement_m": (5e-3, 2e-5),
    "final_interstorey_drift": (5e-3, 1e-5),
    "residual_storey_drift": (5e-3, 1e-5),
    "brace_ductility": (5e-4, 1e-9),
    "brace_damage": (5e-3, 1e-9),  # a square of strain ranges
    "damper_strain": (5e-4, 1e-9),
    "damper_deformation_m": (5e-4, 1e-9),
    "damper_force_N": (1e-3, 1e-3),  # powers of the velocity, and SUNDIALS' tolerance of 1e-6 a step
}
UNITS = {
    "floor_displacement": "_m",
    "storey_drift": "",
    "residual_storey_drift": "",
    "storey_shear": "_N",
    "floor_acceleration": "_m_s2",
}


def measures(archive: Path) -> Rows:
    """Status and response measures of every analysis; those of dampers and braces where there are any."""
    items = summarise(archive)["analyses"]
    names = [
        name
        for name in items[0]["measures"]
        if not name.startswith(("damper_", "brace_")) or any(item["measures"][name] is not None for item in items)
    ]
    return [
        {"analysis": item["name"], "status": item["status"]} | {name: text(item["measures"][name]) for name in names}
        for item in items
    ]


def storeys(archive: Path) -> Rows:
    """Peaks of every storey of the histories and pushovers."""
    rows = []
    with open_archive(archive) as opened:
        for name in opened.names("analyses"):
            group = opened.group(f"analyses/{name}")
            if group.attributes["kind"] not in ("history", "pushover"):
                continue
            profile = storey_profile(group)
            for at, storey in enumerate(group.coords["storey"].values):
                values = {key + UNITS[key]: text(profile[key][at]) if key in profile else "" for key in UNITS}
                rows.append({"analysis": name, "storey": str(storey), **values})
    return rows


def periods(archive: Path) -> Rows:
    """Periods and effective masses of every modal analysis."""
    rows = []
    with open_archive(archive) as opened:
        for name in opened.names("analyses"):
            group = opened.group(f"analyses/{name}")
            if group.attributes["kind"] == "modal":
                for at, mode in enumerate(group.coords["mode"].values):
                    found = {
                        "period_s": text(group.variables["period"].values[at]),
                        "effective_mass_ratio_x": text(group.variables["effective_mass_ratio_x"].values[at]),
                    }
                    rows.append({"analysis": name, "mode": str(mode), **found})
    return rows


TABLES: dict[str, Callable[[Path], Rows]] = {"measures": measures, "storeys": storeys, "periods": periods}


def text(value: float | None) -> str:
    """A number as it stands in the files; rounding about zero becomes 0, what does not apply is empty."""
    if value is None:
        return ""
    return "0" if abs(value) < 1e-10 else f"{value:.{DIGITS}g}"


@pytest.mark.parametrize("table", TABLES)
@pytest.mark.parametrize("case", CASES)
def test_results_are_the_expected_ones(case: str, table: str, archive_of: Callable[[str], Path]) -> None:
    found = TABLES[table](archive_of(case))
    path = HERE / case / f"{table}.csv"
    if REWRITE:
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, list(found[0]), lineterminator="\n")
            writer.writeheader()
            writer.writerows(found)
        return
    with path.open(encoding="utf-8", newline="") as file:
        expected = list(csv.DictReader(file))
    assert differences(found, expected) == []


def differences(found: Rows, expected: Rows) -> list[str]:
    """What differs by more than the tolerances, each as one line."""
    if [row.keys() for row in found] != [row.keys() for row in expected]:
        return ["other rows or columns"]
    lines = []
    for new, old in zip(found, expected, strict=True):
        place = " ".join(new[key] for key in KEYS if key in new)
        for column in new:
            if column in KEYS or not (new[column] and old[column]):
                same = new[column] == old[column]
            else:
                relative, absolute = TOLERANCES[column]
                same = abs(float(new[column]) - float(old[column])) <= relative * abs(float(old[column])) + absolute
            if not same:
                lines.append(f"{place} {column}: {new[column] or 'none'}, expected {old[column] or 'none'}")
    return lines


def test_a_difference_is_seen_and_named() -> None:
    """A guard of the comparison itself: one value off by twice its tolerance, one that has gone, one row less."""
    row = {"analysis": "shake", "status": "completed", "base_shear_N": "1000000", "roof_drift": "0.01"}
    assert differences([row], [dict(row)]) == []
    assert differences([row | {"base_shear_N": "1001000"}], [row]) == [
        "shake completed base_shear_N: 1001000, expected 1000000"
    ]
    assert differences([row | {"roof_drift": ""}], [row]) == ["shake completed roof_drift: none, expected 0.01"]
    assert differences([row | {"status": "failed"}], [row]) != []
    assert differences([], [row]) == ["other rows or columns"]


def test_there_are_cases_and_all_their_analyses_complete(archive_of: Callable[[str], Path]) -> None:
    assert len(CASES) >= 7
    for case in CASES:
        if case != "thesis_4_bays":  # needs the package of its record; its table of measures holds the status
            assert {item["status"] for item in summarise(archive_of(case))["analyses"]} == {"completed"}
