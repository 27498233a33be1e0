"""Dampers between floors: the moment by which a frame overturns, by statics, and what its columns lack of it.

Statics: loads and inertia forces at the floors times their heights. A damper between floors pushes them apart with F,
and F times the height of the storey is the couple that a chevron has in its lower ends.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from edesign import check_project, load_project
from edesign.archive.dataset import Group
from edesign.study.plan.plan import make_plan
from edesign.study.results.warnings import warnings_of
from edesign.study.run.analyses import run_analysis

MOTION = Path(__file__).parent.parent / "cases" / "records" / "motion.csv"
PROJECT = """edesign: 1
title: Dampers in both bays
frame:
  bays: [6 m, 5 m]
  storeys: [4 m, 3.5 m, 3 m]
  supports: fixed
  diaphragms: all
  columns: [{{storeys: all, section: HEB240, material: steel}}]
  beams: [{{floors: all, section: IPE360, material: steel}}]
materials: {{steel: {{law: elastic, E: 210 GPa}}}}
masses: {{given: [{{floors: all, mass: 12 t}}], directions: horizontal}}
elements: {{geometry: {{columns: linear}}}}
dampers:
  laws: {{pad: {{type: kelvin_voigt, parameters: {{k: {k} kN/mm, c: {c} kN*s/m}}}}}}
  devices: [{{kind: {kind}, bays: [1, 2], storeys: all, law: pad}}]
damping: {{kind: none}}
integration: {{method: newmark, time_step: 0.005 s}}
records: {{motion: {{file: {motion}, acceleration_unit: m/s^2}}}}
analyses:
  - {{name: shake, kind: history, record: motion}}
  - {{name: push, kind: pushover, pattern: triangular, roof_drift: 0.5 %, steps: 5}}
outputs: {{histories: [floors, storeys, supports, dampers]}}
"""
HEIGHTS = np.array([4.0, 3.5, 3.0])  # m
LEVELS = np.cumsum(HEIGHTS)
MASS = 3 * 12e3  # kg, of a floor
LINES = np.array([0.0, 6.0, 11.0])  # m
SINGLE = 1e-6
"""Histories of the archive are rounded to 6e-8 of their numbers; moments add up some of them."""


def results(folder: Path, kind: str, k: float = 15.0, c: float = 1000.0) -> dict[str, Group]:
    file = folder / "project.yaml"
    file.write_text(PROJECT.format(kind=kind, k=k, c=c, motion=MOTION), encoding="utf-8")
    project = load_project(file)
    return {task.spec.name: run_analysis(project, task.spec) for task in make_plan(project)}


def values(group: Group, name: str) -> np.ndarray:
    return np.asarray(group.variables[name].values, dtype=float)


def moment_of_reactions(group: Group) -> np.ndarray:
    up, turning = values(group, "support_vertical_reaction"), values(group, "support_moment")
    return np.asarray(up @ (LINES - 5.5) + turning.sum(axis=1))


@pytest.mark.parametrize("kind", ["storey", "chevron"])
def test_overturning_moment_is_that_of_the_loads(tmp_path: Path, kind: str) -> None:
    found = results(tmp_path, kind)
    shake, push = found["shake"], found["push"]
    inertia = -MASS * values(shake, "floor_acceleration") @ LEVELS  # accelerations are total ones
    overturning = values(shake, "overturning_moment")
    assert np.abs(overturning - inertia).max() < SINGLE * np.abs(inertia).max()
    shares = values(push, "lateral_load_share").reshape(3, -1).sum(axis=1)  # of the nodes, floor by floor
    loads = values(push, "lateral_load") * (shares @ LEVELS)
    assert values(push, "overturning_moment") == pytest.approx(loads, rel=1e-6)  # equilibrium is solved to 1e-7


def test_columns_lack_the_couples_of_dampers_between_floors(tmp_path: Path) -> None:
    """And the warning says how much; with chevrons they lack nothing."""
    found = results(tmp_path, "storey")
    for group in found.values():
        force = values(group, "storey_damper_force" if "time" in group.coords else "storey_damper_force_final")
        shear = values(group, "storey_shear") if "time" in group.coords else values(group, "storey_shear_final")
        couple, total = force @ HEIGHTS, (shear + force) @ HEIGHTS
        reactions = values(group, "overturning_moment") - moment_of_reactions(group)
        lacking = reactions if "time" in group.coords else reactions[-1]
        assert np.abs(lacking - couple).max() < SINGLE * np.abs(couple).max()
        (reported,) = warnings_of(group)
        assert reported.kind == "damper_couple"
        most, of, at_line = np.abs(couple).max() / 1e3, np.abs(total).max() / 1e3, np.abs(couple).max() / 2.0 / 5e3
        # dampers are alike in both bays, and line C ends the narrower one
        assert reported.text.startswith(
            f"{most:.4g} of {of:.4g} kNm of overturning are in no column, at line C {at_line:.4g} kN; "
        )
    for group in results(tmp_path, "chevron").values():
        assert warnings_of(group) == []
        own = values(group, "overturning_moment")
        assert np.abs(moment_of_reactions(group) - own).max() < SINGLE * np.abs(own).max()


def test_all_dampers_overturn(tmp_path: Path) -> None:
    """The couple stands beside the moment of columns and all dampers, those with couples of their own too."""
    kinds = "storey, bays: 1, storeys: all, law: pad}, {kind: chevron"
    group = results(tmp_path, kinds)["shake"]
    force = values(group, "storey_damper_force")
    (reported,) = warnings_of(group)
    total = np.abs((values(group, "storey_shear") + force) @ HEIGHTS).max() / 1e3
    own = [i for i, name in enumerate(group.coords["damper"].values) if str(name).startswith("S_")]
    couple = np.abs(values(group, "damper_force")[:, own] @ HEIGHTS).max() / 1e3
    assert reported.text.startswith(f"{couple:.4g} of {total:.4g} kNm of overturning are in no column")


def test_small_couples_are_not_reported(tmp_path: Path) -> None:
    """Up to the tenth of the overturning moment that EN 1998-1, 4.4.2.2(2), lets second-order effects have."""
    group = results(tmp_path, "storey", k=0.2, c=1.0)["shake"]
    force, shear = values(group, "storey_damper_force"), values(group, "storey_shear")
    share = np.abs(force @ HEIGHTS).max() / np.abs((shear + force) @ HEIGHTS).max()
    assert 0.01 < share < 0.1
    assert warnings_of(group) == []


def test_check_reports_before_the_run(tmp_path: Path) -> None:
    for kind, reported in (("storey", True), ("chevron", False)):
        file = tmp_path / f"{kind}.yaml"
        file.write_text(PROJECT.format(kind=kind, k=15.0, c=1000.0, motion=MOTION), encoding="utf-8")
        warnings = check_project(load_project(file)).get("warnings", "")
        assert ("dampers.devices[0]: dampers of the kind `storey`" in warnings) == reported
