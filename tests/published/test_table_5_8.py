"""The thesis study (projects/thesis_10_storey/study.yaml) against Tables 5.7 and 5.8, and against its own means.

References: thesis Tables 5.7 and 5.8 with the bars of projects/thesis_10_storey/reference.yaml; where a cell is beyond
its bar, docs/results/thesis_study.md says what the runs of causes.yaml show. The means in thesis_study_means.csv are
those of this program with simulated records where recordings cannot ship; EDESIGN_REWRITE_CASES=1 renews them.
The whole study is for `make pytest ARGS="-m study"`; `make slow` runs three of its twenty records.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from edesign import load_study, open_archive, run_study
from edesign.project.study.reference_loader import load_reference
from edesign.report.comparison.cells import ComparedCell, Comparison
from edesign.report.comparison.compare import compare

THESIS = Path(__file__).resolve().parents[2] / "projects" / "thesis_10_storey"
MEANS = Path(__file__).with_name("thesis_study_means.csv")
MEANS_OF_THREE = Path(__file__).with_name("thesis_study_means_of_three.csv")
THREE = ("ImperialValley1940_I-ELC180", "Tabas1978_FER-L1", "BorregoMtn1968_A-ELC180")
MEAN = "Table 5.8, mean response"

BEYOND = {  # cells of Table 5.8 beyond their bars, with simulated records; docs/results/thesis_study.md
    ("bare", "DBE"): {
        "residual roof displacement",
        "residual interstorey drift",
        "beam plastic rotation",
        "column plastic rotation",
    },
    ("bare", "MCE"): {"roof acceleration", "beam plastic rotation", "column plastic rotation"},
    ("damped", "DBE"): {
        "residual roof displacement",
        "roof drift",  # a misprint, 29 cm of 35 m are 0.83 %
        "interstorey drift",
        "residual interstorey drift",
        "roof acceleration",
        "column plastic rotation",
    },
    ("damped", "MCE"): {
        "roof displacement",
        "residual roof displacement",
        "roof drift",
        "interstorey drift",
        "residual interstorey drift",
        "column plastic rotation",
    },
}
NEAR = 0.01  # of a bar: what is so close to it may stand on either side on another machine


@pytest.fixture(scope="module")
def comparison(tmp_path_factory: pytest.TempPathFactory) -> Comparison:
    return compared(tmp_path_factory.mktemp("thesis") / "study.h5", (), 85)  # modes, gravity, 20 x 2 x 2, the warm one


@pytest.fixture(scope="module")
def of_three(tmp_path_factory: pytest.TempPathFactory) -> Comparison:
    only = [f"{variant}.{level}.{name}" for variant, level in BEYOND for name in THREE]
    return compared(tmp_path_factory.mktemp("thesis") / "three.h5", only, len(only))


def compared(path: Path, only: Sequence[str], count: int) -> Comparison:
    summary = run_study(load_study(THESIS / "study.yaml"), path, workers=2, only=only)
    assert not summary.failed, [outcome.reason for outcome in summary.failed]
    assert len(summary.outcomes) == count
    with open_archive(path) as archive:
        return compare(archive, load_reference(THESIS / "reference.yaml"))


def cells(comparison: Comparison, title: str) -> list[ComparedCell]:
    return [cell for table in comparison.tables if table.title == title for cell in table.cells]


@pytest.mark.study
def test_no_history_is_lost(comparison: Comparison) -> None:
    """20 of 20 histories in every cell; OpenSees with its usual fallbacks loses most of the bare frame's at MCE."""
    found = cells(comparison, MEAN)
    assert len(found) == 40
    assert all(cell.count == cell.of == 20 and not cell.missing for cell in found)


@pytest.mark.study
def test_means_are_within_the_bars_but_for_those_that_are_explained(comparison: Comparison) -> None:
    beyond = {key: set[str]() for key in BEYOND}
    for cell in cells(comparison, MEAN):
        assert cell.difference is not None and cell.within is not None
        if abs(abs(cell.difference) - cell.within) > NEAR and not cell.inside:
            beyond[cell.variant, cell.level].add(cell.quantity)
    assert beyond == BEYOND


@pytest.mark.slow  # the design alone is in test_table_5_7.py
def test_storey_stiffness_is_that_of_table_5_7(of_three: Comparison) -> None:
    found = [cell for cell in cells(of_three, "Table 5.7") if cell.quantity == "storey stiffness"]
    assert len(found) == 10
    assert all(cell.difference is not None and abs(cell.difference) < 0.12 for cell in found)


@pytest.mark.study
def test_means_hold(comparison: Comparison) -> None:
    hold(comparison, MEANS)


@pytest.mark.slow
def test_means_of_three_records_hold(of_three: Comparison) -> None:
    hold(of_three, MEANS_OF_THREE)
    assert all(cell.count == 3 and not cell.missing for cell in cells(of_three, MEAN))


def hold(comparison: Comparison, means: Path) -> None:
    """2 % for peaks, 10 % for what is left of plastic excursions and for rotations, which are differences."""
    rows = [
        {"variant": cell.variant, "level": cell.level, "quantity": cell.quantity, "value": f"{cell.found:.5g}"}
        for cell in cells(comparison, MEAN)
    ]
    if os.environ.get("EDESIGN_REWRITE_CASES"):
        with means.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, rows[0], lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
    with means.open(encoding="utf-8") as file:
        expected = list(csv.DictReader(file))
    assert [{**row, "value": ""} for row in rows] == [{**row, "value": ""} for row in expected]
    for row, wanted in zip(rows, expected, strict=True):
        small = "residual" in row["quantity"] or "rotation" in row["quantity"]
        assert float(row["value"]) == pytest.approx(float(wanted["value"]), rel=0.10 if small else 0.02), row
