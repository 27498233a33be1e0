"""Each form of an effect on a Kelvin-Voigt damper against its equation, written here in numpy on the samples."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
import pytest
from damper_problems import LAW_VALUES, problem
from scipy.special import erf

from edesign.calibration.dampers.effects import forms
from edesign.calibration.dampers.mechanisms import Placement
from edesign.calibration.dampers.motion import Motion
from edesign.core.damper import CoreDamper, EffectValues
from edesign.estimation.model import PredictionError

K, C = LAW_VALUES["kelvin_voigt"].values()
DEGREES = (20.0, 26.0, 31.0, 24.0, 28.0)
VOLTS = (1.0, 3.0, 0.0, 1.0, 2.5)  # the last test is no part of mean and range
PROBLEM = problem(tests=5, degrees=DEGREES, tones=(50.0, 31.0), conditions={"V": VOLTS})
MOTIONS = [one.motion for one in PROBLEM.experiments]
S = PROBLEM.typical
P = Mapping[str, float]
Forces = list[np.ndarray]


def law(u: np.ndarray, v: np.ndarray) -> np.ndarray:
    return K * u + C * v


def paths() -> list[np.ndarray]:
    """Path (n,) since the first test began."""
    before, found = 0.0, []
    for m in MOTIONS:
        own = before + np.concatenate(([0.0], np.cumsum(np.abs(np.diff(m.displacement)))))
        found.append(own)
        before = own[-1]
    return found


def each(force: Callable[[Motion, int], np.ndarray]) -> Forces:
    return [force(m, i) for i, m in enumerate(MOTIONS)]


def whole(factor: Callable[[Motion, int], np.ndarray | float]) -> Forces:
    return each(lambda m, i: factor(m, i) * law(m.displacement, m.velocity))


def beside(force: Callable[[Motion, int], np.ndarray | float]) -> Forces:
    return each(lambda m, i: law(m.displacement, m.velocity) + force(m, i))


def envelope(m: Motion, tau: float) -> np.ndarray:
    a = np.zeros_like(m.time)
    for i, u in enumerate(np.abs(m.displacement)):
        a[i] = max(u, a[i - 1] * np.exp(-(m.time[i] - m.time[i - 1]) / tau) if i else 0.0)
    return a


def payne(p: P) -> Forces:
    def left(m: Motion, i: int) -> np.ndarray:
        ratio = (envelope(m, p["tau_a"]) / p["a0"]) ** p["m"]
        return 1.0 - p["d"] * ratio / (1.0 + ratio)

    return whole(left)


def payne_elastic(p: P) -> Forces:
    def gone(m: Motion, i: int) -> np.ndarray:
        ratio = (envelope(m, p["tau_a"]) / p["a0"]) ** p["m"]
        return -p["k"] * ratio / (1.0 + ratio) * m.displacement

    return beside(gone)


def network(p: P) -> Forces:
    def left(m: Motion, i: int) -> np.ndarray:
        x = np.zeros_like(m.time)
        for j in range(1, x.size):
            breaks, heals = abs(m.displacement[j] - m.displacement[j - 1]) / p["s0"], m.steps[j - 1] / p["tau"]
            end = breaks / (breaks + heals)
            x[j] = end + (x[j - 1] - end) * np.exp(-breaks - heals)
        return 1.0 - p["d"] * x

    return whole(left)


def valve(p: P, v: np.ndarray) -> np.ndarray:
    return np.where(v > 0.0, 1.0 + p["b"] * np.tanh(v / p["v0"]), 1.0)


def largest() -> list[np.ndarray]:
    """Largest deformation ever (n,), nothing of it forgotten between tests."""
    before, found = 0.0, []
    for m in MOTIONS:
        found.append(np.maximum.accumulate(np.maximum(np.abs(m.displacement), before)))
        before = found[-1][-1]
    return found


def worked(p: P, factor: Callable[[float], float], gain: float, forgets: float, carried: bool) -> Forces:
    """F = factor(e) F_law, e' = gain F v - e/forgets: the factor of a step takes e of its beginning."""
    found, e = [], 0.0
    for m in MOTIONS:
        e = e if carried else 0.0
        force = np.zeros_like(m.time)
        given = law(m.displacement, m.velocity)
        force[0] = factor(e) * given[0]
        for j in range(1, force.size):
            force[j] = factor(e) * given[j]
            work = 0.5 * (force[j] + force[j - 1]) * (m.displacement[j] - m.displacement[j - 1])
            e = e * np.exp(-m.steps[j - 1] / forgets) + gain * work
        found.append(force)
    return found


