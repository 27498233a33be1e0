"""Histories with chosen drifts, and the frame of two storeys they belong to, for tests of verdicts."""

from __future__ import annotations

from unit.assess.known_history import known_history

from edesign.archive.dataset import Group
from edesign.project import Project, parse_project
from edesign.project.criteria.criteria import Criteria, Objectives
from edesign.project.reading.base import Model
from edesign.project.reading.yaml_file import check_model

FRAME = """\
edesign: 1
title: Two storeys
frame:
  bays: [6 m]
  storeys: [4 m, 3 m]
  columns: [{storeys: all, section: HEB450, material: S275}]
  beams: [{floors: all, section: IPE450, material: S275}]
materials: {S275: {law: bilinear, E: 210 GPa, fy: 275 MPa}}
hazard:
  code: ec8-2004
  a_gR: 0.36 g
  ground: C
  spectrum: 1
  levels: {DBE: {return_period: 475 years}, MCE: {probability: 2 %}, own: {gamma_I: 1.2}}
analyses: [{name: gravity, kind: gravity}]
"""


class Part(Model):
    """The part of a study file that is judged."""

    criteria: Criteria = ()
    objectives: Objectives = ()


def part(text: str) -> Part:
    found, problems = check_model(text, Part, "study file", "criteria:")
    assert found is not None, [str(problem) for problem in problems.found]
    return found


def frame() -> Project:
    return parse_project(FRAME)


def history(variant: str, level: str, drift: float = 0.01, status: str = "completed", **about: object) -> Group:
    """A history whose storey 1 drifts by `drift` and storey 2 by half of it; residual drifts are a tenth."""
    if status == "not run":
        return Group(attributes={"kind": "history", "variant": variant, "level": level, "status": status})
    group = known_history(status=status)
    group.variables["storey_drift_max"].values[:] = [drift, 0.5 * drift]
    group.variables["storey_drift_min"].values[:] = 0.0
    if status == "completed":
        group.variables["residual_storey_drift"].values[:] = [0.1 * drift, 0.05 * drift]
    group.attributes |= {"variant": variant, "level": level, **about}
    return group
