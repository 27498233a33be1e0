"""Laws of the temperature against their formulas, and what an error of the thermometer does."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from irregular_motion import (
    STIFFNESS,
    U,
    close,
    factor,
    motion,
    sizes,
    trial,
)

from edesign.calibrate.dampers.effects import (
    temperature_law,
)
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of, candidates
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Sizes
from edesign.calibrate.fit import Model, fit
from edesign.calibrate.problem import PredictionError
from edesign.calibrate.search.screening import screen
from edesign.core.damper import CoreDamper
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters


def test_a_transition_is_half_way_at_its_middle() -> None:
    t = trial(motion(8), temperature=np.linspace(20.0, 40.0, motion(8).time.size))
    (phi,) = factor(temperature_law.Transition(), {"d": 0.4, "Tc": 30.0, "w": 0.5, "T0": 20.0}, (t,))
    assert np.interp(30.0, t.temperature, phi) == pytest.approx(0.8, abs=1e-6)
    assert phi[0] == pytest.approx(1.0, abs=1e-12) and phi[-1] == pytest.approx(0.6, abs=1e-8)


def test_readings_of_one_temperature_show_no_law_of_it() -> None:
    random = np.random.default_rng(5)
    read = [np.round(20.0 + off + 0.3 * random.standard_normal(motion(8).time.size), 1) for off in (-0.4, 0.1, 0.3)]
    one = Sizes.of([trial(motion(8), order, temperature) for order, temperature in enumerate(read)])
    assert max(x.max() for x in read) - min(x.min() for x in read) > 1.5
    assert one.temperatures == pytest.approx((19.6, 20.3), abs=0.2)
    warmed = Sizes.of([trial(motion(8), 0, read[1] + np.linspace(0.0, 6.0, motion(8).time.size))])
    assert warmed.temperatures == pytest.approx((20.4, 25.8), abs=0.3)
    for form in temperature_law.FORMS:
        assert not form().unknowns(one) and not form().starts(one)
        assert form().unknowns(warmed)


def test_no_transition_is_sharper_than_a_thermometer_sees() -> None:
    size = replace(sizes(), temperatures=(20.0, 23.0), levels=4)
    sharpest = next(u for u in temperature_law.Transition().unknowns(size) if u.name == "w")
    assert sharpest.lower == 1.0
    assert all(w >= 1.0 for _, _, w in temperature_law.Transition().starts(size))


def test_three_temperatures_tell_no_width_of_a_transition() -> None:
    # depth, middle and width are three numbers beside the force at the reference
    degrees = {3: (20.0, 30.0, 20.4, 35.0, 30.5), 4: (20.0, 30.0, 25.0, 35.0)}
    for number, at in degrees.items():
        size = Sizes.of([replace(trial(motion(8), order, warm), use="fit") for order, warm in enumerate(at)])
        assert size.levels == number
        form = temperature_law.Transition()
        names = [unknown.name for unknown in form.unknowns(size)]
        assert names == ["d", "Tc", "w"][: number - 1]
        assert {len(row) for row in form.starts(size)} == {number - 1}
        assert form.fixed(size).get("w") == (0.25 * 15.0 if number == 3 else None)
    validated = [replace(trial(motion(8), order, 20.0 + 2.0 * order), use="validate") for order in range(5)]
    assert Sizes.of([replace(trial(motion(8)), use="fit"), *validated]).levels == 1


def test_exponential_follows_the_temperature_within_a_test() -> None:
    of = motion(8)
    warm = np.linspace(18.0, 32.0, of.time.size)
    (phi,) = factor(temperature_law.Exponential(), {"b": 0.03, "T0": 20.0}, (trial(of, 0, warm),))
    close([phi], [np.array([math.exp(-0.03 * (x - 20.0)) for x in warm])])


def test_wlf_and_arrhenius_by_their_formulas() -> None:
    of = motion(8)
    warm = np.linspace(12.0, 45.0, of.time.size)
    tests = (trial(of, 0, warm),)
    # log10 a_T = -C1 (T - T0)/(C2 + T - T0); E/R (1/T - 1/T0) in kelvin
    wlf = [np.array([10.0 ** (-8.86 * (x - 20.0) / (101.6 + x - 20.0)) for x in warm])]
    arrhenius = [np.array([math.exp(4000.0 * (1.0 / (273.15 + x) - 1.0 / 293.15)) for x in warm])]
    for expected, b, c in (
        (wlf, 8.86 * math.log(10.0) / 101.6, 1.0 / 101.6),
        (arrhenius, 4000.0 / 293.15**2, 1.0 / 293.15),
    ):
        close(factor(temperature_law.Wlf(), {"b": b, "c": c, "T0": 20.0}, tests), expected)
    one = temperature_law.Arrhenius()
    (unknown,) = one.unknowns(replace(sizes(), temperatures=(12.0, 45.0)))
    close(factor(one, {unknown.name: 4000.0 / 293.15**2, **one.fixed(sizes())}, tests), arrhenius)
    straight = factor(temperature_law.Exponential(), {"b": 0.03, "T0": 20.0}, tests)
    close(factor(temperature_law.Wlf(), {"b": 0.03, "c": 0.0, "T0": 20.0}, tests), straight)


def test_a_fall_by_wlf_has_no_end_within_a_test() -> None:
    of = motion(8)
    (phi,) = factor(
        temperature_law.Wlf(), {"b": 0.03, "c": 0.02, "T0": 20.0}, (trial(of, 0, np.full(of.time.size, -80.0)),)
    )
    np.testing.assert_allclose(phi, math.exp(0.03 * 100.0 / 0.05), rtol=1e-12)  # T0 - 1/c = -30 degC is passed


@pytest.mark.parametrize(
    ("law", "values"),
    [
        ("zener", {"k0": 1e6, "k1": 2e6, "c1": 2e5}),
        ("fractional_kelvin", {"k0": 1e6, "c": 0.3, "alpha": 0.4}),
        ("maxwell_power", {"c": 4e4, "alpha": 0.5, "k": 5e6}),
        ("bouc_wen", {"Fy": 1e4, "Y": 2e-3, "alpha": 0.1}),
        (
            "mgmm",
            {
                **{"k1": 5.15e5, "c1": 1.51e4, "k0": 1.07e5, "c_NL": 2.1e4, "alpha": 0.374, "k_a": 3.7e6},
                **{"k_b": 3.6e6, "u_ref": 8e-3, "c_a": 9e5, "c_b": 1.9e5, "v_ref": 0.0135, "consistent": 1.0},
            },
        ),
    ],
)
def test_shifted_law_is_the_law_on_another_clock(law: str, values: dict[str, float]) -> None:
    # time-temperature superposition (Ferry 1980, chapter 11): force at T over time t = force at T0 over time t / a_T
    of = motion(9)
    complete = LAWS[law].complete(values)
    a_t = math.exp(-0.06 * 9.0)
    shifted = temperature_law.Shift().law({"b": 0.06, "T0": 20.0}, trial(of, 0, 29.0), complete)
    assert list(shifted) == list(complete)
    slowing = {"b": 0.06 * (1.0 + 0.01 * 9.0), "c": 0.01, "T0": 20.0}
    assert temperature_law.ShiftWlf().law(slowing, trial(of, 0, 29.0), complete) == pytest.approx(shifted, rel=1e-12)
    activated = {"b": 0.06 * (1.0 + 9.0 / 293.15), **temperature_law.ShiftArrhenius().fixed(sizes())}
    assert temperature_law.ShiftArrhenius().law(activated, trial(of, 0, 29.0), complete) == pytest.approx(shifted)
    warm = CoreDamper(law, tuple(shifted.values())).force(of.time, of.displacement, of.velocity)
    cold = CoreDamper(law, tuple(complete.values())).force(of.time / a_t, of.displacement, of.velocity * a_t)
    # the core sums exponentials over absolute times for fractional derivatives: between clocks 3e-5 here
    np.testing.assert_allclose(warm, cold, rtol=0.0, atol=1e-4 * np.max(np.abs(cold)))
    if law != "bouc_wen":
        plain = CoreDamper(law, tuple(complete.values())).force(of.time, of.displacement, of.velocity)
        assert np.max(np.abs(warm - plain)) > 0.01 * np.max(np.abs(plain))


def test_a_shift_of_forces_leaves_velocities() -> None:
    # Table 4.2 by hand, SI: dashpots in N s/m by a_T, c_NL in N (s/m)^alpha by a_T^alpha, the rest as it was
    printed = {"k1": 5.15e5, "c1": 1.51e4, "k0": 1.07e5, "c_NL": 2.1e4, "alpha": 0.374, "k_a": 3.7e6, "k_b": 3.6e6}
    values = {**printed, "u_ref": 8e-3, "c_a": 9e5, "c_b": 1.9e5, "v_ref": 0.0135, "consistent": 0.0}
    found = temperature_law.ShiftOfForces().law(
        {"b": 0.05, "c": 0.01, "T0": 20.0}, trial(motion(3), 0, 28.0), LAWS["mgmm"].complete(values)
    )
    a_t = math.exp(-0.05 * 8.0 / 1.08)
    expected = {name: a_t * values[name] for name in ("c1", "c_a", "c_b")}
    assert found == pytest.approx({**values, **expected, "c_NL": a_t**0.374 * values["c_NL"]}, rel=1e-12)


def test_a_law_in_the_place_of_gamma_is_that_law_without_it() -> None:
    # 27.5 degC: gamma_T of Table 4.4 is half way between 0.935 and 0.875; an effect of no size leaves a law without it
    mgmm, size = LAWS["mgmm"], sizes()
    values = read_parameters(mgmm, "thesis_table_4_2")
    warm, cold = (replace(trial(motion(3), 0, degrees), use="fit") for degrees in (27.5, 20.0))
    (form,) = (f for f in temperature_law.forms_of(size) if f.form == "exponential_in_place")
    candidate = candidate_of(form, size, Left())
    assert candidate is not None and candidate.label == "temperature_law.exponential_in_place"
    problem = DamperProblem(mgmm, values, (warm, cold), size)
    for b in (0.0, 0.03):
        forces = problem.predict(problem.declared, [(candidate, np.array([b]))], ("fit",))
        assert forces[0] is not None and forces[1] is not None
        scale = float(np.max(np.abs(forces[1])))
        np.testing.assert_allclose(forces[0], math.exp(-b * 7.5) * forces[1], rtol=0.0, atol=1e-9 * scale)
    plain = problem.predict(problem.declared, (), ("fit",))
    assert plain[0] is not None and np.max(np.abs(plain[0])) < 0.95 * scale
    labels = {f"temperature_law.{f.form}" for f in temperature_law.forms_of(size)}
    rest = Left((warm,), [np.zeros_like(warm.force)])
    assert labels <= {c.label for c in candidates(size, rest, True, True)}
    assert not labels & {c.label for c in candidates(size, rest, False, True)}  # no law but the MGMM has gamma_T


def test_another_gamma_multiplies_every_parameter_in_the_units_of_the_thesis() -> None:
    # Table 4.2 by hand: c_NL is in kN (s/mm)^alpha there, and alpha changes too
    printed = {
        "k1": 0.515,
        "c1": 0.0151,
        "k0": 0.107,
        "k_a": 3.741,
        "k_b": 3.613,
        "c_a": 0.902,
        "c_b": 0.190,
    }  # kN, mm, s
    rest = {"u_ref": 7.966e-3, "v_ref": 13.468e-3, "alpha": 0.374, "consistent": 0.0}
    values = {**{name: 1e6 * value for name, value in printed.items()}, **rest}
    values["c_NL"] = 1.585e3 * 1e3**0.374
    b, c, of = 0.02, 5e-3, motion(3)
    for form, p, gamma in (
        (temperature_law.Gamma(), {"b": b, "T0": 20.0}, math.exp(-b * 9.0)),
        (temperature_law.GammaWlf(), {"b": b, "c": c, "T0": 20.0}, math.exp(-b * 9.0 / (1.0 + c * 9.0))),
        (temperature_law.GammaLine(), {"b": b, "T0": 20.0}, 1.0 - b * 9.0),
    ):
        found = form.law(p, trial(of, 0, 29.0), values)
        assert found.keys() == values.keys()
        for name in (*printed, "u_ref", "v_ref", "alpha"):
            assert found[name] == pytest.approx(gamma * values[name], rel=1e-12)
        assert found["c_NL"] == pytest.approx(1.585e3 * gamma * 1e3 ** (0.374 * gamma), rel=1e-12)
        assert found["consistent"] == 0.0
        other = {"k": 1e6, "c": 2e4}
        assert form.law(p, trial(of, 0, 29.0), other) == other


def test_one_temperature_shows_no_temperature_law() -> None:
    alike = Sizes.of((trial(motion(1), 0, 20.0), trial(motion(2), 1, 20.5)))
    for form in (kind() for kind in temperature_law.FORMS):
        assert form.unknowns(alike) == () and form.starts(alike) == ()
        assert form.unknowns(sizes())


def test_an_error_of_the_thermometer_is_no_residual() -> None:
    # forces of a test 0.2 K warmer than was read: all of the residual, and what such an error is taken to leave
    size = replace(sizes(), temperatures=(20.0, 26.0))
    test = replace(trial(motion(11)), temperature=np.full(motion(11).time.size, 25.0))
    solid = DamperProblem(LAWS["kelvin_voigt"], {"k": STIFFNESS, "c": 2e4}, (test,), size)
    softens = candidate_of(temperature_law.Exponential(), size, Left())
    assert softens is not None
    part = (softens, np.array([0.01]))
    (force,) = solid.predict(solid.declared, [part], ("fit",))
    assert force is not None
    warmer = math.exp(-0.01 * 0.2) * force
    noise = 1e-4 * STIFFNESS * U
    noisy = replace(test, force=warmer + noise * np.random.default_rng(1).standard_normal(force.size))
    for thermometer, low, high in ((0.0, 10.0, math.inf), (0.2, 0.8, 1.2)):
        problem = replace(solid, trials=(noisy,), thermometer=thermometer)
        model = Model(problem, (noise,), effects=(softens,), held=True)
        (residual,) = model.residuals(model.coordinates(parts=[part]))
        assert low < problem.left([residual], [noise]) < high  # noise in the few bins of the band of the motion
    doubt = replace(solid, thermometer=0.2).doubt([part], 0)
    np.testing.assert_allclose(doubt, -0.002 * force, atol=2e-5 * STIFFNESS * U)  # second order of 0.002
    assert replace(solid, thermometer=0.2).doubt([], 0) is None  # this law has no temperature


def test_laws_of_the_temperature_are_screened_with_nothing_in_doubt() -> None:
    # 20 to 32 degC and losses that fall with them: seen beside a law without, doubt takes a share of what is left
    tests = tuple(
        replace(trial(motion(11), order, warm), name=f"t{order}") for order, warm in enumerate((20.0, 24.0, 28.0, 32.0))
    )
    solid = DamperProblem(LAWS["mgmm"], read_parameters(LAWS["mgmm"], "thesis_table_4_2"), tests, Sizes.of(tests))
    falls = candidate_of(temperature_law.Exponential().of_loss(), solid.sizes, Left())
    assert falls is not None and falls.doubted
    made = solid.predict(solid.declared, [(falls, np.array([0.02]))], ("fit",))
    noise = 1e-3 * float(np.std(made[0]))
    random = np.random.default_rng(3)
    noisy = tuple(
        replace(test, force=force + noise * random.standard_normal(force.size))
        for test, force in zip(tests, made, strict=True)
    )
    certain = replace(solid, trials=noisy)
    doubted = replace(certain, thermometer=0.2)
    found = []
    for problem in (certain, doubted):
        model = Model(problem, (noise,) * 4, held=True)
        (signature,) = screen(fit(model, model.coordinates()), [falls])
        assert signature.model.problem is problem
        found.append(signature)
    assert found[1].gain == pytest.approx(found[0].gain, rel=1e-12)
    np.testing.assert_allclose(found[1].start, found[0].start, rtol=1e-12)
    assert falls.unknowns[0].value(float(found[0].start[-1])) == pytest.approx(0.02, rel=0.2)  # one linear step


def test_parameters_that_no_law_has_are_no_prediction() -> None:
    # gamma_T of 8 makes alpha 3; beside a form in the place of the law's own gamma_T nothing else asks for it
    mgmm, of = LAWS["mgmm"], motion(4)
    warm = trial(of, 0, 29.0)
    damper = DamperProblem(mgmm, read_parameters(mgmm, "thesis_table_4_2"), (warm,), Sizes.of((trial(of), warm)))
    parts = [
        candidate_of(form, damper.sizes, Left()) for form in (temperature_law.Gamma(), temperature_law.GammaLine())
    ]
    # and one of 1340 a c_NL of 1000^501
    for rate, message in ((-math.log(8.0) / 9.0, "alpha"), (-0.8, "beyond all numbers")):
        given = [(part, np.array([value])) for part, value in zip(parts, (rate, 0.0), strict=True) if part]
        assert len(given) == 2
        with pytest.raises(PredictionError, match=message):
            damper.predict(damper.declared, given, ("fit",))
