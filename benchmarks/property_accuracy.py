"""Accuracy of `edesign.damper.testing.properties`: G', G_eq and n of loops with noise, against closed forms.

A spring K beside a dashpot: linear (Kelvin-Voigt), of a power of the velocity, or friction; and Zener in its steady
state. The share r of the dashpot is its largest force over that of the spring. With F = r |cos|^alpha sgn cos and the
spring sin: G' is the spring's, n = 2 r B(1 + alpha/2, 1/2) / pi, G_eq the largest of the sum (friction: alpha 0).
Strain 30 %, cycles 5 to 15 averaged. Noise is white: in per cent of the peak force and of the displacement amplitude.
Each seed also places the samples anew in the cycle, so cases without noise scatter too; no two cases share noise.
Columns: bias, which is the mean error, and standard deviation over the seeds, per cent.

The settings of the estimator (window widths, limits) were chosen on cases such as these, with other seeds: those used
here are from 1000 on, so the noise is noise the settings have not seen; the kinds of loops are not.

Usage: python -m benchmarks.property_accuracy [--seeds N]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.special import beta

from edesign.damper.testing.measured_histories import DamperTest
from edesign.damper.testing.properties import properties

# not as tests.*: another package may be installed by that name
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))
from verification.test_verify_properties import AMPLITUDE, CYCLES, MODULUS, RAMP, SPECIMEN, K, motion  # noqa: E402

FIRST_SEED = 1000
QUANTITIES = ("G_storage", "G_eq", "loss_factor")
Force = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]
"""Displacement and force at times in cycles."""


@dataclass(frozen=True)
class Loop:
    """A damper with known properties; `exact` in the order of `QUANTITIES`."""

    name: str
    history: Force
    exact: tuple[float, float, float]


def dashpot(name: str, alpha: float, share: float) -> Loop:
    """Spring beside a dashpot with a power alpha of the velocity; 1 is Kelvin-Voigt, 0 friction."""

    def history(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        u, v = motion(t, 1.0)
        relative = v / (2.0 * np.pi * AMPLITUDE)
        return u, K * u + share * K * AMPLITUDE * np.abs(relative) ** alpha * np.sign(relative)

    # x is the distance from the reversal, spaced for a maximum that is close to it
    x = np.geomspace(1e-9, 0.5 * np.pi, 400_001)
    largest = 1.0 + share if alpha == 0.0 else float(np.max(np.cos(x) + share * np.sin(x) ** alpha))
    factor = 2.0 * share * float(beta(1.0 + 0.5 * alpha, 0.5)) / np.pi
    return Loop(name, history, (MODULUS, largest * MODULUS, factor))


def zener() -> Loop:
    """Steady state from the complex modulus, without ramps."""
    stiff, branch, w_tau = 0.6e6, 0.9e6, 0.75
    modulus = stiff + branch * 1j * w_tau / (1.0 + 1j * w_tau)

    def history(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        turn = np.exp(2j * np.pi * t)
        return AMPLITUDE * turn.imag, SPECIMEN.stiffness(1.0) * AMPLITUDE * (modulus * turn).imag

    return Loop("Zener", history, (modulus.real, abs(modulus), modulus.imag / modulus.real))


def errors(loop: Loop, samples: int, force_noise: float, displacement_noise: float, seed: list[int]) -> np.ndarray:
    """Relative errors of `QUANTITIES` in one test at 1 Hz; samples a cycle, seed and number of the case."""
    generator = np.random.default_rng(seed)
    t = (np.arange((CYCLES + 2 * RAMP) * samples) + generator.random()) / samples
    u, f = loop.history(t)
    f = f + force_noise * np.max(np.abs(f)) * generator.standard_normal(t.size)
    u = u + displacement_noise * AMPLITUDE * generator.standard_normal(t.size)
    found = properties(DamperTest(loop.name, t, u, f), SPECIMEN)
    return np.array([getattr(found, name) for name in QUANTITIES]) / np.array(loop.exact) - 1.0


def cases() -> list[tuple[Loop, int, float, float]]:
    """Loop, samples a cycle, noise of force and of displacement."""
    kelvin_voigt = dashpot("Kelvin-Voigt", 1.0, 0.35)
    sharp = [dashpot(f"spring, power {alpha:g}", alpha, 0.3) for alpha in (0.2, 0.374, 0.7)]
    sharp.append(dashpot("spring, friction", 0.0, 0.2))
    rows = [
        (kelvin_voigt, samples, *noise)
        for noise in ((0.0, 0.0), (0.01, 0.0), (0.01, 0.01))
        for samples in (20, 100, 1000)
    ]
    rows += [(zener(), 250, noise, 0.0) for noise in (0.0, 0.01)]
    rows += [(loop, samples, noise, 0.0) for loop in sharp for noise in (0.0, 0.01) for samples in (100, 1000)]
    return rows


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=16, help="of each case, from 1000 on (default 16)")
    arguments = parser.parse_args()
    if arguments.seeds < 2:
        parser.error("--seeds: a standard deviation needs 2 or more")
    seeds = range(FIRST_SEED, FIRST_SEED + arguments.seeds)
    print(f"errors in per cent, bias and standard deviation over {len(seeds)} seeds")
    print(f"{'loop':20s}{'samples':>8s}{'noise F, u':>12s}" + "".join(f"{q:>17s}" for q in ("G'", "G_eq", "n")))
    for number, (loop, samples, force, displacement) in enumerate(cases()):
        found = 100.0 * np.array([errors(loop, samples, force, displacement, [seed, number]) for seed in seeds])
        bias, scatter = np.mean(found, axis=0), np.std(found, axis=0, ddof=1)
        noise = f"{100 * force:g}, {100 * displacement:g}"
        line = "".join(f"{round(b, 3) + 0.0:+9.3f}{s:8.3f}" for b, s in zip(bias, scatter, strict=True))
        print(f"{loop.name:20s}{samples:8d}{noise:>12s}{line}")


if __name__ == "__main__":
    main()
