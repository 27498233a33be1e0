"""`edesign run building.yaml` with pushovers: names, attributes, tables and figures of its archive."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from verification.test_verify_building_pushes import HAZARD, PORTAL

from edesign.archive.reader import open_archive
from edesign.frame.building_file import load_building
from edesign.report.archive.project_tables import project_tables
from edesign.report.capacity.pushover_figures import pushover_figures
from edesign.report.capacity.target_hinges import hinge_figures
from edesign.study.run.run import run_project

ANALYSES = """\
analyses:
  - {name: push, kind: pushover, pattern: uniform, direction: [@direction@], targets: n2, steps: 20,
     eccentricity: [0, -x-y]}
"""
NAMES = ["push.x+.0", "push.x+.-x-y", "push.x-.0", "push.x-.-x-y"]


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    text = PORTAL + HAZARD + ANALYSES.replace("[@direction@]", "x")
    for name, value in {"x": "12 m", "y": "8 m", "G": "10 kN", "geometry": "p_delta"}.items():
        text = text.replace(f"@{name}@", value)
    path = tmp_path_factory.mktemp("pushes") / "portal.yaml"
    path.write_text(text, encoding="utf-8")
    summary = run_project(load_building(path))
    assert [outcome.status for outcome in summary.outcomes] == ["completed"] * 8
    return summary.archive


def test_names_and_attributes(archive: Path) -> None:
    with open_archive(archive) as opened:
        assert opened.attributes["planned"] == [name + end for name in NAMES for end in ("", ".n2.DBE")]
        for name in NAMES:
            for about in (opened.group_attributes(f"analyses/{name}{end}") for end in ("", ".n2.DBE")):
                assert name == f"push.{about['direction']}.{about['eccentricity']}"
        pushed = opened.group("analyses/push.x+.-x-y")
    assert pushed.variables["base_shear"].dims == ("step", "direction")
    assert pushed.variables["roof_drift"].dims == pushed.variables["control_displacement"].dims == ("step",)
    assert pushed.variables["column_plastic_rotation_max"].dims == ("column", "end", "axis")


def test_tables_and_figures(archive: Path) -> None:
    with open_archive(archive) as opened:
        tables = {table.name: table for table in project_tables(opened)}
        drawn = {name: figure for name, _, figure in pushover_figures(opened)}
        hinges = [name for name, _, _ in hinge_figures(opened)]
    targets = tables["target_displacements_n2"]
    assert [row[0] for row in targets.rows] == NAMES
    assert list(drawn) == ["capacity_curves", "n2"]
    (axes,) = drawn["capacity_curves"].axes
    curves = [y for y in (np.asarray(line.get_ydata()) for line in axes.lines) if y.size > 2]
    assert len(curves) == 4
    assert all(curve[-1] > 0.0 for curve in curves)
    assert hinges == ["target_hinges_X1_n2_DBE", "target_hinges_X2_n2_DBE"]  # none along y
