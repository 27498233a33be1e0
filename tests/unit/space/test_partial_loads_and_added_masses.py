"""Loads on parts of beams of a building, and masses beside those of its loads."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import building, number_of

from edesign.project.building import BuildingError
from edesign.space.nonlinear import build_building
from edesign.space.structure.area_loads import part_share
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.geometry import space_frame

TEXT = """\
edesign_building: 1
title: One storey
plan: {x: [6 m, 4 m], y: [5 m]}
storeys: [4 m]
columns: [{section: HEB240, material: S275, strong: x}]
beams: [{along: x, section: IPE300, material: S275}, {along: y, section: IPE270, material: S275}]
braces: [{along: x, frames: 1, bays: 1, kind: chevron, section: SHS120x8, material: S275}]
materials: {S275: {fy: 275 MPa}}
loads:
  self_weight: false
  beams:
    - {along: x, bays: 2, partial: [{start: 1 m, end: 0.8, G: [6 kN/m, 12 kN/m], Q: 3 kN/m}], category: B}
    - {along: x, bays: 1, frames: 1, partial: [{start: 2 m, end: 5 m, G: [4 kN/m, 10 kN/m]}]}
masses: {from_loads: {G: 1.0, Q: {B: 0.3}}, added: [{at: B2, floors: 1, mass: 2 t}, {at: 2, floors: 1, mass: 1 t}]}
"""


def test_three_forces_have_the_end_forces_of_the_load() -> None:
    """Reaction and moment at the start of a fixed beam: polynomials of the third degree, integrated by 4000 strips.

    A midpoint sum of 4000 strips is within 1e-7 of the integral.
    """
    length, start, end, load = 7.0, 0.2, 0.65, (3e3, 11e3)
    share = part_share(start, end, length, load)
    at = start + (end - start) * (np.arange(4000) + 0.5) / 4000
    force = np.interp(at, [start, end], load) * (end - start) * length / 4000
    for effect in (
        lambda x: (1.0 - x) ** 2 * (1.0 + 2.0 * x),  # reaction
        lambda x: length * x * (1.0 - x) ** 2,  # moment
        lambda x: length * (1.0 - x) * x**2,  # moment at the other end
    ):
        assert sum(of * effect(x) for x, of in share.points) == pytest.approx((force * effect(at)).sum(), rel=1e-6)


def loads_on(frame: SpaceFrame, case: str, name: str) -> tuple[float, float]:
    """Sum of the point forces on a member, and their centre as a fraction of its length."""
    of, number = frame.cases[case], number_of(frame, name)
    there = of.point_member == number
    force = -of.point_force[there, 2]
    return float(force.sum()), float(force @ of.point_position[there] / force.sum())


def test_the_parts_stand_where_the_file_says() -> None:
    """Resultant and centre of a trapezoid; of a beam that braces meet in the middle each half has its own."""
    frame = space_frame(building(TEXT))
    total, centre = loads_on(frame, "G", "BX_2_2_1")  # from 1 m to 3.2 m of 4 m
    assert total == pytest.approx(9e3 * 2.2)
    assert centre == pytest.approx((1.0 + 2.2 * (6 + 2 * 12) / (3 * 18)) / 4.0)
    assert loads_on(frame, "Q_B", "BX_1_2_1") == pytest.approx((3e3 * 2.2, 2.1 / 4.0))
    left, right = (loads_on(frame, "G", f"BX_1_1_1_{half}") for half in (1, 2))
    assert left == pytest.approx((5e3 * 1.0, (2.0 + (4 + 2 * 6) / (3 * 10)) / 3.0))
    assert right == pytest.approx((8e3 * 2.0, 2.0 * (6 + 2 * 10) / (3 * 16) / 3.0))


def test_added_masses_are_beside_those_of_the_loads() -> None:
    bare = space_frame(
        building(TEXT.replace(", added: [{at: B2, floors: 1, mass: 2 t}, {at: 2, floors: 1, mass: 1 t}]", ""))
    )
    frame = space_frame(building(TEXT))
    more = dict(zip(frame.node_names, (frame.node_mass - bare.node_mass).tolist(), strict=True))
    assert {name: mass for name, mass in more.items() if mass > 1e-9} == pytest.approx(
        {"A2.1": 1e3, "B2.1": 3e3, "C2.1": 1e3}
    )
    model = build_building(building(TEXT))
    assert model.mass == pytest.approx(frame.node_mass.sum(), rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("end: 0.8", "end: 5 m", "partial.0..end: 5 m is beyond the end of a beam of 4 m .E-LOAD-02"),
        ("start: 1 m, end: 0.8", "start: 3.5 m, end: 0.8", "not after its `start` at 3.5 m .E-VALUE-04"),
        (", category: B}", "}", "category: this key is missing"),
        ("Q: 3 kN/m}", "Q: -3 kN/m}", "a variable load acts downwards"),
        ("G: [4 kN/m, 10 kN/m]", "G: [4 kN/m, 10 GN/m]", "E-UNIT-03"),
        ("from_loads: {G: 1.0, Q: {B: 0.3}}", "given: [{floors: 1, mass: 10 t}]", "beside those of `from_loads`"),
        ("at: B2, floors: 1", "at: B2, floors: 2", "masses.added.0..floors"),
        ("mass: 2 t", "mass: 2000000 t", "masses.added.0..mass: floor 1 has .*E-UNIT-03"),
    ],
)
def test_what_is_refused(old: str, new: str, words: str) -> None:
    with pytest.raises(BuildingError, match=words):
        building(TEXT, (old, new))
