"""projects/l_plan: figures of docs/tutorials/irregular_plan.md, and what dampers at the edges do to the turning."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.assess.measures import located_measure
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_study
from edesign.project.criteria.measures import InSpace
from edesign.study.run.run import run_study

PROJECT = Path(__file__).resolve().parents[2] / "projects" / "l_plan"


def edge(group: Group, line: str) -> float:
    """The largest drift of a column line along y."""
    found = located_measure(group, "interstorey_drift", chosen=InSpace(direction="y", at=(line,)))
    assert found is not None
    return found.value


def test_the_design_is_the_building_with_other_sections() -> None:
    start, chosen = (load_building(PROJECT / f"{name}.yaml") for name in ("building", "designed"))
    assert [column.group for column in start.columns] == [column.group for column in chosen.columns]
    assert start.plan == chosen.plan and start.dampers == chosen.dampers and start.loads == chosen.loads


@pytest.mark.slow
def test_the_east_edge_drifts_most_and_dampers_at_the_edges_stop_the_turning(tmp_path: Path) -> None:
    """The history that turns most, pair 12 with the masses to the north-east; the page has three digits."""
    for path in PROJECT.glob("*.yaml"):
        shutil.copy(path, tmp_path)
    study = load_study(tmp_path / "study.yaml")
    summary = run_study(study, workers=2, only=["bare.DBE.12.+x+y", "damped.DBE.12.+x+y"])
    with open_archive(summary.archive) as archive:
        bare, damped = (archive.group(f"analyses/{name}.DBE.12.+x+y") for name in ("bare", "damped"))
    for group, west, east, turn in ((bare, 0.0189, 0.0478, 0.0170), (damped, 0.0130, 0.0143, 0.0064)):
        assert (edge(group, "A1"), edge(group, "F1")) == pytest.approx((west, east), rel=0.01)
        most = max(np.abs(group.variables[f"floor_rotation_{end}"].values).max() for end in ("max", "min"))
        assert most == pytest.approx(turn, rel=0.01)
