"""Properties of steel sections against the tables of the standards and against finite elements.

Tables: ArcelorMittal, Sections and merchant bars (I sections, also EN 10365); EN 10210-2:2006, Annex B (hollow ones);
IPE 330: Steel Buildings in Europe, Multi-storey steel buildings, Part 4 (MSB04), example A.1; RHS 200x100x16: SDC
Verifier, benchmark of example 6.9 of the Designers' Guide to EN 1993-1-1.
"""

from __future__ import annotations

import math

import pytest

from edesign.errors import InputError
from edesign.frame.sections.steel_section import SteelSection, steel_section

CM2, CM3, CM4, CM6 = 1e-4, 1e-6, 1e-8, 1e-12

I_SECTIONS = {  # A, A_vz; I_y, I_z, I_t; I_w in 1000 cm6; W_el_y, W_el_z, W_pl_y, W_pl_z
    "IPE330": (62.61, 30.81, 11770, 788.1, 28.15, 199.1, 713.1, 98.52, 804.3, 153.7),
    "IPE450": (98.82, 50.85, 33740, 1676, 66.87, 791.0, 1500, 176.4, 1702, 276.4),
    "IPE500": (115.5, 59.87, 48200, 2142, 89.29, 1249, 1928, 214.2, 2194, 335.9),
    "HEA200": (53.83, 18.08, 3692, 1336, 20.98, 108.0, 388.6, 133.6, 429.5, 203.8),
    "HEB300": (149.1, 47.43, 25170, 8563, 185.0, 1688, 1678, 570.9, 1869, 870.1),
    "HEM300": (303.1, 90.53, 59200, 19400, 1408, 4386, 3482, 1252, 4078, 1913),
}

HOLLOW = {  # A, I_y, I_z, W_el_y, W_el_z, W_pl_y, W_pl_z, I_t
    "SHS200x10": (74.9, 4471, 4471, 447, 447, 531, 531, 7031),
    "RHS200x100x8": (44.8, 2234, 739, 223, 148, 282, 172, 1804),
    "RHS200x100x16": (83.0, 3678, 1147, 368, 229, 491, 290, 2982),
    "CHS168.3x8": (40.3, 1297, 1297, 154, 154, 206, 206, 2595),
}


@pytest.mark.parametrize("name", I_SECTIONS)
def test_rolled_sections(name: str) -> None:
    s = steel_section(name)
    found = [s.A / CM2, s.A_vz / CM2, s.I_y / CM4, s.I_z / CM4, s.I_t / CM4, s.I_w / CM6 / 1e3]
    found += [w / CM3 for w in (s.W_el_y, s.W_el_z, s.W_pl_y, s.W_pl_z)]
    assert found == pytest.approx(
        I_SECTIONS[name], rel=6e-4
    )  # the tables print four digits, of which 1000 is the least


@pytest.mark.parametrize("name", HOLLOW)
def test_hollow_sections(name: str) -> None:
    s = steel_section(name)
    found = [s.A / CM2, s.I_y / CM4, s.I_z / CM4]
    found += [w / CM3 for w in (s.W_el_y, s.W_el_z, s.W_pl_y, s.W_pl_z)]
    found.append(s.I_t / CM4)
    assert found == pytest.approx(HOLLOW[name], rel=3e-3, abs=0.051)  # three digits


def test_areas_of_the_thesis_braces() -> None:
    """SHS 200, 180 and 160 x 10 have 74.93, 66.93 and 58.93 cm2 with r_o = 1.5 t and r_i = t."""
    areas = [steel_section(f"SHS{size}x10").A / CM2 for size in (200, 180, 160)]
    assert areas == pytest.approx([74.93, 66.93, 58.93], abs=0.005)


