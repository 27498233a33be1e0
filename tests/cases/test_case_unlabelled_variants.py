"""The report of a project whose histories have dampers or not, have a hazard level or not, and bear no labels."""

from __future__ import annotations

from pathlib import Path

import pytest
from report_project import write_report_project

from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_project
from edesign.report.archive_view import results
from edesign.report.inputs.damper_schedule import schedule_tables
from edesign.report.page.sections.response import response
from edesign.report.page.sections.summary import summary
from edesign.report.page.source import Source
from edesign.study.run.run import run_project


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = write_report_project(tmp_path_factory.mktemp("unlabelled"))
    text = path.read_text(encoding="utf-8").replace(", variant: bare", "").replace(", variant: damped", "")
    text = text.replace("level: MCE, dampers: false", "dampers: false")
    path.write_text(text, encoding="utf-8")
    return run_project(load_project(path)).archive


def test_no_mean_is_over_histories_with_and_without_dampers(archive: Path) -> None:
    with open_archive(archive) as opened:
        source = Source(opened)
        sets = {(one.variant, one.level): list(one.histories) for one in source.sets}
        asked = summary(source).intro[0]
    assert sets == {
        ("without dampers", "DBE"): ["bare.DBE"],
        ("with dampers", "DBE"): ["damped.DBE"],
        ("without dampers", ""): ["bare.MCE"],
    }
    assert "(without dampers and with dampers) was subjected to 1 ground motion at DBE and without a level." in asked


def test_histories_without_dampers_ask_nothing_of_dampers(archive: Path) -> None:
    with open_archive(archive) as opened:
        source = Source(opened)
        assert source.frames is not None
        required = schedule_tables(source.frames, None, source.sets, lambda name: results(opened, name))[1]
    assert {row[3] for row in required.rows} == {"DBE, with dampers"}


def test_what_has_no_level_is_not_said_to_be_of_all(archive: Path) -> None:
    with open_archive(archive) as opened:
        parts = response(Source(opened)).parts
    headings = [part.text for part in parts if type(part).__name__ == "Heading"]
    assert headings == ["DBE", "Without a hazard level"]
