"""Own sections of buildings on their way to SAP2000 and back: their properties stay, their shape does not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import edesign
from edesign.frame.building_file import load_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model

TEXT = """\
edesign_building: 1
title: Own sections
plan: {x: [6 m], y: [5 m]}
storeys: [4 m, 3.5 m]
columns: [{section: COL, material: S275, strong: x}]
beams:
  - {along: x, section: IPE300, material: S275, stiffness_factor: 1.5}
  - {along: y, section: EDGE, material: S275}
sections:
  COL: {height: 300 mm, width: 280 mm, flange: 20 mm, web: 12 mm}
  EDGE: {area: 45 cm^2, inertia: 6000 cm^4, weak_inertia: 420 cm^4, torsion_constant: 16 cm^4, shear_area: 20 cm^2}
materials: {S275: {fy: 275 MPa}}
loads: {areas: [{G: 4 kN/m^2, spans: x}]}
masses: {from_loads: {}}
"""


def periods(path: Path) -> np.ndarray:
    building = load_building(path)
    frame = space_frame(building)
    return np.asarray(space_model(frame, building.materials).modes(frame.node_mass).period)


def test_a_building_with_own_sections_comes_back_as_stiff(tmp_path: Path) -> None:
    """The text has 12 digits."""
    source, model, back = tmp_path / "b.yaml", tmp_path / "b.s2k", tmp_path / "back.yaml"
    source.write_text(TEXT)
    edesign.translate(source, model)
    edesign.translate(model, back)
    assert set(load_building(back).sections) == {"COL", "EDGE", "IPE300_x1.5"}
    assert periods(back) == pytest.approx(periods(source), rel=1e-9)
    assert "members of it are not checked" in back.read_text()