def maxwell(p: P) -> Forces:
    def branch(m: Motion, i: int) -> np.ndarray:
        q, fine = np.zeros_like(m.time), 40
        for j in range(1, q.size):  # small steps of the exponential, the velocity linear over each
            h = m.steps[j - 1] / fine
            q[j] = q[j - 1]
            for n in range(fine):
                v = m.velocity[j - 1] + (m.velocity[j] - m.velocity[j - 1]) * (n + 0.5) / fine
                q[j] = q[j] * np.exp(-h / p["tau"]) + p["k"] * v * p["tau"] * -np.expm1(-h / p["tau"])
        return q

    return beside(branch)


def temperature(p: P, c: float) -> Forces:
    return whole(lambda m, i: np.exp(-p["b"] * (DEGREES[i] - 20.0) / (1.0 + c * (DEGREES[i] - 20.0))))


def shift(p: P, c: float) -> Forces:
    """Times of the law, here c/k, by a_T."""

    def shifted(m: Motion, i: int) -> np.ndarray:
        w = DEGREES[i] - 20.0
        return K * m.displacement + C * np.exp(-p["b"] * w / (1.0 + c * w)) * m.velocity

    return each(shifted)


def transition(p: P) -> Forces:
    def passed(t: float) -> float:
        return 1.0 / (1.0 + np.exp(-(t - p["Tc"]) / p["w"]))

    return whole(lambda m, i: 1.0 - p["d"] * (passed(DEGREES[i]) - passed(20.0)))


def moved(u: Callable[[Motion], np.ndarray], v: Callable[[Motion], np.ndarray]) -> Forces:
    return each(lambda m, i: law(u(m), v(m)))


def sided(p: P, side: float) -> Forces:
    return beside(lambda m, i: side * p["k"] * np.maximum(side * m.displacement - p["u0"], 0.0))


def contact(p: P, side: float) -> Forces:
    def force(m: Motion, i: int) -> np.ndarray:
        x = np.maximum(side * m.displacement - p["u0"], 0.0)
        return side * p["k"] * x * (x / S.displacement) ** (p["n"] - 1.0)

    return beside(force)


def follow(p: P) -> Forces:
    def own(m: Motion, i: int) -> np.ndarray:
        x, velocity, half = np.zeros_like(m.time), np.zeros_like(m.time), 0.5 * p["play"]
        for j in range(1, x.size):
            x[j] = min(max(x[j - 1], m.displacement[j] - half), m.displacement[j] + half)
            velocity[j] = m.velocity[j] if x[j] != x[j - 1] else 0.0
        return law(x, velocity)

    return each(own)


def gained(p: P, first: int, last: int = 5) -> Forces:
    return whole(lambda m, i: 1.0 + p["g"] if first <= i + 1 <= last else 1.0)


def scaled(p: P, first: int, last: int = 5) -> Forces:
    return whole(lambda m, i: 1.0 / (1.0 + p["g"]) if first <= i + 1 <= last else 1.0)


def limited(p: P, low: float, high: float) -> Forces:
    """Of what is beyond the limits the share s is lost."""
    forces = each(lambda m, i: law(m.displacement, m.velocity))
    return [(1.0 - p["s"]) * one + p["s"] * np.clip(one, low * p["F_l"], high * p["F_l"]) for one in forces]


def plays(p: P) -> Forces:
    """The integral over all play operators of half widths r, of the density 2, by its midpoints."""
    found = []
    for m in MOTIONS:
        force = law(m.displacement, m.velocity)
        most, number = float(np.max(np.abs(force))), 20_000
        half, state, response = (np.arange(number) + 0.5) * most / number, np.zeros(number), np.zeros_like(force)
        for j, one in enumerate(force):
            state = np.clip(state, one - half, one + half)
            response[j] = 2.0 * float(np.mean(state)) * most
        found.append(force + p["h"] / S.force * response)
    return found


