"""What holds for any building: equilibrium of every load case, mirrored results, checks that grow with the load."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from building_examples import building, design_of
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.space.designed import ElasticDesign
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.structure.frame import AXES

LOPSIDED = """\
edesign_building: 1
title: Frames along x, chevrons along y near one end, the upper floors set back
plan: {x: [6 m, 5 m, 4 m], y: [5 m, 6 m]}
storeys: [4 m, 3.5 m, 3.5 m]
setbacks: [{floors: 3, bays: {x: 2-3, y: all}}]
columns: [{section: HEB300, material: S355, strong: x}]
beams:
  - {along: x, section: IPE400, material: S355}
  - {along: y, section: IPE300, material: S355, ends: pinned}
braces: [{along: y, frames: [B, D], bays: 2, kind: chevron, section: SHS140x8, material: S355}]
materials: {S355: {fy: 355 MPa}}
loads:
  areas: [{G: 4 kN/m^2, Q: 3 kN/m^2, category: B, spans: two_way}]
  perimeter: [{floors: 1-2, G: 1.5 kN/m}]
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.24 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: concentric_v, q: 2}}
"""


@pytest.fixture(scope="module")
def lopsided() -> ElasticDesign:
    return design_of(LOPSIDED)


def test_reactions_carry_every_load_case(lopsided: ElasticDesign) -> None:
    """Forces and moments about the origin, 1e-9 of the largest reaction times the size of the building."""
    frame, static = lopsided.frame, lopsided.static
    start, end = (frame.coordinates[nodes] for nodes in frame.ends)
    for name, reactions in zip(static.names, static.reactions, strict=True):
        case = frame.cases[name]
        forces, places = [case.nodal[:, :3], reactions[:, :3]], [frame.coordinates, frame.coordinates]
        forces.append(case.uniform * frame.length[:, None])
        places.append(0.5 * (start + end))
        along = case.point_position[:, None]
        forces.append(case.point_force)
        places.append(start[case.point_member] * (1.0 - along) + end[case.point_member] * along)
        force, place = np.concatenate(forces), np.concatenate(places)
        turning = np.cross(place, force).sum(axis=0) + case.nodal[:, 3:].sum(axis=0) + reactions[:, 3:].sum(axis=0)
        scale = np.abs(reactions[:, :3]).max()
        assert scale > 0.0
        assert np.abs(force.sum(axis=0)).max() < 1e-9 * scale
        assert np.abs(turning).max() < 1e-9 * scale * 15.0


def test_a_mirrored_building_has_mirrored_results(lopsided: ElasticDesign) -> None:
    """Mirrored about the middle along x: 1e-10, as both solve equations in another order."""
    mirrored = design_of(
        LOPSIDED,
        ("x: [6 m, 5 m, 4 m]", "x: [4 m, 5 m, 6 m]"),
        ("bays: {x: 2-3, y: all}", "bays: {x: 1-2, y: all}"),
        ("frames: [B, D]", "frames: [A, C]"),
    )
    np.testing.assert_allclose(lopsided.modes.period, mirrored.modes.period, rtol=1e-10)
    for axis in AXES:
        one, other = lopsided.response[axis], mirrored.response[axis]
        np.testing.assert_allclose(one.storey_shear, other.storey_shear, rtol=1e-10)
        np.testing.assert_allclose(one.drift, other.drift, rtol=1e-10)
    order = [
        np.lexsort(np.round(middles(of) * (sign, 1.0, 1.0) + (shift, 0.0, 0.0), 6).T)
        for of, sign, shift in ((lopsided, 1.0, 0.0), (mirrored, -1.0, 15.0))
    ]
    use = [of.members.utilisation[places] for of, places in zip((lopsided, mirrored), order, strict=True)]
    assert np.nanmax(use[0]) > 0.3
    np.testing.assert_allclose(use[0], use[1], rtol=1e-10, atol=1e-12)


def middles(design: ElasticDesign) -> np.ndarray:
    start, end = (design.frame.coordinates[nodes] for nodes in design.frame.ends)
    # those of a pair of diagonals differ in which of its ends is higher
    return np.asarray(0.5 * (start + end) + 1e-3 * (start[:, 2:] - end[:, 2:]) * (end - start)[:, :1])


@cache
def analysed() -> tuple[ElasticAnalysis, ElasticDesign]:
    analysis = ElasticAnalysis(building(LOPSIDED))
    return analysis, analysis.design()


@settings(max_examples=30, deadline=None)
@given(factor=st.floats(1.0, 5.0))
def test_no_check_is_used_less_under_more_load(factor: float) -> None:
    """Of all actions together, and of the earthquake alone: N has both its signs, moments the one that adds.

    1e-12 for rounding.
    """
    analysis, design = analysed()

    def use(static: float, spectral: float) -> np.ndarray:
        of = design.effects
        acting = replace(of, static=of.static * static, seismic=of.seismic * spectral)
        persistent = design.members.rows[: design.members.counts[0]]
        combinations = (
            persistent,
            analysis.combinations.seismic,
            design.overstrength,
            design.q,
            analysis.combinations.yielded,
            analysis.combinations.vertical,
        )
        found = analysis.members.results(design.frame, acting, *combinations)
        return np.nan_to_num(found.utilisation, nan=0.0)

    now = use(1.0, 1.0)
    np.testing.assert_array_equal(now, np.nan_to_num(design.members.utilisation, nan=0.0))
    assert (use(factor, factor) >= now * (1.0 - 1e-12)).all()
    assert (use(1.0, factor) >= now * (1.0 - 1e-12)).all()
