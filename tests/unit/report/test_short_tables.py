"""What a run ends with: verdicts by criterion, means by level, on lines that fit."""

from __future__ import annotations

import io
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from plain_tables import plain_table
from unit.assess.assessed import FRAME, frame, history, part

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.assess.sets import history_sets
from edesign.assess.verdicts import Verdict, judge
from edesign.project.criteria.criteria import Objectives
from edesign.report.archive.tables import SCREEN, short_tables
from edesign.report.assessment.check_table import check_table
from edesign.report.assessment.measure_tables import DIFFERENCE, statistics_tables
from edesign.report.assessment.response_in_short import response_in_short
from edesign.report.assessment.verdict_tables import verdicts_tables
from edesign.report.assessment.verdicts_in_short import verdicts_in_short
from edesign.report.page.sections.verdicts import verdict_tiles
from edesign.report.page.source import Source
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


def test_variants_stand_side_by_side() -> None:
    table, governs = verdicts_in_short(judge(STUDY.criteria, STUDY.objectives, HISTORIES, frame()), None)
    assert table.headers == ["criterion", "bare", "damped", "damped twice"]
    assert table.texts[0] == ["drift, DBE", "not met 2.31", "met 0.92", "met 0.69"]  # the larger of two, over 1.3 %
    assert [row[0] for row in table.rows[1:]] == [
        "columns, DBE", "objective h, by drift, DBE", "objective h, by members, DBE",
    ]  # fmt: skip
    assert table.notes[0].startswith("bare: ") and "damped twice: " in table.notes[0]
    assert [row[:2] for row in governs.rows][0] == ["bare", "drift, DBE"]
    assert governs.rows[1][:2] == ["damped", "columns, DBE"]


def test_a_page_counts_what_a_summary_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Criteria and objectives: one count of what is met on the screen, on the page and in the PDF."""

    def judged(archive: object, study: object, histories: object, objectives: Objectives = ()) -> tuple[Verdict, ...]:
        return judge(STUDY.criteria, objectives, HISTORIES, frame())

    monkeypatch.setattr("edesign.report.page.source.verdicts_of", judged)
    known = SimpleNamespace(study=STUDY, sets=[None], targets=[], archive=None, judged_histories=HISTORIES)
    of_page = vars(Source)["verdicts"].func(known)
    table, _ = verdicts_in_short(judge(STUDY.criteria, STUDY.objectives, HISTORIES, frame()), None)
    said = [f"{tile.label.partition(', ')[2]}: {tile.value} met" for tile in verdict_tiles(of_page)]
    assert len(said) == 3 and "; ".join(said) in " ".join(table.notes)


@pytest.mark.parametrize("width", [60, 80, 100, 200])
def test_verdicts_fit_and_names_stay_whole(width: int) -> None:
    tables = verdicts_in_short([verdict(1.2), verdict(0.4, variant="damped at 35 degC")], None)
    lines = "\n".join(plain(part) for table in tables for part in fitted(table, width)).splitlines()
    assert max(map(len, lines)) <= width
    assert sum(LONG in line for line in lines) == 2


def test_far_beyond_a_limit_is_no_number() -> None:
    cells = [verdicts_in_short([verdict(ratio)], None)[0].texts[0][1] for ratio in (9.994, 82.74)]
    assert cells == ["not met 9.99", "not met > 10"]


def test_of_many_criteria_those_that_are_met_with_room_are_counted() -> None:
    """Sixteen of one variant: the eleven with the largest demand over capacity, all that are not met among them."""
    ratios = [0.1 + 0.05 * i for i in range(15)] + [1.3]
    many = [replace(verdict(ratio), name=f"c{i}") for i, ratio in enumerate(ratios)]
    table = verdicts_in_short(many, None)[0]
    assert [row[0] for row in table.rows] == [f"c{i}, DBE" for i in range(5, 16)]
    assert table.notes[0] == "and 5 more, which all variants meet, among all tables"


def test_one_history_is_reported_as_one() -> None:
    """EN 1998-1, 3.2.3.1.2(4)a asks for three records; 4.3.3.4.3(3) takes the largest of fewer than seven."""
    notes = " ".join(verdicts_in_short([verdict(0.5, 1), verdict(0.5, 3, "damped")], None)[0].notes)
    assert "Not judged as the code does: drift (mean) of damped, DBE. Of fewer than 7 motions the most" in notes
    assert "One history only: bare, DBE." in notes and "3 at least" in notes


def test_means_have_a_line_for_each_variant_and_level() -> None:
    """Of two records each, by hand: (2 + 3) / 2, (1 + 1.2) / 2, (0.8 + 0.9) / 2."""
    table = response_in_short(history_sets(HISTORIES))
    assert table.title == "Mean response of the records" and table.headers[:3] == ["histories", "n", "drift %"]
    assert [row[:3] for row in table.texts] == [
        ["bare, DBE", "2", "2.50"], ["damped, DBE", "2", "1.10"], ["damped twice, DBE", "2", "0.850"],
    ]  # fmt: skip
    one = {name: group for name, group in HISTORIES.items() if name.endswith("two")}
    single = response_in_short(history_sets(one))
    assert single.title == "Response" and single.headers[:2] == ["histories", "drift %"]


@pytest.mark.parametrize("width", range(44, 90, 9))
def test_no_cut_parts_a_difference_from_its_variant(width: int) -> None:
    table = statistics_tables(history_sets(HISTORIES))[0]
    header_of = f"{DIFFERENCE} [%]"
    assert header_of in table.headers
    for cut in fitted(table, width):
        columns = list(cut.columns)
        for at, header in enumerate(columns):
            assert header != header_of or columns[at - 1].startswith("damped")


def test_a_path_that_is_longer_than_a_line_is_broken_inside_of_a_cell_only() -> None:
    name = "a" * 90
    (part_of,) = fitted(plain_table("T", ("file", "n"), [[name, "1"]]), 60)
    assert max(map(len, plain(part_of).splitlines())) <= 60
    assert "".join(row[0] for row in part_of.rows) == name
    heading = plain_table("T", (), [["archive", name]], keys=2)  # to be copied
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
    assert "Mean response of the records" in text and "Statistics" not in text
    assert "analyses  6 of 6 completed" in text and len(text.splitlines()) <= SCREEN
    assert text.rstrip().endswith("--all")
    assert all(len(line) <= PAPER for line in text.splitlines() if str(path) not in line)


def test_what_rounding_leaves_of_nothing_is_0_and_governed_by_nothing() -> None:
    """A column that stays elastic: its plastic rotation is the curvature less the elastic one, in doubles."""
    asked = ("columns", "no plastic hinges in columns: at most 0.001 rad", "damped", "DBE", "mean")
    one = Verdict(*asked, 1.98e-18, 1e-3, "rad", True, "", "damped.DBE.a", None, "C_A_1", 7, ())
    table, governing = verdicts_in_short([one], None)
    assert (table.texts, governing.texts) == (
        [["columns, DBE", "met 0.00"]],
        [["damped", "columns, DBE", "0 rad", "-"]],
    )
    answers, governs = verdicts_tables([one], None)[:2]
    assert answers.texts[0][4] == "0 rad" and governs.texts[0][3:5] == ["-", "-"]
    checks = check_table([one], ())
    assert checks.texts[0][checks.headers.index("governs")] == "-"
    small = replace(one, value=2e-6)  # 2 microrad, which yielding may leave
    assert verdicts_in_short([small], None)[1].texts[0][2:] == ["2e-06 rad", "C_A_1 a"]
