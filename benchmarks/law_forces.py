"""Forces of laws in the tests of a campaign with many sets of parameters, as a calibration asks for them.

All sets by fixed steps in one call of the core, on one thread and on two, against a history of each set by steps that
the law asks for; medians of all in turn. The largest difference is that from SUNDIALS' integrators.

Usage: python -m benchmarks.law_forces [--repeats 10] [--sets 16]
"""

from __future__ import annotations

import argparse
import statistics
import time
from collections.abc import Callable, Mapping

import numpy as np

from edesign.calibration.dampers.law_forces import LawTest, Run, forces, length_of
from edesign.calibration.dampers.motion import Motion
from edesign.core.damper import CoreDamper, Method
from edesign.damper.history import NONE
from edesign.damper.laws import law as law_of
from edesign.damper.parameters import read_parameters

STEP, STEPS, TESTS = 0.008, 1800, 4  # of a test of 15 s as a fit takes it
LAWS: Mapping[str, Mapping[str, float] | str] = {
    "mgmm": "thesis_table_4_2",
    "kelvin_voigt": {"k": 4e6, "c": 2e5},
    "bouc_wen": {"Fy": 2e4, "Y": 1e-3, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.5},
    "maxwell_power": {"c": 3e5, "alpha": 0.35, "k": 4e7},
}


def main() -> None:
    """Print a line for each law."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.law_forces", description=__doc__)
    parser.add_argument("--repeats", type=int, default=10)
    parser.add_argument("--sets", type=int, default=16, help="of parameters in a call")
    chosen = parser.parse_args()
    rng = np.random.default_rng(1)
    motions = [shaken(rng) for _ in range(TESTS)]
    print(f"{TESTS} tests of {STEPS} samples, {chosen.sets} sets: us for a set and test")
    print("law             histories   one call   two threads   ratio   largest difference / peak")
    for name, values in LAWS.items():
        print(line(name, values, motions, chosen.sets, chosen.repeats, rng), flush=True)


def line(
    name: str,
    given: Mapping[str, float] | str,
    motions: list[Motion],
    sets: int,
    repeats: int,
    rng: np.random.Generator,
) -> str:
    """Return times and difference of a law.

    Args:
        name: of the law.
        given: its parameters, SI, or the name of a set of them.
        motions: of the tests.
        sets: of parameters, within some per cent of those that are given.
        repeats: of each.
        rng: for the sets.
    """
    law = law_of(name)
    begun = law.complete(read_parameters(law, given) if isinstance(given, str) else given)
    free = {one.name for one in law.all_parameters(begun) if one.fitted}
    each = [
        tuple(v * float(np.exp(rng.uniform(-0.02, 0.02))) if n in free else v for n, v in begun.items())
        for _ in range(sets)
    ]
    far = max(float(np.max(np.abs(one.displacement))) for one in motions)
    largest = max(float(np.max(np.abs(one))) for one in histories(name, each[:1], motions)[0])
    length = length_of(law, begun, largest, far)
    runs: list[Run] = [
        ((LawTest(name, values, (), None, NONE), motion),) for motion in motions for values in each
    ]  # a fresh specimen in each test
    ways: list[Callable[[], object]] = [
        lambda: histories(name, each, motions),
        lambda: forces(runs, 1, length),
        lambda: forces(runs, 2, length),
    ]
    times: list[list[float]] = [[] for _ in ways]
    for _ in range(repeats):
        for way, of_way in zip(ways, times, strict=True):
            before = time.perf_counter()
            way()
            of_way.append(time.perf_counter() - before)
    a, b, c = (1e6 * statistics.median(one) / (sets * len(motions)) for one in times)
    accurate = histories(name, each, motions, "ode")
    exact = [force for of_motion in zip(*accurate, strict=True) for force in of_motion]
    apart = max(
        float(np.max(np.abs(found[0] - force)) / np.max(np.abs(force)))
        for found, force in zip(forces(runs, 1, length), exact, strict=True)
        if isinstance(found, list)
    )
    return f"{name:14}  {a:10.0f}  {b:9.0f}   {c:11.0f}   {b / a:5.2f}   {apart:.1e}"


def histories(
    name: str, sets: list[tuple[float, ...]], motions: list[Motion], method: Method = "best"
) -> list[list[np.ndarray]]:
    """Return the force (n,) N of each set in each motion, by a history of its own.

    Args:
        name: of the law.
        sets: parameters in the order of the core, SI.
        motions: of the tests.
        method: of the steps.
    """
    return [[CoreDamper(name, one).force(*m.samples[:3], method) for m in motions] for one in sets]


def shaken(rng: np.random.Generator) -> Motion:
    """Return three sines of 0.7 to 2.3 Hz and up to 12 mm, at rest nowhere.

    Args:
        rng: for their phases.
    """
    time_ = STEP * np.arange(STEPS)
    w, phase = 2.0 * np.pi * np.array([0.7, 1.6, 2.3]), rng.uniform(0.0, 2.0 * np.pi, 3)
    size, angle = np.array([6e-3, 4e-3, 2e-3]), np.outer(time_, w) + phase
    return Motion(time_, np.sin(angle) @ size, np.cos(angle) @ (size * w), -np.sin(angle) @ (size * w**2))


if __name__ == "__main__":
    main()
