"""Combinations of EN 1990:2002+A1, 6.4.3 and 6.5.3: rows written out by hand."""

from __future__ import annotations

import math

import pytest

from edesign.codes.ec8 import national_parameters
from edesign.codes.ec8.analysis.directions import direction_factors, vertical_component_counts
from edesign.codes.en1990 import Combination, characteristic, frequent, fundamental, quasi_permanent, seismic
from edesign.codes.en1990.combinations import stated
from edesign.codes.en1991.imposed import alpha_A, alpha_n
from edesign.errors import InputError

NATIONAL = national_parameters()
PSI, FACTORS = NATIONAL.psi, NATIONAL.action_factors
OFFICE = {"G": "permanent", "Q": "B"}
WITH_WIND = {"G": "permanent", "Q": "B", "S": "snow", "W": "wind"}


def names(rows: tuple[Combination, ...]) -> list[str]:
    return [row.name for row in rows]


def test_the_ten_rows_of_the_thesis() -> None:
    """Section 5.2: 1.35G+1.5Q; G+Q; G+0.3Q+-E_X+-0.3E_Y (4); G+0.3Q+-E_Y+-0.3E_X (4)."""
    rows = fundamental(OFFICE, PSI, FACTORS) + characteristic(OFFICE, PSI) + seismic(OFFICE, PSI)
    assert names(rows) == [
        "1.35 G + 1.5 Q",
        "G + Q",
        "G + 0.3 Q + E_x + 0.3 E_y",
        "G + 0.3 Q + E_x - 0.3 E_y",
        "G + 0.3 Q - E_x + 0.3 E_y",
        "G + 0.3 Q - E_x - 0.3 E_y",
        "G + 0.3 Q + E_y + 0.3 E_x",
        "G + 0.3 Q + E_y - 0.3 E_x",
        "G + 0.3 Q - E_y + 0.3 E_x",
        "G + 0.3 Q - E_y - 0.3 E_x",
    ]
    assert [dict(row.static) for row in rows] == [
        {"G": 1.35, "Q": 1.5},
        {"G": 1.0, "Q": 1.0},
        *[{"G": 1.0, "Q": 0.3}] * 8,
    ]
    assert [row.seismic[:2] for row in rows[2:6]] == [(1.0, 0.3), (1.0, -0.3), (-1.0, 0.3), (-1.0, -0.3)]
    assert [row.seismic[:2] for row in rows[6:]] == [(0.3, 1.0), (-0.3, 1.0), (0.3, -1.0), (-0.3, -1.0)]
    assert [row.equation for row in rows] == ["6.10", "6.14b", *["6.12b"] * 8]
    assert [row.set for row in rows] == ["fundamental", "characteristic", *["seismic"] * 8]


def test_each_variable_action_leads_once() -> None:
    assert names(fundamental(WITH_WIND, PSI, FACTORS)) == [
        "1.35 G + 1.5 Q + 0.75 S + 0.9 W",  # 1.5 x 0.5, 1.5 x 0.6
        "1.35 G + 1.05 Q + 1.5 S + 0.9 W",  # 1.5 x 0.7
        "1.35 G + 1.05 Q + 0.75 S + 1.5 W",
    ]
    assert names(characteristic(WITH_WIND, PSI)) == [
        "G + Q + 0.5 S + 0.6 W",
        "G + 0.7 Q + S + 0.6 W",
        "G + 0.7 Q + 0.5 S + W",
    ]
    assert names(frequent(WITH_WIND, PSI)) == ["G + 0.5 Q", "G + 0.3 Q + 0.2 S", "G + 0.3 Q + 0.2 W"]
    assert names(quasi_permanent(WITH_WIND, PSI)) == ["G + 0.3 Q"]


def test_pair_of_6_10a_and_6_10b() -> None:
    rows = fundamental(OFFICE, PSI, FACTORS, "6.10a/b")
    assert [(row.equation, row.name) for row in rows] == [
        ("6.10a", "1.35 G + 1.05 Q"),
        ("6.10b", "1.1475 G + 1.5 Q"),  # 0.85 x 1.35
    ]


def test_what_both_of_the_pair_give_is_one_row() -> None:
    """G alone, and loads of stores, whose psi_0 is 1 (EN 1990, Table A1.1): 6.10a and 6.10b do not differ at G_inf."""
    rows = fundamental({"G": "permanent", "Q": "E"}, PSI, FACTORS, "6.10a/b", favourable=True)
    assert [(row.equation, row.name) for row in rows] == [
        ("6.10a", "1.35 G"),
        ("6.10b", "1.1475 G"),
        ("6.10a/b", "G"),
        ("6.10a", "1.35 G + 1.5 Q"),
        ("6.10b", "1.1475 G + 1.5 Q"),
        ("6.10a/b", "G + 1.5 Q"),
    ]
    assert len(set(names(rows))) == len(rows)


