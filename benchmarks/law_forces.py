"""Force of the MGMM in one motion with many sets of parameters, as a calibration asks for it: its exact steps against
moments of its terms; medians of both in turn.

Usage: python -m benchmarks.law_forces [--repeats 40]
"""

from __future__ import annotations

import argparse
import statistics
import time

import numpy as np

from edesign.calibrate.dampers.law_force import law_force
from edesign.calibrate.dampers.trial import NONE, Motion
from edesign.core.damper import CoreDamper
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters

STEP, STEPS = 0.008, 1800  # of a test of 15 s as a fit takes it
MOVED = {"modulus": ("k_a",), "relaxation time": ("k1",), "all parameters": ()}


def main() -> None:
    """Print a line for each kind of change."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.law_forces", description=__doc__)
    parser.add_argument("--repeats", type=int, default=40)
    repeats = parser.parse_args().repeats
    law, rng = LAWS["mgmm"], np.random.default_rng(1)
    begun = read_parameters(law, "thesis_table_4_2")
    names = [parameter.name for parameter in law.parameters if parameter.fitted]
    way = shaken(rng)
    print("parameters that move   exact steps, us   moments, us   ratio   largest difference / peak")
    for title, moved in MOVED.items():
        exact, by_moments, apart = [], [], 0.0
        for _ in range(repeats):
            factors = {name: float(np.exp(rng.uniform(-0.02, 0.02))) for name in moved or names}
            values = {name: value * factors.get(name, 1.0) for name, value in begun.items()}
            before = time.perf_counter()
            expected = CoreDamper("mgmm", tuple(values.values())).force(way.time, way.displacement, way.velocity)
            between = time.perf_counter()
            force = law_force(law, values, way, NONE, begun["v_ref"])
            by_moments.append(time.perf_counter() - between)
            exact.append(between - before)
            apart = max(apart, float(np.max(np.abs(force - expected)) / np.max(np.abs(expected))))
        a, b = 1e6 * statistics.median(exact), 1e6 * statistics.median(by_moments)
        print(f"{title:21}  {a:15.0f}   {b:11.0f}   {b / a:5.2f}   {apart:.1e}")


def shaken(rng: np.random.Generator) -> Motion:
    """Three sines of 0.7 to 2.3 Hz and up to 12 mm, at rest nowhere."""
    time_ = STEP * np.arange(STEPS)
    w, phase = 2.0 * np.pi * np.array([0.7, 1.6, 2.3]), rng.uniform(0.0, 2.0 * np.pi, 3)
    size, angle = np.array([6e-3, 4e-3, 2e-3]), np.outer(time_, w) + phase
    return Motion(time_, np.sin(angle) @ size, np.cos(angle) @ (size * w), -np.sin(angle) @ (size * w**2))


if __name__ == "__main__":
    main()
