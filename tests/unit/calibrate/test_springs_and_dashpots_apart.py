"""Effects that change springs and dashpots of a law apart, against their formulas."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from irregular_motion import (
    ROUNDING,
    STIFFNESS,
    U,
    factor,
    motion,
    shaken,
    sizes,
    trial,
)

from edesign.calibrate.dampers.effects import (
    payne,
    temperature_law,
)
from edesign.calibrate.dampers.law_unknowns import law_unknowns
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of, candidates
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.temperature import at

MGMM = {
    **{"k1": 5.15e5, "c1": 1.51e4, "k0": 1.07e5, "c_NL": 2.1e4, "alpha": 0.374, "k_a": 3.7e6},
    **{"k_b": 3.6e6, "u_ref": 8e-3, "c_a": 9e5, "c_b": 1.9e5, "v_ref": 0.0135},
}


def test_kraus_softens_springs_and_gives_dashpots_a_hump() -> None:
    test = trial(motion(11))
    p = {"d": 0.3, "a0": 4e-3, "m": 1.4, "tau_a": 2.0, "h": 0.5}
    a, broken = 0.0, []
    for i, u in enumerate(test.motion.displacement):
        h = test.motion.time[i] - test.motion.time[i - 1] if i else 0.0
        a = max(abs(u), a * math.exp(-h / p["tau_a"]))
        broken.append((a / p["a0"]) ** p["m"] / (1.0 + (a / p["a0"]) ** p["m"]))
    g = np.array(broken)
    phi, phi2 = 1.0 - 0.3 * g, (1.0 - 0.3 * g) * (1.0 + 2.0 * 0.5 * np.sqrt(g * (1.0 - g)))
    size, rest = sizes(), [np.zeros_like(test.force)]
    (kraus,) = (c for c in candidates(size, Left((test,), rest), False, True) if c.label == "payne.kraus")
    assert not [c for c in candidates(size, Left((test,), rest), False, False) if c.label == "payne.kraus"]
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (test,), size)
    values = np.array([p[unknown.name] for unknown in kraus.unknowns])
    (found,) = solid.predict(solid.declared, [(kraus, values)], ("fit",))
    expected = STIFFNESS * test.motion.displacement * phi + 2e4 * test.motion.velocity * phi2
    assert found is not None and g.max() - g.min() > 0.2
    # the core's first sample is that of a law at rest before: 1e-6 N
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


@pytest.mark.parametrize(
    ("label", "p", "springs"),
    [
        ("hardening.springs", {"b": 0.4, "p": 2.5}, lambda x: 1.0 + 0.4 * np.abs(x) ** 2.5),
        ("hardening.springs_gent", {"b": 1.0, "u_m": 1.6}, lambda x: 1.0 / (1.0 - (x / 1.6) ** 2)),
        (
            "hardening.springs_beyond",
            {"b": 3.0, "u0": 0.4, "n": 1.7},
            lambda x: 1.0 + 3.0 * np.maximum(np.abs(x) - 0.4, 0.0) ** 1.7,
        ),
        ("one_sided.even_springs", {"b": -0.3}, lambda x: 1.0 - 0.3 * x),
    ],
)
def test_springs_stiffen_and_dashpots_stay(
    label: str, p: dict[str, float], springs: Callable[[np.ndarray], np.ndarray]
) -> None:
    # of Kelvin and Voigt, so that the law's force is k u and c v apart; x = u/r, r the largest deformation
    test, size = trial(motion(11)), sizes()
    rest = [np.zeros_like(test.force)]
    (form,) = (c for c in candidates(size, Left((test,), rest), True, True) if c.label == label)
    # springs that do not soften have the springs beside them for it
    assert not [c for c in candidates(size, Left((test,), rest), False, True) if c.label == label]
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (test,), size)
    values = {name: value * (size.displacement if name in ("u_m", "u0") else 1.0) for name, value in p.items()}
    (found,) = solid.predict(solid.declared, [(form, np.array([values[u.name] for u in form.unknowns]))], ("fit",))
    u, v = test.motion.displacement, test.motion.velocity
    expected = STIFFNESS * springs(u / size.displacement) * u + 2e4 * v
    assert found is not None
    # the core's first sample is that of a law at rest before: 1e-6 N
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_parameters_of_a_law_stay_within_a_thousand_times_the_declared_ones() -> None:
    # a search that takes c1/k1 to nothing asks for laws that no step resolves
    unknowns = law_unknowns(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, sizes())
    for unknown, value in zip(unknowns, (STIFFNESS, 2e4), strict=True):
        bounds = [unknown.value(end) for end in unknown.span]
        np.testing.assert_allclose(bounds, [1e-3 * value, 1e3 * value], rtol=1e-12)


def test_an_axial_load_softens_springs_and_pushes_the_specimen_over() -> None:
    test = trial(motion(11))
    size, rest = sizes(), [np.zeros_like(test.force)]
    found = {c.label: c for c in candidates(size, Left((test,), rest), False, True)}
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (test,), size)
    springs, dashpots = STIFFNESS * test.motion.displacement, 2e4 * test.motion.velocity
    for label, value, expected in (
        ("static_offset.axial_load", 0.2, 0.8 * springs + 1.2 * dashpots),
        ("static_offset.p_delta", 3e5, springs + dashpots - 3e5 * test.motion.displacement),
    ):
        (force,) = solid.predict(solid.declared, [(found[label], np.array([value]))], ("fit",))
        assert force is not None
        np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_of_loss_changes_dashpots_alone() -> None:
    warm = replace(trial(motion(11)), temperature=np.full(motion(11).time.size, 26.0))
    size, rest = replace(sizes(), temperatures=(20.0, 26.0)), [np.zeros_like(warm.force)]
    found = {c.label: c for c in candidates(size, Left((warm,), rest), False, True)}
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (warm,), size)
    springs, dashpots = STIFFNESS * warm.motion.displacement, 2e4 * warm.motion.velocity
    phi = math.exp(-0.03 * 6.0)
    for label, values, expected in (
        ("temperature_law.exponential", (0.03,), phi * (springs + dashpots)),
        ("temperature_law.exponential_of_loss", (0.03,), springs + phi * dashpots),
        ("temperature_law.exponential_loss", (0.03, 2.0), phi * springs + phi**2 * dashpots),
    ):
        (force,) = solid.predict(solid.declared, [(found[label], np.array(values))], ("fit",))
        np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_dashpots_take_a_share_of_what_springs_do() -> None:
    warm = replace(trial(motion(12)), temperature=np.full(motion(12).time.size, 26.0))
    size = replace(sizes(), temperatures=(20.0, 26.0))
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (warm,), size)
    plain = candidate_of(temperature_law.Exponential(), size, Left())
    assert plain is not None
    (shared, begun), _ = solid.finer((plain, np.array([0.03])))
    assert shared.form == "exponential_shared" and begun.tolist() == [0.03, 1.0]
    (force,) = solid.predict(solid.declared, [(shared, np.array([0.03, 0.4]))], ("fit",))
    s = math.exp(-0.03 * 6.0) - 1.0
    expected = (1.0 + s) * STIFFNESS * warm.motion.displacement + (1.0 + 0.4 * s) * 2e4 * warm.motion.velocity
    np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-9 * STIFFNESS * U)


def test_springs_of_the_mgmm_are_what_goes_with_the_deformation() -> None:
    # F + tau F' = k u + phi (c v + c_NL |v|^alpha sgn v) is the MGMM itself with these parameters (thesis Eq. 4.29)
    mgmm = LAWS["mgmm"]
    values = mgmm.complete(MGMM)
    test = trial(motion(12), 3)
    solid = DamperProblem(mgmm, values, (test,), sizes(), fineness=0.0)
    found = {c.label: c for c in candidates(sizes(7), Left((test,), [np.zeros_like(test.force)]), True, True)}
    phi = 1.0 - 0.1 * 3
    (force,) = solid.predict(solid.declared, [(found["ageing.linear_of_loss"], np.array([-0.1]))], ("fit",))
    tau, branch = values["c1"] / values["k1"], 1e-9
    viscous = tau * values["k0"] + values["c1"] + values["c_b"]
    expected = Damper(
        mgmm,
        {
            **values,
            **{
                "k1": branch * values["k1"],
                "c1": branch * values["c1"],
                "k0": 0.0,
                "k_b": values["k0"] + values["k_b"],
            },
            **{"c_NL": phi * values["c_NL"], "c_a": phi * values["c_a"], "c_b": phi * viscous},
        },
    ).force(test.motion.time, test.motion.displacement, test.motion.velocity)
    # of the branch 1e-9 is left
    np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-9 * np.max(np.abs(expected)))


@pytest.mark.parametrize("temperature_C", [20.0, 27.0])
def test_a_law_at_a_temperature_has_the_parameters_of_that(temperature_C: float) -> None:
    mgmm = LAWS["mgmm"]
    test = replace(trial(motion(13)), temperature=np.full(motion(13).time.size, temperature_C))
    for c_nl, v_ref in ((2.1e4, 0.0135), (3e4, 0.05), (0.0, 0.0135)):
        values = mgmm.complete({**MGMM, "c_NL": c_nl, "v_ref": v_ref})
        solid = DamperProblem(mgmm, {**values, "v_ref": 0.0135}, (test,), sizes(), fineness=0.0)
        base = np.array([values[unknown.name] for unknown in solid.base])
        (force,) = solid.predict(base, [], ("fit",))
        warm, _ = at(mgmm, values, temperature_C)
        expected = Damper(mgmm, warm).force(test.motion.time, test.motion.displacement, test.motion.velocity)
        # v_ref rounds the power within 1e-7 v_ref of rest; the steps are good to 1e-8
        np.testing.assert_allclose(force, expected, rtol=0.0, atol=1e-7 * np.max(np.abs(expected)))


def test_a_curve_of_its_own_bends_all_of_a_law_that_has_no_sides() -> None:
    test = replace(trial(motion(12)), temperature=np.full(motion(12).time.size, 26.0))
    size = replace(sizes(), temperatures=(20.0, 26.0))
    zener = LAWS["zener"]
    values = {parameter.name: 1e6 for parameter in zener.parameters}
    solid = DamperProblem(zener, values, (test,), size)
    plain = candidate_of(temperature_law.Exponential(), size, Left())
    assert plain is not None
    (fine,) = solid.finer((plain, np.array([0.03])))
    assert [unknown.name for unknown in fine[0].unknowns] == ["b", "s2"]  # springs and dashpots are not told apart
    (law_force,) = solid.predict(solid.declared, (), ("fit",))
    s = math.exp(-0.03 * 6.0) - 1.0
    for c in (0.0, 2.0):
        (force,) = solid.predict(solid.declared, [(fine[0], np.array([0.03, c]))], ("fit",))
        np.testing.assert_allclose(force, (1.0 + s + c * s**2) * law_force, rtol=1e-12)


def test_hump_of_kraus_is_h_where_half_is_broken() -> None:
    held = shaken(np.full(3, 4e-3))
    p = {"d": 0.3, "a0": 4e-3, "m": 1.4, "tau_a": 2.0, "h": 0.5}
    form = payne.Kraus()
    (phi,) = factor(form, p, (trial(held),))
    dashpots = form.dashpot_factor(p, held, phi)
    assert phi[0] == pytest.approx(1.0 - 0.5 * 0.3, rel=ROUNDING)
    assert np.asarray(dashpots)[0] == pytest.approx((1.0 - 0.5 * 0.3) * (1.0 + 0.5), rel=ROUNDING)


def test_mean_square_forgets_a_held_deformation_exponentially() -> None:
    """a^2 = 2 u^2 (1 - exp(-t/tau)) of u held since the test began; in steady cycles far faster than tau, a = u0."""
    p = {"d": 1.0, "a0": 4e-3, "m": 2.0, "tau_a": 3.0}
    held = shaken(np.full(300, 4e-3))
    (phi,) = factor(payne.MeanSquare(), p, (trial(held),))
    square = 2.0 * -np.expm1(-(held.time - held.time[0]) / 3.0)
    np.testing.assert_allclose(phi, 1.0 / (1.0 + square), rtol=ROUNDING)
    cycles = shaken(4e-3 * np.sin(2.0 * math.pi * np.arange(4001) / 20.0))
    (phi,) = factor(payne.MeanSquare(), p | {"tau_a": 1.0}, (trial(cycles),))  # 200 cycles in 10 s
    # of the beginning exp(-10) is left, and a^2 swings by 1/(2 w tau) = 0.4 %
    assert np.mean(phi[-100:]) == pytest.approx(0.5, rel=5e-3)


def test_a_mean_of_the_rate_comes_up_exponentially() -> None:
    """q = |v|/V (1 - exp(-t/tau)) at one speed, whatever its sign."""
    p = {"d": 0.7, "tau": 3.0, "V": 0.1}
    to_and_fro = shaken(1e-3 * np.abs(np.arange(400) % 40 - 20.0))
    speed = np.abs(to_and_fro.ways[0] / to_and_fro.steps[0])
    (phi,) = factor(payne.Intrinsic(), p, (trial(to_and_fro),))
    q = speed / 0.1 * -np.expm1(-(to_and_fro.time - to_and_fro.time[0]) / 3.0)
    assert q[-1] > 0.3
    np.testing.assert_allclose(phi, 1.0 / (1.0 + 0.7 * q), rtol=ROUNDING)