def test_favourable_actions() -> None:
    """The rows of one permanent and two independent imposed cases as Dlubal, FAQ 002341 lists them; and with G_inf."""
    rows = fundamental({"LF1": "permanent", "LF3": "A", "LF4": "A"}, PSI, FACTORS, favourable=True)
    assert {row.name for row in rows if row.static["LF1"] == 1.35} == {
        "1.35 LF1",
        "1.35 LF1 + 1.5 LF3",
        "1.35 LF1 + 1.5 LF3 + 1.5 LF4",
        "1.35 LF1 + 1.5 LF4",
    }
    assert len(rows) == 8 and {"LF1", "LF1 + 1.5 LF3 + 1.5 LF4"} <= set(names(rows))


def test_imposed_loads_are_one_action_and_categories_keep_their_psi() -> None:
    """EN 1991-1-1, 3.3.1(3)P: with wind leading, offices and archives accompany with 0.7 and 1.0."""
    cases = {"G1": "permanent", "G2": "permanent", "Q": "B", "QE": "E", "W": "wind"}
    assert names(fundamental(cases, PSI, FACTORS)) == [
        "1.35 G1 + 1.35 G2 + 1.5 Q + 1.5 QE + 0.9 W",
        "1.35 G1 + 1.35 G2 + 1.05 Q + 1.5 QE + 1.5 W",
    ]
    assert names(seismic(cases, PSI))[0] == "G1 + G2 + 0.3 Q + 0.8 QE + E_x + 0.3 E_y"


def test_winds_exclude_each_other_and_roof_loads_exclude_snow_and_wind() -> None:
    cases = {"G": "permanent", "R": "H", "S": "snow", "Wx": "wind", "Wy": "wind"}
    rows = fundamental(cases, PSI, FACTORS)
    assert names(rows) == [
        "1.35 G + 1.5 S + 0.9 Wx",
        "1.35 G + 0.75 S + 1.5 Wx",
        "1.35 G + 1.5 S + 0.9 Wy",
        "1.35 G + 0.75 S + 1.5 Wy",
        "1.35 G + 1.5 R",
    ]
    cases = {"G": "permanent", "Q": "B", "R": "H", "S": "snow_above_1000_m"}
    assert names(fundamental(cases, PSI, FACTORS)) == [  # 1.35 G + 1.5 Q without snow would say nothing more
        "1.35 G + 1.5 Q + 1.05 S",
        "1.35 G + 1.05 Q + 1.5 S",
        "1.35 G + 1.05 Q + 1.5 R",
    ]
    assert [row.static for row in seismic(cases, PSI)] == [{"G": 1.0, "Q": 0.3, "S": 0.2}] * 8
    cases = {"G": "permanent", "R": "H", "S": "snow", "Wx": "wind", "Wy": "wind"}
    assert not any({"Wx", "Wy"} <= set(row.static) for row in fundamental(cases, PSI, FACTORS, favourable=True))


def test_actions_that_may_relieve_others() -> None:
    """Wind to either side of an office: absent, beside the imposed load, and with favourable G: G + 1.5 W."""
    cases = {"G": "permanent", "Q": "B", "W": "wind", "-W": "wind"}
    assert names(fundamental(cases, PSI, FACTORS, relieving=("W", "-W"))) == [
        "1.35 G + 1.5 Q",
        "1.35 G + 1.5 Q + 0.9 W",
        "1.35 G + 1.05 Q + 1.5 W",
        "1.35 G + 1.5 Q - 0.9 W",
        "1.35 G + 1.05 Q - 1.5 W",
        "G + 1.5 W",
        "G - 1.5 W",
    ]
    assert names(characteristic(cases, PSI, relieving=("W", "-W"))) == [
        "G + Q",
        "G + Q + 0.6 W",
        "G + 0.7 Q + W",
        "G + Q - 0.6 W",
        "G + 0.7 Q - W",
        "G + W",
        "G - W",
    ]
    assert [dict(row.static) for row in seismic(cases, PSI, relieving=("W", "-W"))] == [{"G": 1.0, "Q": 0.3}] * 8
    pair = names(fundamental(cases, PSI, FACTORS, "6.10a/b", relieving=("W", "-W")))
    assert {"1.35 G + 1.05 Q + 0.9 W", "1.1475 G + 1.05 Q + 1.5 W", "G + 1.5 W"} <= set(pair)


