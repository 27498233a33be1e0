"""Ctrl-C and the requests of other threads end long calls of the core.

Each call below would take minutes; a process is sent the signal once the call has begun and must end within seconds.
"""

from __future__ import annotations

import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from limited import limited

from edesign.core.damper import CoreDamper
from edesign.core.spectrum import peak_displacement
from edesign.stopping import Stopped, in_threads, stoppable

SOON = 30.0  # s: it asks five times a second, but machines that do other things as well are slow to end a process

SETTING = """
    import signal
    import numpy as np
    from edesign.core import Analysis, CampaignTest, Model, SeriesRig, campaign_forces
    from edesign.core.damper import CoreDamper
    from edesign.core.spectrum import peak_responses, recursion_peaks, rotated_peak_displacement
    from edesign.ground_motion.response_spectrum import response_spectra

    N = 10_000_000
    samples = np.sin(0.37 * np.arange(N)) * 1e-3
    time, speed = np.arange(N) * 0.01, np.cos(0.37 * np.arange(N)) * 0.037
    period, damping = np.linspace(1.0, 2.0, 20_000), np.full(20_000, 0.05)
    MGMM = [0.515e6, 15.1e3, 0.107e6, 20974.0, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0]
    mgmm, power = CoreDamper("mgmm", MGMM), CoreDamper("maxwell_power", [300e3, 0.35, 40e6])

    def mast():
        model = Model()
        steel = model.elastic_section(2.1e9, 4.2e7)
        nodes = [model.node(f"n{i}", 0.0, 3.0 * i) for i in range(12)]
        model.fix(nodes[0], True, True, True)
        for i, (lower, upper) in enumerate(zip(nodes, nodes[1:])):
            model.beam_column(f"e{i}", lower, upper, steel, points=3)
            model.mass(upper, 1e4, 1e4, 0.0)
        pattern = model.pattern()
        model.nodal_load(pattern, nodes[-1], 1e3, 0.0, 0.0)
        return Analysis(model), pattern, nodes[-1]

    structure, pattern, top = mast()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell that starts tests behind may ignore it
    print("ready", flush=True)
"""

CALLS = {
    "spectrum": "peak_responses(samples, 0.01, period, damping)",
    "rotated": "rotated_peak_displacement(samples, samples, 0.01, period, damping, 180)",
    "recursions": "recursion_peaks(samples[:1_000_000], np.ones((40_000, 3)), np.zeros((40_000, 2)), 0.0, 100)",
    "exact steps": "CoreDamper('mgmm', MGMM, brace=1e8).force(time, samples, speed)",
    "SUNDIALS": "power.force(time, samples, speed)",
    "in series": "campaign_forces([mgmm], [CampaignTest(time, samples, speed, rig=SeriesRig(1e8))], threads=1)",
    "static": "structure.static(pattern, 1.0, 10_000_000)",
    "pushover": "structure.pushover(pattern, top, 'ux', 0.1, 10_000_000)",
    "history": "structure.history(samples, 0.01)",
    "threads": "response_spectra(samples, 0.01, period[:2000], 0.05, threads=2)",
}


ONE_BY_ONE = """
    import sys
    for line in sys.stdin:
        try:
            eval(line)
        except KeyboardInterrupt:
            print("stopped", flush=True)
        else:
            print("ended", flush=True)
"""


def started(script: str) -> subprocess.Popen[str]:
    """A process that has all that calls take and is ready for them."""
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(SETTING) + script],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    with limited(process):
        assert process.stdout.readline() == "ready\n"
    return process


def interrupt(process: subprocess.Popen[str]) -> None:
    time.sleep(1.0)  # well inside the call
    assert process.poll() is None
    process.send_signal(signal.SIGINT)


@pytest.fixture(scope="module")
def caller() -> Iterator[subprocess.Popen[str]]:
    process = started(textwrap.dedent(ONE_BY_ONE))
    yield process
    process.kill()
    process.communicate()


@pytest.mark.parametrize("call", CALLS)
def test_interrupt_ends_a_long_call(call: str, caller: subprocess.Popen[str]) -> None:
    """One process for all calls, which takes the next when one is interrupted."""
    assert caller.stdin is not None and caller.stdout is not None
    caller.stdin.write(CALLS[call] + "\n")
    caller.stdin.flush()
    interrupt(caller)
    with limited(caller, SOON):
        assert caller.stdout.readline() == "stopped\n"


def test_a_process_ends_on_the_interrupt_of_a_call() -> None:
    process = started(CALLS["history"] + "\n")
    try:
        interrupt(process)
        _, error = process.communicate(timeout=SOON)
    finally:
        process.kill()
    assert process.returncode == -signal.SIGINT  # as Python ends on a KeyboardInterrupt that nobody catches
    assert error.rstrip().endswith("KeyboardInterrupt")
    assert "From cffi" not in error and "Exception ignored" not in error


def long_call() -> np.ndarray:
    periods = np.linspace(1.0, 2.0, 20_000)
    return peak_displacement(np.ones(2_000_000), 0.01, periods, np.full(periods.size, 0.05))


def test_a_request_of_another_thread_ends_a_long_call() -> None:
    stop = threading.Event()

    def work() -> None:
        with stoppable(stop.is_set):
            long_call()

    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(work)
        time.sleep(0.5)
        stop.set()
        with pytest.raises(Stopped):
            future.result(SOON)


def test_requests_of_outer_contexts_count_and_end_with_them() -> None:
    with stoppable(lambda: True):
        with stoppable(lambda: False), pytest.raises(Stopped):
            long_call()
        with pytest.raises(Stopped):
            long_call()
    short = peak_displacement(np.ones(10), 0.01, np.array([1.0]), np.array([0.05]))
    assert np.all(np.isfinite(short))


def test_an_error_in_one_thread_ends_the_others() -> None:
    began = time.monotonic()

    def work(item: int) -> float:
        if item:
            return float(long_call().max())
        time.sleep(0.3)
        raise ValueError("the first one fails")

    with pytest.raises(ValueError, match="the first one"):
        list(in_threads(work, range(2), 2))
    assert time.monotonic() - began < SOON


def test_an_error_of_the_question_is_raised_behind_the_call() -> None:
    def broken() -> bool:
        raise RuntimeError("the question failed")

    with stoppable(broken), pytest.raises(RuntimeError, match="the question failed"):
        long_call()
    time_ = np.arange(100) * 0.01
    assert CoreDamper("viscous", [1.0]).force(time_, time_, np.ones(100))[-1] == 1.0
