"""Parameters at other temperatures."""

from __future__ import annotations

import math

import numpy as np
import pytest
from damper_examples import EXAMPLES
from pydantic import ValidationError

from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.temperature import FerryShift, GammaT, at
from edesign.damper.temperature_file import TemperatureLaw
from edesign.errors import InputError
from edesign.project.notation.temperature import parse_temperature

MGMM = LAWS["mgmm"]


def printed(p: dict[str, float], gamma: float, u: float, v: float, u_max: float, v_max: float) -> tuple[float, float]:
    """Left and right side factors of Eqs. 4.34-4.36 in the thesis' units (kN, mm, s), gamma_T once at k_mod,T."""
    k_mod = gamma * p["k_a"] * math.exp(-u_max / (gamma * p["u_ref"])) + gamma * p["k_b"]
    c_mod = gamma * p["c_a"] * math.exp(-v_max / (gamma * p["v_ref"])) + gamma * p["c_b"]
    tau = p["c1"] / p["k1"]
    right = (gamma * p["k0"] + k_mod) * u + (tau * p["k0"] * gamma + gamma * p["c1"] + c_mod) * v
    return tau, right + gamma * p["c_NL"] * abs(v) ** (p["alpha"] * gamma) * math.copysign(1.0, v)


def same_law_in_si(q: dict[str, float], u: float, v: float, u_max: float, v_max: float) -> tuple[float, float]:
    """Eqs. 4.24-4.29 in SI."""
    k_mod = q["k_a"] * math.exp(-u_max / q["u_ref"]) + q["k_b"]
    c_mod = q["c_a"] * math.exp(-v_max / q["v_ref"]) + q["c_b"]
    tau = q["c1"] / q["k1"]
    right = (q["k0"] + k_mod) * u + (tau * q["k0"] + q["c1"] + c_mod) * v
    return tau, right + q["c_NL"] * abs(v) ** q["alpha"] * math.copysign(1.0, v)


@pytest.mark.parametrize("temperature", [20.0, 27.0, 35.0])
def test_equations_4_34_to_4_36_term_by_term(temperature: float) -> None:
    """In kN, mm and s as printed, against the turned parameters in SI: the number c_NL keeps its mm/s."""
    table = {
        "k1": 0.515, "c1": 0.0151, "k0": 0.107, "c_NL": 1.585, "alpha": 0.374, "k_a": 3.741, "k_b": 3.613,
        "u_ref": 7.966, "c_a": 0.902, "c_b": 0.190, "v_ref": 13.468,
    }  # fmt: skip
    gamma = float(np.interp(temperature, [20.0, 25.0, 30.0, 35.0], [1.0, 0.935, 0.875, 0.82]))
    shifted, _ = at(MGMM, EXAMPLES["mgmm"], temperature, GammaT())
    for u, v in ((3.0, 0.4), (-2.0, 55.0), (1.0, -7.0)):
        tau, right = printed(table, gamma, u, v, 5.0, 60.0)
        tau_si, right_si = same_law_in_si(shifted, u * 1e-3, v * 1e-3, 5e-3, 60e-3)
        assert tau_si == pytest.approx(tau, rel=1e-12)
        assert right_si == pytest.approx(1e3 * right, rel=1e-12)


def test_letter_of_equation_4_34() -> None:
    """gamma_T before the bracket with k_mod,T: gamma_T squared at k_a and k_b, and nowhere else."""
    once, _ = at(MGMM, EXAMPLES["mgmm"], 30.0, GammaT())
    twice, _ = at(MGMM, EXAMPLES["mgmm"], 30.0, GammaT(of="by_the_letter"))
    changed = {name: twice[name] / once[name] for name in once if twice[name] != once[name]}
    assert changed == pytest.approx({"k_a": 0.875, "k_b": 0.875})


