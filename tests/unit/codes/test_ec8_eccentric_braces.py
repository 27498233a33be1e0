"""Seismic links by EN 1998-1:2004, 6.8, and NTC 2018, 7.5.6: worked by hand for HEB200 of S355.

The equations were compared with a transcription of NTC 2018, 7.5.6, whose equations are the same, with the Designers'
Guide to EN 1998-1 (D6.10 to D6.12), and, for stiffeners at the ends and spacing at 0.08 rad, with IS 18168:2023, 11.4.
"""

from __future__ import annotations

import math

import pytest

from edesign.codes.ec8.steel.eccentric_braces import (
    LinkResistance,
    largest_rotation,
    link_resistance,
    link_stiffeners,
    longest_under_axial_force,
    overstrength_of_link,
    rotation,
)
from edesign.errors import InputError

HEB200 = {"b": 0.2, "t_f": 0.015, "t_w": 0.009, "d": 0.2}
A = 78.08e-4


@pytest.fixture
def link() -> LinkResistance:
    return link_resistance(355e6, A, **HEB200)


def test_resistances(link: LinkResistance) -> None:
    """M_p = 355 . 200 . 15 . 185 = 197.0 kN m; V_p = 355 / 1.732 . 9 . 185 = 341.3 kN (four digits)."""
    assert link.M_p == pytest.approx(197.025e3, rel=1e-9)
    assert link.V_p == pytest.approx(341.3e3, rel=2e-4)
    assert link.N_pl == pytest.approx(2771.8e3, rel=1e-4)


def test_axial_force(link: LinkResistance) -> None:
    """Up to 0.15 N_pl nothing changes; at 0.3 M_p . 0.7 = 137.9 kN m and V_p . sqrt(0.91) = 325.5 kN."""
    assert link.reduced(-0.15 * link.N_pl) == link
    reduced = link.reduced(-0.3 * link.N_pl)
    assert reduced.M_p == pytest.approx(137.9e3, rel=2e-4)
    assert reduced.V_p == pytest.approx(325.5e3, rel=2e-4)
    assert link.reduced(2.0 * link.N_pl).V_p == 0.0


@pytest.mark.parametrize(
    ("alpha", "e_s", "e_L"),
    [(1.0, 0.9238, 1.7321), (0.25, 0.5774, 1.0825), (0.0, 0.4619, 0.8660)],  # 1.6, 3.0; 0.8 and 1.5 times 1 + alpha
)
def test_lengths(link: LinkResistance, alpha: float, e_s: float, e_L: float) -> None:
    """M_p / V_p = 197.0 / 341.3 = 0.5774 m."""
    assert link.limits(alpha) == pytest.approx((e_s, e_L), rel=1e-4)
    assert [link.category(e, alpha) for e in (0.99 * e_s, 1.01 * e_s, 1.01 * e_L)] == ["short", "intermediate", "long"]
    with pytest.raises(InputError, match="alpha lies between 0 and 1, not 1.2 .E-VALUE-02"):
        link.limits(1.2)


def test_length_beside_an_axial_force(link: LinkResistance) -> None:
    """N = 0.3 N_pl = 831.6 kN, V = 300 kN: R = 831.6 . 0.1960 / 300 = 0.543, e <= 0.8784 . 0.9238 = 0.811 m.

    With V = 600 kN R is 0.272, and e <= 0.9238 m.
    """
    web = 0.009 * 0.17 / A
    assert longest_under_axial_force(link, 0.14 * link.N_pl, 300e3, web) is None
    assert longest_under_axial_force(link, -0.3 * link.N_pl, 300e3, web) == pytest.approx(0.8115, rel=2e-4)
    assert longest_under_axial_force(link, 0.3 * link.N_pl, 600e3, web) == pytest.approx(0.9238, rel=1e-4)


def test_overstrength(link: LinkResistance) -> None:
    """1.5 . 341.3 / 250 = 2.048 of a short link, 1.5 . 197.0 / 150 = 1.970 of others."""
    assert overstrength_of_link(link, "short", 250e3, 150e3) == pytest.approx(2.0475, rel=1e-4)
    for category in ("intermediate", "long"):
        assert overstrength_of_link(link, category, 250e3, 150e3) == pytest.approx(1.9703, rel=1e-4)  # type: ignore[arg-type]
    assert overstrength_of_link(link, "short", 0.0, 0.0) == math.inf


def test_rotations() -> None:
    """A drift of 1 % in a bay of 6 m turns a link of 0.6 m by 0.1 rad; limits are 0.08 and 0.02, half-way 0.05."""
    assert rotation(0.01, 6.0, 0.6) == pytest.approx(0.1)
    assert [largest_rotation(e, 0.9, 1.7) for e in (0.5, 0.9, 1.3, 1.7, 2.5)] == pytest.approx(
        [0.08, 0.08, 0.05, 0.02, 0.02]
    )


@pytest.mark.parametrize(
    ("e", "theta_p", "spacing", "flange", "count"),
    [
        (0.6, 0.08, 0.230, 0.0, 2),  # 30 . 9 - 200 / 5 = 230 mm: three parts of 200 mm
        (0.6, 0.02, 0.428, 0.0, 1),  # 52 . 9 - 40 = 428 mm: two parts
        (0.6, 0.05, 0.329, 0.0, 1),  # half-way 41 . 9 - 40 = 329 mm
        (1.2, 0.06, 0.296, 0.3, 6),  # one at 300 mm from each end, one before either, two between them
        (2.0, 0.02, math.inf, 0.3, 2),  # long: those at 1.5 . 200 mm alone
        (3.0, 0.02, math.inf, 0.0, 0),  # longer than 5 M_p / V_p = 2.887 m
    ],
)
def test_stiffeners(link: LinkResistance, e: float, theta_p: float, spacing: float, flange: float, count: int) -> None:
    """At the ends 10 mm (0.75 . 9 is less) and 200 - 18 = 182 mm; between 10 mm and 100 - 9 = 91 mm at one side."""
    found = link_stiffeners(link, link.category(e, 1.0), e, theta_p, 0.2, 0.009, 0.2)
    assert (found.spacing, found.flange_distance, found.count) == pytest.approx((spacing, flange, count))
    assert (found.end_thickness, found.end_width) == pytest.approx((0.010, 0.182))
    assert (found.thickness, found.width, found.sides) == pytest.approx((0.010 if count else 0.0, 0.091, 1))


def test_deep_links_have_stiffeners_at_both_sides(link: LinkResistance) -> None:
    assert [link_stiffeners(link, "short", 0.6, 0.08, 0.22, 0.012, d).sides for d in (0.599, 0.6)] == [1, 2]
