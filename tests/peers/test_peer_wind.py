"""Wind on a building in space side by side with OpenSeesPy: displacements, member forces and reactions."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building
from elastic_in_opensees import solve_in_opensees

from edesign.space.analysis.bracing import bracing
from edesign.space.analysis.lateral import static_effects
from edesign.space.checks.foundations import supports
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties, space_model

ops = pytest.importorskip("openseespy.opensees")

pytestmark = pytest.mark.peer

TOWER = """\
edesign_building: 1
title: Stepped tower
plan: {x: [6 m, 4 m], y: {count: 2, width: 5 m}}
storeys: [4 m, 3.5 m, 3 m]
setbacks: [{floors: 3, bays: {x: 1, y: all}}]
columns: [{section: HEB240, material: S275, strong: x}]
beams:
  - {along: x, section: IPE330, material: S275}
  - {along: y, section: IPE300, material: S275}
materials: {S275: {fy: 275 MPa}}
loads:
  self_weight: false
  areas: [{G: 4 kN/m^2, spans: x}]
  cases:
    wind_x: {category: wind, facades: [{side: x-, pressure: 0.8 kN/m^2}, {side: x+, pressure: -0.5 kN/m^2}]}
    wind_y:
      category: wind
      facades: [{side: y-, storeys: 1-2, pressure: 0.8 kN/m^2}]
      floors: [{floors: 3, y: 20 kN, at: {x: 1 m, y: 5 m}}]
masses: {from_loads: {}}
"""


@pytest.mark.parametrize("case", ["wind_x", "wind_y"])
def test_wind_on_a_stepped_tower(case: str) -> None:
    """All to 1e-7 of the largest: both are exact. The force beside the middle is given to the master of OpenSees."""
    made = building(TOWER)
    frame = space_frame(made, design=True)
    model, gravity_model = (space_model(frame, made.materials, gravity) for gravity in (False, True))
    braces = bracing(frame)
    static = static_effects(gravity_model, model, frame, braces, supports(frame, braces))
    number = static.names.index(case)
    u = solve_in_opensees(ops, frame, member_properties(frame, made.materials), frame.cases[case].nodal)
    np.testing.assert_allclose(static.displacements[number], u, atol=1e-7 * np.abs(u).max())
    ends = np.array([ops.eleResponse(m, "localForces") for m in range(len(frame.members))])
    internal = static.internal[number]
    np.testing.assert_allclose(internal[:, 0], -ends[:, :6], atol=1e-7 * np.abs(ends).max())
    np.testing.assert_allclose(internal[:, -1], ends[:, 6:], atol=1e-7 * np.abs(ends).max())
    ops.reactions()
    base = np.flatnonzero(frame.fixed.all(axis=1))
    reactions = np.array([ops.nodeReaction(int(i)) for i in base])
    np.testing.assert_allclose(static.reactions[number, base], reactions, atol=1e-7 * np.abs(reactions).max())
    ops.wipe()
