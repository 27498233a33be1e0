"""Printed values of footings on soil.

Kramer & Stewart 2024, Geotechnical Earthquake Engineering, 2nd edition, Examples 8.1 and 8.4; Gazetas 1991, Journal of
Geotechnical Engineering 117, 1363-1381, worked example of its Figure 4.
"""

from __future__ import annotations

from math import pi

import pytest
from verification.footing_mast import mast

from edesign.codes.asce7.soil_strain import damping_ratio, modulus_ratio
from edesign.codes.ec8.action.soil_strain import soil_strain
from edesign.errors import InputError
from edesign.frame.footing_impedance import Block, static_stiffness
from edesign.study.analysis.footings import interaction
from edesign.study.analysis.structure import make_structure


def test_example_8_4_of_kramer_and_stewart() -> None:
    """A test structure on 4.06 m x 4.06 m, V_s = 198 m/s, 1800 kg/m3, nu = 0.3: 7.8e5 kN/m, 3.4e6 kN m/rad, a_0 = 0.39
    at 6 Hz, printed to two digits."""
    G, B = 1800.0 * 198.0**2, 2.03
    found = static_stiffness(Block(B, B, 0.0, 0.0, G, 0.3), "pais_kausel")
    assert found["x"] == pytest.approx(7.8e8, rel=0.01)
    assert found["yy"] == pytest.approx(3.4e9, rel=0.015)
    assert 2.0 * pi * 6.0 * B / 198.0 == pytest.approx(0.39, abs=0.005)


def test_example_8_1_of_kramer_and_stewart() -> None:
    """h / (V_s T) = 0.35, h / B = 1, square, nu = 0.33, mass ratio 0.15, soil without damping: ratio of periods 1.5 and
    foundation damping 0.2, read off NIST GCR 12-917-21, Figure 2-2, to half a division of it."""
    project, _, _, _ = mast(5.0, 10.0, 10.0, 0.35)
    structure = make_structure(project)
    found = interaction(project, structure, structure.modes(1), gravity=False)
    assert found.flexible / found.fixed == pytest.approx(1.5, abs=0.025)
    assert found.closed_damping == pytest.approx(0.20, abs=0.01)


def test_worked_example_of_gazetas() -> None:
    """G = 120 MPa, nu = 0.4, 2L = 16 m, area / 4L^2 = 0.26: K_z = 4.13e6 kN/m and K_x = 3.0e6 kN/m, of a rectangle
    of this area. K_x is printed with B / L = 1 / 3.2 of another shape, which changes it by 1 %."""
    L = 8.0
    found = static_stiffness(Block(L, 0.26 * L, 0.0, 0.0, 120e6, 0.4), "gazetas")
    assert found["z"] == pytest.approx(4.13e9, rel=0.002)
    assert found["x"] == pytest.approx(3.0e9, rel=0.025)


@pytest.mark.parametrize(("acceleration", "ratio", "damping"), [(0.05, 0.80, 0.03), (0.2, 0.5, 0.06), (0.3, 0.36, 0.1)])
def test_en_1998_5_table_4_1(acceleration: float, ratio: float, damping: float) -> None:
    assert soil_strain(acceleration) == pytest.approx((ratio, damping))


def test_en_1998_5_ends_at_0_3_g() -> None:
    with pytest.raises(InputError, match=" 0.31 g .*E-EC8-05"):
        soil_strain(0.31)


@pytest.mark.parametrize(
    ("site_class", "acceleration", "ratio", "damping"),
    [
        ("C", 0.4, 0.75, 0.03),
        ("D", 0.1, 0.90, 0.02),
        ("D", 0.25, 0.70, 0.045),
        ("D", 0.9, 0.10, 0.15),
        ("E", 0.4, 0.05, 0.20),
    ],
)
def test_asce_7_tables_19_3_2_and_3(site_class: str, acceleration: float, ratio: float, damping: float) -> None:
    """As Kramer & Stewart 2024, Table 8.1, prints them too."""
    assert modulus_ratio(site_class, acceleration) == pytest.approx(ratio)
    assert damping_ratio(site_class, acceleration) == pytest.approx(damping)


def test_asce_7_leaves_some_soils_to_an_investigation() -> None:
    with pytest.raises(InputError, match=" E .* 0.4 g,.*E-ASCE-01"):
        modulus_ratio("E", 0.5)
    with pytest.raises(InputError, match=" B; .*E-ASCE-01"):
        damping_ratio("B", 0.1)
