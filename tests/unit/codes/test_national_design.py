"""National parameters of design. Recommended: EN 1998-1:2004, EN 1990:2002+A1, EN 1993-1-1:2005, tables as named.

France: arrete du 22 octobre 2010 (DEVP1015475A), article 4, published in JORF 248 of 24 October 2010. The table of psi
agrees with that of eurocodepy 2027.0.12 (its Eurocodes/Loads/Live and action_factors.json).
"""

from __future__ import annotations

import pytest

from edesign.codes.ec8 import countries, national_parameters
from edesign.codes.ec8.national import ActionFactors
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, design_spectrum
from edesign.project import parse_project

RECOMMENDED = national_parameters()


@pytest.mark.parametrize(
    ("category", "psi_0", "psi_1", "psi_2"),
    [  # EN 1990, Table A1.1
        ("A", 0.7, 0.5, 0.3),
        ("B", 0.7, 0.5, 0.3),
        ("C", 0.7, 0.7, 0.6),
        ("D", 0.7, 0.7, 0.6),
        ("E", 1.0, 0.9, 0.8),
        ("F", 0.7, 0.7, 0.6),
        ("G", 0.7, 0.5, 0.3),
        ("H", 0.0, 0.0, 0.0),
        ("snow", 0.5, 0.2, 0.0),
        ("snow_above_1000_m", 0.7, 0.5, 0.2),
        ("wind", 0.6, 0.2, 0.0),
        ("temperature", 0.6, 0.5, 0.0),
    ],
)
def test_table_a1_1(category: str, psi_0: float, psi_1: float, psi_2: float) -> None:
    psi = RECOMMENDED.psi[category]
    assert (psi.psi_0, psi.psi_1, psi.psi_2) == (psi_0, psi_1, psi_2)
    assert len(RECOMMENDED.psi) == 12


def test_recommended_values_of_design() -> None:
    assert (RECOMMENDED.gamma_ov, RECOMMENDED.gamma_pb, RECOMMENDED.low_ductility_q) == (1.25, 0.3, 1.5)
    assert [RECOMMENDED.nu(name) for name in ("I", "II", "III", "IV")] == [0.5, 0.5, 0.4, 0.4]
    assert RECOMMENDED.phi == {"roof": 1.0, "correlated": 0.8, "independent": 0.5, "other": 1.0}
    assert RECOMMENDED.action_factors == ActionFactors() == ActionFactors(G_sup=1.35, G_inf=1.0, Q=1.5, xi=0.85)
    assert RECOMMENDED.gamma_M == {"M0": 1.0, "M1": 1.0, "M2": 1.25}
    with pytest.raises(InputError, match="`V`.*E-NAME-01"):
        RECOMMENDED.nu("V")


@pytest.mark.parametrize("country", countries())
def test_every_value_of_a_country_names_clause_and_source(country: str) -> None:
    for parameter in national_parameters(country).parameters.values():
        assert parameter.clause and parameter.source, parameter.name


def test_france() -> None:
    france = national_parameters("france")
    assert [france.a_gR(zone) for zone in "12345"] == [0.4, 0.7, 1.1, 1.6, 3.0]  # m/s2
    C = france.horizontal(2, "C")
    assert (C.S, C.T_B, C.T_C, C.T_D) == (1.5, 0.06, 0.4, 2.0)
    E = france.horizontal(2, "E")
    assert (E.S, E.T_B, E.T_C, E.T_D) == (1.8, 0.08, 0.45, 1.25)
    for ground in "ABCDE":  # the values of zone 5 are those that EN 1998-1 recommends for type 1
        assert france.horizontal(1, ground) == RECOMMENDED.horizontal(1, ground)
    assert (france.vertical(2).ratio, france.vertical(2).T_D) == (0.8, 2.5)
    assert (france.vertical(1).ratio, france.vertical(1).T_C) == (0.9, 0.4)


def test_a_zone_of_france_takes_one_type_of_spectrum() -> None:
    france = national_parameters("france")
    france.check_spectrum_type("3", 2)
    france.check_spectrum_type("5", 1)
    with pytest.raises(InputError, match="zone 3 of france .*E-EC8-02"):
        france.check_spectrum_type("3", 1)
    with pytest.raises(InputError, match="`6`.*E-NAME-01"):
        france.check_spectrum_type("6", 1)
    national_parameters("greece").check_spectrum_type("3", 2)  # no rule: any type


def test_the_project_file_is_reported_where_the_type_is_wrong() -> None:
    text = """\
edesign: 1
title: site
hazard:
  code: ec8-2004
  country: france
  zone: 4
  ground: B
  spectrum: 1
  behaviour_factor: 4
frame:
  bays: [6 m]
  storeys: [4 m]
  columns: [{storeys: all, section: HEB340, material: steel}]
  beams: [{floors: all, section: IPE360, material: steel}]
materials: {steel: {law: elastic, E: 210 GPa}}
analyses: [{name: gravity, kind: gravity}]
"""
    with pytest.raises(InputError, match=r":8:.*hazard\.spectrum: zone 4 of france .*E-EC8-02"):
        checked_hazard(parse_project(text))
    hazard = checked_hazard(parse_project(text.replace("spectrum: 1", "spectrum: 2")))
    # plateau of zone 4 on ground B: 1.6 x 1.35 x 2.5 / 4
    assert design_spectrum(hazard).acceleration(0.2) == pytest.approx(1.35, rel=1e-12)  # rounding
