"""Columns that change their section inside a storey: a floor without beams and diaphragm stands at the splice."""

from __future__ import annotations

import math

import numpy as np
import pytest
from building_examples import building

from edesign.core import Analysis
from edesign.space.nonlinear import build_building
from edesign.study.analysis.structure import Structure

SPLICED = """\
edesign_building: 1
title: Two storeys, columns spliced 1.2 m above the first floor
plan: {x: [6 m, 4 m], y: [5 m]}
storeys: [4 m, 1.2 m, 2.3 m]
diaphragms: [1, 3]
columns:
  - {section: HEB240, material: S275, strong: x}
  - {storeys: 3, section: HEB180, material: S275, strong: x}
beams: [{along: x, section: IPE300, material: S275}, {along: y, section: IPE270, material: S275}]
missing: {beams: [{along: x, floors: 2}, {along: y, floors: 2}]}
materials: {S275: {fy: 275 MPa}}
loads: {self_weight: false}
masses: {given: [{floors: 1, mass: 8 t}, {floors: 3, mass: 7 t}]}
"""
PLAIN = (
    SPLICED.replace("[4 m, 1.2 m, 2.3 m]", "[4 m, 3.5 m]")
    .replace("diaphragms: [1, 3]", "diaphragms: 1-2")
    .replace("storeys: 3,", "storeys: 2,")
    .replace("missing: {beams: [{along: x, floors: 2}, {along: y, floors: 2}]}\n", "")
    .replace("{floors: 3,", "{floors: 2,")
)


def periods(text: str, upper: str) -> np.ndarray:
    """Periods with a section of the upper columns, s."""
    frame = build_building(building(text, ("HEB180", upper)))
    return np.asarray(2.0 * math.pi / Structure(frame, Analysis(frame.model)).modes(6).omega)


def test_a_splice_between_equal_sections_changes_nothing() -> None:
    assert periods(SPLICED, "HEB240") == pytest.approx(periods(PLAIN, "HEB240"), rel=1e-9)


def test_a_splice_lies_between_both_sections() -> None:
    stiff, spliced, soft = periods(PLAIN, "HEB240"), periods(SPLICED, "HEB180"), periods(PLAIN, "HEB180")
    assert (stiff < spliced).all() and (spliced < soft).all()
