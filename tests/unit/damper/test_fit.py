"""Fits of laws in closed form: least squares, standard errors, bounds, warnings, bad input."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from fit_campaign import measured, motions

from edesign.damper.damper import Damper
from edesign.damper.fitting import cross_validate, fit_forces
from edesign.damper.fitting.compare import compare_laws
from edesign.damper.fitting.loading import Loading
from edesign.damper.fitting.write import practical_errors
from edesign.damper.history import spline_velocity
from edesign.damper.laws import LAWS
from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.nrms import determination, error_of_peak, nrms
from edesign.errors import InputError
from edesign.report.damper.fit_tables import comparison_table

KELVIN, POWER = LAWS["kelvin_voigt"], LAWS["viscous_power"]
K, C = 8e6, 0.4e6


def kelvin_voigt(values: Mapping[str, float], loading: Loading) -> np.ndarray:
    return values["k"] * loading.displacement + values["c"] * loading.velocity


def power(values: Mapping[str, float], loading: Loading) -> np.ndarray:
    return values["c"] * np.abs(loading.velocity) ** values["alpha"] * np.sign(loading.velocity)


def histories_with(noise: float = 0.01, seed: int = 1, k: float = K, c: float = C) -> list[DamperTest]:
    generator, found = np.random.default_rng(seed), []
    for name, (time, u) in motions().items():
        force = k * u + c * spline_velocity(time, u)
        force = force + noise * np.max(np.abs(force)) * generator.standard_normal(force.size)
        found.append(DamperTest(name, time, u, force))
    return found


def test_errors_are_shares_of_what_was_measured() -> None:
    """By hand; Eq. 4.28 of the thesis would be 1/5, and infinite of no force."""
    assert nrms([1.0, 2.0], [1.0, 1.0]) == pytest.approx(1.0 / 2.0, rel=1e-15)  # without a root
    assert nrms([0.0, 0.0], [3.0, -4.0]) == 1.0
    assert nrms([0.0, 0.0], [0.0, 0.0]) == 0.0
    assert nrms([1.0, 0.0], [0.0, 0.0]) == np.inf
    assert error_of_peak([1.0, 2.0], [3.0, -4.0]) == pytest.approx(np.sqrt(20.0) / 4.0, rel=1e-15)
    assert determination([1.0, 2.0, 4.0], [1.0, 2.0, 3.0]) == pytest.approx(1.0 - 1.0 / 2.0, rel=1e-15)
    assert determination([1.0, 1.0], [1.0, 1.0]) == 1.0
    with pytest.raises(InputError, match="2 and 3 .*E-SIGNAL-01"):
        nrms([1.0, 2.0], [1.0, 2.0, 3.0])


def test_a_linear_law_gives_the_normal_equations() -> None:
    """F = k u + c v by least squares weighted with 1 / (rms^2 n) of each test; white-noise errors in closed form."""
    tests = histories_with()
    rows, force, noise = [], [], []
    for test in tests:
        f = test.measured_force()
        weight = 1.0 / np.sqrt(np.mean(f**2) * f.size)
        rows.append(weight * np.column_stack((test.displacement, spline_velocity(test.time, test.displacement))))
        force.append(weight * f)
    matrix = np.vstack(rows)
    expected = np.linalg.lstsq(matrix / [1e-3, 1e-3], np.concatenate(force), rcond=None)[0] * 1e3
    fit = fit_forces(KELVIN, tests, predict=kelvin_voigt)
    assert [fit.values["k"], fit.values["c"]] == pytest.approx(expected.tolist(), rel=1e-7)
    inverse, samples, meat = np.linalg.inv(matrix.T @ matrix), len(matrix), np.zeros((2, 2))
    for row, f in zip(rows, force, strict=True):
        noise.append(np.mean((f - row @ expected) ** 2) * samples / (samples - 2))
        meat += noise[-1] * row.T @ row
    errors = np.sqrt(np.diag(inverse @ meat @ inverse))
    assert [fit.standard_error_white["k"], fit.standard_error_white["c"]] == pytest.approx(errors.tolist(), rel=1e-5)
    assert fit.same_minimum == len(fit.starts) == 6
    assert fit.at_bound == {} and fit.warnings == ()


def test_a_power_law_is_recovered_by_a_callable() -> None:
    found = []
    for name, (time, u) in motions().items():
        v = spline_velocity(time, u)
        found.append(DamperTest(name, time, u, 300e3 * np.abs(v) ** 0.35 * np.sign(v)))
    fit = fit_forces(POWER, found, predict=power)
    assert fit.values["c"] == pytest.approx(300e3, rel=1e-6)
    assert fit.values["alpha"] == pytest.approx(0.35, rel=1e-6)
    assert fit.nrms_overall < 1e-12


def test_robust_errors_cover_correlated_noise_and_white_ones_do_not() -> None:
    """AR(1) noise of correlation 0.95 a sample: over many seeds the spread of the estimate is the standard error.

    60 seeds give a standard deviation to 1 / sqrt(120) = 9 %; three of these, and 10 % for blocks of finite length.
    """
    spread, robust, white = [], [], []
    base = histories_with(0.0)
    for seed in range(60):
        generator, tests = np.random.default_rng(100 + seed), []
        for test in base:
            shocks, noise = generator.standard_normal(test.time.size), np.zeros(test.time.size)
            for i in range(1, noise.size):
                noise[i] = 0.95 * noise[i - 1] + shocks[i]
            tests.append(replace(test, force=test.measured_force() + 500.0 * noise))
        fit = fit_forces(KELVIN, tests, {"k": K, "c": C}, predict=kelvin_voigt, starts=1)
        assert fit.error_kind == "robust"
        spread.append(fit.values["k"])
        robust.append(fit.standard_error_robust["k"])
        white.append(fit.standard_error_white["k"])
    true = float(np.std(spread, ddof=1))
    assert np.sqrt(np.mean(np.square(robust))) == pytest.approx(true, rel=0.37)
    assert np.mean(white) < 0.5 * true  # independent errors are assumed wrongly: far too sure


def test_a_parameter_reaches_its_bound_and_says_so() -> None:
    """Forces of a negative damping: the best allowed one is zero, exactly."""
    fit = fit_forces(KELVIN, histories_with(c=-0.05 * C), predict=kelvin_voigt)
    assert fit.values["c"] == 0.0
    assert fit.at_bound == {"c": 0.0}
    assert fit.free == ("k",)
    assert "c ended at its bound 0" in fit.warnings


def test_the_users_bound_holds_and_is_named() -> None:
    fit = fit_forces(KELVIN, histories_with(), bounds={"k": (1e6, 7e6)}, predict=kelvin_voigt)
    assert fit.values["k"] == pytest.approx(7e6, rel=1e-12)
    assert fit.at_bound == {"k": pytest.approx(7e6)}


def test_fixed_parameters_stay() -> None:
    fit = fit_forces(KELVIN, histories_with(), fixed={"k": 7.5e6}, predict=kelvin_voigt)
    assert fit.values["k"] == 7.5e6
    assert fit.free == ("c",)
    assert fit.fixed == {"k": "fixed by the user"}


def test_what_cannot_be_separated_is_named() -> None:
    """Friction: with N free beside mu only the product is determined."""
    tests = measured("friction", {"mu": 0.3, "N": 330e3, "k": 100e6})
    fit = fit_forces(LAWS["friction"], tests, fit_also=["N"], starts=1)
    assert any(warning.startswith("mu and N: the data determine only combinations") for warning in fit.warnings)
    assert fit.values["mu"] * fit.values["N"] == pytest.approx(99e3, rel=0.01)
    assert fit.standard_error["mu"] > 10.0 * fit.values["mu"]


def test_robust_losses_set_outliers_aside() -> None:
    tests = histories_with()
    force = tests[0].measured_force().copy()
    force[::20] += 5.0 * np.max(force)  # spikes
    spoiled = [replace(tests[0], force=force), *tests[1:]]
    errors = {}
    for loss in ("linear", "soft_l1", "huber", "cauchy"):
        fit = fit_forces(KELVIN, spoiled, predict=kelvin_voigt, loss=loss)
        errors[loss] = abs(fit.values["k"] / K - 1.0)
    assert max(errors["soft_l1"], errors["huber"], errors["cauchy"]) < 0.2 * errors["linear"]


def test_weights_and_threads() -> None:
    """A weight of w counts as w copies of the test; threads change nothing."""
    tests = histories_with(0.05)
    copies = [*tests, replace(tests[1], name="again"), replace(tests[1], name="and again")]
    weighted = fit_forces(KELVIN, tests, weights={tests[1].name: 3.0}, predict=kelvin_voigt)
    copied = fit_forces(KELVIN, copies, predict=kelvin_voigt)
    assert weighted.values["k"] == pytest.approx(copied.values["k"], rel=1e-6)
    one, two = (fit_forces(LAWS["zener"], tests, workers=workers) for workers in (1, 2))
    assert one.values == two.values and one.standard_error == two.standard_error and one.starts == two.starts


def test_cross_validation_leaves_out_what_it_predicts() -> None:
    """The held-out error of a test is that of a fit to the others."""
    tests = histories_with(0.05)
    found = cross_validate(KELVIN, tests, predict=kelvin_voigt)
    assert list(found.nrms) == [test.name for test in tests] and found.folds == len(tests)
    others = fit_forces(KELVIN, tests[1:], predict=kelvin_voigt)
    force = others.values["k"] * tests[0].displacement
    force = force + others.values["c"] * spline_velocity(tests[0].time, tests[0].displacement)
    assert found.nrms[tests[0].name] == pytest.approx(nrms(force, tests[0].measured_force()), rel=1e-6)
    assert found.worst[1] == max(found.nrms.values())
    assert cross_validate(KELVIN, tests, predict=kelvin_voigt, folds=2).folds == 2


def test_the_law_that_made_the_data_suffices() -> None:
    tests = measured("zener", {"k0": 5e6, "k1": 8e6, "c1": 0.8e6})
    laws = [LAWS[name] for name in ("kelvin_voigt", "zener", "fractional_zener")]
    found = compare_laws(laws, tests, starts=2)
    assert found.sufficient.fit.law.name == "zener"
    assert found.laws[0].bic > 100.0 and found.laws[1].bic == 0.0
    samples = sum(test.time.size for test in tests)
    assert 0.8 * samples < found.independent <= samples  # the noise is white
    zener = found.laws[1].fit
    assert zener.follows and not [warning for warning in zener.warnings if "does not follow" in warning]
    assert list(zener.determination.values()) == pytest.approx(
        [1.0 - zener.nrms[test.name] for test in tests], abs=1e-3
    )
    for test in tests:
        measured_force = test.measured_force()
        share = np.sqrt(np.mean(measured_force**2)) / np.max(np.abs(measured_force))
        assert zener.peak_error[test.name] == pytest.approx(zener.rms_error[test.name] * share, rel=1e-6)


@pytest.mark.parametrize("held_out", [False, True])
def test_no_law_suffices_that_does_not_follow_the_tests(held_out: bool) -> None:
    """A dashpot, and one beside a spring, fitted to friction."""
    tests = measured("friction", {"mu": 0.3, "N": 330e3, "k": 100e6})
    found = compare_laws([LAWS["viscous"], LAWS["kelvin_voigt"]], tests, held_out=held_out, starts=1)
    assert found.sufficient is None
    assert found.nearest.fit.law.name in ("viscous", "kelvin_voigt")
    assert all(item.fit.nrms_overall <= 1.0 for item in found.laws)  # no force at all would have 1
    assert any("does not follow the tests" in warning for warning in found.nearest.fit.warnings)
    text = comparison_table(found).notes[0]
    assert "none of the laws compared follows the tests" in text and "suffices" not in text


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"tests": []}, "`use: fit`.*E-FIT-01"),
        ({"force": None}, "E-TEST-06"),
        ({"force": "constant"}, "throughout"),
        ({"start": {"q": 1.0}}, "start: .*`q`.*E-FIT-04"),
        ({"start": {"k": -1.0}}, "start of `k`: -1 N/m .*E-FIT-03"),
        (
            {"start": {"k": 9e6}, "bounds": {"k": (1e6, 2e6)}},
            "start of `k`: 9e[+]06 N/m .* 1e[+]06 to 2e[+]06.*E-FIT-03",
        ),
        ({"bounds": {"k": (2e6, 1e6)}}, "bounds of `k`: 2e[+]06 to 1e[+]06 .*E-FIT-03"),
        ({"bounds": {"k": (-2e6, 1e6)}}, "bounds of `k`: -2e[+]06 to 1e[+]06 .*E-FIT-03"),
        ({"fixed": ["k"], "bounds": {"k": (1e6, 2e6)}}, "bounds of `k`: .*fitted are: c.*E-FIT-03"),
        ({"fixed": ["k", "c"]}, "kelvin_voigt.*E-FIT-04"),
        ({"fixed": ["kk"]}, "fixed: law kelvin_voigt has no parameter `kk`; did you mean `k`"),
        ({"loss": "square"}, "loss: `square`.*E-FIT-04"),
        ({"starts": 0}, "starts: 0.*E-FIT-04"),
        ({"weights": {"nobody": 1.0}}, "weights: .*`nobody`.*E-FIT-04"),
        ({"weights": {"random": 0.0}}, "weights: random .*E-FIT-04"),
        ({"temperature": "gamma"}, "temperature: .*20 degC.*E-FIT-05"),
        ({"twice": True}, "E-NAME-02"),
        ({"short": True}, "test s: 5 samples.*E-FIT-01"),
    ],
)
def test_bad_input(change: dict[str, object], said: str) -> None:
    options = dict(change)
    tests = histories_with()
    if "tests" in options:
        tests = []
        options.pop("tests")
    if "force" in options:
        force = options.pop("force")
        tests[0] = replace(tests[0], force=None if force is None else np.full(tests[0].time.size, 3.0))
    if options.pop("twice", False):
        tests.append(tests[0])
    if options.pop("short", False):
        first = tests[0]
        tests = [DamperTest("s", first.time[:5], first.displacement[10:15], first.measured_force()[:5])]
    with pytest.raises(InputError, match=said):
        fit_forces(KELVIN, tests, options.pop("start", None), predict=kelvin_voigt, **options)  # type: ignore[arg-type]


def test_a_force_that_is_not_a_number_never_reaches_a_fit() -> None:
    test = histories_with()[0]
    force = test.measured_force().copy()
    force[3] = np.nan
    with pytest.raises(InputError, match="test sweep .*sample 4 .*E-TEST-07"):
        replace(test, force=force)


def test_more_parameters_than_the_data_carry() -> None:
    test = histories_with()[0]
    few = DamperTest("few", test.time[:12], test.displacement[20:32], test.measured_force()[20:32])
    with pytest.raises(InputError, match="12 samples .* 9 parameters.*E-FIT-01"):
        fit_forces(LAWS["mgmm"], [few])


def test_what_went_before_a_test_in_motion_is_left_out_of_a_fit() -> None:
    """A Zener solid in tests cut from longer ones: F - k0 u begins with what was there, and forgets it in c1 / k1."""
    truth = {"k0": 3e6, "k1": 6e6, "c1": 1.2e6}
    generator, tests = np.random.default_rng(4), []
    for name, frequency in (("slow", 0.5), ("middle", 1.0), ("fast", 2.0)):
        time = np.arange(-3.0, 4.0, 0.005)
        u = 3e-3 * np.sin(2.0 * np.pi * frequency * time + 1.0)
        force = Damper(LAWS["zener"], truth).force(time, u)
        force = force + 50.0 * generator.standard_normal(time.size)
        tests.append(DamperTest(name, time[600:], u[600:], force[600:]))
    fit = fit_forces(LAWS["zener"], tests, starts=2)
    for name, value in truth.items():
        assert abs(fit.values[name] - value) < 4.0 * fit.standard_error_white[name]
    assert all(
        rms < 1.2 * 50.0 / np.sqrt(np.mean(t.measured_force() ** 2))
        for t, rms in zip(tests, fit.rms_error.values(), strict=True)
    )
    assert [warning for warning in fit.warnings if "starts away from rest" in warning and "not judged" in warning]


def test_the_standard_error_of_a_parameter_of_zero_has_its_unit() -> None:
    """40 000 N/m are 0.04 kN/mm; 7 000 N (s/m)^0.5 are 7 kN over the root of 1000, as a s/mm is 1000 s/m."""
    fit = fit_forces(KELVIN, histories_with(), starts=1)
    at_zero = replace(fit, values={"k": 0.0, "c": C})
    assert practical_errors(at_zero, {"k": 4e4, "c": 2e3}) == {"k": "0.04 kN/mm", "c": "0.002 kN*s/mm"}
    dashpot = replace(fit, law=POWER, values={"c": 7e4, "alpha": 0.5})
    assert practical_errors(dashpot, {"c": 7e3, "alpha": 0.01}) == {"c": "0.221 kN*(s/mm)^alpha", "alpha": 0.01}