def test_patterns_of_imposed_loads_act_alone_where_they_lead() -> None:
    cases = {"G": "permanent", "Q1": "B", "Q2": "B", "S": "snow"}
    assert names(fundamental(cases, PSI, FACTORS, patterns=(("Q1",), ("Q2",)))) == [
        "1.35 G + 1.5 Q1 + 1.5 Q2 + 0.75 S",
        "1.35 G + 1.05 Q1 + 1.05 Q2 + 1.5 S",
        "1.35 G + 1.5 Q1 + 0.75 S",
        "1.35 G + 1.5 Q2 + 0.75 S",
    ]


def test_stated_factors_are_a_combination() -> None:
    row = stated({"G": 1.2, "Q": 0.5, "-W": 1.1})
    assert (row.name, row.set, row.equation) == ("1.2 G + 0.5 Q - 1.1 W", "fundamental", "stated")


def test_permanent_loads_alone() -> None:
    assert names(fundamental({"G": "permanent"}, PSI, FACTORS)) == ["1.35 G"]
    assert names(frequent({"G": "permanent"}, PSI)) == ["G"]


def test_seismic_rows_by_srss_and_with_the_vertical_component() -> None:
    rows = seismic(OFFICE, PSI, "srss")
    assert names(rows) == ["G + 0.3 Q + SRSS(E_x, E_y)", "G + 0.3 Q - SRSS(E_x, E_y)"]
    assert [row.directions for row in rows] == ["srss", "srss"]
    assert [row.seismic for row in rows] == [(1.0, 1.0, 0.0), (-1.0, -1.0, 0.0)]
    rows = seismic(OFFICE, PSI, vertical=True)
    assert len(rows) == 24  # three directions that lead, eight sets of signs
    assert "G + 0.3 Q - E_z + 0.3 E_x - 0.3 E_y" in names(rows)


def test_bad_input_of_combinations() -> None:
    with pytest.raises(InputError, match=r"no category of the load case S, `snoww`; did you mean `snow`\?"):
        fundamental({"G": "permanent", "S": "snoww"}, PSI, FACTORS)
    with pytest.raises(InputError, match="E-EN1990-01"):
        seismic({"Q": "B"}, PSI)
    with pytest.raises(InputError, match=r"`6\.11`.*E-NAME-01"):
        fundamental(OFFICE, PSI, FACTORS, "6.11")
    with pytest.raises(InputError, match="`40 %`.*E-NAME-01"):
        seismic(OFFICE, PSI, "40 %")
    with pytest.raises(InputError, match="E-EN1990-02"):  # and no long wait before it
        fundamental({"G": "permanent"} | {f"Q{i}": "B" for i in range(40)}, PSI, FACTORS, favourable=True)
    with pytest.raises(InputError, match="1000 .*E-EN1990-02"):
        fundamental({"G": "permanent", **{f"Q{i}": "B" for i in range(9)}}, PSI, FACTORS, "6.10a/b", favourable=True)


def test_the_worst_row_of_the_30_percent_rule() -> None:
    effects = (-3.0, 5.0, 2.0)
    rows = [sum(f * e for f, e in zip(row, effects, strict=True)) for row in direction_factors("30 %", vertical=True)]
    assert max(rows) == pytest.approx(5.0 + 0.3 * 3.0 + 0.3 * 2.0)


def test_when_the_vertical_component_counts() -> None:
    """4.3.3.5.2(1): a_vg above 2.5 m/s2, and a span of 20 m or more, a cantilever above 5 m, ..."""
    assert vertical_component_counts(2.6, span=20.0)
    assert not vertical_component_counts(2.5, span=30.0)
    assert not vertical_component_counts(4.0, span=19.9, cantilever=5.0)
    assert vertical_component_counts(4.0, cantilever=5.1)
    assert vertical_component_counts(4.0, supports_column=True)


def test_reduction_of_imposed_loads() -> None:
    """EN 1991-1-1, Eqs. 6.1 and 6.2, psi_0 = 0.7: 5/7 x 0.7 = 0.5."""
    assert alpha_A(40.0, "B", 0.7) == pytest.approx(0.75)
    assert alpha_A(15.0, "B", 0.7) == 1.0
    assert alpha_A(1000.0, "B", 0.7) == pytest.approx(0.51)
    assert alpha_A(1000.0, "C", 0.7) == 0.6
    assert alpha_n(10, "A", 0.7) == pytest.approx(0.76)  # (2 + 8 x 0.7) / 10
    assert alpha_n(2, "A", 0.7) == alpha_n(1, "A", 0.7) == 1.0
    assert alpha_n(10, "A", 0.7, leading=False) == 1.0  # psi reduces it already
    with pytest.raises(InputError, match="E-EN1990-03"):
        alpha_n(5, "E", 1.0)
    with pytest.raises(InputError, match="`Z`.*E-NAME-01"):
        alpha_A(10.0, "Z", 0.7)
    with pytest.raises(InputError, match="area .*E-VALUE-02"):
        alpha_A(math.nan, "B", 0.7)
