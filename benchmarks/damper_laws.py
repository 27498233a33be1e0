"""Cost of the damper laws: one device, 60 s of random deformation sampled at 1 kHz, each law with its example.

CPU time of a force history, median of several runs after a first one, in one thread, with arrays in memory; and the
time of a step. The bar is 0.1 s for a history. With --ode also by SUNDIALS, for laws that have differential equations.

With --cases a table of where laws are used, each with its example and in the cases in which it is known to be slow:
one device at 200 Hz (12 000 steps); 20 devices in the thesis' frame, a step over one of the bare frame, in 20 s of El
Centro; and a fit to 20 tests, ended after EVALUATIONS of all of them.

Usage: python -m benchmarks.damper_laws [--repeats N] [--ode | --cases] [LAW ...]
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.damped_frame import AREAS, damped_project, el_centro, measure
from benchmarks.timing import cpu_seconds
from edesign.core.damper import CoreDamper, LawValues, Method
from edesign.core.errors import CoreError
from edesign.damper.damper import Damper
from edesign.damper.fitting.forces import core_predict, fit_forces
from edesign.damper.fitting.identifiable import FIXED
from edesign.damper.fitting.loading import Loading
from edesign.damper.laws import LAWS
from edesign.project.project import Project
from edesign.study.analysis.structure import make_frame, make_structure
from edesign.study.motions.applied import input_motion

# not as tests.*: another package may be installed by that name
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "support"))
from damper_examples import EXAMPLES  # noqa: E402
from damper_motions import Motion  # noqa: E402
from fit_campaign import measured  # noqa: E402

AMPLITUDE, DURATION, RATE = 8e-3, 60.0, 1000.0
BAR = 0.1
"""Seconds for a history."""

SLOW: Mapping[str, Mapping[str, tuple[Mapping[str, float], float]]] = {
    "generalised_maxwell": {"brace": ({}, 40e6)},
    "maxwell_power": {f"spring of 1e{n} N/m": ({"c": 4e5, "k": 10.0**n}, 0.0) for n in (9, 12)},
    "fractional_zener": {"brace": ({}, 40e6)},
    "viscous_power": {"brace": ({}, 40e6)},
    "ramberg_osgood": {"brace": ({}, 40e6)},
    "bouc_wen": {"n = 1.5": ({"n": 1.5}, 0.0), "brace": ({}, 40e6)},
    "modified_bouc_wen": {"brace": ({}, 40e6), "n = 1.5": ({"n": 1.5}, 0.0)},
    "asymptote": {"brace": ({}, 40e6)},
    "mgmm": {"brace": ({}, 40e6)},
}
"""Cases by law in which it takes longer: changes of its example, and a brace in N/m (0: none)."""

AMPLITUDES = (0.002, 0.004, 0.006, 0.008, 0.01)
"""m, of the tests of a fit: with the four motions of each they are 20."""

EVALUATIONS = 200
"""Forces of all tests after which a fit ends: full fits of slow laws take an hour."""


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


class _Enough(Exception):
    """The evaluations of a fit are used up."""


class Frame:
    """The thesis' frame in 20 s of El Centro, bare and with 20 devices of one law in place of its dampers."""

    def __init__(self) -> None:
        self.project: Project = damped_project(braces=False)
        whole = input_motion(el_centro(self.project), 1.5, 0.01, 0.0)
        self.motion = replace(whole, acceleration=whole.acceleration[:2001])
        self.terms = make_frame(self.project, dampers=True).model.damper_terms

    def step(self, law: LawValues | None, brace: float) -> float:
        """CPU time of a step, us; None: bare."""
        frame = make_frame(self.project)
        for number, terms in enumerate(self.terms):
            if law is None:
                break
            size = AREAS[number % len(AREAS)] / 0.0414  # of the tested pair, as 70 mm of elastomer to its 12 mm
            frame.model.damper(f"d{number}", law, terms, brace * size * 12.0 / 70.0, size, 12.0 / 70.0)
        return measure(self.project, make_structure(self.project, frame), self.motion)[0]

    def ratio(self, law: LawValues, brace: float, repeats: int) -> float:
        """A step with the devices over a bare one: median of rounds of both."""
        return statistics.median(self.step(law, brace) / self.step(None, 0.0) for _ in range(repeats))


