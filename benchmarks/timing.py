"""CPU time of a call."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable


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
