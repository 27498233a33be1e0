"""Spectra of NTC 2018, 3.2.3, against worked tables and the printed return periods.

The tables are of a design note that another program computed from the text of the decree (the project NOVA, its
section 5.3): a_g = 0.25 g, F_0 = 2.50, T_C* = 0.30 s, subsoil C, T1, q = 3.9, six digits. The others are by hand from
the equations of the decree; return periods follow from its Table 3.2.I, rounded as guides print them.
"""

from __future__ import annotations

import numpy as np
import pytest

from edesign.codes.ntc2018 import (
    SERVICEABILITY,
    ULTIMATE,
    NtcDesignSpectrum,
    NtcSpectrum,
    NtcVerticalSpectrum,
    Site,
    reference_life,
    return_period,
)
from edesign.codes.quantities import STANDARD_GRAVITY as G
from edesign.errors import InputError

EXAMPLE = NtcSpectrum(0.25 * G, 2.50, 0.30, Site("C"))
PERIODS = (0.0, 0.1, 0.156221, 0.468663, 1.0, 2.0, 4.0)


def test_parameters_of_the_worked_table() -> None:
    assert EXAMPLE.site.C_C(0.30) == pytest.approx(1.562210, abs=5e-7)
    assert EXAMPLE.corners == pytest.approx({"T_B": 0.156221, "T_C": 0.468663, "T_D": 2.600}, abs=5e-7)
    assert EXAMPLE.S == pytest.approx(1.325000, abs=5e-7)


def test_ordinates_of_the_worked_table() -> None:
    elastic = (0.331250, 0.649309, 0.828125, 0.828125, 0.388111, 0.194056, 0.063068)
    design = (0.331250, 0.255133, 0.212340, 0.212340, 0.099516, 0.050000, 0.050000)
    np.testing.assert_allclose(EXAMPLE.acceleration(PERIODS) / G, elastic, atol=6e-7)
    np.testing.assert_allclose(NtcDesignSpectrum(EXAMPLE, 3.9).acceleration(PERIODS) / G, design, atol=6e-7)


def test_worksheet_of_a_named_site() -> None:
    """Brembate (Bergamo), SLV of a nominal life of 50 years and class II: six digits of a worksheet of an engineer.

    Read in the description of that worksheet (`sisma.xls`, golden test case) by a program that replaces it: a_g 0.098
    g, F_0 2.436, T_C* 0.272 s, subsoil B, T1, q = 1.5. It has the elastic spectrum over q, and no bound of 0.2 a_g,
    below which it falls at 5 s.
    """
    site = NtcSpectrum(0.098 * G, 2.436, 0.272, Site("B"))
    assert round(return_period("SLV", reference_life(50.0, "II"))) == 475
    assert site.site.C_C(0.272) == pytest.approx(1.42718, abs=5e-6)
    assert site.S == pytest.approx(1.2, abs=1e-12)
    assert site.corners == pytest.approx({"T_B": 0.129398, "T_C": 0.388193, "T_D": 1.992}, abs=5e-7)
    design, corners = NtcDesignSpectrum(site, 1.5), list(site.corners.values())
    printed = [0.1176, 0.190982, 0.190982, 0.0372179]
    np.testing.assert_allclose(design.acceleration([0.0, *corners]) / G, printed, rtol=3e-6)
    assert float(site.acceleration(5.0)) / G / 1.5 == pytest.approx(0.00590732, rel=1e-6)
    assert float(design.acceleration(5.0)) / G == pytest.approx(0.2 * 0.098, rel=1e-12)


def test_return_periods() -> None:
    """V_N = 50 years, class II: 30, 50, 475 and 975 years; class III 45, 75, 712 and 1462; C_U of class I is 0.7."""
    life = reference_life(50.0, "II")
    assert [round(return_period(name, life)) for name in ("SLO", "SLD", "SLV", "SLC")] == [30, 50, 475, 975]
    life = reference_life(50.0, "III")
    assert [round(return_period(name, life)) for name in ("SLO", "SLD", "SLV", "SLC")] == [45, 75, 712, 1462]
    assert reference_life(100.0, "IV") == 200.0 and reference_life(50.0, "I") == pytest.approx(35.0)
    with pytest.raises(InputError, match="`SLE`.*E-NAME-01"):
        return_period("SLE", life)
    with pytest.raises(InputError, match="class of use.*E-NAME-01"):
        reference_life(50.0, "V")


