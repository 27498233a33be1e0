"""Ground types, national parameters and the registry of codes (values: EN 1998-1:2004, clauses as named)."""

from __future__ import annotations

from typing import get_args

import pytest

from edesign.codes import codes, find_code
from edesign.codes.ec8 import ElasticSpectrum, HorizontalParameters, VerticalParameters, countries, national_parameters
from edesign.codes.ec8.action.ground import ground_type
from edesign.codes.ec8.action.importance import factor_of_probability, factor_of_return_period, return_period_of
from edesign.codes.ec8.national import Parameter
from edesign.errors import InputError
from edesign.project.actions.hazard import OTHER_CODES, AsceHazard, EC8Hazard, Level, NtcHazard, UserHazard

G = 9.80665


def test_table_3_1() -> None:
    assert all(ground_type(name).name == name for name in ("A", "B", "C", "D", "E", "S1", "S2"))
    assert ground_type("C").v_s30 == (180.0, 360.0)
    with pytest.raises(InputError, match="`F`.*E-NAME-01"):
        ground_type("F")


def test_every_recommended_parameter_names_its_clause() -> None:
    clauses = {name: parameter.clause for name, parameter in national_parameters().parameters.items()}
    assert clauses == {
        "reference_probability": "2.1(1)P Note 1",
        "reference_return_period": "2.1(1)P Note 1",
        "hazard_exponent": "2.1(4) Note",
        "horizontal": "3.2.2.2(2)P Note 1",
        "vertical": "3.2.2.3(1)P Note",
        "lower_bound_factor": "3.2.2.5(4)P Note",
        "importance_factors": "4.2.5(5)P Note",
        "phi": "4.2.4(2)P Note",
        "displacement_reduction": "4.4.3.2(2) Note",
        "low_ductility_q": "6.1.2(1) Note 1",
        "material_overstrength": "6.2(3) Note",
        "post_buckling": "6.7.4(2) Note",
        "psi": "EN 1990, A1.2.2(1) Note",
        "action_factors": "EN 1990, A1.3.1(1) Note",
        "resistance_factors": "EN 1993-1-1, 6.1(1) Note 2B",
    }


def test_recommended_values() -> None:
    recommended = national_parameters()
    assert (recommended.country, recommended.beta, recommended.hazard_exponent) == (None, 0.2, 3.0)
    assert (recommended.reference_probability, recommended.reference_return_period) == (0.10, 475.0)
    assert not recommended.zones
    with pytest.raises(InputError, match="E-EC8-02"):
        recommended.a_gR("3")


@pytest.mark.parametrize(("zone", "a_gR"), [("1", 0.16), ("Z2", 0.24), ("z3", 0.36), ("3", 0.36)])
def test_zones_of_greece(zone: str, a_gR: float) -> None:
    assert national_parameters("greece").a_gR(zone) == pytest.approx(a_gR * G, rel=1e-15)


def test_what_greece_does_not_state_is_recommended() -> None:
    greece, recommended = national_parameters("greece"), national_parameters()
    stated = {name for name, parameter in greece.parameters.items() if parameter.origin == "greece"}
    assert stated == {"zones"}
    assert greece.parameters["zones"].clause.startswith("3.2.1")
    assert greece.horizontal(1, "C") == recommended.horizontal(1, "C")
    assert isinstance(greece.parameters["horizontal"], Parameter)
    assert greece.parameters["horizontal"].origin == "recommended"


def test_names_that_do_not_exist_are_reported_with_those_that_do() -> None:
    assert countries() == ("france", "greece")
    with pytest.raises(InputError, match=r"there is no country `grece`; did you mean `greece`\?"):
        national_parameters("grece")
    with pytest.raises(InputError, match=r"no zone in greece `4`.*`Z1`, `Z2`, `Z3`"):
        national_parameters("greece").a_gR("4")
    with pytest.raises(InputError, match="`3`.*E-NAME-01"):
        national_parameters().horizontal(3, "A")
    with pytest.raises(InputError, match="`0`.*E-NAME-01"):
        national_parameters().vertical(0)
    with pytest.raises(InputError, match="`F`.*E-NAME-01"):
        national_parameters().horizontal(1, "F")
    with pytest.raises(InputError, match="`V`.*E-NAME-01"):
        national_parameters().gamma_I("V")
    with pytest.raises(InputError, match="E-EC8-05"):
        national_parameters().horizontal(1, "S1")


def test_parameters_must_fit_together() -> None:
    with pytest.raises(InputError, match="E-VALUE-04"):
        HorizontalParameters("C", 1, 1.15, 0.7, 0.6, 2.0)
    with pytest.raises(InputError, match="^S .*E-VALUE-02"):
        HorizontalParameters("C", 1, 0.0, 0.2, 0.6, 2.0)
    with pytest.raises(InputError, match="T_B .*E-VALUE-02"):
        VerticalParameters(1, 0.9, 0.0, 0.15, 1.0)


def test_actions_and_periods_that_make_no_sense_are_refused() -> None:
    C = national_parameters().horizontal(1, "C")
    with pytest.raises(InputError, match="a_gR .*E-VALUE-02"):
        ElasticSpectrum(0.0, C)
    with pytest.raises(InputError, match="gamma_I .*E-VALUE-02"):
        ElasticSpectrum(1.0, C, gamma_I=-1.0)
    with pytest.raises(InputError, match="not 5 .E-VALUE-02"):
        ElasticSpectrum(1.0, C, damping=5.0)
    with pytest.raises(InputError, match="not -0.1 s .E-VALUE-02"):
        ElasticSpectrum(1.0, C).acceleration([0.1, -0.1])
    assert ElasticSpectrum(1.0, C).acceleration(0.3).shape == ()
    assert ElasticSpectrum(1.0, C).acceleration([[0.3, 1.0, 2.0]]).shape == (1, 3)


@pytest.mark.parametrize("probability", [0.0, 1.0, 2.0, float("nan")])
def test_a_probability_lies_between_0_and_1(probability: float) -> None:
    with pytest.raises(InputError, match="E-VALUE-02"):
        factor_of_probability(probability)
    with pytest.raises(InputError, match="E-VALUE-02"):
        return_period_of(probability)


def test_times_and_exponents_are_positive() -> None:
    with pytest.raises(InputError, match="E-VALUE-02"):
        factor_of_return_period(0.0)
    with pytest.raises(InputError, match="exponent k .*E-VALUE-02"):
        factor_of_probability(0.02, k=0.0)


def test_registry() -> None:
    code = find_code("ec8-2004")
    assert code.title == code.set_rules.code == "EN 1998-1:2004"
    with pytest.raises(InputError, match=r"there is no code `ec8`; did you mean `ec8-2004`\?"):
        find_code("ec8")


def test_the_project_file_allows_what_the_codes_have() -> None:
    """The schema cannot import the codes, so its lists are compared with theirs here."""
    named = [get_args(of.model_fields["code"].annotation) for of in (EC8Hazard, NtcHazard, AsceHazard)]
    assert {code for of in named for code in of} == set(codes)
    assert set(get_args(UserHazard.model_fields["criteria"].annotation)) == set(codes)
    assert {code for of in named[1:] for code in of} | {"user"} == set(OTHER_CODES)
    table = national_parameters().parameters["horizontal"].value
    assert set(get_args(EC8Hazard.model_fields["spectrum"].annotation)) == set(table)
    assert set(get_args(EC8Hazard.model_fields["ground"].annotation)) == set(table[1]) == set(table[2])
    classes = get_args(get_args(Level.model_fields["importance_class"].annotation)[0])
    assert set(classes) == set(national_parameters().parameters["importance_factors"].value)
