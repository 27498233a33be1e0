"""The blind tests' own integrator against edesign's law, and forms of hidden effects against closed forms."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from blind import law
from blind.effects.base import Effect
from blind.effects.friction import Dahl, LuGre, Smoothed
from blind.effects.inertia import Rigid
from blind.effects.lag import FirstOrder, ForceLate, SecondOrder
from blind.effects.payne import Network
from blind.effects.play import Gap
from blind.effects.relaxation_branch import Slow
from blind.effects.self_heating import Exponential
from blind.effects.series_flexibility import Linear, Shims, Stiffening
from blind.effects.static_offset import PreShear
from blind.laboratory import observe, predicted
from blind.programme import Trial, programme
from blind.series import Changes, deformation, power_root
from edesign.damper.damper import Damper
from edesign.damper.laws import law as edesign_law
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaT, at

SPRING = {**law.TABLE_4_2, "c_NL": 1e-9, "k_a": 0.0, "c_a": 0.0, "c_b": 0.0, "c1": 1e-9, "k1": 1e-6}
"""Next to nothing but k0 + k_b = 3.72 kN/mm; tau is 1 ms."""


def sine(
    frequency: float,
    amplitude: float,
    seconds: float,
    rate: float = 2000.0,
    temperature: float = 20.0,
    pause: float = 0.0,
) -> Trial:
    t = np.arange(int(seconds * rate) + 1) / rate
    ramp = np.clip(t * frequency, 0.0, 1.0)
    x = amplitude * ramp * ramp * (3.0 - 2.0 * ramp) * np.sin(2.0 * np.pi * frequency * t)
    return Trial(0, 1, "validate", "", x, 1.0 / rate, 1, temperature, pause)


def made(form: type[Effect], tests: Sequence[Trial], size: float, **values: float) -> Effect:
    effect = form(np.random.default_rng(1), tests)
    effect.size = size
    for name, value in values.items():
        setattr(effect, name, value)
    return effect


def last_cycle(test: Trial, frequency: float) -> slice:
    return slice(test.n - 1 - round(1.0 / (frequency * test.h)), test.n)


def work(force: np.ndarray, x: np.ndarray) -> float:
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(x)))


def test_package_knows_nothing_of_edesign() -> None:
    files = sorted(Path(law.__file__).parent.rglob("*.py"))
    assert len(files) > 30
    for path in files:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            names += [alias.name for alias in node.names] if isinstance(node, ast.Import) else []
            assert not any(name.split(".")[0] == "edesign" for name in names), path


@pytest.mark.parametrize("seed", [3, 4])
def test_law_against_edesign(seed: int) -> None:
    """All motions of two programmes at their temperatures; edesign's exact quadrature is fed with the same steps.

    3e-4 of the peak: both rules are second order, at 2 kHz, and the power of the velocity begins with infinite slope.
    """
    mgmm = edesign_law("mgmm")
    values = read_parameters(mgmm, "thesis_table_4_2")
    for test, force in zip(
        tests := programme(np.random.default_rng(seed), temperatures=seed == 4),
        predicted(law.TABLE_4_2, tests),
        strict=True,
    ):
        warm, _ = at(mgmm, values, test.temperature, GammaT())
        right = 1e-3 * Damper(mgmm, warm).force(test.t, 1e-3 * test.x)
        assert np.abs(force - right).max() < 3e-4 * np.abs(right).max(), test.title


@pytest.mark.parametrize(("form", "more"), [(Smoothed, 1e-2), (Dahl, 1e-2), (LuGre, 3e-2)])
def test_friction_takes_four_forces_times_amplitude_in_a_cycle(form: type[Effect], more: float) -> None:
    """W = 4 F_c A; what bristles and smoothing round off is below 1 % for A of 200 times the presliding way."""
    test = sine(1.0, 4.0, 4.0)
    quick = {"smooth": 0.05} if form is Smoothed else {"presliding": 0.02, "stick": 1.2, "stribeck": 2.0}
    force = observe(law.TABLE_4_2, [test], [made(form, [test], 2.5, **quick)])[1][0]
    added = force - predicted(law.TABLE_4_2, [test])[0]
    cycle = last_cycle(test, 1.0)
    assert work(added[cycle], test.x[cycle]) == pytest.approx(4.0 * 2.5 * 4.0, rel=more)


@pytest.mark.parametrize("stiffness", [2.0, 30.0])
def test_flexibility_in_series_with_a_spring(stiffness: float) -> None:
    """1/k = 1/k_damper + 1/k_rig; the relaxation of 1 ms shifts by less than 1 % of the peak at 1 Hz."""
    test = sine(1.0, 5.0, 2.0)
    force = observe(SPRING, [test], [made(Linear, [test], 1.0 / stiffness)])[1][0]
    k = 1.0 / (1.0 / (SPRING["k0"] + SPRING["k_b"]) + 1.0 / stiffness)
    assert np.abs(force - k * test.x).max() < 0.01 * np.abs(force).max()


@pytest.mark.parametrize(
    ("form", "size"), [(Linear, 0.02), (Stiffening, 0.02), (Shims, 0.02), (Gap, 0.4), (Linear, 1e-6)]
)
def test_joint_and_damper_carry_the_same_force(form: type[Effect], size: float) -> None:
    """The deformation found, put into the law alone, gives the force of the joint. 0.2 % of the peak while extremes
    grow, which are looked ahead by half a step of 0.5 ms; 1e-6 in the sum of squares."""
    test = sine(2.0, 4.0, 3.0)
    joint = made(form, [test], size).joint()
    assert joint is not None
    one, none = np.ones(test.n - 1), np.zeros(test.n - 1)
    u = deformation(law.TABLE_4_2, test.x, test.h, joint, Changes(one, one, one, none, np.zeros(test.n)))
    force = law.force(law.TABLE_4_2, u, test.h)
    carried = np.array([joint(w)[0] for w in test.x - u])
    assert np.abs(force - carried).max() < 2e-3 * np.abs(force).max()
    assert np.sum((force - carried) ** 2) < 1e-6 * np.sum(force**2)


def test_root_of_line_and_power() -> None:
    """Put back into its equation, from any guess; at rest the power has an infinite slope."""
    rng = np.random.default_rng(1)
    for _ in range(2000):
        m, d, alpha = 10.0 ** rng.uniform(-3, 3), 10.0 ** rng.uniform(-6, 2), rng.uniform(0.3, 0.45)
        right, guess = (
            rng.choice([-1.0, 1.0]) * 10.0 ** rng.uniform(-20, 3),
            rng.choice([-1.0, 0.0, 1.0]) * 10.0 ** rng.uniform(-9, 3),
        )
        v = power_root(m, d, alpha, right, guess)
        assert m * v + d * abs(v) ** alpha * np.sign(v) == pytest.approx(right, rel=1e-6, abs=0.0)
    assert power_root(1.0, 1.0, 0.374, 0.0, 3.0) == 0.0
    assert abs(power_root(1.0, 1.0, 0.374, 1e-200, 3.0)) < 1e-50


def test_play_leaves_the_spring_free_in_the_gap() -> None:
    """A spring behind a gap of 1 mm, entered half-way: k (|x| - 0.5 mm), nothing in between."""
    test = sine(0.5, 4.0, 4.0)
    force = observe(SPRING, [test], [made(Gap, [test], 1.0, contact=1e5)])[1][0]
    k = SPRING["k0"] + SPRING["k_b"]
    right = k * np.sign(test.x) * np.maximum(np.abs(test.x) - 0.5, 0.0)
    assert np.abs(force - right).max() < 0.02 * k * 4.0  # the relaxation of 1 ms


def test_lag_shifts() -> None:
    """A delay of d turns the fundamental by w d; filters do so by their phase."""
    test = sine(1.5, 4.0, 6.0)
    w = 2.0 * np.pi * 1.5
    cycle = slice(test.n - 1 - round(2.0 / (1.5 * test.h)), test.n - 1)

    def phase(force: np.ndarray) -> float:
        return float(np.angle(np.sum(force[cycle] * np.exp(-1j * w * test.t[cycle]))))

    alone = phase(predicted(law.TABLE_4_2, [test])[0])
    d = 0.008
    zeta = 0.87
    own = 2.0 * zeta / d
    expected = {
        ForceLate: w * d,
        FirstOrder: np.arctan(w * d),
        SecondOrder: np.arctan2(2.0 * zeta * w / own, 1.0 - (w / own) ** 2),
    }
    for form, turn in expected.items():
        late = phase(observe(law.TABLE_4_2, [test], [made(form, [test], d)])[1][0])
        assert alone - late == pytest.approx(turn, rel=2e-3), form.form


def test_mass_adds_its_acceleration() -> None:
    test = sine(2.0, 3.0, 3.0)
    force = observe(law.TABLE_4_2, [test], [made(Rigid, [test], 0.5)])[1][0]
    added = (force - predicted(law.TABLE_4_2, [test])[0])[last_cycle(test, 2.0)]
    assert np.abs(added[2:-2]).max() == pytest.approx(0.5 * (2.0 * np.pi * 2.0) ** 2 * 3e-3, rel=1e-3)  # t m/s2 = kN


def test_branch_dissipates_its_loss_modulus() -> None:
    """pi k'' A^2 a cycle, k'' = k w tau/(1 + w^2 tau^2), once the start is forgotten."""
    test = sine(1.0, 3.0, 6.0)
    w, tau = 2.0 * np.pi, 0.4
    added = made(Slow, [test], 2.0, tau=tau).parallel([test], [test.x])
    assert added is not None
    cycle = last_cycle(test, 1.0)
    loss = 2.0 * w * tau / (1.0 + (w * tau) ** 2)
    assert work(added[0][cycle], test.x[cycle]) == pytest.approx(np.pi * loss * 9.0, rel=2e-3)


def test_network_reaches_its_balance() -> None:
    """Under a velocity the same throughout, the whole share tends to 1/(1 + heal |v|/path)."""
    t = np.arange(40001) / 2000.0
    test = Trial(0, 1, "fit", "", 5.0 * t, 5e-4, 1, 20.0, 0.0)
    factors = made(Network, [test], 0.5, heal=2.0, path=20.0).factors([test], [test.x], [test.x])
    assert factors is not None
    whole = 1.0 / (1.0 + 2.0 * 5.0 / 20.0)
    assert np.asarray(factors[0][0])[-1] == pytest.approx(1.0 - 0.5 * (1.0 - whole), rel=1e-6)


def test_heat_is_the_work_where_nothing_cools() -> None:
    """Work of all cycles over the heat capacity, and what is left of it after a pause."""
    test = sine(1.0, 5.0, 8.0)
    again = Trial(1, 2, "fit", "", test.x, test.h, 1, 20.0, pause=1e6 * np.log(2.0))
    force = predicted(law.TABLE_4_2, [test])[0]
    effect = made(Exponential, [test], 0.1, capacity=1000.0, cooling=1e6)
    warmth = effect.warmth([test, again], [test.x] * 2, [force] * 2)  # type: ignore[attr-defined]
    rise = work(force, test.x) / 1000.0  # kN mm = J
    assert warmth[0][-1] == pytest.approx(rise, rel=0.08)  # power is smoothed over half a second of eight
    assert warmth[1][0] == pytest.approx(0.5 * warmth[0][-1], rel=1e-6)


def test_pre_shear_starts_at_rest() -> None:
    """Nothing moves, nothing changes: the force is the long-time stiffness times the pre-shear."""
    test = Trial(0, 1, "fit", "", np.zeros(2001), 5e-4, 1, 20.0, 0.0)
    effect = made(PreShear, [test], 2.0, side=1.0)
    force = observe(law.TABLE_4_2, [test], [effect])[1][0]
    p = law.TABLE_4_2
    k = p["k0"] + p["k_b"] + p["k_a"] * np.exp(-1.0 / p["u_ref"])
    assert force == pytest.approx(np.full(2001, 2.0 * k), rel=1e-9)
