"""Self-heating through gamma_T against thesis Eq. 4.29 with parameters that follow a heat balance, stepped."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.calibrate.dampers.effects import self_heating
from edesign.calibrate.dampers.left import Left
from edesign.calibrate.dampers.library import candidate_of
from edesign.calibrate.dampers.problem import DamperProblem
from edesign.calibrate.dampers.trial import Motion, Sizes, Trial
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.temperature import GammaOf

BETA, TAU_H, KEPT = 8e-5, 60.0, 0.4
FINE = 20  # steps of the reference between two samples


def swept(n: int) -> Motion:
    """An amplitude sweep at 1.5 Hz, 12 s long."""
    t = np.linspace(0.0, 12.0, n)
    size, w = 5e-3 * np.sin(np.pi * t / 12.0), 3.0 * np.pi
    rate = 5e-3 * np.pi / 12.0 * np.cos(np.pi * t / 12.0)
    u, v = size * np.sin(w * t), size * w * np.cos(w * t) + rate * np.sin(w * t)
    return Motion(t, u, v, np.gradient(v, t))


def stepped(values: dict[str, float], motion: Motion, q: float, of: GammaOf) -> tuple[np.ndarray, float]:
    """Force N of Eq. 4.29 in mm and kN with all parameters times exp(-q), q' = BETA F v - q/TAU_H; q at the end."""
    fine = np.linspace(motion.time[0], motion.time[-1], FINE * (motion.time.size - 1) + 1)
    u, v = (np.interp(fine, motion.time, a) * 1e3 for a in (motion.displacement, motion.velocity))
    h, tau = fine[1] - fine[0], values["c1"] / values["k1"]
    k0, k_a, k_b = (values[name] * 1e-6 for name in ("k0", "k_a", "k_b"))
    c1, c_a, c_b = (values[name] * 1e-6 for name in ("c1", "c_a", "c_b"))
    c_nl = values["c_NL"] * 1e-3 * 1e-3 ** values["alpha"]
    u_ref, v_ref = values["u_ref"] * 1e3, values["v_ref"] * 1e3
    force, found = 0.0, [0.0]
    top_u = low_u = top_v = low_v = 0.0
    for i in range(1, fine.size):
        um, vm = 0.5 * (u[i - 1] + u[i]), 0.5 * (v[i - 1] + v[i])
        top_u, low_u, top_v, low_v = max(top_u, um), min(low_u, um), max(top_v, vm), min(low_v, vm)
        g = np.exp(-q)
        shape, again = (1.0 if of == "force" else g), (g if of == "by_the_letter" else 1.0)
        k_mod = g * again * (k_a * np.exp(-0.5 * (top_u - low_u) / (shape * u_ref)) + k_b)
        c_mod = g * (c_a * np.exp(-0.5 * (top_v - low_v) / (shape * v_ref)) + c_b)
        right = (g * k0 + k_mod) * um + (tau * g * k0 + g * c1 + c_mod) * vm
        right += g * c_nl * abs(vm) ** (shape * values["alpha"]) * np.sign(vm)
        force += (right - force) * (1.0 - np.exp(-h / tau))
        q += h * (BETA * force * vm - q / TAU_H)  # kN mm/s are W
        found.append(force)
    return 1e3 * np.array(found)[::FINE], q


@pytest.mark.parametrize("of", ["parameters", "by_the_letter", "force"])
def test_two_tests_of_which_the_second_begins_warm(of: GammaOf) -> None:
    law = LAWS["mgmm"]
    values = read_parameters(law, "thesis_table_4_2")
    motion = swept(2401)
    expected, q = [], 0.0
    for _ in range(2):
        force, q = stepped(values, motion, q, of)
        expected.append(force)
        q *= KEPT
    trials = tuple(
        Trial(f"t{i}", "fit", i, motion, force, np.full(motion.time.size, 20.0)) for i, force in enumerate(expected)
    )
    problem = DamperProblem(law, values, trials, Sizes.of(trials), gamma_of=of)
    candidate = candidate_of(self_heating.Gamma(), problem.sizes, Left())
    assert candidate is not None
    p = {"beta": BETA, "tau_h": TAU_H, "kept": KEPT}
    part = (candidate, np.array([p[unknown.name] for unknown in candidate.unknowns]))
    found = problem.predict(problem.declared, (part,), ("fit",))
    plain = problem.predict(problem.declared, (), ("fit",))
    for force, own, without in zip(expected, found, plain, strict=True):
        assert own is not None and without is not None
        size = float(np.sqrt(np.mean(force**2)))
        assert np.sqrt(np.mean((without - force) ** 2)) > 0.05 * size
        # q, which rises by 0.03 in a second, is not quite still within tau = 0.03 s: 1e-3 at 2400 samples and at 4800
        assert np.sqrt(np.mean((own - force) ** 2)) < 1.5e-3 * size
