"""Permanent loads that are not structural, G2 of NTC 2018, Table 2.6.I: combinations, forces and masses by hand."""

from __future__ import annotations

import numpy as np
import pytest
from building_examples import NO_TORSION, building, changed, design_of, moment_frames
from test_ntc_buildings import G, ntc

from edesign.codes.ec8.national import Psi
from edesign.codes.en1990.combinations import fundamental
from edesign.codes.ntc2018.parameters import ntc_parameters
from edesign.errors import InputError
from edesign.space.extract import frame_row, project_text
from edesign.space.structure.geometry import space_frame

_CASES = {"G": "permanent", "G2": "permanent", "Q": "B"}
_PSI = {"B": Psi(0.7, 0.5, 0.3)}


def test_factors_of_table_2_6_i() -> None:
    """Column A1: G1 1.3 and 1.0, G2 1.5 and 0.8, Q 1.5; each of both kinds may be favourable without the other."""
    factors = ntc_parameters().action_factors
    unfavourable = fundamental(_CASES, _PSI, factors, non_structural=("G2",))
    assert [row.name for row in unfavourable] == ["1.3 G + 1.5 G2 + 1.5 Q"]
    either = {row.name for row in fundamental(_CASES, _PSI, factors, favourable=True, non_structural=("G2",))}
    without = {"1.3 G + 1.5 G2", "1.3 G + 0.8 G2", "G + 1.5 G2", "G + 0.8 G2"}
    assert either == without | {f"{name} + 1.5 Q" for name in without}


def test_wind_that_lifts_acts_with_favourable_loads() -> None:
    """Wind may relieve: G 1.0 and G2 0.8 with 1.5 wind alone."""
    cases, psi = _CASES | {"wind": "wind"}, _PSI | {"wind": Psi(0.6, 0.2, 0.0)}
    found = fundamental(cases, psi, ntc_parameters().action_factors, relieving=("wind",), non_structural=("G2",))
    assert "G + 0.8 G2 + 1.5 wind" in [row.name for row in found]


_TEXT = ntc(moment_frames() + NO_TORSION)
_APART = changed(_TEXT, ("G: 5 kN/m^2", "G: 3 kN/m^2, G2: 2 kN/m^2"))


def test_column_bases_carry_the_factored_loads() -> None:
    """One storey of 6 m by 8 m with 3 kN/m2 of G, 2 kN/m2 of G2 and 2 kN/m2 of Q, without self weight.

    1.3 x 3 + 1.5 x 2 + 1.5 x 2 = 9.9 kN/m2 on 48 m2 are 475.2 kN; with all permanent loads as G they are
    1.3 x 5 + 1.5 x 2 = 9.5 kN/m2 and 456 kN. Both have masses of 5 + 0.3 x 2 = 5.6 kN/m2, 268.8 kN, and the same
    seismic combinations (1e-9: equilibrium).
    """
    apart, joined = design_of(_APART), design_of(_TEXT)
    assert apart.foundations.persistent == ("1.3 G + 1.5 G2 + 1.5 Q",)
    for of in (apart, joined):  # what they say of gamma_G holds with and without G2
        assert [note for note in of.notes if note.startswith("permanent loads `G` have gamma_G of G_1")]
    for of, load in ((apart, 475.2e3), (joined, 456e3)):
        assert of.foundations.acting[0, :, 2].sum() == pytest.approx(load, rel=1e-9)
        assert of.frame.node_mass.sum() == pytest.approx(268.8e3 / G, rel=1e-9)
    seismic = [row.name for row in apart.combinations if row.set == "seismic"]
    assert seismic[0].startswith("G + G2 + 0.3 Q + ")
    np.testing.assert_allclose(apart.modes.period, joined.modes.period, rtol=1e-9)
    np.testing.assert_allclose(apart.foundations.largest, joined.foundations.largest, rtol=1e-9, atol=1e-3)


def test_deflections_under_variable_loads_are_without_them() -> None:
    """The span/250 of variable loads knows Q alone: it is the same whichever permanent loads there are (1e-9)."""
    apart, joined = (design_of(text).deflections for text in (_APART, _TEXT))
    np.testing.assert_allclose(apart.live, joined.live, rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(apart.total, joined.total, rtol=1e-9, atol=1e-12)


def test_secondary_beams_carry_them() -> None:
    """IPE200 of 6 m every 2.667 m: w = 2.667 (1.3 x 3 + 1.5 x 2 + 1.5 x 2) = 26.4 kN/m, M = w 36 / 8 = 118.8 kNm.

    The self weight is off. M_c,Rd = 220.6 cm3 x 275 MPa / 1.05 = 57.8 kNm: 2.056 (1e-3: the catalogue's digits).
    """
    beams = "spans: y, secondary_beams: 2, secondary_section: IPE200, secondary_material: S275"
    found = design_of(changed(_APART, ("spans: y", beams)))
    rule = next(rule for rule in found.criteria if rule.text.endswith("M_Ed / M_c,Rd"))
    assert rule.value == pytest.approx(2.056, rel=1e-3)


def test_extracted_frames_have_them() -> None:
    """A project file has one G: 4 m of 3 + 2 kN/m2 on each beam along x."""
    of = building(_APART)
    text = project_text(frame_row(of, space_frame(of), "X1"))
    assert "G: 20 kN/m, Q: 8 kN/m" in text


def test_other_codes_do_not_know_them() -> None:
    with pytest.raises(InputError, match=r"`G2`, permanent loads that are not structural, are of NTC 2018"):
        building(changed(moment_frames(), ("G: 5 kN/m^2", "G: 3 kN/m^2, G2: 2 kN/m^2")))


def test_stated_combinations_say_their_factor() -> None:
    asked = _APART + "  fundamental: {stated: [{G: 1.3, Q: 1.5}]}\n"
    with pytest.raises(InputError, match="`G2` is missing beside `G`"):
        building(asked)