def test_gamma_of_the_force_is_a_factor_of_it() -> None:
    t = np.linspace(0.0, 3.0, 301)
    u = 6e-3 * t / 3.0 * np.sin(2.0 * np.pi * t)
    warm, _ = at(MGMM, EXAMPLES["mgmm"], 30.0, GammaT(of="force"))
    cold, hot = (Damper(MGMM, values).force(t, u) for values in (EXAMPLES["mgmm"], warm))
    np.testing.assert_allclose(hot, 0.875 * cold, rtol=1e-12, atol=1e-9)
    # alpha and the references as printed make another force: of c_NL |v|^alpha, a fifth of it here, some per cent
    as_printed, _ = at(MGMM, EXAMPLES["mgmm"], 30.0, GammaT())
    other = Damper(MGMM, as_printed).force(t, u)
    assert 0.01 < np.linalg.norm(other - hot) / np.linalg.norm(hot) < 0.1


def test_gamma_between_and_beyond_the_table() -> None:
    model = GammaT()
    assert [model.gamma(T) for T in (20.0, 25.0, 30.0, 35.0)] == [1.0, 0.935, 0.875, 0.82]
    assert model.gamma(22.5) == pytest.approx(0.9675)
    assert model.gamma(10.0) == pytest.approx(1.13)  # 0.013 a degree below
    assert model.gamma(40.0) == pytest.approx(0.765)  # 0.011 a degree above
    assert at(MGMM, EXAMPLES["mgmm"], 35.0, model)[1] == ()
    (warning,) = at(MGMM, EXAMPLES["mgmm"], 40.0, model)[1]
    assert "0.765" in warning and "from 20 to 35 degC" in warning
    with pytest.raises(InputError, match="greater than 0"):
        model.gamma(120.0)


def test_reference_changes_nothing_and_says_nothing() -> None:
    for name, values in EXAMPLES.items():
        assert at(LAWS[name], values, 20.0) == (LAWS[name].complete(values), ())
    assert at(MGMM, EXAMPLES["mgmm"], 20.0, GammaT()) == (EXAMPLES["mgmm"], ())


def test_laws_without_a_temperature_law_warn() -> None:
    for name in LAWS:
        found, (warning,) = at(LAWS[name], EXAMPLES[name], 30.0)
        assert ("published factor gamma_T" in warning) == (name == "mgmm")
        assert (found == LAWS[name].complete(EXAMPLES[name])) == (name != "mgmm")


MODULI = {
    "kelvin_voigt": lambda p, s: p["k"] + p["c"] * s,
    "viscous": lambda p, s: p["c"] * s,
    "zener": lambda p, s: p["k0"] + p["c1"] * s / (1.0 + p["c1"] / p["k1"] * s),
    "generalised_maxwell": lambda p, s: (
        p["k0"] + sum(p[f"c{i}"] * s / (1.0 + p[f"c{i}"] / p[f"k{i}"] * s) for i in (1, 2))
    ),
    "maxwell": lambda p, s: p["c0"] * s / (1.0 + p["lambda"] * s),
    "fractional_kelvin": lambda p, s: p["k0"] * (1.0 + p["c"] * s ** p["alpha"]),
    "fractional_zener": lambda p, s: p["k0"] * (1.0 + p["b"] * s ** p["alpha"]) / (1.0 + p["a"] * s ** p["alpha"]),
    "fractional_maxwell": lambda p, s: p["c0"] * s / (1.0 + p["lambda"] * s ** p["nu"]),
}
"""Complex stiffness of each law at s = i omega, from its equation."""


