"""Curves of effects in the report of a calibration, against their equations; every one has what it asks for."""

from __future__ import annotations

import numpy as np
import pytest
from kelvin_voigt_campaign import campaign

from edesign.calibration.dampers.effect import EffectForm
from edesign.calibration.dampers.effects import TABLES
from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.dampers.sizes import Sizes
from edesign.report.calibration.effect_figures import _SHAPES

FORMS: dict[tuple[str, str], EffectForm] = {(one.name, one.form): one for table in TABLES for one in table.FORMS}


@pytest.fixture(scope="module")
def sizes(tmp_path_factory: pytest.TempPathFactory) -> Sizes:
    return damper_problem(campaign(tmp_path_factory.mktemp("c"), tests=4)).typical


@pytest.mark.parametrize("name", _SHAPES, ids=".".join)
def test_an_effect_has_the_parameters_of_its_curve(name: tuple[str, str], sizes: Sizes) -> None:
    form = FORMS[name]
    values = form.of(sizes).values(form.starts(sizes)[0])
    assert np.all(np.isfinite(_SHAPES[name].of(values, np.linspace(0.0, sizes.displacement, 9))))


@pytest.mark.parametrize(
    ("name", "values", "driver", "expected"),
    [
        # exp(-b (T - 20)): parameters hold at 20 degC, as the laws' do
        (("temperature_law", "exponential"), {"b": 0.02}, [20.0, 30.0, 10.0], [1.0, 0.8187308, 1.2214028]),
        # exp(-b w/(1 + c w)) with w = 10 K: exp(-0.2/1.5)
        (("temperature_law", "wlf"), {"b": 0.02, "c": 0.05}, [20.0, 30.0], [1.0, 0.8751733]),
        # F_V (v/V)^alpha: half the velocity has the root of a half of the force
        (
            *(("velocity_exponent", "dashpot"), {"F_V": 4e3, "alpha": 0.5, "V": 0.1}),
            *([0.1, 0.05, 0.0, -0.1], [4e3, 2828.4271, 0.0, -4e3]),
        ),
        # beyond 1 mm to the negative side alone
        (
            *(("one_sided", "spring_negative"), {"k": 1e6, "u0": 1e-3, "side": -1.0}),
            *([-3e-3, -1e-3, 3e-3], [-2e3, 0.0, 0.0]),
        ),
        (("one_sided", "factor_positive"), {"b": 0.1, "side": 1.0}, [-1e-3, 1e-3], [1.0, 1.1]),
    ],
    ids=lambda value: ".".join(value) if isinstance(value, tuple) else "",
)
def test_curves_follow_their_equations(
    name: tuple[str, str], values: dict[str, float], driver: list[float], expected: list[float]
) -> None:
    # worked by hand to seven digits
    assert _SHAPES[name].of(values, np.array(driver)) == pytest.approx(expected, rel=1e-6, abs=1e-9)
