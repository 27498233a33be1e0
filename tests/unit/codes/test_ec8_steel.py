"""Clauses of EN 1998-1:2004, chapter 6 and 4.4.2, on steel frames: tables, and values worked out by hand.

Table 6.2 and Table 6.3 were typed a second time.
"""

from __future__ import annotations

import math

import pytest

from edesign.codes.ec8.steel.behaviour_factor import (
    SYSTEMS,
    alpha_ratio,
    behaviour_factor,
    largest_section_class,
    reference_q,
)
from edesign.codes.ec8.steel.concentric_braces import (
    asymmetry,
    homogeneity,
    post_buckling_forces,
    slenderness,
)
from edesign.codes.ec8.steel.moment_frames import (
    column_hinge_shear,
    hinge_shear,
    rotation_capacity,
    web_panel_area_with_doubler,
    web_panel_resistance,
    web_panel_shear,
    web_panel_slenderness,
)
from edesign.codes.ec8.verification.capacity import foundation_factor, overstrength
from edesign.codes.ec8.verification.strong_column import LEAST_RATIO, is_exempt, strength_ratio
from edesign.errors import InputError


@pytest.mark.parametrize(
    ("system", "medium", "high", "with_ratio"),
    [  # Table 6.2; alpha_u / alpha_1 = 1.25 stands for any
        ("moment_frame", 4.0, 6.25, True),
        ("concentric_diagonal", 4.0, 4.0, False),
        ("concentric_v", 2.0, 2.5, False),
        ("eccentric", 4.0, 6.25, True),
        ("inverted_pendulum", 2.0, 2.5, True),
        ("moment_frame_with_concentric_bracing", 4.0, 5.0, True),
        ("moment_frame_with_infills_in_contact", 2.0, 2.0, False),
        ("moment_frame_with_isolated_infills", 4.0, 6.25, True),
    ],
)
def test_table_6_2(system: str, medium: float, high: float, with_ratio: bool) -> None:
    assert reference_q(system, "medium", 1.25) == medium
    assert reference_q(system, "high", 1.25) == high
    assert (reference_q(system, "high", 1.0) != high) is with_ratio
    assert reference_q(system, "low", 1.25) == 1.5
    assert len(SYSTEMS) == 8


def test_the_thesis_has_6_5_in_x_and_4_in_y() -> None:
    """Section 5.2: moment frames of ten storeys and several bays, q = 5 x 1.3; diagonal bracings, q = 4."""
    assert behaviour_factor("moment_frame", "high", alpha_ratio("moment_frame", 10, 4)) == 6.5
    assert behaviour_factor("concentric_diagonal", "high", alpha_ratio("concentric_diagonal", 10, 3)) == 4.0


def test_defaults_of_alpha() -> None:
    """Figures 6.1-6.8."""
    assert [alpha_ratio("moment_frame", *frame) for frame in ((1, 3), (5, 1), (5, 3))] == [1.1, 1.2, 1.3]
    assert alpha_ratio("eccentric", 5, 3) == alpha_ratio("moment_frame_with_concentric_bracing", 5, 3) == 1.2
    assert alpha_ratio("moment_frame", 5, 3, regular_in_plan=False) == pytest.approx(1.15)


def test_irregularity_in_elevation_takes_20_percent() -> None:
    assert behaviour_factor("moment_frame", "high", 1.3, regular_in_elevation=False) == pytest.approx(5.2)
    assert behaviour_factor("concentric_v", "medium", regular_in_elevation=False) == pytest.approx(1.6)
    assert behaviour_factor("moment_frame", "low", regular_in_elevation=False) == 1.5  # 6.1.2(3)
    assert behaviour_factor("moment_frame", "low", regular_in_elevation=False, low_ductility_q=2.0) == 1.6


@pytest.mark.parametrize(
    ("ductility", "q", "section_class"),
    [  # Table 6.3
        ("medium", 1.8, 3),
        ("medium", 2.0, 3),
        ("medium", 2.1, 2),
        ("medium", 4.0, 2),
        ("high", 6.5, 1),
        ("high", 4.0, 1),
        ("low", 1.5, 4),
        ("low", 2.0, 3),
    ],
)
def test_table_6_3(ductility: str, q: float, section_class: int) -> None:
    assert largest_section_class(ductility, q) == section_class


def test_bad_input_of_behaviour_factors() -> None:
    with pytest.raises(InputError, match=r"`moment_frames`; did you mean `moment_frame`\?"):
        reference_q("moment_frames", "high")
    with pytest.raises(InputError, match="`DCH`.*E-NAME-01"):
        reference_q("moment_frame", "DCH")
    with pytest.raises(InputError, match=r"1\.6, not 1\.7 .*E-VALUE-02"):
        reference_q("moment_frame", "high", 1.7)
    with pytest.raises(InputError, match="at most 2, not 3 .E-VALUE-02"):
        reference_q("moment_frame", "low", low_ductility_q=3.0)
    with pytest.raises(InputError, match="E-EC8-01"):
        largest_section_class("medium", 5.0)
    with pytest.raises(InputError, match="E-VALUE-02"):
        alpha_ratio("moment_frame", 0, 1)


# IPE450 of S275: W_pl 1702 cm3, A_vz 50.85 cm2, A 98.82 cm2; M_pl 468.05 kNm, V_pl 807.3 kN, N_pl 2717.6 kN
M_PL, V_PL, N_PL = 1702e-6 * 275e6, 50.85e-4 * 275e6 / math.sqrt(3.0), 98.82e-4 * 275e6


def test_beam_of_a_moment_frame() -> None:
    V_M = hinge_shear(M_PL, M_PL, 6.75)  # 7.2 m less half a column HEB450 at each end
    assert V_M == pytest.approx(138.68e3, rel=1e-4)  # printed digits


