"""What belongs to single tests: told starts, zeros and hum, against what closed forms put there."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.calibration.results.fit import unbounded
from edesign.calibration.results.nuisances import nuisances_of
from edesign.calibration.results.predictions import predicted
from edesign.calibration.results.result import OfTests
from edesign.calibration.search.models import FittedModel
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.laws import law
from edesign.damper.testing.start import Start
from edesign.estimation.noise import Noise

K0, K1, C1 = 2.0e6, 3.0e6, 0.6e6  # N/m, N s/m: a spring beside a Maxwell element of tau = 0.2 s
NOISE, TONE = 60.0, 50.0  # N, Hz
T = np.arange(0.0, 4.0, 1.0 / 400.0)
MOVING = (1, 2)  # of four tests; the last one validates


def zener(amplitude: float, frequency: float, phase: float, before: float) -> tuple[Motion, np.ndarray]:
    """Motion a sin(w t + p), and the force with `before` in the Maxwell element at first; in closed form.

    dF/dt + F/tau = k1 a w cos(w t + p) has F = (before - G(0)) exp(-t/tau) + G(t), with
    G = k1 a w tau (cos(w t + p) + w tau sin(w t + p)) / (1 + (w tau)^2).
    """
    w, tau = 2.0 * np.pi * frequency, C1 / K1
    sine, cosine = np.sin(w * T + phase), np.cos(w * T + phase)
    motion = Motion(T, amplitude * sine, amplitude * w * cosine, -amplitude * w**2 * sine)
    steady = K1 * amplitude * w * tau * (cosine + w * tau * sine) / (1.0 + (w * tau) ** 2)
    return motion, K0 * motion.displacement + steady + (before - steady[0]) * np.exp(-T / tau)


def campaign(seed: int) -> tuple[DamperProblem, dict[str, dict[str, float]]]:
    """Tests with initial forces, zeros and hum that are drawn, and what these are."""
    random = np.random.default_rng(seed)
    experiments: list[Experiment] = []
    truth: dict[str, dict[str, float]] = {"start": {}, "zero": {}, "amplitude": {}, "phase": {}}
    tone = TONE + random.uniform(-0.02, 0.02)
    for order in range(4):
        name = f"test {order + 1}"
        moving = order in MOVING
        before = 4e3 * random.standard_normal() if moving else 0.0
        motion, force = zener(3e-3 + 1e-3 * order, 0.5 + 0.3 * order, random.uniform(-0.3, 0.3) * moving, before)
        zero, size, phase = 300.0 * random.standard_normal(), random.uniform(50.0, 200.0), random.uniform(-3.0, 3.0)
        force = force + zero + size * np.sin(2.0 * np.pi * tone * T + phase) + NOISE * random.standard_normal(T.size)
        if moving:
            truth["start"][name] = before
        truth["zero"][name], truth["amplitude"][name], truth["phase"][name] = zero, size, phase
        start = Start(float(motion.displacement[0]), float(motion.velocity[0]), 0.0, True) if moving else None
        use = "validate" if order == 3 else "fit"
        experiments.append(
            Experiment(name, use, order, 4.0 * order, motion, force, 20.0, channel_noise=NOISE, start=start)
        )
    truth["frequency"] = {"": tone}
    zener_law = law("zener")
    declared = zener_law.complete({"k0": 1.05 * K0, "k1": 0.95 * K1, "c1": 1.05 * C1})
    return DamperProblem(zener_law, declared, tuple(experiments), Sizes.of(experiments, (TONE,)), threads=1), truth


def told(problem: DamperProblem) -> dict[str, OfTests]:
    """What is told of the tests by the law with zeros and hum, fitted twice: nuisances are looked at near a law."""
    wanted = ("offset.per_test", "hum.tone")
    effects = [one for label in wanted for one in problem.effects if one.label == label]
    values = np.array(problem.start)
    for _ in range(3):
        near = dict(zip((one.name for one in problem.base), values.tolist(), strict=True))
        problem = replace(problem, near=near)
        model = unbounded(problem, SETTINGS).fit(effects, values, Noise.white(problem.deviations))
        assert isinstance(model, FittedModel)
        values = model.fit.values
    forces = predicted(problem, model.effects, model.fit.values)
    return {one.name if one.of != "start" else "start": one for one in nuisances_of(problem, model, forces)}


def distances(seed: int) -> dict[str, list[float]]:
    """Estimates less truth, in standard errors, by what they are of."""
    problem, truth = campaign(seed)
    found, far = told(problem), dict[str, list[float]]()
    far["start"] = [(one.value - truth["start"][name]) / one.error for name, one in found["start"].tests.items()]
    far["zero"] = [(one.value - truth["zero"][name]) / one.error for name, one in found["zero"].tests.items()]
    for name, one in found["hum"].tests.items():
        far.setdefault("amplitude", []).append((one.value - truth["amplitude"][name]) / one.error)
        turned = math.remainder(one.phase - truth["phase"][name], 2.0 * math.pi)
        far.setdefault("phase", []).append(turned / one.phase_error)
    frequency = found["hum"].frequency
    assert frequency is not None
    far["frequency"] = [(frequency.value - truth["frequency"][""]) / frequency.standard_error]
    return far


def test_starts_zeros_and_hum_are_found_within_their_errors() -> None:
    problem, truth = campaign(1)
    found = told(problem)
    assert list(found["start"].tests) == list(truth["start"]) and list(found["zero"].tests) == list(truth["zero"])
    # n samples of white noise: a mean is known to NOISE / sqrt(n), an amplitude to sqrt(2) times that
    assert all(NOISE / 40.0 < one.error < 1.5 * NOISE / 40.0 for one in found["zero"].tests.values())
    assert all(
        one.error == pytest.approx(math.sqrt(2.0) * NOISE / 40.0, rel=0.1) for one in found["hum"].tests.values()
    )
    # exp(-t/tau) alone of a force F0 at rate r: NOISE / sqrt(r tau / 2); parameters and the zero make it somewhat more
    least = NOISE / math.sqrt(400.0 * 0.2 / 2.0)
    assert all(least < one.error < 3.0 * least for one in found["start"].tests.values())
    assert all(abs(far) < 4.0 for of in distances(1).values() for far in of)


def test_errors_cover_the_truth() -> None:
    """Fifty initial forces, a hundred zeros and waves, 25 frequencies, drawn: two thirds within a standard error."""
    of = [distances(seed) for seed in range(25)]
    for name in of[0]:
        far = np.abs(np.concatenate([one[name] for one in of]))
        within, expected, n = np.mean(far < 1.959964), 0.95, far.size
        # binomial: three standard deviations either way
        assert within == pytest.approx(expected, abs=3.0 * math.sqrt(expected * (1.0 - expected) / n)), name
        assert np.mean(far < 1.0) == pytest.approx(0.683, abs=3.0 * math.sqrt(0.683 * 0.317 / n)), name
