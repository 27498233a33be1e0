"""Smooth functions of displacement and velocity in a residual: known ones, noise, and forces that are none."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from residual_examples import Example, Extra, campaign, examples

from edesign.calibration.residual.curves import FreeCurve, free_curves
from edesign.calibration.residual.series import Residual
from edesign.calibration.residual.shape import describe_residual
from edesign.report.calibration.residual_figures import curve_figures

PERIOD = 8e-3  # m
VALIDATION = (1, 5)  # a sine, and a random motion


def split(extra: Extra = lambda example: 0.0, seed: int = 3) -> list[Residual]:
    tests = campaign(extra, seed=seed)
    return [replace(test, use="validate" if test.order in VALIDATION else "fit") for test in tests]


def curves(tests: list[Residual]) -> dict[str, FreeCurve]:
    return {one.of: one for one in free_curves(tests)}


def known_share(extra: Extra, tests: list[Residual]) -> float:
    """Share of the known force in the squared residual of the validation tests."""
    of = [(e, t) for e, t in zip(examples(), tests, strict=True) if t.use == "validate"]
    part = sum(float(np.sum((extra(e) + 0.0 * e.time) ** 2)) / t.rms_force**2 for e, t in of)
    return part / sum(float(t.residual @ t.residual) / t.rms_force**2 for _, t in of)


def periodic(e: Example) -> np.ndarray:
    return 2e3 * np.sin(2.0 * np.pi * e.displacement / PERIOD)


def power(e: Example) -> np.ndarray:
    return 5e3 * np.sign(e.velocity) * np.abs(e.velocity) ** 0.3


def product(e: Example) -> np.ndarray:
    return 1e7 * e.velocity * e.displacement


def slip(reach: float) -> Extra:
    """A spring with a slider, in closed form from step to step: z follows u and stays within its reach."""

    def force(e: Example) -> np.ndarray:
        z = np.zeros_like(e.time)
        for i, step in enumerate(np.diff(e.displacement), 1):
            z[i] = min(max(z[i - 1] + step, -reach), reach)
        return 1e6 * z

    return force


@pytest.mark.parametrize(("of", "extra"), [("displacement", periodic), ("velocity", power)])
def test_a_known_curve_is_found_within_its_band(of: str, extra: Extra) -> None:
    tests = split(extra)
    found = curves(tests)[of]
    assert found.share == pytest.approx(known_share(extra, tests), abs=0.01)
    (curve,) = found.curves
    low, high = curve.band
    inside = slice(1, -1)
    at = Example(0, 1.0, (1.0,))
    at.displacement = at.velocity = curve.at
    true = extra(at)
    assert np.mean(((low <= true) & (true <= high))[inside]) > 0.85  # of 95 %: neighbours go together
    assert np.median(high - low) < 0.1 * np.ptp(true)


def test_sums_and_products_are_told_from_curves_alone() -> None:
    both = curves(split(lambda e: periodic(e) + power(e)))
    assert both["sum"].share > 0.9 > max(both["displacement"].share, both["velocity"].share)
    tests = split(product)
    found = curves(tests)
    assert found["product"].share == pytest.approx(known_share(product, tests), abs=0.02)
    assert max(found[of].share for of in ("displacement", "velocity", "sum")) < 0.05


@pytest.mark.parametrize("seed", [0, 1, 2, 3])
def test_chance_takes_nothing(seed: int) -> None:
    assert all(one.share < 0.005 for one in free_curves(split(seed=seed)))


@pytest.mark.parametrize("reach", [1e-3, 3e-3])
def test_a_hysteretic_residual_is_no_sum_of_curves(reach: float) -> None:
    """No sum of functions takes more of the validation tests than one that is fitted to them: means of 40 x 40 bins."""
    tests = split(slip(reach))
    found = curves(tests)
    judged = [t for t in tests if t.use == "validate"]
    u, v = (np.concatenate([getattr(t, name) for t in judged]) for name in ("displacement", "velocity"))
    y = np.concatenate([t.residual / t.rms_force for t in judged])
    rest = y
    columns = [np.searchsorted(np.quantile(x, np.linspace(0.0, 1.0, 41)[1:-1]), x) for x in (u, v)]
    for _ in range(50):  # back-fitting
        for one in columns:
            rest = rest - (np.bincount(one, rest) / np.maximum(np.bincount(one), 1))[one]
    most = 1.0 - float(rest @ rest) / float(y @ y)
    assert found["sum"].share < most + 0.02 < 0.9


def test_words_name_the_curve_and_need_validation_tests() -> None:
    tests = split(periodic)
    words = describe_residual(tests, curves=free_curves(tests))
    assert "a smooth function of the displacement alone" in words and "(95 % of the validation tests)" in words
    assert free_curves(campaign(periodic)) == ()
    assert free_curves([]) == ()


def test_the_figure_has_both_curves_alone_and_those_of_a_sum() -> None:
    found = free_curves(split(lambda e: periodic(e) + power(e)))
    ((name, caption, figure),) = curve_figures(SimpleNamespace(calibration=SimpleNamespace(unexplained_curves=found)))
    titles = [axis.get_title(loc="left") for axis in figure.axes]
    assert (name, len(titles)) == ("curves", 4) and titles[2].startswith("sum, displacement: takes 9")
    assert "95 % band" in caption
    nothing = free_curves(split())
    assert not list(curve_figures(SimpleNamespace(calibration=SimpleNamespace(unexplained_curves=nothing))))