def elapsed(p: P) -> Forces:
    return beside(lambda m, i: p["rate"] * (3.0 - 1 / 250.0) * i + p["rate"] * m.time)


# the law is linear, so that what a channel of the motion does is defined for displacement and velocity
EQUATIONS: dict[str, Callable[[P], Forces]] = {
    "payne.whole": payne,
    "payne.elastic": payne_elastic,
    "payne.exponential": lambda p: whole(
        lambda m, i: 1.0 + p["d"] * np.expm1(-((envelope(m, p["tau_a"]) / p["a0"]) ** p["m"]))
    ),
    "payne.network": network,
    "mullins.path": lambda p: whole(lambda m, i: 1.0 + p["m"] * np.exp(-((paths()[i] / p["s0"]) ** p["q"]))),
    "mullins.elastic": lambda p: beside(
        lambda m, i: p["k"] * np.exp(-((paths()[i] / p["s0"]) ** p["q"])) * m.displacement
    ),
    "mullins.maximum": lambda p: whole(
        lambda m, i: (
            1.0 - p["m"] * erf((largest()[i] ** 2 - m.displacement**2) / (p["r"] ** 2 + p["beta"] * largest()[i] ** 2))
        )
    ),
    "mullins.damage": lambda p: whole(lambda m, i: 1.0 + p["m"] * np.expm1(-((largest()[i] / p["r"]) ** p["p"]))),
    "hardening.power": lambda p: beside(
        lambda m, i: p["k"] * m.displacement * (np.abs(m.displacement) / S.displacement) ** (p["p"] - 1.0)
    ),
    "hardening.threshold": lambda p: beside(
        lambda m, i: p["k"] * np.maximum(np.abs(m.displacement) - p["u0"], 0.0) * np.sign(m.displacement)
    ),
    "hardening.contact": lambda p: beside(
        lambda m, i: (
            p["k"]
            * S.displacement ** (1.0 - p["n"])
            * np.maximum(np.abs(m.displacement) - p["u0"], 0.0) ** p["n"]
            * np.sign(m.displacement)
        )
    ),
    "limit.force": lambda p: limited(p, -1.0, 1.0),
    "limit.force_positive": lambda p: limited(p, -np.inf, 1.0),
    "limit.force_negative": lambda p: limited(p, -1.0, np.inf),
    "limit.range": lambda p: each(lambda m, i: np.clip(law(m.displacement, m.velocity), -p["F_l"], p["F_l"])),
    "linearity.odd": lambda p: whole(lambda m, i: 1.0 + p["a"] * np.abs(law(m.displacement, m.velocity)) / S.force),
    "linearity.even": lambda p: whole(lambda m, i: 1.0 + p["a"] * law(m.displacement, m.velocity) / S.force),
    "reversibility.rayleigh": plays,
    "hardening.exponential": lambda p: beside(
        lambda m, i: (
            p["k_r"]
            * m.displacement
            * np.expm1((m.displacement / p["u0"]) ** 2)
            / np.expm1((S.displacement / p["u0"]) ** 2)
        )
    ),
    "hardening.saturating": lambda p: beside(lambda m, i: p["F_s"] * np.tanh(m.displacement / p["u0"])),
    "pinching.slip": lambda p: whole(
        lambda m, i: 1.0 - p["d"] * np.exp(-((m.displacement / (p["w"] * np.maximum(largest()[i], 1e-12))) ** 2))
    ),
    "one_sided.spring_positive": lambda p: sided(p, 1.0),
    "one_sided.spring_negative": lambda p: sided(p, -1.0),
    "one_sided.contact_positive": lambda p: contact(p, 1.0),
    "one_sided.contact_negative": lambda p: contact(p, -1.0),
    "one_sided.factor_positive": lambda p: whole(lambda m, i: 1.0 + p["b"] * (m.displacement > 0.0)),
    "one_sided.factor_negative": lambda p: whole(lambda m, i: 1.0 + p["b"] * (m.displacement < 0.0)),
    "one_sided.force_positive": lambda p: whole(lambda m, i: 1.0 + p["b"] * (law(m.displacement, m.velocity) > 0.0)),
    "one_sided.force_negative": lambda p: whole(lambda m, i: 1.0 + p["b"] * (law(m.displacement, m.velocity) < 0.0)),
    "one_sided.valve_positive": lambda p: whole(lambda m, i: valve(p, m.velocity)),
    "one_sided.valve_negative": lambda p: whole(lambda m, i: valve(p, -m.velocity)),
    "one_sided.valve_positive_dashpots": lambda p: each(
        lambda m, i: K * m.displacement + valve(p, m.velocity) * C * m.velocity
    ),
    "one_sided.even": lambda p: beside(
        lambda m, i: p["k"] * np.abs(m.displacement) * (np.abs(m.displacement) / S.displacement) ** (p["n"] - 1.0)
    ),
    "relaxation_branch.maxwell": maxwell,
    "velocity_exponent.dashpot": lambda p: beside(
        lambda m, i: p["F_V"] * np.abs(m.velocity / S.velocity) ** p["alpha"] * np.sign(m.velocity)
    ),
    "velocity_exponent.position": lambda p: beside(
        lambda m, i: (
            p["F_V"]
            * (np.abs(m.displacement) / S.displacement) ** p["q"]
            * np.abs(m.velocity / S.velocity) ** p["alpha"]
            * np.sign(m.velocity)
        )
    ),
    "velocity_exponent.flow": lambda p: beside(lambda m, i: p["f"] * np.arcsinh(m.velocity / p["v0"])),
    "temperature_law.exponential": lambda p: temperature(p, 0.0),
    "temperature_law.wlf": lambda p: temperature(p, p["c"]),
    "temperature_law.transition": transition,
    "temperature_law.shift": lambda p: shift(p, 0.0),
    "temperature_law.shift_wlf": lambda p: shift(p, p["c"]),
    "self_heating.rate": lambda p: worked(p, lambda q: np.exp(-q), p["beta"], p["tau_h"], False),
    "degradation.energy": lambda p: worked(
        p, lambda e: 1.0 + p["d"] * np.expm1(-((max(e, 0) / p["E0"]) ** p["q"])), 1.0, np.inf, True
    ),
    "degradation.path": lambda p: whole(lambda m, i: 1.0 + p["d"] * np.expm1(-((paths()[i] / p["s0"]) ** p["q"]))),
    "ageing.linear": lambda p: whole(lambda m, i: 1.0 + p["rate"] * i),
    "ageing.logarithmic": lambda p: whole(lambda m, i: 1.0 + p["rate"] * np.log(1.0 + i / p["n0"])),
    "friction.coulomb": lambda p: beside(lambda m, i: p["F_c"] * np.tanh(m.velocity / p["v0"])),
    "friction.stribeck": lambda p: beside(
        lambda m, i: (
            p["F_c"] * (1.0 + p["s"] * np.exp(-((m.velocity / p["v_s"]) ** 2))) * np.tanh(10.0 * m.velocity / p["v_s"])
        )
    ),
    "friction.loaded": lambda p: beside(
        lambda m, i: (p["F_c"] + p["mu"] * np.abs(law(m.displacement, m.velocity))) * np.tanh(m.velocity / p["v0"])
    ),
    "static_offset.pre_shear": lambda p: moved(lambda m: m.displacement + p["offset"], lambda m: m.velocity),
    "static_offset.pre_shear_tared": lambda p: moved(lambda m: m.displacement, lambda m: m.velocity),
    "static_offset.axial_load": lambda p: each(
        lambda m, i: (1.0 - p["q"]) * K * m.displacement + (1.0 + p["q"]) * C * m.velocity
    ),
    "static_offset.p_delta": lambda p: beside(lambda m, i: -p["P_over_h"] * m.displacement),
    "lag.displacement_filter": lambda p: moved(
        lambda m: m.displacement + p["time_constant"] * m.velocity,
        lambda m: m.velocity + p["time_constant"] * m.acceleration,
    ),
    "offset.constant": lambda p: beside(lambda m, i: p["offset"]),
    "drift.per_test_line": lambda p: beside(lambda m, i: p["rate"] * m.time),
    "drift.campaign": elapsed,
    "drift.displacement": lambda p: moved(
        lambda m: m.displacement - p["rate"] * m.time, lambda m: m.velocity - p["rate"]
    ),
    "inertia.mass": lambda p: beside(lambda m, i: p["mass"] * m.acceleration),
    "condition.force_of_V": lambda p: beside(lambda m, i: p["offset"] * (VOLTS[i] - 1.25) / 3.0),
    "condition.factor_of_V": lambda p: whole(lambda m, i: 1.0 + p["b"] * (VOLTS[i] - 1.25) / 3.0),
    "condition.factor_and_dashpot_of_V": lambda p: each(
        lambda m, i: (
            (1.0 + p["b"] * (VOLTS[i] - 1.25) / 3.0) * law(m.displacement, m.velocity)
            + p["F_V"]
            * (1.0 + p["b_v"] * (VOLTS[i] - 1.25) / 3.0)
            * np.abs(m.velocity / S.velocity) ** p["alpha"]
            * np.sign(m.velocity)
        )
    ),
    "gain.force": lambda p: gained(p, 1),
    "gain.displacement": lambda p: scaled(p, 1),
    "gain.force_from_test_3": lambda p: gained(p, 3),
    "gain.displacement_from_test_3": lambda p: scaled(p, 3),
    "gain.force_of_test_2": lambda p: gained(p, 2, 2),
    "gain.displacement_of_test_4": lambda p: scaled(p, 4, 4),
    "clock.of_test_3": lambda p: each(
        lambda m, i: K * m.displacement + C * m.velocity * (1.0 + p["g"] if i == 2 else 1.0)
    ),
}
TOLERANCES = {
    "relaxation_branch.maxwell": 1e-6,  # midpoints of 40 steps
    "velocity_exponent.dashpot": 1e-9,
    "velocity_exponent.position": 1e-9,
}