def test_a_member_without_effect_has_no_overstrength() -> None:
    assert overstrength([400.0, 300.0, 2.0], [300.0, -250.0, 0.0]).tolist() == [400.0 / 300.0, 1.2, math.inf]
    with pytest.raises(InputError, match="demand .* nan .E-VALUE-02"):
        overstrength([2.0, 2.0], [1.0, math.nan])
    with pytest.raises(InputError, match="resistance .*E-VALUE-02"):
        overstrength([2.0, 0.0], [1.0, 1.0])


def test_factor_of_foundations() -> None:
    """Eq. 4.30: gamma_Rd 1.2 above q = 3, else 1; Omega from 1 to q."""
    assert foundation_factor([1.2, 5.0, 0.8], q=4.0).tolist() == pytest.approx([1.44, 4.8, 1.2])
    assert foundation_factor(3.5, q=2.0) == 2.0


def test_hinge_at_the_base_of_a_column() -> None:
    assert column_hinge_shear([300.0, 300.0], [-60.0, 0.0], 4.0).tolist() == [90.0, 75.0]


def test_web_panel() -> None:
    """HEB450 of S275 between two IPE450: z = 450 - 14.6 = 435.4 mm; V = 2 x 468.05 / 0.4354; A_vc 79.66 cm2."""
    V = web_panel_shear(2.0 * M_PL / 0.4354)
    assert V == pytest.approx(2150e3, rel=1e-3)  # printed digits
    assert web_panel_shear(2.0 * M_PL / 0.4354, 250e3) == pytest.approx(float(V) - 250e3)
    assert web_panel_resistance(79.66e-4, 275e6) == pytest.approx(1138.3e3, rel=1e-4)  # 0.9 x 7966 x 275 / sqrt(3)
    assert web_panel_slenderness(0.344, 0.014, 275e6) == pytest.approx(24.571 / (69.0 * 0.92442), rel=1e-4)
    assert web_panel_area_with_doubler(79.66e-4, 0.344, 0.014) == pytest.approx((7966 + 344 * 14) * 1e-6)


def test_rotation_capacity() -> None:
    assert [rotation_capacity(d, 4.0) for d in ("high", "medium", "low")] == [0.035, 0.025, 0.0]
    assert rotation_capacity("medium", 2.0) == 0.0


def test_asymmetry_of_diagonals() -> None:
    """Three single diagonals a frame: 2 against 1 fails, |2 - 1| / 3; two mirrored frames have 3 against 3."""
    one_frame = asymmetry(2.0, 1.0, 4)
    assert one_frame.value == pytest.approx(1.0 / 3.0) and not one_frame.passed and one_frame.detail == "storey 4"
    assert asymmetry(3.0, 3.0, 1).passed
    assert asymmetry(1.05, 0.95, 1).passed  # 0.05 itself is allowed, up to rounding of the sum
    with pytest.raises(InputError, match="E-VALUE-02"):
        asymmetry(0.0, 0.0, 1)


@pytest.mark.parametrize(
    ("value", "kind", "storeys", "clause", "passed"),
    [
        (1.3, "x", 10, "6.7.3(1)", False),
        (1.31, "x", 10, "6.7.3(1)", True),
        (2.01, "x", 10, "6.7.3(1)", False),
        (0.5, "diagonal", 10, "6.7.3(2)", True),
        (2.1, "diagonal", 10, "6.7.3(2)", False),
        (2.0, "v", 10, "6.7.3(3)", True),
        (2.5, "x", 2, "6.7.3(4)", None),
    ],
)
def test_slenderness(value: float, kind: str, storeys: int, clause: str, passed: bool | None) -> None:
    check = slenderness(value, kind, storeys, "DY_A_1_5_r")
    assert (check.clause, check.passed, check.detail) == (clause, passed, "DY_A_1_5_r")


def test_homogeneity_of_diagonals() -> None:
    check = homogeneity([1.25, 1.2, 1.6], ", direction y")
    assert check.value == pytest.approx(1.6 / 1.2 - 1.0) and not check.passed
    assert homogeneity([1.0, 1.25]).passed  # 25 % is allowed
    named = homogeneity([1.25, 1.2, 1.6], ", direction y", ["DY_A", "DY_B", "DY_C"])
    assert named.detail == "Omega from 1.2 (DY_B) to 1.6 (DY_C)"


def test_v_bracing() -> None:
    """6.7.4(2): N_pl,Rd in tension, 0.3 N_pl,Rd in compression; the recommended gamma_pb."""
    assert post_buckling_forces([1000.0, 1000.0, 500.0], [True, False, False]).tolist() == [1000.0, -300.0, -150.0]
    with pytest.raises(InputError, match="gamma_pb .*E-VALUE-02"):
        post_buckling_forces([1.0], [True], -0.3)


def test_strong_columns() -> None:
    """Eq. 4.29: two columns of 800 and two beams of 500 have 1.6; with one column at the roof 0.8, which is exempt."""
    ratios = strength_ratio([[800.0, 800.0], [800.0, 0.0], [800.0, 0.0]], [[500.0, 500.0], [500.0, 500.0], [0.0, 0.0]])
    assert ratios.tolist() == [1.6, 0.8, math.inf]
    assert (ratios >= LEAST_RATIO).tolist() == [True, False, True]
    assert is_exempt(10, 10) and not is_exempt(9, 10)
    assert is_exempt(1, 1) and is_exempt(3, 10, frame_in_plane=False)
    with pytest.raises(InputError, match="M_Rb .*E-VALUE-02"):
        strength_ratio([1.0], [-1.0])