@pytest.mark.parametrize("name", MODULI)
@pytest.mark.parametrize("temperature", [5.0, 35.0])
def test_ferry_shifts_the_frequency(name: str, temperature: float) -> None:
    """A law at T at a frequency f is the law at the reference at a_T f, exactly, for every linear law."""
    model = FerryShift(p1=5.0, p2=60.0)
    warmer = temperature - 20.0
    a_t = math.exp(-5.0 * warmer / (60.0 + warmer))
    shifted, warnings = at(LAWS[name], EXAMPLES[name], temperature, model)
    assert warnings == () and (a_t < 1.0) == (temperature > 20.0)
    for f in (0.1, 1.0, 5.0):
        s = 2j * math.pi * f
        assert MODULI[name](shifted, s) == pytest.approx(MODULI[name](EXAMPLES[name], a_t * s), rel=1e-12)


def test_every_law_that_is_shifted_is_tested() -> None:
    assert set(FerryShift(1.0, 1.0).laws) == set(MODULI)


def test_refusals() -> None:
    with pytest.raises(InputError, match="-30 degC.*E-LAW-04"):
        at(LAWS["zener"], EXAMPLES["zener"], -30.0, FerryShift(5.0, 50.0))
    with pytest.raises(InputError, match="friction .*mgmm.*E-LAW-05"):
        at(LAWS["friction"], EXAMPLES["friction"], 30.0, GammaT())
    with pytest.raises(InputError, match="nan degC .*E-LAW-04"):
        at(LAWS["zener"], EXAMPLES["zener"], math.nan)
    with pytest.raises(InputError, match="ascending.*E-LAW-05"):
        GammaT(((25.0, 0.9), (20.0, 1.0)))
    with pytest.raises(InputError, match="gamma_T must be 1 .*E-LAW-05"):
        GammaT(((20.0, 0.9), (25.0, 0.8)))


def test_yaml_forms() -> None:
    gamma = TemperatureLaw.model_validate({"gamma_T": {"25 degC": 0.9, "293.15 K": 1.0}}).model()
    assert gamma == GammaT(((20.0, 1.0), (25.0, 0.9)))
    force = TemperatureLaw.model_validate({"gamma_T": {"20 degC": 1.0, "25 degC": 0.9}, "of": "force"}).model()
    assert force == GammaT(((20.0, 1.0), (25.0, 0.9)), "force")
    ferry = TemperatureLaw.model_validate({"ferry": {"p1": 5.0, "p2": "60 K", "reference": "20 °C"}}).model()
    assert ferry == FerryShift(5.0, 60.0, 20.0)


@pytest.mark.parametrize(
    ("block", "message"),
    [
        ({}, "`gamma_T` and `ferry` .*E-LAW-05"),
        ({"gamma_T": {"20 degC": 1.0}, "ferry": {"p1": 1.0, "p2": "5 K", "reference": "20 degC"}}, "ferry.*E-LAW-05"),
        ({"gamma_T": {"20": 1.0}}, "`20` .*E-VALUE-01"),
        ({"gamma_T": {"20 degC": 0.9, "25 degC": 0.8}}, "must be 1 .*E-LAW-05"),
        ({"gamma_T": {"20 degC": 1.0, "25 degC": -0.8}}, r"`-0\.8` .*E-VALUE-02"),
        ({"ferry": {"p1": 1.0, "p2": 5.0, "reference": "20 degC"}}, "`50 K`.*E-LAW-05"),
        ({"ferry": {"p1": 1.0, "p2": "5 K", "reference": "20 degC"}, "of": "force"}, "`of` .*`ferry` .*E-LAW-05"),
        ({"gamma_T": {"20 degC": 1.0, "25 degC": 0.9}, "of": "forces"}, "by_the_letter"),
    ],
)  # fmt: skip
def test_bad_yaml(block: dict[str, object], message: str) -> None:
    with pytest.raises(ValidationError, match=message):
        TemperatureLaw.model_validate(block)


def test_temperatures() -> None:
    assert parse_temperature("-5 degC") == -5.0
    assert parse_temperature("293.15 K") == 20.0
    for bad in (20, "20", "20 degF", "-300 degC", None):
        with pytest.raises(Exception, match="no temperature|absolute zero"):
            parse_temperature(bad)
