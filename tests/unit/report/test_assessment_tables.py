"""Tables of an assessment say what the histories say, of how many, and what is missing."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from unit.assess.assessed import FRAME, frame, history, part

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.assess.sets import history_sets
from edesign.assess.verdicts import Verdict
from edesign.project import parse_project
from edesign.report.assessment.measure_tables import record_measures_table, statistics_tables
from edesign.report.assessment.tables import assessment_tables, tables_of_histories
from edesign.report.assessment.verdict_tables import verdicts_tables
from edesign.report.tables.table import Table
from edesign.report.tables.text import plain

STUDY = part(
    "criteria:\n"
    "  - {name: drift, measure: interstorey_drift, least: 0.7 %, most: 1.3 %, variants: damped, levels: DBE}\n"
    "  - {name: columns, plastic_hinges: none, of: columns, levels: DBE}\n"
    "objectives: [h]\n"
)
WARM = "damped at 35 degC"
HISTORIES = {
    "bare.DBE.one": history("bare", "DBE", 0.02, record="suite/one"),
    "bare.DBE.two": history("bare", "DBE", 0.03, record="suite/two"),
    "damped.DBE.one": history("damped", "DBE", 0.01, record="suite/one"),
    "damped.DBE.two": history("damped", "DBE", status="failed", record="suite/two"),
}


def row(table: Table, name: str) -> list[str]:
    return next(cells for cells in table.texts if cells[0] == name)


def test_single_histories_have_no_statistics() -> None:
    """All statistics of one value are that value: it is printed once."""
    one = {name: HISTORIES[name] for name in ("bare.DBE.one", "damped.DBE.one")}
    (table,) = statistics_tables(history_sets(one))
    assert table.title == "Response"
    assert row(table, "interstorey drift [%]")[1:] == ["2.000", "1.000", "-50.0"]


def test_rounding_has_no_difference() -> None:
    """What is shown as 0 is no measure of anything."""
    one = {name: history(name, "DBE", drift, record="one") for name, drift in (("bare", 1e-18), ("damped", 3e-18))}
    (table,) = statistics_tables(history_sets(one))
    assert row(table, "interstorey drift [%]")[1:] == ["0", "0", "-"]


def test_statistics_stand_beside_each_other_with_their_difference() -> None:
    mean, maximum, *_ = statistics_tables(history_sets(HISTORIES))
    assert mean.headers == ["measure", "bare, DBE", "damped, DBE", "diff. [%]"]
    assert row(mean, "interstorey drift [%]")[1:] == ["2.500", "1.000", "-50.0"]  # 1 % and 2 % under record one
    assert row(maximum, "interstorey drift [%]")[1:] == ["3.000", "1.000", "-50.0"]
    assert row(mean, "residual interstorey drift [%]")[1:] == ["0.2500", "0.1000", "-50.0"]
    assert row(mean, "base shear, columns [kN]")[1:] == ["300.0", "300.0", "+0.0"]
    assert not any(cells[0].startswith("damper") for cells in mean.rows)  # none has any
    assert "Histories: bare, DBE: 2 of 2; damped, DBE: 1 of 2" in mean.notes
    assert "damped, DBE: failed, in no statistic (1 of 2): damped.DBE.two" in mean.notes
    assert "diff. of damped, DBE: over the 1 record that bare, DBE has too" in mean.notes


def test_differences_compare_the_same_records_only() -> None:
    """A variant at another temperature under one record, and one under records that the first has not."""
    warm = history("damped", "DBE", 0.015, record="suite/two")
    warm.attributes["temperature_C"] = 35.0
    added = {
        "damped.35C.DBE.two": warm,
        "other.DBE.three": history("other", "DBE", 0.04, record="suite/three"),
        "same.DBE.two": history("same", "DBE", 0.06, record="suite/two"),
        "same.DBE.one": history("same", "DBE", 0.02, record="suite/one"),
    }
    mean = statistics_tables(history_sets(HISTORIES | added))[0]
    assert mean.headers[4:] == ["damped at 35 degC, DBE", "diff. [%]", "other, DBE", "same, DBE", "diff. [%]"]
    assert row(mean, "interstorey drift [%]")[4:] == ["1.500", "-50.0", "4.000", "4.000", "+60.0"]
    reported = [note for note in mean.notes if note.startswith("diff.")]
    assert reported == [f"diff. of {name}, DBE: over the 1 record that bare, DBE has too" for name in ("damped", WARM)]


def test_measures_of_each_record_and_their_statistics() -> None:
    bare, damped = (record_measures_table(found) for found in history_sets(HISTORIES))
    at = bare.headers.index("storey drift [%]")
    assert [cells[at] for cells in bare.texts[:2]] == ["2.000", "3.000"]
    assert row(bare, "suite/one")[at] == "2.000" and row(bare, "median")[at] == "2.500"
    assert row(bare, "dispersion (of ln)")[at] == "0.287"  # ln 1.5 / sqrt 2
    assert [cells[0] for cells in damped.rows] == ["suite/one"]  # one record has no statistics
    assert damped.notes == ["failed, in no statistic (1 of 2): damped.DBE.two"]


def test_verdicts_performance_and_objectives() -> None:
    tables = tables_of_histories(HISTORIES, frame(), STUDY.criteria, STUDY.objectives)
    *_, verdicts, governs, remarks, required, performance, by_members, objectives = tables
    assert row(verdicts, "drift")[1:] == ["damped", "DBE", "not met", "1 %", "1.3 %", "inf"]
    assert row(governs, "drift")[1:] == ["damped", "DBE", "storey 1", "one", "maximum", "1/2"]
    assert row(required, "drift") == ["drift", "interstorey drift 0.7 to 1.3 %"]
    said = row(remarks, "drift")
    assert said[1:3] == ["damped", "DBE"] and said[3].startswith("not met: failed histories count")
    assert said[3].endswith("missing: damped.DBE.two")
    assert [cells[3] for cells in verdicts.texts if cells[0] == "columns"] == ["not met", "not met"]
    assert row(performance, "bare")[2:7] == ["CP", "0", "1", "1", "0"]  # one at 2, one at 3 %, which counts
    assert row(performance, "damped")[-2] == row(by_members, "damped")[-2] == "1/2"
    by_drift = objectives.texts[0]
    assert by_drift[:5] == ["h", "bare", "drift", "not met", "1.2"]  # 3 of 2.5 %
    assert by_drift[5:9] == ["10 % in 50 years (DBE)", "Life Safety (LS)", "basic", "maximum"]
    assert [cells[3] for cells in objectives.texts] == ["not met", "not met", "met", "not met"]
    assert all(
        len(line) > 0 for table in (verdicts, performance, by_members, objectives) for line in plain(table).splitlines()
    )


def test_means_of_few_histories_are_remarked() -> None:
    """EN 1998-1, 4.3.3.4.3(3): from seven histories on the mean counts, else the largest."""

    hazard = parse_project(FRAME).hazard

    def remarks(count: int, statistic: str = "mean", missing: tuple[str, ...] = ()) -> list[str]:
        found = ("bare.DBE.one", None, "C_A_1", count, missing)
        verdict = Verdict("drift", "drift", "bare", "DBE", statistic, 0.01, 0.013, "1", True, "", *found)
        notes = " ".join(note for table in verdicts_tables([verdict], hazard) for note in table.notes)
        return [notes[notes.index("Not judged") :]] if "Not judged" in notes else []

    (said,) = remarks(6)
    assert said.startswith(
        "Not judged as the code does: drift (mean) of bare, DBE. Of fewer than 7 motions the most unfavourable "
        "response counts (EN 1998-1, 4.3.3.4.3(3)"
    )
    assert remarks(7) == remarks(6, "maximum") == remarks(6, missing=("bare.DBE.later",)) == []
    assert remarks(0) == []  # nothing was judged


def test_an_archive_is_read_with_what_is_still_to_come(tmp_path: Path) -> None:
    path = tmp_path / "study.h5"
    names = [*HISTORIES, "damped.DBE.later", "modes"]
    root = Group(attributes={"title": "Two storeys", "planned": names, "project_file": "project.yaml"})
    root.add("project_text", (), np.asarray(FRAME), "", "project file")
    with ArchiveWriter(path, root) as writer:
        for order, (name, group) in enumerate(HISTORIES.items()):
            group.attributes["order"] = order
            writer.write(f"analyses/{name}", group)
        writer.finish()
    tables = assessment_tables(path, STUDY.criteria, STUDY.objectives)
    mean = next(table for table in tables if table.title == "Mean response")
    assert "damped, DBE: not run, in no statistic (1 of 3): damped.DBE.later" in mean.notes
    assert row(mean, "interstorey drift [%]")[1:] == ["2.500", "1.000", "-50.0"]
