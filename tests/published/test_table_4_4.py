"""Thesis Table 4.4: gamma_T from sweeps at four temperatures, made by Table 4.2, Eqs. 4.34-4.36 and noise."""

from __future__ import annotations

import pytest
from damper_examples import EXAMPLES
from fit_campaign import measured

from edesign.damper.fitting import fit_forces
from edesign.damper.laws import LAWS
from edesign.damper.temperature import FerryShift, GammaT, at

TABLE_4_4 = {20.0: 1.0, 25.0: 0.935, 30.0: 0.875, 35.0: 0.820}  # typed from the thesis
MGMM = LAWS["mgmm"]


def test_gamma_t_is_recovered() -> None:
    truth, tests = EXAMPLES["mgmm"], []
    for seed, temperature in enumerate(TABLE_4_4):
        values, _ = at(MGMM, truth, temperature, GammaT(tuple(TABLE_4_4.items())))
        tests += measured("mgmm", values, 0.01, seed, temperature)
    fit = fit_forces(MGMM, tests, truth, starts=1, temperature="gamma")
    for temperature, gamma in TABLE_4_4.items():
        if temperature != 20.0:
            name = f"gamma_{temperature:g}"
            error = fit.standard_error_white[name]
            assert error < 0.003  # the table has three digits
            assert abs(fit.thermal_values[name] - gamma) < 3.0 * error
    assert fit.thermal.reference_C == 20.0
    assert fit.values_at(35.0)["k_a"] == pytest.approx(fit.thermal_values["gamma_35"] * fit.values["k_a"], rel=1e-12)


def test_one_set_of_parameters_for_all_temperatures_is_worse_and_said() -> None:
    truth, tests = EXAMPLES["mgmm"], []
    for temperature in (20.0, 35.0):
        values, _ = at(MGMM, truth, temperature, GammaT())
        tests += measured("mgmm", values, 0.01, 3, temperature, ["sweep 1.57 Hz"])
    one = fit_forces(MGMM, tests, truth, starts=1)
    two = fit_forces(MGMM, tests, truth, starts=1, temperature="gamma")
    assert one.cost > 5.0 * two.cost  # 18 % of force against 2 % of noise
    assert any("one set of parameters" in warning for warning in one.warnings)


def test_ferrys_shift_is_recovered() -> None:
    """Eq. 4.33 on a linear law; p1 and p2 are from the data that they made."""
    law, truth, shift, tests = LAWS["zener"], EXAMPLES["zener"], FerryShift(6.0, 80.0), []
    for seed, temperature in enumerate((5.0, 20.0, 35.0)):
        tests += measured("zener", at(law, truth, temperature, shift)[0], 0.01, seed, temperature)
    fit = fit_forces(law, tests, starts=2, temperature="ferry")
    for name, value in (("p1", 6.0), ("p2", 80.0)):
        assert abs(fit.thermal_values[name] - value) < 3.0 * fit.standard_error_white[name]
    assert shift.factor(35.0) == pytest.approx(0.388, abs=0.001)  # exp(-6 15/95): the effect is there to be found
