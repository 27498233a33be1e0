"""EN 1993-1-1:2005, 6.3.1: worked examples, and Tables 6.1 and 6.2 typed a second time from the document.

Examples: Gardner & Nethercot, Designers' Guide to EN 1993-1-1, Example 6.7 (also among the benchmarks of SDC Verifier);
Eurocodes: Design of steel buildings with worked examples (JRC, Brussels, October 2014), Example 1.
"""

from __future__ import annotations

import math

import pytest

from edesign.codes.ec3.buckling import (
    IMPERFECTION,
    buckling_resistance,
    critical_force,
    hollow_curve,
    reduction_factor,
    rolled_i_curve,
    slenderness,
    solid_curve,
    welded_i_curve,
)
from edesign.errors import InputError
from edesign.frame.sections.profiles import profile
from edesign.frame.struts import strut
from edesign.project import parse_project

E, S355 = 210e9, 355e6

FRAME = """\
edesign: 1
title: Storey
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB340, material: S355}]
  beams: [{floors: all, section: IPE360, material: S355}]
sections:
  welded: {height: 300 mm, width: 300 mm, flange: 20 mm, web: 10 mm}
  flat: {rectangles: [{width: 100 mm, depth: 20 mm, centre: 0 mm}]}
  bare: {area: 20 cm^2}
  known: {area: 20 cm^2, inertia: 1000 cm^4}
materials:
  S355: {law: bilinear, E: 210 GPa, fy: 355 MPa}
  elastic: {law: elastic, E: 210 GPa}
analyses: [{name: gravity, kind: gravity}]
"""


def test_hot_finished_hollow_section() -> None:
    """CHS 244.5 x 10, S355, 4 m: A = 7370 mm2, I = 5073 cm4, curve a, chi = 0.8777838747, N_b,Rd = 2297 kN."""
    area = 7370e-6
    chi = reduction_factor(slenderness(area, S355, critical_force(E, 50.73e-6, 4.0)), hollow_curve(S355))
    assert chi == pytest.approx(0.877783874726401, rel=2e-4)  # that benchmark has lambda_1 = 93.9 epsilon, rounded
    assert buckling_resistance(area, S355, chi) == pytest.approx(2297e3, rel=3e-4)  # four digits


def test_column_of_the_jrc_example() -> None:
    """HEB 340, S355, L_cr = 4.335 m: chi_z = 0.69, N_b,Rd = 4186.2 kN = 0.69 x 170.9 cm2 x 355 MPa."""
    rolled = profile("HEB340")
    assert rolled_i_curve(rolled.h, rolled.b, rolled.tf, "z", S355) == "c"
    found = strut(parse_project(FRAME), "HEB340", "S355", 4.335)
    assert found is not None
    assert found.resistance == pytest.approx(4186.2e3, rel=0.005 / 0.69)  # chi is printed with two digits
    assert found.squash == pytest.approx(170.9e-4 * S355, rel=1e-3)


def test_table_6_1() -> None:
    assert IMPERFECTION == {"a0": 0.13, "a": 0.21, "b": 0.34, "c": 0.49, "d": 0.76}


ROLLED = [  # h/b, t_f [mm]; S235 to S420: y, z; S460: y, z
    (1.5, 40.0, "a", "b", "a0", "a0"),
    (1.5, 40.1, "b", "c", "a", "a"),
    (1.5, 100.0, "b", "c", "a", "a"),
    (1.2, 20.0, "b", "c", "a", "a"),
    (1.2, 100.0, "b", "c", "a", "a"),
    (1.0, 100.1, "d", "d", "c", "c"),
]


@pytest.mark.parametrize(("ratio", "flange", "y", "z", "y460", "z460"), ROLLED)
def test_table_6_2_rolled(ratio: float, flange: float, y: str, z: str, y460: str, z460: str) -> None:
    found = [rolled_i_curve(ratio, 1.0, 1e-3 * flange, axis, fy) for fy in (S355, 460e6) for axis in ("y", "z")]
    assert found == [y, z, y460, z460]


def test_table_6_2_others() -> None:
    assert [welded_i_curve(1e-3 * flange, axis) for flange in (40.0, 41.0) for axis in ("y", "z")] == list("bccd")
    assert [hollow_curve(S355), hollow_curve(460e6), hollow_curve(S355, cold_formed=True)] == ["a", "a0", "c"]
    assert solid_curve() == "c"


def test_reduction_factor_solves_the_interaction_of_ayrton_and_perry() -> None:
    """chi (1 - chi s2) + eta chi = 1 - chi s2, eta = alpha (s - 0.2), from which Eq. 6.49 comes; the smaller root."""
    for curve, alpha in IMPERFECTION.items():
        for s in (0.2001, 0.5, 1.0, 3.0):
            chi = reduction_factor(s, curve)
            assert (1.0 - chi) * (1.0 - chi * s**2) == pytest.approx(alpha * (s - 0.2) * chi, abs=1e-14)
            assert chi < min(1.0, 1.0 / s**2)
        assert reduction_factor(0.2, curve) == 1.0
        assert reduction_factor(20.0, curve) == pytest.approx(1.0 / 20.0**2, rel=0.05)  # Euler


def test_the_weakest_axis_governs_and_own_sections_have_their_curves() -> None:
    project = parse_project(FRAME)
    plates, flat, known = (strut(project, name, "S355", 4.0) for name in ("welded", "flat", "known"))
    assert plates is not None and flat is not None and known is not None
    weak = 2 * 0.02 * 0.3**3 / 12 + 0.26 * 0.01**3 / 12
    area = 2 * 0.3 * 0.02 + 0.26 * 0.01
    assert plates.slenderness == pytest.approx(math.sqrt(area * S355 / (math.pi**2 * E * weak / 16.0)))
    assert plates.resistance == pytest.approx(reduction_factor(plates.slenderness, "c") * area * S355)
    assert flat.slenderness == pytest.approx(math.sqrt(0.002 * S355 / (math.pi**2 * E * 0.1 * 0.02**3 / 12 / 16.0)))
    assert known.slenderness == pytest.approx(math.sqrt(0.002 * S355 / (math.pi**2 * E * 1e-5 / 16.0)))
    assert strut(project, "bare", "S355", 4.0) is None
    elastic = strut(project, "known", "elastic", 4.0)
    assert elastic is not None and elastic.resistance == pytest.approx(math.pi**2 * E * 1e-5 / 16.0)


def test_what_is_impossible_is_refused() -> None:
    with pytest.raises(InputError, match="`e`.*E-NAME-01"):
        reduction_factor(1.0, "e")
    with pytest.raises(InputError, match=" -1 .*E-VALUE-02"):
        reduction_factor(-1.0, "a")
    with pytest.raises(InputError, match="length: 0 .*E-VALUE-02"):
        critical_force(E, 1e-5, 0.0)