def offered(label: str):
    (found,) = (one for one in PROBLEM.effects if one.label == label)
    return found


def predicted(effect, start: Sequence[float]) -> tuple[P, Forces]:
    model = PROBLEM.model((effect,), ("fit", "validate"))
    (found,) = model.forces(np.array([[*(one.centre for one in PROBLEM.base), *start]]))
    assert not isinstance(found, PredictionError), found
    return effect.data.values(start), found


@pytest.mark.parametrize("label", EQUATIONS)
def test_the_force_follows_the_equation(label):
    effect = offered(label)
    for start in effect.starts[:3]:
        if effect.data.values(start).get("recovery"):
            continue  # nothing is forgotten between tests in the equations here
        start = [0.6 if one.name == "q" else value for one, value in zip(effect.parameters, start, strict=True)]
        p, found = predicted(effect, start)
        for one, expected in zip(found, EQUATIONS[label](p), strict=True):
            assert np.max(np.abs(one - expected)) < TOLERANCES.get(label, 1e-9) * S.force


@pytest.mark.parametrize("label", ["mullins.path", "mullins.elastic", "mullins.maximum", "mullins.damage"])
def test_a_specimen_that_recovers_is_as_virgin_in_each_test(label):
    effect = offered(label)
    start = effect.starts[-1]
    assert start[-1] == 1.0
    _, found = predicted(effect, start)
    for i, force in enumerate(found):
        alone = PROBLEM.with_experiments([PROBLEM.experiments[i]]).prediction
        base = dict(PROBLEM.declared)
        (expected,) = alone.predict([(base, [(effect.data, effect.data.values(start))])], (0,))
        assert np.max(np.abs(force - expected[0])) < 1e-9 * S.force


