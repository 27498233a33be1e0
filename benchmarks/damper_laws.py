"""Cost of the damper laws: one device, 60 s of random deformation sampled at 1 kHz, each law with its example.

CPU time of a force history, median of several runs after a first one, in one thread, with arrays in memory; and the
time of a step. The bar is 0.1 s for a history. With --ode also by SUNDIALS, for laws that have differential equations.

Usage: python -m benchmarks.damper_laws [--repeats N] [--ode]
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.timing import cpu_seconds
from edesign.core.damper import CoreDamper, Method
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.laws import LAWS

# not as tests.*: another package may be installed by that name
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from damper_examples import EXAMPLES  # noqa: E402
from damper_motions import Motion  # noqa: E402

AMPLITUDE, DURATION, RATE = 8e-3, 60.0, 1000.0
BAR = 0.1
"""Seconds for a history."""


def history(core: CoreDamper, motion: Motion, method: Method) -> Callable[[], np.ndarray]:
    """The call that is measured."""
    t, u, v = motion.time, motion.u(motion.time), motion.v(motion.time)
    return lambda: core.force(t, u, v, method)


def cell(core: CoreDamper, motion: Motion, method: Method, repeats: int) -> str:
    """Time of a history, its spread, and time of a step."""
    try:
        middle, spread = cpu_seconds(history(core, motion, method), repeats)
    except CoreError:
        return f"{'-':>10s}"
    over = " above the bar" if middle > BAR else ""
    return f"{1e3 * middle:7.2f} ms{100 * spread:6.0f} %{1e6 * middle / motion.time.size:9.3f} us{over}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=7, help="of each law (default 7)")
    parser.add_argument("--ode", action="store_true", help="also by SUNDIALS")
    arguments = parser.parse_args()
    motion = Motion(AMPLITUDE, seed=1, duration=DURATION, rate=RATE)
    largest = 1e3 * np.max(np.abs(motion.u(motion.time)))
    print(f"{motion.time.size} samples at {RATE:g} Hz, largest deformation {largest:.1f} mm")
    heading = f"{'median':>10s}{'spread':>8s}{'a step':>12s}"
    print(f"{'law':22s}{heading}{'   by SUNDIALS' if arguments.ode else ''}")
    for name, law in LAWS.items():
        core = Damper(law, EXAMPLES[name]).core
        line = cell(core, motion, "best", arguments.repeats)
        if arguments.ode:
            line += "   " + cell(core, motion, "ode", arguments.repeats)
        print(f"{name:22s}{line}")


if __name__ == "__main__":
    main()
