"""CPU time of calls, and what it went into."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass

from edesign.core import Response


def cpu_seconds(call: Callable[[], object], repeats: int) -> tuple[float, float]:
    """Median CPU time after a first call, and its relative spread, of the process and all its threads."""
    call()
    values = []
    for _ in range(repeats):
        start = time.process_time()
        call()
        values.append(time.process_time() - start)
    middle = statistics.median(values)
    return middle, (max(values) - min(values)) / middle


@dataclass
class Timing:
    """Milliseconds of CPU a step, median of the repeats, and how many there were."""

    milliseconds: float
    spread: float
    repeats: int


def timed(run: Callable[[], float], repeats: int) -> Timing:
    """Median and relative spread of `repeats` runs, each returning CPU seconds a step."""
    values = [run() for _ in range(repeats)]
    middle = statistics.median(values)
    return Timing(1e3 * middle, (max(values) - min(values)) / middle, repeats)


def describe(response: Response) -> str:
    """What the steps of a history cost."""
    s = response.statistics
    return (
        f"{s['iterations'] / s['steps']:.2f} iterations and "
        f"{s['refactorisations'] / s['steps']:.3f} refactorisations a step, "
        f"{s['element_iterations'] / s['iterations']:.1f} element iterations an iteration, "
        f"{100 * s['elastic_updates'] / s['state_updates']:.0f} % of the element states by the elastic shortcut, "
        f"{s['fallbacks']:.0f} fallbacks"
    )