def interior_rate(values: np.ndarray, time: np.ndarray) -> np.ndarray:
    return np.gradient(values, time, edge_order=2)


RIGS: dict[str, Callable[[P, np.ndarray, np.ndarray], np.ndarray]] = {
    "series_flexibility.linear": lambda p, e, rate: p["stiffness"] * e,
    "series_flexibility.damped": lambda p, e, rate: p["stiffness"] * (e + p["t_r"] * rate),
    "series_flexibility.stiffening": lambda p, e, rate: p["stiffness"] * e * (1.0 + (e / p["e0"]) ** 2),
    "series_flexibility.power": lambda p, e, rate: (
        p["F_r"] * np.sign(e) * np.abs(e * p["stiffness"] / p["F_r"]) ** p["n"]
    ),
    "series_flexibility.closing": lambda p, e, rate: (
        p["stiffness"] * np.clip(e, -p["F_c"] / p["stiffness"], p["F_c"] / p["stiffness"])
        + p["ratio"] * p["stiffness"] * np.sign(e) * np.maximum(np.abs(e) - p["F_c"] / p["stiffness"], 0.0)
    ),
    "play.gap": lambda p, e, rate: p["stiffness"] * np.sign(e) * np.maximum(np.abs(e) - 0.5 * p["play"], 0.0),
    "play.gap_seated": lambda p, e, rate: (
        2.0 * p["F_c"] / p["play"] * np.clip(e, -0.5 * p["play"], 0.5 * p["play"])
        + p["stiffness"] * np.sign(e) * np.maximum(np.abs(e) - 0.5 * p["play"], 0.0)
    ),
}
RIGS["play.closing"] = RIGS["series_flexibility.closing"]


