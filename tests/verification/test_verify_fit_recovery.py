"""Every law is fitted to forces that it made itself, with noise: the parameters must come back, from the data alone.

Reference: the parameters that made the data. White noise of 1 % of the peak force, so each estimate is normal about the
truth with the standard error of white noise (Gauss-Markov); 3 of them hold 99.7 % of all, and the seed was not chosen.
"""

from __future__ import annotations

import numpy as np
import pytest
from damper_examples import EXAMPLES
from fit_campaign import measured

from edesign.damper.damper import Damper
from edesign.damper.fitting import Fit, fit_forces
from edesign.damper.fitting.identifiable import FIXED
from edesign.damper.laws import LAWS

NOISE = 0.01


def recovered(name: str, noise: float = NOISE, starts: int = 2, seed: int = 7) -> Fit:
    truth = EXAMPLES[name]
    fixed = {
        key: truth[key] for key in FIXED.get(name, {})
    }  # what no data determine is given, all else comes from the data
    branches = sum(key.startswith("c") for key in truth) if LAWS[name].branch else 1
    return fit_forces(LAWS[name], measured(name, truth, noise, seed), fixed=fixed, starts=starts, branches=branches)


SLOW = {"modified_bouc_wen"}  # takes three times as long as any other


@pytest.mark.parametrize("name", [pytest.param(law, marks=[pytest.mark.slow] * (law in SLOW)) for law in LAWS])
def test_parameters_come_back(name: str) -> None:
    fit = recovered(name)
    truth = LAWS[name].complete(EXAMPLES[name])
    assert set(fit.free) | set(fit.at_bound) | set(fit.fixed) == set(truth)
    for key in fit.free:
        error = max(fit.standard_error_white[key], 1e-6 * abs(truth[key]))  # the integration of the law: 1e-6
        assert abs(fit.values[key] - truth[key]) < 3.0 * error, key
    for key, bound in fit.at_bound.items():
        assert truth[key] == bound, key
    # what is left is the noise: its variance over that of the force, test by test
    for test in measured(name, EXAMPLES[name], NOISE):
        force = Damper(LAWS[name], EXAMPLES[name]).force(test.time, test.displacement)
        expected = float(np.sum((test.measured_force() - force) ** 2) / np.sum(force**2))
        assert fit.nrms[test.name] == pytest.approx(expected, rel=0.05)


def test_the_parameters_fixed_by_default_are_those_that_no_data_determine() -> None:
    """Eq. 4.29 as printed: k0 and k_b, and c1, k1 and c_b, change together without any change of the force."""
    truth = EXAMPLES["mgmm"]
    tau, shift, factor = truth["c1"] / truth["k1"], 0.1e6, 3.0
    other = dict(truth, k0=truth["k0"] + shift, k_b=truth["k_b"] - shift, k1=factor * truth["k1"])
    other |= {"c1": factor * truth["c1"], "c_b": truth["c_b"] - tau * shift - (factor - 1.0) * truth["c1"]}
    for test in measured("mgmm", truth, 0.0):
        one, two = (Damper(LAWS["mgmm"], values).force(test.time, test.displacement) for values in (truth, other))
        np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-9 * np.max(np.abs(one)))  # quadrature


@pytest.mark.parametrize(
    ("name", "change"),
    [
        # z -> s z, with n = 2: A s, beta / s, Y and gamma as they are would need gamma / s; see identifiable.py
        ("bouc_wen", {"A": 2.0, "Fy": 0.5, "alpha": None, "beta": 4.0, "gamma": 4.0}),
        ("friction", {"mu": 2.0, "N": 0.5}),
        ("ramberg_osgood", {"a": 2.0**5.0, "Fy": 2.0}),
        ("linearised", {"zeta_eff": 3.0, "omega": 3.0}),
    ],
)
def test_what_scales_together_is_fixed(name: str, change: dict[str, float | None]) -> None:
    truth = EXAMPLES[name]
    other = {key: value * (change.get(key) or 1.0) for key, value in truth.items()}
    if (
        name == "bouc_wen"
    ):  # (1 - alpha) Fy and alpha Fy / Y with z twice as large: Fy' (1 - alpha') = Fy (1 - alpha) / 2
        linear, hysteretic = truth["alpha"] * truth["Fy"], (1.0 - truth["alpha"]) * truth["Fy"] / 2.0
        other |= {"Fy": linear + hysteretic, "alpha": linear / (linear + hysteretic)}
        other |= {"beta": truth["beta"] / 2.0, "gamma": truth["gamma"] / 2.0}
    for test in measured(name, truth, 0.0):
        one, two = (Damper(LAWS[name], values).force(test.time, test.displacement) for values in (truth, other))
        np.testing.assert_allclose(one, two, rtol=0.0, atol=1e-4 * np.max(np.abs(one)))  # SUNDIALS: 1e-6 a step
    assert set(FIXED[name]) & set(change)
