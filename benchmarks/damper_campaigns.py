"""Cost of predicting a campaign with many sets of parameters, as calibrations and fits do.

First table: CPU time of a sample, by law with its example: alone, with a brace, in series with a flexible rig with and
without play; as the core does it by itself and in fixed steps, with the largest difference of the two. Second table: a
campaign of TESTS tests of SAMPLES samples and SETS dampers: CPU time in single calls and in one call, and how many
times faster two threads are by the clock, which takes two idle processors.

Usage: python -m benchmarks.damper_campaigns [--repeats N] [LAW ...]
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.timing import cpu_seconds
from edesign.core import CampaignTest, CoreDamper, CoreError, campaign_forces

# not as tests.*: another package may be installed by that name
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))
from damper_examples import EXAMPLES  # noqa: E402
from series_history import force_in_series  # noqa: E402

STEP, SAMPLES, TESTS, SETS = 0.01, 1000, 8, 50
BRACE, RIG, PLAY, LENGTH = 60e6, 60e6, 5e-4, 2e-3  # N/m, N/m, m, m
WAYS = {
    "alone": (0.0, None),
    "brace": (BRACE, None),
    "rig": (0.0, 0.0),
    "rig with play": (0.0, PLAY),
    "brace and rig": (BRACE, 0.0),
}


def main() -> None:
    """Print both tables."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.damper_campaigns", description=__doc__)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("laws", nargs="*", metavar="LAW")
    arguments = parser.parse_args()
    names = arguments.laws or list(EXAMPLES)
    way = shaken(np.random.default_rng(1))
    print("law                  way             by itself, us   fixed steps, us   apart / peak")
    for name in names:
        for title, (brace, play) in WAYS.items():
            try:
                damper = CoreDamper(name, tuple(EXAMPLES[name].values()), brace)
                itself, fixed = forces(damper, way, play, "best"), forces(damper, way, play, "fixed")
                expected = itself()
            except CoreError:
                continue  # such a damper does not go there
            apart = np.max(np.abs(fixed() - expected)) / np.max(np.abs(expected))
            each = [1e6 * cpu_seconds(call, arguments.repeats)[0] / SAMPLES for call in (itself, fixed)]
            print(f"{name:19}  {title:14}  {each[0]:13.3f}   {each[1]:15.3f}   {apart:12.1e}")
    tests = [CampaignTest(*shaken(np.random.default_rng(seed))) for seed in range(TESTS)]
    print("\nlaw                  single calls, ms   one call, ms   two threads, times faster")
    for name in names:
        values = tuple(EXAMPLES[name].values())
        sets = [CoreDamper(name, (values[0] * (1.0 + 1e-3 * i), *values[1:])) for i in range(SETS)]
        single, one, two = in_single_calls(sets, tests), in_one_call(sets, tests, 1), in_one_call(sets, tests, 2)
        each = [1e3 * cpu_seconds(call, arguments.repeats)[0] / SETS for call in (single, one)]
        faster = elapsed(one, arguments.repeats) / elapsed(two, arguments.repeats)
        print(f"{name:19}  {each[0]:16.3f}   {each[1]:12.3f}   {faster:25.2f}")


def in_single_calls(sets: list[CoreDamper], tests: list[CampaignTest]) -> Callable[[], object]:
    """Return a call for all forces, one history after the other."""
    return lambda: [[one.force(test.time, test.deformation, test.velocity) for test in tests] for one in sets]


def in_one_call(sets: list[CoreDamper], tests: list[CampaignTest], threads: int) -> Callable[[], object]:
    """Return a call for all forces at once."""
    return lambda: campaign_forces(sets, tests, threads=threads)


def forces(
    damper: CoreDamper, way: tuple[np.ndarray, np.ndarray, np.ndarray], play: float | None, method: str
) -> Callable[[], np.ndarray]:
    """Return a call for the force of a damper, alone (play None) or in series with a rig."""
    length = LENGTH if method == "fixed" else None
    if play is None:
        return lambda: damper.force(*way, method=method, length=length)  # type: ignore[arg-type]
    return lambda: force_in_series(damper, *way, RIG, play, method=method, length=length)[0]


def elapsed(call: Callable[[], object], repeats: int) -> float:
    """Return the shortest time of several calls, s."""
    found = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        found.append(time.perf_counter() - start)
    return min(found)


def shaken(rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return four sines of 0.3 to 3 Hz and some 10 mm together: time, deformation, velocity."""
    time_ = STEP * np.arange(SAMPLES)
    w, phase, size = (
        2.0 * np.pi * rng.uniform(0.3, 3.0, 4),
        rng.uniform(0.0, 2.0 * np.pi, 4),
        rng.uniform(1e-3, 5e-3, 4),
    )
    angle = np.outer(time_, w) + phase
    return time_, np.sin(angle) @ size, np.cos(angle) @ (size * w)


if __name__ == "__main__":
    main()
