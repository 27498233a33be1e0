"""NTC 2018 for steel buildings: figures of the decree's own tables and formulas, by hand."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.codes.ec8.building_rules import RULES as EC8
from edesign.codes.ntc2018.behaviour_factor import (
    largest_section_class,
    limit_of_q,
    limit_of_q_for_damage,
    non_dissipative_q,
)
from edesign.codes.ntc2018.building_rules import RULES
from edesign.codes.ntc2018.capacity import FOUNDATIONS, material_overstrength, overstrength_beside_gravity
from edesign.codes.ntc2018.displacement import displacement_ductility
from edesign.codes.ntc2018.drift import limit_of_drift, limit_state_of_drift
from edesign.codes.ntc2018.parameters import ntc_parameters
from edesign.codes.ntc2018.regularity import setbacks
from edesign.codes.ntc2018.vertical import vertical_component_counts
from edesign.errors import InputError


@pytest.mark.parametrize(
    ("system", "ductility", "ratio", "regular", "q"),
    [
        ("moment_frame", "high", 1.3, True, 6.5),  # 5.0 alpha_u/alpha_1
        ("moment_frame", "medium", 1.3, True, 4.0),
        ("moment_frame", "medium", 1.3, False, 3.2),  # K_R = 0.8
        ("eccentric", "high", 1.2, True, 6.0),
        ("concentric_diagonal", "high", 1.0, True, 4.0),
        ("concentric_v", "high", 1.0, True, 2.5),
        ("concentric_v", "medium", 1.0, True, 2.0),
        ("moment_frame", "low", 1.3, True, 1.5),  # 2/3 4.0 = 2.67, at most 1.5
        ("concentric_v", "low", 1.0, True, 4.0 / 3.0),  # 2/3 2.0
        ("concentric_v", "low", 1.0, False, 3.2 / 3.0),  # 2/3 0.8 2.0
    ],
)
def test_behaviour_factors(system: str, ductility: str, ratio: float, regular: bool, q: float) -> None:
    """Tables 7.3.I and 7.3.II, Eqs. 7.3.1 and 7.3.2."""
    assert limit_of_q(system, ductility, ratio, regular) == pytest.approx(q)


def test_non_dissipative_q_is_at_least_one() -> None:
    """Eq. 7.3.2: 1 <= q_ND."""
    assert non_dissipative_q(1.2) == 1.0


@pytest.mark.parametrize(
    ("ductility", "q_0", "of"), [("high", 5.2, 1), ("high", 4.0, 2), ("medium", 4.0, 2), ("low", 1.5, 4)]
)
def test_classes_of_dissipative_sections(ductility: str, q_0: float, of: int) -> None:
    """Table 7.5.I: class 1 for q_0 above 4, else 1 or 2."""
    assert largest_section_class(ductility, q_0) == of


@pytest.mark.parametrize(("T_1", "mu"), [(0.5, 4.0), (0.8, 4.0), (0.25, 7.0), (0.05, 16.0)])
def test_displacement_ductility(T_1: float, mu: float) -> None:
    """q = 4, T_C = 0.5 s: q from T_C on; 1 + 3 0.5 / 0.25 = 7 below; at most 5 q - 4 = 16 (7.3.9)."""
    assert displacement_ductility(4.0, T_1, 0.5) == pytest.approx(mu)


@pytest.mark.parametrize(
    ("elements", "use", "state", "limit"),
    [
        ("brittle", "II", "SLD", 0.0050),
        ("ductile", "I", "SLD", 0.0075),
        ("none_attached", "II", "SLD", 0.0100),
        ("brittle", "III", "SLO", 0.0050 * 2.0 / 3.0),
        ("ductile", "IV", "SLO", 0.0050),
    ],
)
def test_drift_limits(elements: str, use: str, state: str, limit: float) -> None:
    """7.3.6.1, Eqs. 7.3.11a, 7.3.11b and 7.3.12; two thirds of them in classes of use III and IV."""
    assert limit_state_of_drift(use) == state
    assert limit_of_drift(elements, use) == pytest.approx(limit)


def test_no_such_class_of_use() -> None:
    with pytest.raises(InputError, match="no class of use `V`"):
        limit_state_of_drift("V")


def test_overstrength() -> None:
    """7.5.1: 1.25 up to S355, 1.15 of S420 and S460. 7.5.4.2: (300 - 60) / 80 = 3, in the worse sense of gravity."""
    assert material_overstrength([235e6, 355e6]) == material_overstrength([460e6, 355e6]) == 1.25
    assert material_overstrength([420e6, 460e6]) == 1.15
    found = overstrength_beside_gravity([300e3, 300e3, 300e3], [60e3, -60e3, 0.0], [80e3, 80e3, 0.0])
    np.testing.assert_allclose(found, [3.0, 3.0, np.inf])


def test_strength_under_damage() -> None:
    """C7.3.1: q' = q_ND S_e,SLV / S_e,SLD = 1.5 0.60 / 0.24 = 3.75."""
    assert limit_of_q_for_damage(1.5, 0.60, 0.24) == pytest.approx(3.75)


