"""Histories with and without dampers in one project are variants of their own, in the plan, tables and the report."""

from __future__ import annotations

from pathlib import Path

import pytest

from edesign.frame.project_file import load_project
from edesign.project.template import new_project
from edesign.study.plan.plan import make_plan


def variants(path: Path) -> dict[str, object]:
    return {task.name: task.labels["variant"] for task in make_plan(load_project(path))}


@pytest.fixture
def damped(tmp_path: Path) -> Path:
    return new_project(tmp_path / "damped", kind="damped")


def test_they_are_distinguished_where_a_kind_has_both(damped: Path) -> None:
    found = variants(damped)
    assert found["gravity"] is None  # there is one alone
    assert found["modes_bare"] == found["bare_DBE_1"] == "without dampers"
    assert found["modes_damped"] == found["damped_MCE_2"] == "with dampers"


def test_labels_of_the_file_stay(damped: Path) -> None:
    text = damped.read_text(encoding="utf-8")
    damped.write_text(text.replace("{name: bare_DBE_1,", "{name: bare_DBE_1, variant: old,"), encoding="utf-8")
    assert variants(damped)["bare_DBE_1"] == "old"


def test_a_project_with_dampers_in_all_histories_has_no_labels(damped: Path) -> None:
    damped.write_text(damped.read_text(encoding="utf-8").replace(", dampers: false", ""), encoding="utf-8")
    assert set(variants(damped).values()) == {None}
