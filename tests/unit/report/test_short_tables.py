"""What a run ends with: verdicts by criterion, means by level, on lines that fit."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from unit.assess.assessed import FRAME, frame, history, part

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.assess.criteria import Verdict, judge
from edesign.assess.sets import history_sets
from edesign.report.assessment.check_table import check_table
from edesign.report.assessment.measure_tables import DIFFERENCE, means_tables
from edesign.report.assessment.verdict_tables import verdicts_tables
from edesign.report.assessment.verdicts_in_short import verdicts_in_short
from edesign.report.short_tables import short_tables
from edesign.report.tables.table import Table
from edesign.report.tables.text import PAPER, fitted, plain, print_tables

LONG = "ImperialValley1979_H-CHI012"  # as long as names of recordings become
STUDY = part(
    "criteria:\n"
    "  - {name: drift, measure: interstorey_drift, least: 0.7 %, most: 1.3 %, levels: DBE}\n"
    "  - {name: columns, plastic_hinges: none, of: columns, levels: DBE}\n"
    "objectives: [h]\n"
)
HISTORIES = {
    f"{variant}.DBE.{record}": history(variant, "DBE", drift, record=f"suite/{record}")
    for variant, drifts in {"bare": (0.02, 0.03), "damped": (0.01, 0.012), "damped twice": (0.008, 0.009)}.items()
    for record, drift in zip((LONG, "two"), drifts, strict=True)
}


def verdict(ratio: float, count: int = 7, variant: str = "bare") -> Verdict:
    asked = ("drift", "interstorey drift at most 1 %", variant, "DBE", "mean")
    return Verdict(*asked, 0.01 * ratio, 0.01, "1", ratio <= 1.0, "", f"{variant}.DBE.{LONG}", 10, "", count, ())


def test_variants_stand_below_their_criterion() -> None:
    table = verdicts_in_short(judge(STUDY.criteria, STUDY.objectives, HISTORIES, frame()))
    assert table.headings[0] == "drift, DBE: interstorey drift 0.7 to 1.3 %"
    assert table.rows[0] == ["bare", "not met", "2.5", "1.92", "storey 1 two"]
    assert table.rows[1][:4] == ["damped", "met", "1.1", "0.85"]
    assert table.headings[9] == "objective h, by members, DBE: Life Safety by plastic rotation"
    assert table.notes[0].startswith("bare: ") and "damped twice: " in table.notes[0]


@pytest.mark.parametrize("width", [60, 80, 100, 200])
def test_the_block_of_verdicts_fits_and_names_stay_whole(width: int) -> None:
    table = verdicts_in_short([verdict(1.2), verdict(0.4, variant="damped at 35 degC")])
    lines = "\n".join(plain(part) for part in fitted(table, width)).splitlines()
    assert max(map(len, lines)) <= width
    assert sum(line.endswith(LONG) for line in lines) == 2
    if width >= PAPER:
        assert sum(f"storey 10 {LONG}" in line for line in lines) == 2


def test_far_beyond_a_limit_is_no_number() -> None:
    ratios = [row[3] for row in verdicts_in_short([verdict(9.994), verdict(82.74)]).rows]
    assert ratios == ["9.99", "> 10"]


def test_one_history_is_told_as_one() -> None:
    """EN 1998-1, 3.2.3.1.2(4)a asks for three records; 4.3.3.4.3(3) takes the largest of fewer than seven."""
    notes = " ".join(verdicts_in_short([verdict(0.5, 1), verdict(0.5, 3, "damped")]).notes)
    assert "Fewer than 7 histories: damped, DBE." in notes
    assert "One history only: bare, DBE." in notes and "3 at least" in notes


def test_means_have_the_difference_beside_their_variant() -> None:
    (table,) = means_tables(history_sets(HISTORIES))
    assert table.title == "Mean response at DBE, 2 records"
    assert list(table.columns) == ["measure", "bare", "damped", DIFFERENCE, "damped twice", DIFFERENCE]
    drift = next(row for row in table.rows if row[0] == "interstorey drift [%]")
    assert drift[1:] == ["2.500", "1.100", "-56.0", "0.8500", "-66.0"]


@pytest.mark.parametrize("width", range(44, 90, 3))
def test_no_cut_parts_a_difference_from_its_variant(width: int) -> None:
    (table,) = means_tables(history_sets(HISTORIES))
    assert DIFFERENCE in table.columns
    for cut in fitted(table, width):
        columns = list(cut.columns)
        for at, header in enumerate(columns):
            assert header != DIFFERENCE or columns[at - 1].startswith("damped")
        assert max(map(len, plain(cut).splitlines())) <= width


def test_one_record_has_no_mean() -> None:
    one = {name: group for name, group in HISTORIES.items() if name.endswith("two")}
    (table,) = means_tables(history_sets(one))
    assert table.title == "Response at DBE, one record"


def test_a_path_that_is_longer_than_a_line_is_broken_inside_of_a_cell_only() -> None:
    name = "a" * 90
    (part_of,) = fitted(Table("T", ("file", "n"), [[name, "1"]]), 60)
    assert max(map(len, plain(part_of).splitlines())) <= 60
    assert "".join(row[0] for row in part_of.rows) == name
    heading = Table("T", (), [["archive", name]], left=2)  # to be copied
    assert name in plain(fitted(heading, 60)[0])


def test_an_archive_in_short(tmp_path: Path) -> None:
    path = tmp_path / "project.h5"
    root = Group(attributes={"title": "Two storeys", "planned": [*HISTORIES], "project_file": "project.yaml"})
    root.add("project_text", (), np.asarray(FRAME), "", "project file")
    with ArchiveWriter(path, root) as writer:
        for order, (name, group) in enumerate(HISTORIES.items()):
            group.attributes["order"] = order
            writer.write(f"analyses/{name}", group)
        writer.finish()
    stream = io.StringIO()
    with open_archive(path) as opened:
        print_tables(short_tables(opened), stream, widest=PAPER)
    text = stream.getvalue()
    assert "Response (largest absolute values)" in text and "Statistics" not in text
    assert text.rstrip().endswith("--all")
    assert all(len(line) <= PAPER for line in text.splitlines() if str(path) not in line)


def test_what_rounding_leaves_of_nothing_is_0_and_governed_by_nothing() -> None:
    """A column that stays elastic: its plastic rotation is the curvature less the elastic one, in doubles."""
    asked = ("columns", "no plastic hinges in columns: at most 0.001 rad", "damped", "DBE", "mean")
    one = Verdict(*asked, 1.98e-18, 1e-3, "rad", True, "", "damped.DBE.a", None, "C_A_1", 7, ())
    assert verdicts_in_short([one]).rows == [["damped", "met", "0", "0.00", "-"]]
    answers, governs = verdicts_tables([one])[:2]
    assert answers.rows[0][4] == "0 rad" and governs.rows[0][3:5] == ["-", "-"]
    assert check_table([one], ()).rows[0][-1] == "-"
    small = replace(one, value=2e-6)  # 2 microrad, which yielding may leave
    assert verdicts_in_short([small]).rows == [["damped", "met", "2e-06", "0.00", "C_A_1 a"]]
