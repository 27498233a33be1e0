"""Warnings of scale factors: of plain histories, of fitted ones, none of incremental studies."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from cases import suite_project

from edesign import load_project
from edesign.ground_motion.project_records import find_recordings, references
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.project import Project
from edesign.study.check.suitability import scale_warnings
from edesign.study.check.summary import check_project
from edesign.study.motions.motions import Motion
from edesign.study.plan.plan import Stripe, Task, make_plan


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return load_project(suite_project.write(tmp_path))


def motions_of(project: Project) -> dict[str, Motion]:
    found = find_recordings(project, references(project, "set"))
    return {reference: Motion(reference, item) for reference, item in found.items()}


def histories(project: Project, **changed: object) -> list[Task]:
    plan = [task for task in make_plan(project) if isinstance(task.spec, HistoryAnalysis) and task.entry == "dbe"]
    return [replace(task, spec=task.spec.model_copy(update=changed)) for task in plan]


def test_levels_and_fits_multiply(project: Project) -> None:
    """gamma_I of 2 % in 50 years is 1.71: a fit of 1.8 is usual at the DBE and not at the MCE."""
    scales = dict.fromkeys(motions_of(project), 1.8)
    warnings = scale_warnings(project, make_plan(project), motions_of(project), scales)
    (said,) = warnings["set"]
    assert (
        said.startswith("MCE: 3 of 3 records are scaled")
        and "first by 3.08" in said
        and "third by 3.08 (simulated)" in said
    )
    assert scale_warnings(project, make_plan(project), motions_of(project), dict.fromkeys(scales, 1.0)) == {}


def test_a_plain_factor_and_a_peak(project: Project) -> None:
    motions = motions_of(project)
    plain = project.model_copy(update={"hazard": None})
    (said,) = scale_warnings(plain, histories(plain, scale=42.0, level=""), motions)["set"]
    assert said.startswith("dbe: 3 of 3 records are scaled") and "first by 42" in said
    peak = motions["set/first"].record.pga
    tasks = [task for task in histories(plain, pga=4.0 * peak, level="") if task.record == "set/first"]
    (said,) = scale_warnings(plain, tasks, motions)["set"]
    assert said.startswith("dbe: the record is scaled") and "first by 4;" in said
    assert scale_warnings(plain, histories(plain, scale=1.0, level=""), motions) == {}


def test_incremental_studies_scale_on_purpose(project: Project) -> None:
    plain = project.model_copy(update={"hazard": None})
    stripe = Stripe("ida", 9.81, 3, "ida.bare.first")
    tasks = [replace(task, stripe=stripe) for task in histories(plain, scale=42.0, level="")]
    assert scale_warnings(plain, tasks, motions_of(plain)) == {}


def test_check_reports_it_before_anything_is_fitted(tmp_path: Path) -> None:
    path = suite_project.write(tmp_path, ("a_gR: 0.2 g", "a_gR: 3 g"))
    warnings = check_project(load_project(path))["warnings"]
    assert "records set: MCE: 3 of 3 records are scaled beyond the usual" in warnings