@pytest.mark.parametrize("label", RIGS)
def test_what_a_rig_carries_is_what_the_damper_does(label):
    """The stretch e that the damper's force asks for follows from K (u - e) + C (u - e)' = F by small steps; a rig with
    that stretch carries F."""
    effect = offered(label)
    p, found = predicted(effect, effect.starts[1 if "gap" in label else -1])
    for m, force in zip(MOTIONS, found, strict=True):
        fine = np.linspace(m.time[0], m.time[-1], 20 * (m.time.size - 1) + 1)
        f = np.interp(fine, m.time, force)
        own, h = np.zeros_like(fine), fine[1] - fine[0]
        for j in range(1, fine.size):
            own[j] = (own[j - 1] + h / C * 0.5 * (f[j] + f[j - 1]) - 0.5 * h * K / C * own[j - 1]) / (
                1.0 + 0.5 * h * K / C
            )
        e = m.displacement - own[::20]
        carried = RIGS[label](p, e, interior_rate(e, m.time))
        # the force is a chord between samples here: least sharp where a clearance closes
        assert np.sqrt(np.mean((carried - force) ** 2)) < 0.05 * np.sqrt(np.mean(force**2))


def test_backlash_rests_until_its_play_is_crossed():
    effect = offered("play.backlash")
    for start in effect.starts[:3]:
        p, found = predicted(effect, start)
        for one, expected in zip(found, follow(p), strict=True):
            # but for the few samples at which it begins to rest or to go along, whose velocity is neither
            assert np.quantile(np.abs(one - expected), 0.97) < 1e-3 * S.force


def test_a_delay_has_the_force_of_an_earlier_moment():
    effect = offered("lag.delay")
    lag = 0.0123
    _, found = predicted(effect, (lag,))
    for m, force in zip(MOTIONS, found, strict=True):
        early = np.interp(m.time - lag, m.time, law(m.displacement, m.velocity))
        # chords of the force between samples, from rest on
        assert np.max(np.abs(force - early)[10:]) < 2e-3 * S.force


def test_a_lag_of_one_test_is_that_of_all_tests_in_it():
    (_, late), (_, one), (_, none) = (
        predicted(offered(label), (lag,))
        for label, lag in (("lag.delay", 0.01), ("lag.delay_of_test_2", 0.01), ("lag.delay", 0.0))
    )
    for i, found in enumerate(one):
        assert np.max(np.abs(found - (late if i == 1 else none)[i])) < 1e-9 * S.force