def test_parameters_are_those_of_the_tables() -> None:
    """Tables 2.5.I, 2.6.I, 4.2.VII; 3.2.3.5; 7.5.5. Masses have no phi."""
    found = ntc_parameters()
    assert found.country == "NTC 2018"
    assert (found.gamma_M["M0"], found.gamma_M["M1"], found.gamma_M["M2"]) == (1.05, 1.05, 1.25)
    assert (found.action_factors.G_sup, found.action_factors.G_inf, found.action_factors.Q) == (1.3, 1.0, 1.5)
    assert (found.beta, found.gamma_pb, set(found.phi.values())) == (0.2, 0.3, {1.0})
    assert (found.psi["E"].psi_0, found.psi["E"].psi_1, found.psi["E"].psi_2) == (1.0, 0.9, 0.8)
    assert FOUNDATIONS == {"low": 1.0, "medium": 1.1, "high": 1.3}


def test_setbacks() -> None:
    """7.2.1 g: 18 to 16.5 m is 8.3 %; to 12 m 27 % of the storey below, 33 % of the first. The roof of four is free."""
    lower, tops = [0.0, 0.0, 0.0, 0.0], [4.0, 7.0, 10.0, 13.0]
    assert setbacks(lower, [18.0, 18.0, 18.0, 9.0], tops) == ()
    each, first = setbacks(lower, [18.0, 16.5, 12.0, 12.0], tops)
    assert (each.value, first.value) == (pytest.approx(1.0 - 12.0 / 16.5), pytest.approx(1.0 - 12.0 / 18.0))
    assert (each.detail, each.passed, first.passed) == ("above storey 2", False, False)
    assert [rule.passed for rule in setbacks(lower[:3], [18.0, 16.5, 16.5], tops[:3])] == [True, True]


def test_vertical_component() -> None:
    """7.2.2: spans above 20 m and cantilevers above 4 m, whatever the acceleration."""
    assert vertical_component_counts(0.1, 20.5) and vertical_component_counts(0.1, 0.0, 4.5)
    assert not vertical_component_counts(9.0, 20.0, 4.0)


def test_clauses_in_words_of_the_code() -> None:
    """Every clause that a text cites is that of the code, one by one; EN 1998-1 keeps its texts."""
    text = "Omega (EN 1998-1, 6.6.3(1)P, 6.7.4(1)), f_y (EN 1993-1-1, 3.2), EN 1998-1, 6.6.2(2), Eq. 6.2"
    told = "Omega (NTC 2018, 7.5.4.2, NTC 2018, 7.5.5), f_y (EN 1993-1-1, 3.2), NTC 2018, 7.5.4.1"
    assert RULES.told(text) == told and EC8.told(text) == text
    assert RULES.clause("4.4.2.2(3)") == "NTC 2018, 7.3.1"
    assert RULES.clause("6.7.1(3)") == "EN 1998-1, 6.7.1(3)"
    assert RULES.clause("EN 1993-1-1, 5.2.2(6)") == "EN 1993-1-1, 5.2.2(6)"