@pytest.mark.parametrize(
    ("ground", "S_S", "C_C"),
    [  # F_0 a_g/g = 0.25: 1.40 - 0.1 > 1.20; 1.70 - 0.15 > 1.50; 2.40 - 0.375 > 1.80; 2 - 0.275 > 1.6
        ("A", 1.0, 1.0),
        ("B", 1.2, 1.10 * 0.32**-0.20),
        ("C", 1.5, 1.05 * 0.32**-0.33),
        ("D", 1.8, 1.25 * 0.32**-0.50),
        ("E", 1.6, 1.15 * 0.32**-0.40),
    ],
)
def test_weak_motion_has_the_largest_site_factor(ground: str, S_S: float, C_C: float) -> None:
    site = Site(ground)
    assert site.S_S(0.1 * G, 2.5) == pytest.approx(S_S, rel=1e-12)
    assert site.C_C(0.32) == pytest.approx(C_C, rel=1e-12)


@pytest.mark.parametrize(("ground", "S_S"), [("A", 1.0), ("B", 1.15), ("C", 1.325), ("D", 1.4625), ("E", 1.3125)])
def test_site_factor_falls_with_the_motion(ground: str, S_S: float) -> None:
    """F_0 a_g/g = 0.625: 1.40 - 0.25; 1.70 - 0.375; 2.40 - 0.9375; 2.00 - 0.6875; at four times that the least."""
    assert Site(ground).S_S(0.25 * G, 2.5) == pytest.approx(S_S, rel=1e-12)
    assert Site(ground).S_S(1.0 * G, 2.5) == {"A": 1.0, "B": 1.0, "C": 1.0, "D": 0.9, "E": 1.0}[ground]


def test_relief_and_damping() -> None:
    """S_T = 1.2 multiplies every ordinate; 10 % damping the plateau by sqrt(10 / 15), period zero not at all."""
    ridge = NtcSpectrum(0.25 * G, 2.50, 0.30, Site("C", S_T=1.2))
    np.testing.assert_allclose(ridge.acceleration(PERIODS), 1.2 * EXAMPLE.acceleration(PERIODS), rtol=1e-12)
    damped = EXAMPLE.with_damping(0.10)
    ratio = damped.acceleration(PERIODS) / EXAMPLE.acceleration(PERIODS)
    assert ratio[0] == 1.0 and ratio[3:] == pytest.approx((10.0 / 15.0) ** 0.5, rel=1e-12)


def test_vertical_spectrum() -> None:
    """F_V = 1.35 x 2.5 x sqrt(0.25) = 1.6875; S_ve: 0.25 x 1.35 x 0.5, plateau 0.25 x 1.6875, at 1 s x 0.15; no S_S."""
    vertical = NtcVerticalSpectrum(0.25 * G, 2.50, 0.30, Site("C"))
    assert vertical.F_V == pytest.approx(1.6875, rel=1e-12)
    at = vertical.acceleration([0.0, 0.05, 0.15, 1.0, 2.0]) / G
    np.testing.assert_allclose(at, [0.16875, 0.421875, 0.421875, 0.06328125, 0.0158203125], rtol=1e-12)


def test_rules_of_a_set() -> None:
    """3.2.3.6: 0.15 s to 2 s or 2 T (1.5 T), - 10 % to + 30 %; 7.3.5: three motions, seven for the mean.

    Both read in a transcription of the Gazzetta Ufficiale, pages 50 and 221 (`claudiopagani/structural-codes`).
    """
    assert ULTIMATE.period_band(0.5) == (0.15, 2.0) and ULTIMATE.period_band(2.0) == (0.15, 4.0)
    assert SERVICEABILITY.period_band(2.0) == (0.15, 3.0)
    T = ULTIMATE.check_periods(1.5)

    def failed(level: float, count: int = 3) -> list[str]:
        spectra = np.tile(level * EXAMPLE.acceleration(T), (count, 1))
        return [found.text[:8] for found in ULTIMATE.check(T, spectra, [0.01] * count, EXAMPLE, 1.5).failed]

    assert failed(0.9) == [] and failed(1.3) == []
    assert failed(0.89) == ["lowest r"] and failed(1.31) == ["greatest"] and failed(1.0, 2) == ["number o"]
