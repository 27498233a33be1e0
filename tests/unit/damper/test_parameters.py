"""Reading and writing parameters with units."""

from __future__ import annotations

import math

import pytest
from damper_examples import EXAMPLES
from hypothesis import given, settings
from hypothesis import strategies as st

from edesign.damper.laws import LAWS
from edesign.damper.parameters import PARAMETER_SETS, ParameterError, read_parameters, write_parameters
from edesign.errors import InputError

POWER = LAWS["viscous_power"]


def test_table_4_2_in_si() -> None:
    """By hand: kN/mm is 1e6 N/m, kN s/mm 1e6 N s/m, kN (s/mm)^0.374 is 1e3 * 1e3^0.374 N (s/m)^0.374."""
    found = read_parameters(LAWS["mgmm"], "thesis_table_4_2")
    assert found == pytest.approx(EXAMPLES["mgmm"], rel=1e-14)
    assert list(found) == [parameter.name for parameter in LAWS["mgmm"].parameters]


def test_sets_are_complete() -> None:
    for name, item in PARAMETER_SETS.items():
        assert read_parameters(LAWS[item.law], item.values), name


@pytest.mark.parametrize("name", LAWS)
def test_written_parameters_read_back(name: str) -> None:
    complete = LAWS[name].complete(EXAMPLES[name])
    assert read_parameters(LAWS[name], write_parameters(LAWS[name], complete)) == pytest.approx(complete, rel=1e-12)


@settings(deadline=None, max_examples=40)
@given(st.floats(1e-6, 2.0), st.floats(1e-3, 1e12))
def test_any_exponent_reads_back(alpha: float, c: float) -> None:
    read = read_parameters(POWER, write_parameters(POWER, {"c": c, "alpha": alpha}))
    assert read == pytest.approx({"c": c, "alpha": alpha}, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["2 kN*(s/mm)^0.35", "2 kN*(s/mm)^alpha", "2 kN*(s/mm)**0.35", "2 kN*s^0.35/mm^0.35", "2 kN·(s/mm)^0.35"]
)
def test_spellings_of_an_exponent(text: str) -> None:
    found = read_parameters(POWER, {"c": text, "alpha": 0.35})
    assert found["c"] == pytest.approx(2000.0 * 1000.0**0.35, rel=1e-14)


def test_exponent_that_is_not_the_parameter() -> None:
    with pytest.raises(
        ParameterError, match=r"length\^0.62 .* for example `1 kN\*\(s/mm\)\^0.374`; alpha = 0.374 .*E-UNIT-02"
    ):
        read_parameters(POWER, {"c": "2 kN*(s/mm)^0.38", "alpha": 0.374})
    # nor is the unit of a linear dashpot that of a power of 0.374
    with pytest.raises(ParameterError, match="alpha = 0.374 .*E-UNIT-02"):
        read_parameters(POWER, {"c": "2 kN*s/mm", "alpha": 0.374})


def test_powers_of_time() -> None:
    found = read_parameters(LAWS["fractional_kelvin"], {"k0": "1 kN/mm", "c": "100 ms^0.5", "alpha": 0.5})
    assert found["c"] == pytest.approx(100.0 * math.sqrt(1e-3))


def test_normal_force_is_no_exponent() -> None:
    """The parameter N has the unit N."""
    assert read_parameters(LAWS["friction"], {"mu": "30 %", "N": "330 kN", "k": "100 kN/mm"}) == {
        "mu": 0.3,
        "N": 330e3,
        "k": 100e6,
    }


def test_hertz_as_circular_frequency() -> None:
    given = {"k_eff": "8 kN/mm", "zeta_eff": 0.2}
    assert read_parameters(LAWS["linearised"], {**given, "omega": "2 Hz"})["omega"] == pytest.approx(4.0 * math.pi)
    assert read_parameters(LAWS["linearised"], {**given, "omega": "2 rad/s"})["omega"] == 2.0


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"k": "8 kN/mm", "c": 5.0}, "parameter `c`: .*E-UNIT-01"),
        ({"k": "8 kN/mm", "c": "5 kN"}, "parameter `c`: .*E-UNIT-02"),
        ({"k": "8 kN/mm", "d": "5 kN"}, r"parameter `d`: .*there are: k, c.*E-LAW-02"),
        ({"k": "8 kNmm/", "c": "1 kN*s/m"}, "parameter `k`: .*E-UNIT-02"),
        ({"k": "8,5 kN/mm", "c": "1 kN*s/m"}, "parameter `k`: .*E-VALUE-01"),
        ({"k": "8 kN/mm", "c": True}, "parameter `c`: .*E-VALUE-01"),
        ({"k": "8 kN/mm"}, "parameter `c`: .*E-LAW-02"),
        ({"k": "-8 kN/mm", "c": "1 kN*s/m"}, "parameter `k`: .*E-LAW-03"),
    ],
)
def test_bad_values(values: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        read_parameters(LAWS["kelvin_voigt"], values)


def test_all_problems_are_reported() -> None:
    with pytest.raises(ParameterError) as caught:
        read_parameters(LAWS["zener"], {"k0": 1.0, "k_1": "1 kN/mm", "c1": "1 m"})
    assert [name for name, _ in caught.value.problems] == ["k_1", "k0", "c1"]
    assert "did you mean `k1`" in str(caught.value)


def test_sets_by_name() -> None:
    with pytest.raises(InputError, match="did you mean `thesis_table_4_2`"):
        read_parameters(LAWS["mgmm"], "thesis_table_42")
    with pytest.raises(InputError, match="`thesis_table_4_2` .*zener.*E-LAW-01"):
        read_parameters(LAWS["zener"], "thesis_table_4_2")


def test_lists_are_of_branches() -> None:
    listed = read_parameters(
        LAWS["generalised_maxwell"], {"k0": "4 kN/mm", "k": ["6 kN/mm", "8 kN/mm"], "c": ["0.6 kN*s/mm", "150 kN*s/m"]}
    )
    assert listed == pytest.approx({"k0": 4e6, "k1": 6e6, "c1": 0.6e6, "k2": 8e6, "c2": 0.15e6})
    one = {"k0": "4 kN/mm", "k": "6 kN/mm", "c": "0.6 kN*s/mm"}
    assert read_parameters(LAWS["generalised_maxwell"], one)["k1"] == 6e6
    with pytest.raises(ParameterError, match="parameter `k`: .*there are 2 of `k`.*E-VALUE-04"):
        read_parameters(LAWS["generalised_maxwell"], one | {"k": ["6 kN/mm", "8 kN/mm"]})
    with pytest.raises(ParameterError, match="parameter `c`: `3 m` .*E-UNIT-02"):
        read_parameters(LAWS["generalised_maxwell"], one | {"c": "3 m"})


def test_a_parameter_of_a_kindred_law_names_that_law() -> None:
    with pytest.raises(InputError, match=r"there are: c\); the law `viscous_power` has them all"):
        read_parameters(LAWS["viscous"], {"c": "5 kN*s/m", "alpha": 0.3})
    with pytest.raises(InputError, match=r"there are: c\) \[E-LAW-02\]$"):
        read_parameters(LAWS["viscous"], {"c": "5 kN*s/m", "nothing": 0.3})
