"""Stiffness of beams with which a slab acts, written out by EN 1994-1-1, 5.4.1.2 and EN 1998-1, 7.7.2(3)."""

from __future__ import annotations

import pytest
from building_examples import building

from edesign.codes.en1994.composite_beams import (
    Slab,
    cracked_inertia,
    effective_width,
    equivalent_span,
    uncracked_inertia,
)
from edesign.errors import InputError
from edesign.frame.sections.steel_section import steel_section
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.model import member_properties

FRAMES = """\
edesign_building: 1
title: Composite beams
plan: {x: [8 m, 8 m], y: [6 m, 6 m]}
storeys: [4 m]
columns: [{section: HEB240, material: S275, strong: x}]
beams:
  - {along: x, frames: 2, section: IPE400, material: S275, group: BX, slab: {thickness: 80 mm, ribs: 60 mm, E: 30 GPa}}
  - {along: x, frames: [1, 3], section: IPE400, material: S275, group: BE}
  - {along: y, section: IPE300, material: S275, group: BY}
materials: {S275: {fy: 275 MPa, E: 210 GPa}}
loads: {areas: [{G: 4 kN/m^2, Q: 2 kN/m^2, category: B, spans: x, secondary_beams: 1}]}
masses: {from_loads: {}}
hazard: {code: ec8-2004, a_gR: 0.1 g, ground: B, spectrum: 1, levels: {DBE: {probability: 10 %}}}
design:
  ductility_class: medium
  systems: {x: {type: moment_frame, q: 4}, y: {type: moment_frame, q: 4}}
"""
IPE400 = steel_section("IPE400")


def factor_of(text: str, name: str) -> float:
    frame = space_frame(building(text))
    return next(member.stiffness_factor for member in frame.members if member.name == name)


def test_effective_widths() -> None:
    """Inner span of 8 m: L_e = 5.6 m, b_ei = 0.7 m of 3 m; at an edge 0.7 + 0.4 m; simple beam: 2 m."""
    assert effective_width(equivalent_span(8.0, 2), (3.0, 3.0)) == pytest.approx(1.4)
    assert effective_width(equivalent_span(8.0, 2), (3.0, 0.4)) == pytest.approx(1.1)
    assert effective_width(equivalent_span(8.0, 1), (3.0, 3.0)) == pytest.approx(1.7)
    assert effective_width(equivalent_span(8.0, 0), (3.0, 3.0)) == pytest.approx(2.0)


def test_uncracked_section_by_parts() -> None:
    """IPE400, 84.5 cm2, 23130 cm4; concrete 140 x 8 cm2 / 7 = 160 cm2, its middle 20 + 6 + 4 = 30 cm above.

    Centroid 160 x 30 / 244.5 = 19.63 cm above that of the steel. I = 23130 + 84.5 x 19.63^2 + 140 x 8^3 / 84
    + 160 x 10.37^2 = 23130 + 32570 + 853 + 17200 = 73760 cm4.
    """
    slab = Slab(0.08, 0.06, 7.0, 0.0)
    found = uncracked_inertia(IPE400.A, IPE400.I_y, IPE400.h, slab, 1.4)
    assert 1e8 * found == pytest.approx(73760.0, rel=2e-3)
    assert cracked_inertia(IPE400.A, IPE400.I_y, IPE400.h, slab, 1.4) == IPE400.I_y
    # bars 1 % of 140 x 8 = 11.2 cm2: 84.5 x 11.2 / 95.7 x 30^2 = 8900 cm4 more
    bars = cracked_inertia(IPE400.A, IPE400.I_y, IPE400.h, Slab(0.08, 0.06, 7.0, 0.01), 1.4)
    assert 1e8 * (bars - IPE400.I_y) == pytest.approx(8900.0, rel=2e-3)


def test_factor_of_a_moment_frame() -> None:
    """0.6 x 73760 / 23130 + 0.4 = 2.313, on I_y of the model; other beams have 1."""
    assert factor_of(FRAMES, "BX_2_1_1") == pytest.approx(2.313, rel=2e-3)
    assert factor_of(FRAMES, "BX_1_1_1") == 1.0
    made = building(FRAMES)
    frame = space_frame(made)
    number = [member.name for member in frame.members].index("BX_2_1_1")
    assert member_properties(frame, made.materials)[number, 6] == pytest.approx(2.313 * IPE400.I_y, rel=2e-3)


def test_factor_of_pinned_beams_is_that_of_sagging() -> None:
    """b_eff = 2 m: 200 x 8 / 7 = 228.6 cm2, I_1 = 23130 + 1219 + 84.5 x 228.6 / 313.1 x 900 = 79880 cm4."""
    text = FRAMES.replace("material: S275, group: BX,", "material: S275, ends: pinned, group: BX,")
    assert factor_of(text, "BX_2_1_1") == pytest.approx(79880.0 / 23130.0, rel=3e-3)


def test_secondary_beams_that_run_alike_narrow_the_slab() -> None:
    """Floors that span along y with 5 secondary beams along x: b_i = 6 / 6 / 2 = 0.5 m on both sides, not 0.7 m."""
    text = FRAMES.replace("spans: x, secondary_beams: 1", "spans: y, secondary_beams: 5")
    slab = Slab(0.08, 0.06, 7.0, 0.0)
    narrow = uncracked_inertia(IPE400.A, IPE400.I_y, IPE400.h, slab, 1.0) / IPE400.I_y
    assert factor_of(text, "BX_2_1_1") == pytest.approx(0.6 * narrow + 0.4, rel=1e-6)


def test_other_sections_have_their_own_factor() -> None:
    """As `edesign design` tries them: the factor of IPE500 is less than that of IPE400."""
    frame = ElasticAnalysis(building(FRAMES)).sections.frame_with({"BX": "IPE500"})
    of = next(member for member in frame.members if member.name == "BX_2_1_1")
    section = steel_section("IPE500")
    slab = uncracked_inertia(section.A, section.I_y, section.h, Slab(0.08, 0.06, 7.0, 0.0), 1.4) / section.I_y
    assert of.stiffness_factor == pytest.approx(0.6 * slab + 0.4, rel=1e-6) and of.stiffness_factor < 2.313


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "frames: 2, section",
            "frames: 1-2, section",
            r"BX_2_1_1 is multiplied by 2\.31 and of BX_1_1_1.*E-BLDG-03",
        ),
        ("group: BX, slab", "group: BX, stiffness_factor: 2, slab", "give one of both"),
        ("E: 30 GPa", "E: 30 MPa", "E-UNIT-03"),
        ("E: 30 GPa", "E: 30 GPa, reinforcement: 120 %", "E-VALUE-02"),
    ],
)
def test_refused(old: str, new: str, message: str) -> None:
    text = (
        FRAMES.replace(old, new, 1).replace("frames: [1, 3]", "frames: 3")
        if "1-2" in new
        else FRAMES.replace(old, new, 1)
    )
    with pytest.raises(InputError, match=message):
        space_frame(building(text))