def fit_seconds(name: str, values: Mapping[str, float]) -> tuple[float, int]:
    """CPU time of a fit, and the evaluations of all tests that it took."""
    tests = [
        replace(test, name=f"{test.name}, {amplitude:g}")
        for amplitude in AMPLITUDES
        for test in measured(name, values, amplitude=amplitude)
    ]
    force, forces = core_predict(LAWS[name]), 0

    def counted(parameters: Mapping[str, float], loading: Loading) -> np.ndarray:
        nonlocal forces
        if forces == EVALUATIONS * len(tests):
            raise _Enough
        forces += 1
        return force(parameters, loading)

    fixed = {key: values[key] for key in FIXED.get(name, {})}
    branches = sum(key.startswith("c") for key in values) if LAWS[name].branch else 1
    start = time.process_time()
    try:
        fit_forces(LAWS[name], tests, fixed=fixed, branches=branches, predict=counted)
    except _Enough:
        pass
    return time.process_time() - start, forces // len(tests)


def cases(names: list[str]) -> Iterator[tuple[str, str, dict[str, float], float]]:
    """Law, case, parameters and brace."""
    for name in names:
        yield name, "example", EXAMPLES[name], 0.0
        for label, (changes, brace) in SLOW.get(name, {}).items():
            yield name, label, EXAMPLES[name] | dict(changes), brace


def print_cases(names: list[str], repeats: int) -> None:
    """Print the table of --cases."""
    motion, frame = Motion(AMPLITUDE, seed=1, duration=DURATION, rate=200.0), Frame()
    print(f"| law | case | alone, us a step | in the frame | fit, CPU s ({EVALUATIONS} evaluations at most) |")
    print("|---|---|---|---|---|")
    for name, label, values, brace in cases(names):
        damper = Damper(LAWS[name], values, brace)
        alone = 1e6 * cpu_seconds(history(damper.core, motion, "best"), repeats)[0] / motion.time.size
        ratio = frame.ratio(LawValues(name, tuple(damper.values.values())), brace, repeats)
        fitted = "" if brace else "{:.2f} ({})".format(*fit_seconds(name, values))
        print(f"| `{name}` | {label} | {alone:.3f} | {ratio:.2f} | {fitted} |", flush=True)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=7, help="of each law (default 7)")
    parser.add_argument("--ode", action="store_true", help="also by SUNDIALS")
    parser.add_argument("--cases", action="store_true", help="alone, in a frame and in a fit, with slow cases")
    parser.add_argument("laws", nargs="*", metavar="LAW", help="all if none is named")
    arguments = parser.parse_args()
    if unknown := set(arguments.laws) - set(LAWS):
        parser.error(f"unknown laws: {', '.join(sorted(unknown))}; there are {', '.join(LAWS)}")
    names = arguments.laws or list(LAWS)
    if arguments.cases:
        print_cases(names, arguments.repeats)
        return
    motion = Motion(AMPLITUDE, seed=1, duration=DURATION, rate=RATE)
    largest = 1e3 * np.max(np.abs(motion.u(motion.time)))
    print(f"{motion.time.size} samples at {RATE:g} Hz, largest deformation {largest:.1f} mm")
    heading = f"{'median':>10s}{'spread':>8s}{'a step':>12s}"
    print(f"{'law':22s}{heading}{'   by SUNDIALS' if arguments.ode else ''}")
    for name in names:
        core = Damper(LAWS[name], EXAMPLES[name]).core
        line = cell(core, motion, "best", arguments.repeats)
        if arguments.ode:
            line += "   " + cell(core, motion, "ode", arguments.repeats)
        print(f"{name:22s}{line}")


if __name__ == "__main__":
    main()
