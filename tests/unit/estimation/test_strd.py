"""The estimator on NIST's reference datasets of nonlinear regression: certified values and standard deviations."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import yaml
from estimation_models import FormulaModel

from edesign.estimation.least_squares import Fit, Settings, fit
from edesign.estimation.noise import Noise
from edesign.estimation.parameters import Parameter
from edesign.estimation.uncertainty import uncertainty

SETS = yaml.safe_load(Path(__file__).with_name("strd.yaml").read_text(encoding="utf-8"))
MODELS: dict[str, Callable[..., np.ndarray]] = {
    "Misra1a": lambda x, a, b: a * (1.0 - np.exp(-b * x)),
    "Misra1b": lambda x, a, b: a * (1.0 - (1.0 + b * x / 2.0) ** -2.0),
    "Misra1c": lambda x, a, b: a * (1.0 - (1.0 + 2.0 * b * x) ** -0.5),
    "Misra1d": lambda x, a, b: a * b * x / (1.0 + b * x),
    "DanWood": lambda x, a, b: a * x**b,
    "Lanczos3": lambda x, a, b, c, d, e, f: a * np.exp(-b * x) + c * np.exp(-d * x) + e * np.exp(-f * x),
    "MGH17": lambda x, a, b, c, d, e: a + b * np.exp(-x * d) + c * np.exp(-x * e),
    "MGH09": lambda x, a, b, c, d: a * (x**2 + x * b) / (x**2 + x * c + d),
    "MGH10": lambda x, a, b, c: a * np.exp(b / (x + c)),
    "Thurber": lambda x, a, b, c, d, e, f, g: (a + b * x + c * x**2 + d * x**3) / (1.0 + e * x + f * x**2 + g * x**3),
    "BoxBOD": lambda x, a, b: a * (1.0 - np.exp(-b * x)),
    "Rat42": lambda x, a, b, c: a / (1.0 + np.exp(b - c * x)),
    "Rat43": lambda x, a, b, c, d: a / (1.0 + np.exp(b - c * x)) ** (1.0 / d),
    "Eckerle4": lambda x, a, b, c: a / b * np.exp(-0.5 * ((x - c) / b) ** 2),
}
ELSEWHERE = {("MGH17", 0), ("MGH10", 0), ("BoxBOD", 0)}
"""Starts from which the path goes to a plateau, where exponentials are 0 or 1 at every point: several starts help."""


def least_squares(name: str, start: list[float]) -> tuple[FormulaModel, Fit]:
    """Search with noise as large as the data, then twice with that which is left: the last differences fit it."""
    x, y = np.array(SETS[name]["x"]), np.array(SETS[name]["y"])
    parameters = tuple(
        Parameter(f"b{i}", "", -np.inf, np.inf, 0.0, abs(value), flat=True) for i, value in enumerate(start, 1)
    )
    model = FormulaModel(parameters, (y,), lambda values: [MODELS[name](x, *values)])
    noise, found, relative = Noise.white([np.sqrt(np.mean(y**2))]), np.sign(start), 1e-4
    with np.errstate(all="ignore"):
        for central in (False, True, True):
            settings = Settings(central=central, steps=300, enough=0.0, relative=relative)
            fitted = fit(model, noise, found, settings=settings)
            noise, found, relative = Noise.white([np.sqrt(np.mean(fitted.left[0] ** 2))]), fitted.z, 1e-12
    return model, fitted


@pytest.mark.parametrize(("name", "start"), [(n, i) for n in SETS for i in (0, 1) if (n, i) not in ELSEWHERE])
def test_certified_values_are_found_from_both_starts(name: str, start: int) -> None:
    """Central differences of one standard error are wrong by its square: values to 1e-3 standard deviations."""
    model, fitted = least_squares(name, SETS[name]["starts"][start])
    certified, deviations = np.array(SETS[name]["certified"]), np.array(SETS[name]["deviations"])
    assert fitted.converged
    assert np.max(np.abs(fitted.values - certified) / deviations) < 1e-3
    assert fitted.left[0] @ fitted.left[0] == pytest.approx(SETS[name]["sum_of_squares"], rel=1e-6)


@pytest.mark.parametrize("name", SETS)
def test_certified_standard_deviations_are_found(name: str) -> None:
    """NIST's are sqrt(RSS / (n - p)) (J'J)^-1/2. Slopes over one standard error: 1 % of them."""
    model, fitted = least_squares(name, SETS[name]["starts"][1])
    within = uncertainty(fitted).within
    errors = [np.sqrt(within[i, i]) * one.spread for i, one in enumerate(model.parameters)]
    assert errors == pytest.approx(SETS[name]["deviations"], rel=1e-2)
    assert uncertainty(fitted).freedom == pytest.approx(len(SETS[name]["x"]) - len(errors), rel=1e-9)