def test_a_misread_temperature_of_one_test_is_another_temperature_there():
    read, true = (problem("mgmm", degrees=(20.0, warm, 31.0, 24.0)) for warm in (26.0, 18.5))
    (effect,) = (one for one in read.effects if one.label == "thermometer.of_test_2")
    base = [one.centre for one in read.base]
    (found,), (expected,) = (
        of.model(effects, ("fit", "validate")).forces(np.array([[*base, *size]]))
        for of, effects, size in ((read, (effect,), (7.5,)), (true, (), ()))
    )
    for one, other in zip(found, expected, strict=True):
        assert np.array_equal(one, other)


@pytest.mark.parametrize("label", ["lag.filter", "lag.second_order", "inertia.sprung"])
def test_filters_obey_their_differential_equations(label):
    effect = offered(label)
    p, found = predicted(effect, effect.starts[0])
    for m, force in zip(MOTIONS, found, strict=True):
        true = law(m.displacement, m.velocity)
        out, given = (force - true, p["mass"] * m.acceleration) if "mass" in p else (force, true)
        rate = interior_rate(out, m.time)
        if label == "lag.filter":
            left = out + p["time_constant"] * rate
        else:
            w = 2.0 * np.pi * p["f"]
            left = out + 2.0 * p["zeta"] / w * rate + interior_rate(rate, m.time) / w**2
        # second differences at the samples
        assert np.max(np.abs(left - given)[20:-20]) < 5e-3 * np.max(np.abs(given))


def test_a_lag_that_grows_is_that_of_each_moment():
    effect = offered("lag.growing")
    p, found = predicted(effect, (0.004, 0.006, 0.001))
    for i, (m, force) in enumerate(zip(MOTIONS, found, strict=True)):
        lag = 0.004 + 0.006 * i / 4.0 + 0.001 * m.time
        u = np.interp(m.time - lag, m.time, m.displacement)
        v = (1.0 - 0.001) * np.interp(m.time - lag, m.time, m.velocity)
        assert np.max(np.abs(force - law(u, v))[10:]) < 2e-3 * S.force


def test_heat_that_is_carried_cools_over_the_rest():
    effect = offered("self_heating.carried")
    p, found = predicted(effect, effect.starts[1])
    q = 0.0
    for m, force in zip(MOTIONS, found, strict=True):
        given, total = law(m.displacement, m.velocity), np.zeros_like(m.time)
        total[0] = np.exp(-q) * given[0]
        for j in range(1, total.size):
            total[j] = np.exp(-q) * given[j]
            work = 0.5 * (total[j] + total[j - 1]) * (m.displacement[j] - m.displacement[j - 1])
            q = q * np.exp(-m.steps[j - 1] / p["tau_h"]) + p["beta"] * work
        q *= np.exp(-p["rest"] / p["tau_h"])
        assert np.max(np.abs(force - total)) < 1e-9 * S.force


def test_friction_that_builds_up_slides_in_the_end():
    """Dahl: x0 z' = v - |v| z |z|^(n-1), by small steps along the path; of n = 40 elastic up to x0, then plastic."""
    effect = offered("friction.presliding")
    for n in (1.0, 2.5, 40.0):
        slides(*predicted(effect, (*effect.starts[1][:2], n)))


def elastic_plastic(u: np.ndarray, length: float) -> np.ndarray:
    """Force (n,) over its yield force: up to that a spring, whose rest length goes along beyond it."""
    z = np.zeros_like(u)
    for j in range(1, u.size):
        z[j] = np.clip(z[j - 1] + (u[j] - u[j - 1]) / length, -1.0, 1.0)
    return z


def slides(p: P, found: Forces) -> None:
    for m, force in zip(MOTIONS, found, strict=True):
        z, fine = np.zeros_like(m.time), 50
        for j in range(1, z.size):
            way = (m.displacement[j] - m.displacement[j - 1]) / fine
            z[j] = z[j - 1]
            for _ in range(fine):
                z[j] += (way - abs(way) * z[j] * abs(z[j]) ** (p["n"] - 1.0)) / p["x0"]
        if p["n"] > 10.0:
            assert np.max(np.abs(z - elastic_plastic(m.displacement, p["x0"]))) < 0.1
        # the way between samples is taken as monotone here; a turning point lies between a few of them
        left = force - law(m.displacement, m.velocity) - p["F_c"] * z
        assert np.quantile(np.abs(left), 0.97) < 0.05 * p["F_c"]


