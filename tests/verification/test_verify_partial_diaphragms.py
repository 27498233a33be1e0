"""Floors of which a part alone is rigid: a table in closed form, and the elastic space frame.

Columns of the table are cantilevers without beams.
"""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from verification.test_verify_building_model import rigid_in_shear  # noqa: F401
from verification.test_verify_shaken_buildings import stiffness

from edesign.core import Analysis
from edesign.space.nonlinear import build_building
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import space_model

TABLE = """\
edesign_building: 1
title: A table with a flexible bay
plan: {x: [6 m, 4 m], y: [5 m]}
storeys: [3.5 m]
diaphragms: @rigid@
columns: [{section: HEB200, material: S275, strong: x}]
beams: [{along: x, section: IPE300, material: S275, ends: pinned}]
missing: {beams: [{along: x}, {along: y}]}
materials: {S275: {E: 210 GPa, fy: 275 MPa, law: elastic}}
loads: {self_weight: false}
masses: {given: [{at: A-B, floors: 1, mass: 8 t}, {at: C, floors: 1, mass: 3 t}]}
elements: {geometry: {columns: linear}}
"""
PART = TABLE.replace("@rigid@", "all\npartial_diaphragms: [{floors: 1, bays: {x: 1, y: all}}]")


def test_columns_beside_a_rigid_part() -> None:
    """Those of line C sway alone; 1e-9: what is exact in both is left to rounding."""
    k_x, k_y, k_t = stiffness("HEB200")
    turning, polar = 4.0 * (k_x * 2.5**2 + k_y * 3.0**2 + k_t), 32e3 * (3.0**2 + 2.5**2)
    squares = [4.0 * k_x / 32e3, 4.0 * k_y / 32e3, turning / polar, *[k_x / 3e3] * 2, *[k_y / 3e3] * 2]
    frame = build_building(building(PART))
    found = Analysis(frame.model).modes(7)
    np.testing.assert_allclose(found.omega**2, sorted(squares), rtol=1e-9)
    assert {name for name, at in frame.nodes.items() if at in frame.model.masters} == {"A1.1", "A2.1", "B1.1", "B2.1"}


def test_a_part_that_is_the_whole() -> None:
    """Bit by bit the building whose floor is rigid."""
    part = TABLE.replace("@rigid@", "all\npartial_diaphragms: [{floors: 1, bays: all}]")
    whole, same = (Analysis(build_building(building(text)).model) for text in (TABLE.replace("@rigid@", "all"), part))
    assert whole.modes(3).period.tolist() == same.modes(3).period.tolist()


SETBACK = """\
edesign_building: 1
title: A tower on a podium
plan: {x: [6 m, 5 m, 6 m], y: [5 m, 4 m]}
storeys: [4 m, 3.5 m, 3 m]
setbacks: [{floors: 2-3, bays: [{x: 1, y: all}, {x: 3, y: all}]}]
diaphragms: @rigid@
columns: [{section: HEB260, material: S275, strong: x}]
beams:
  - {along: x, section: IPE330, material: S275}
  - {along: y, section: IPE300, material: S275}
braces: [{along: y, frames: [A, B], bays: 1, storeys: all, kind: chevron, section: SHS100x5, material: S275}]
materials: {S275: {fy: 275 MPa, law: elastic}}
loads: {areas: [{floors: all, G: 5 kN/m^2, spans: x}]}
masses: {from_loads: {}}
elements: {geometry: {columns: linear}}
"""
TIED = "all\npartial_diaphragms: [{floors: 2-3, bays: {x: 1, y: all}}, {floors: 1, bays: {x: 1-2, y: 1}}]"


@pytest.mark.usefixtures("rigid_in_shear")
@pytest.mark.parametrize("rigid", [TIED, "none", "1"])
def test_modes_are_those_of_the_elastic_space_frame(rigid: str) -> None:
    """Two towers, of which a rigid floor ties one, or none; 1e-9 as of whole floors."""
    whole = building(SETBACK.replace("@rigid@", rigid))
    frame = space_frame(whole)
    expected = space_model(frame, whole.materials).modes(frame.node_mass, 12)
    built = build_building(whole)
    found = Analysis(built.model).modes(12)
    np.testing.assert_allclose(found.period, expected.period, rtol=1e-9)
    assert built.mass == pytest.approx(frame.node_mass.sum(), rel=1e-12)
    if rigid == TIED:
        tied = {name for name, at in zip(frame.node_names, frame.node_diaphragm, strict=True) if at == 0}
        assert tied == {f"{line}.1" for line in ("A1", "A2", "B1", "B2", "C1", "C2")} | {"BY_A_1_1", "BY_B_1_1"}
        assert "D1.2" in built.masses and "A1.2" not in built.masses and "floor.2" in built.masses
