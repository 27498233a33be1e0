"""Problems of damper tests with motions in closed form, sampled so finely that they are predicted at their samples."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.calibration.dampers.experiment import Experiment
from edesign.calibration.dampers.motion import Motion
from edesign.calibration.dampers.problem import DamperProblem
from edesign.calibration.dampers.sizes import Sizes
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS
from edesign.damper.testing.measured_histories import Use

RATE = 250.0  # Hz: six times what a fit of 1 Hz needs
LAW_VALUES: dict[str, dict[str, float]] = {
    "kelvin_voigt": {"k": 4.0e6, "c": 2.0e5},
    "mgmm": {
        "k1": 0.515e6,
        "c1": 15.1e3,
        "k0": 0.107e6,
        "c_NL": 21e3,
        "alpha": 0.374,
        "k_a": 3.741e6,
        "k_b": 3.613e6,
        "u_ref": 7.966e-3,
        "c_a": 902e3,
        "c_b": 190e3,
        "v_ref": 13.468e-3,
    },
    "viscous_power": {"c": 1.0e5, "alpha": 0.5},
    "bouc_wen": {"Fy": 2.0e4, "Y": 1e-3, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.5},
}


def motion(order: int, duration: float = 3.0, rate: float = RATE) -> Motion:
    """Two sines that grow from rest, others in each test."""
    t = np.arange(0.0, duration, 1.0 / rate)
    f, amplitude = (0.5, 1.0, 0.7, 0.9)[order % 4], (3e-3, 5e-3, 8e-3, 2e-3)[order % 4]
    total = [np.zeros_like(t) for _ in range(3)]
    for part, w in ((0.7, 2.0 * np.pi * f), (0.3, 2.0 * np.pi * 1.3 * f)):
        g, g1, g2 = (
            (1.0 - np.exp(-t)) ** 2,
            2.0 * np.exp(-t) * (1.0 - np.exp(-t)),
            4.0 * np.exp(-2 * t) - 2 * np.exp(-t),
        )
        sine, cosine = np.sin(w * t), np.cos(w * t)
        total[0] += amplitude * part * g * sine
        total[1] += amplitude * part * (g1 * sine + w * g * cosine)
        total[2] += amplitude * part * (g2 * sine + 2.0 * w * g1 * cosine - w**2 * g * sine)
    return Motion(t, *total)


def problem(
    law: str = "kelvin_voigt",
    tests: int = 4,
    degrees: Sequence[float] = (20.0,),
    values: Mapping[str, float] | None = None,
    tones: Sequence[float] = (),
    refit: bool = True,
    lasting: bool = False,
    threads: int | None = None,
    conditions: Mapping[str, Sequence[float]] | None = None,
) -> DamperProblem:
    """A problem whose forces are those of the law; the last test validates. Conditions are listed test by test."""
    chosen = LAWS[law]
    declared = chosen.complete({**LAW_VALUES[law], **(values or {})})
    experiments, elapsed = [], 0.0
    for order in range(tests):
        moved = motion(order)
        force = Damper(chosen, declared).force(moved.time, moved.displacement)
        use: Use = "fit" if order < tests - 1 else "validate"
        warm = degrees[order % len(degrees)]
        declared_there = {name: values[order] for name, values in (conditions or {}).items()}
        experiments.append(
            Experiment(
                *(f"test {order + 1}", use, order, elapsed, moved, force, warm),
                channel_noise=10.0,
                conditions=declared_there,
            )
        )
        elapsed += float(moved.since[-1])
    return DamperProblem(
        chosen, declared, tuple(experiments), Sizes.of(experiments, tones), refit, lasting, threads=threads
    )