def test_gas_is_compressed_by_the_rod_of_a_fluid_damper():
    fluid = problem("viscous_power", 3)
    (effect,) = [one for one in fluid.effects if one.label == "gas_spring.polytropic"]
    for start in effect.starts:
        model = fluid.model((effect,))
        (found,) = model.forces(np.array([[*(one.centre for one in fluid.base), *start]]))
        (plain,) = fluid.model(()).forces(np.array([[one.centre for one in fluid.base]]))
        for i, one, other in zip(model.tests, found, plain, strict=True):
            room = 1.0 - start[1] * fluid.experiments[i].motion.displacement
            # P V^n = constant; the difference of two forces
            assert np.max(np.abs(one - other - start[0] * room**-1.2)) < 1e-9 * fluid.typical.force


@pytest.mark.parametrize(
    ("label", "columns"),
    [
        ("offset.per_test", [lambda t: np.ones_like(t)]),
        ("drift.each_own", [lambda t: t / t[-1]]),
        ("drift.warming", [lambda t: t / t[-1], lambda t: 1.0 - np.exp(-4.0 * t / t[-1])]),
        ("hum.tone", [lambda t: np.sin(100.0 * np.pi * t), lambda t: np.cos(100.0 * np.pi * t)]),
        ("hum.two_tones", [lambda t: np.sin(100.0 * np.pi * t), lambda t: np.sin(62.0 * np.pi * t)]),
        ("hum.harmonics", [lambda t: np.sin(62.0 * np.pi * t), lambda t: np.cos(186.0 * np.pi * t)]),
    ],
)
def test_nuisance_amplitudes_are_five_per_cent_of_the_force(label, columns):
    effect = offered(label)
    model = PROBLEM.model((effect,))
    found = model.nuisance_columns(np.array([one.centre for one in model.parameters]))
    for m, own, weights in zip(MOTIONS, found, model.weights, strict=False):
        for column in columns:
            expected = 0.05 * S.force * weights * column(m.time)
            nearest = min(np.max(np.abs(one - expected)) for one in own.T)
            assert nearest < 1e-9 * S.force


def test_every_form_is_checked_here_or_by_the_core():
    """Placements are those of the core's effects, which have tests of their own; the MGMM has its gamma_T alone."""
    known = {*EQUATIONS, *RIGS, "lag.delay", "lag.filter", "lag.second_order", "lag.growing", "inertia.sprung"}
    known |= {"offset.per_test", "drift.each_own", "drift.warming", "hum.tone", "hum.two_tones", "hum.harmonics"}
    known |= {"self_heating.carried", "friction.presliding", "play.backlash"}
    known |= {"gas_spring.polytropic", "condition.parameter_of_V", "condition.gas_of_V"}
    known |= {"hysteresis.stretch"}
    known |= {"extremes.lasting"}
    endings = ("_inside", "_springs", "_dashpots", "_in_place")
    for form in forms(S):
        plain = form.label
        for ending in endings:
            plain = plain.removesuffix(ending)
        of_one = ("clock.of_test_", "lag.delay_of_test_", "thermometer.of_test_")
        assert plain in known or plain.startswith(("gain.", "temperature_law.gamma", *of_one)), form.label


@pytest.mark.parametrize("effect", PROBLEM.effects, ids=lambda one: one.label)
def test_an_effect_remembers_if_the_core_keeps_a_state_of_it(effect):
    """A state more than that of a constant factor, which has none of its own."""
    none = CoreDamper("kelvin_voigt", (K, C), effects=[EffectValues("constant", (1.1,))]).start().size
    p, test = effect.data.values(effect.starts[0]), PROBLEM.experiments[1]
    for one in effect.data.form.core_effects:
        if one.placement is Placement.WHOLE:
            kept = CoreDamper("kelvin_voigt", (K, C), effects=[one.in_test(p, test)]).start().size
            assert one.remembers == (kept > none)