def _thin_tube(h: float, b: float, t: float) -> float:
    """Shear area of a rectangular tube by integration of (S/t)2 along its midline, in 20000 steps."""
    H, B, n = h - t, b - t, 5000
    flange = [(i + 0.5) * B / 2 / n * H / 2 for i in range(n)]  # S/t from the middle of a flange to the corner
    web = [B * H / 4 + (H**2 / 4 - z**2) / 2 for z in ((i + 0.5) * H / 2 / n for i in range(n))]
    total = 4 * t * (sum(s**2 for s in flange) * B / 2 / n + sum(s**2 for s in web) * H / 2 / n)
    return (t * (H**3 / 6 + B * H**2 / 2)) ** 2 / total


def test_shear_areas_of_tubes() -> None:
    s = steel_section("RHS200x100x8")
    assert s.A_z == pytest.approx(_thin_tube(0.2, 0.1, 0.008), rel=1e-6)  # midpoint rule
    assert s.A_y == pytest.approx(_thin_tube(0.1, 0.2, 0.008), rel=1e-6)
    square = steel_section("SHS200x10")
    assert square.A_z == pytest.approx(5 / 12 * 4 * 0.19 * 0.01)  # 5/12 of A, a classical result


FINITE_ELEMENTS = {  # sectionproperties 3.10.2: I_t in cm4, shear areas in cm2; cross-sections as here
    "IPE330": (27.655, 34.225, 24.283),
    "HEB300": (187.79, 102.76, 32.263),
    "HEB450": (449.89, 139.15, 61.377),
    "HEM300": (1418.1, 213.72, 68.225),
    "CHS168.3x8": (2592.5, 20.219, 20.219),
}


@pytest.mark.parametrize("name", FINITE_ELEMENTS)
def test_torsion_and_shear_against_finite_elements(name: str) -> None:
    I_t, A_y, A_z = FINITE_ELEMENTS[name]
    s = steel_section(name)
    assert s.I_t / CM4 == pytest.approx(I_t, rel=0.025)  # the formula of the tables
    assert s.A_z / CM2 == pytest.approx(A_z, rel=0.05)  # h t_w counts the fillets and the flanges' depth as web
    assert 0.88 * A_y < s.A_y / CM2 < A_y  # without the fillets


def test_plastic_moduli_by_integration() -> None:
    """W_pl of a cold formed tube and of an I section, layer by layer."""

    def width(s: SteelSection, z: float) -> float:
        if s.kind == "I":
            if z > s.h / 2 - s.tf:
                return s.b
            into = z - (s.h / 2 - s.tf - s.r)
            return s.tw + (2.0 * (s.r - math.sqrt(s.r**2 - into**2)) if into > 0.0 else 0.0)

        def solid(h: float, b: float, r: float) -> float:
            into = z - (h / 2 - r)
            if z > h / 2:
                return 0.0
            return b - (2.0 * (r - math.sqrt(r**2 - into**2)) if into > 0.0 else 0.0)

        return solid(s.h, s.b, s.r) - solid(s.h - 2 * s.tf, s.b - 2 * s.tf, s.r - s.tf)

    for name in ("CFRHS200x100x8", "HEB300"):
        s, n = steel_section(name), 200000
        step = s.h / 2 / n
        modulus = 2 * sum(width(s, z) * z * step for z in ((i + 0.5) * step for i in range(n)))
        assert s.W_pl_y == pytest.approx(modulus, rel=2e-5)  # h/2 times a step where the width jumps


def test_names() -> None:
    assert steel_section("shs 200 x 10") == steel_section("HFSHS200x200x10") == steel_section("SHS200×10")
    assert steel_section("IPE 330").name == "IPE330"
    cold = steel_section("CFSHS200x10")
    assert cold.cold_formed and cold.r == pytest.approx(0.025) and cold.A < steel_section("SHS200x10").A
    assert steel_section("RHS100x200x8").h == 0.2
    for name, message in (
        ("SHS200", "E-SECT-02"),
        ("SHS20x10", "10 mm .* 20 mm; .*E-SECT-02"),
        ("CHS100x60", "60 mm .* 100 mm; .*E-SECT-02"),
        ("CHS100x0", "E-SECT-02"),
        ("HEB305", "HEB305.* HEB .*`HEB300`"),
        ("", "written like"),
    ):
        with pytest.raises(InputError, match=message):
            steel_section(name)
