"""Advice on random linear partitions against runs of their loops (substructure_tests.md 6.9)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
import scipy

from edesign.project.substructure import parse_rts_file
from edesign.substructure.advice.advice import advise
from edesign.substructure.advice.expectation import ExpectedTest
from edesign.substructure.virtual_test import VirtualTest
from edesign.substructure.virtual_tests import VirtualLaboratory

PARTITIONS = 100
LEAST_RIGHT = 98
FACTOR = 1.5
PERIODS = 60.0
"""Of free vibration after a pulse: a damping ratio of -0.05 % has grown by a fifth then."""
COMPENSATORS = (
    "kind: none",
    "kind: none",
    "kind: polynomial, delay: {d} s",
    "kind: polynomial, order: 2, delay: {d} s",
    "kind: inverse, delay: {d} s",
    "kind: linear_acceleration, delay: {d} s",
    "kind: fixed_alpha, alpha: [1.0, {d} s]",
    "kind: fixed_alpha, alpha: [1.0, {d} s, {square} s^2]",
    "kind: smith, delay: {d} s, stiffness: {k} N/m, damping: {c} N*s/m",
    "kind: phase_lead, lead: {d} s, lag: {tenth} s",
)


@dataclass(frozen=True)
class Partition:
    """A structure of one or three storeys with a damper of spring and dashpot in the first.

    Attributes:
        frequency: of the first mode with the spring, Hz.
        text: of the file, without the tests.
    """

    frequency: float
    text: str


def partition(rng: np.random.Generator) -> Partition:
    """Half are of one storey, half have a rig that is a pure delay; compensators miss its delay by up to 30 %."""
    storeys, frequency = int(rng.choice([1, 3])), float(np.exp(rng.uniform(np.log(0.7), np.log(8.0))))
    share, loss, omega = rng.uniform(0.1, 0.9), rng.uniform(0.0, 0.1), 2.0 * np.pi * frequency
    masses, whole = structure(storeys, omega)
    spring = share * whole[0]
    dashpot = loss * spring / omega
    rig, delay = random_rig(rng)
    d = max(round(delay * rng.uniform(0.7, 1.3), 5), 0.002)
    estimate = {"d": d, "square": d**2 / 2.0, "tenth": 0.1 * d, "k": spring * rng.uniform(0.9, 1.1), "c": dashpot}
    compensator = COMPENSATORS[rng.integers(len(COMPENSATORS))].format(**estimate)
    springs = [(1.0 - share) * whole[0], *whole[1:]]
    text = (
        "edesign_rts: 1\n"
        f"structure: {{masses: {listed(masses, 'kg')}, stiffnesses: {listed(springs, 'N/m')}, "
        f"damping: {{kind: modal, ratio: {rng.uniform(0.003, 0.02):.5f}}}}}\n"
        f"specimen: {{law: {{type: kelvin_voigt, parameters: {{k: {spring!r} N/m, c: {dashpot!r} N*s/m}}}}}}\n"
        f"rig: {{{rig}}}\n"
        f"loop: {{unseen_delay: {rng.integers(2)} step, force: {rng.choice(['held', 'extrapolated'])}}}\n"
        f"compensators: {{one: {{{compensator}}}}}\n"
    )
    return Partition(frequency, text)


def structure(storeys: int, omega: float) -> tuple[list[float], list[float]]:
    """Masses (kg) and stiffnesses (N/m) with a lowest frequency of omega (rad/s)."""
    masses, relative = ([1e5], [1.0]) if storeys == 1 else ([1e5, 1e5, 6e4], [1.0, 0.9, 0.7])
    drifts = np.eye(storeys) - np.eye(storeys, k=-1)
    squares = scipy.linalg.eigh(drifts.T @ (np.array(relative)[:, None] * drifts), np.diag(masses), eigvals_only=True)
    return masses, [float(one * omega**2 / squares[0]) for one in relative]


def random_rig(rng: np.random.Generator) -> tuple[str, float]:
    """A rig, and its delay at low frequencies, s."""
    if rng.random() < 0.5:
        delay = float(rng.uniform(0.002, 0.04))
        return f"kind: delay, delay: {delay!r} s", delay
    frequency, damping, delay = float(rng.uniform(10, 50)), float(rng.uniform(0.4, 1.0)), float(rng.uniform(0, 0.015))
    text = f"kind: second_order, frequency: {frequency!r} Hz, damping: {damping!r}, delay: {delay!r} s"
    return text, delay + damping / (np.pi * frequency)


def listed(values: list[float], unit: str) -> str:
    return "[" + ", ".join(f"{value!r} {unit}" for value in values) + "]"


def write_records(folder: Path) -> None:
    """An earthquake of 20 s as filtered noise, and a pulse of 0.1 s."""
    time = np.arange(0.0, 20.005, 0.01)
    filtered = scipy.signal.butter(2, [0.3, 15.0], "band", fs=100.0, output="sos")
    noise = scipy.signal.sosfilt(filtered, np.random.default_rng(7).normal(size=time.size))
    quake = noise * np.clip(time / 2.0, 0.0, 1.0) * np.exp(-np.maximum(time - 8.0, 0.0) / 6.0)
    quake[[0, -1]] = 0.0
    short = np.arange(11) * 0.01
    for name, t, a in (("quake", time, quake / np.abs(quake).max()), ("pulse", short, np.sin(np.pi * short / 0.1))):
        np.savetxt(folder / f"{name}.csv", np.column_stack([t, a]), "%.9f", ",", header="time,acc", comments="")


def with_test(one: Partition, record: str, free: float, folder: Path) -> VirtualLaboratory:
    text = (
        f"{one.text}tests:\n  - {{name: one, kind: rts, record: {record}, free_vibration: {free!r} s}}\n"
        f"records:\n  {record}: {{file: {record}.csv, acceleration_unit: m/s^2, "
        "columns: {time: time, acceleration: acc}}\n"
    )
    return VirtualLaboratory(parse_rts_file(text, folder / "rts.yaml"))


def run_of(laboratory: VirtualLaboratory) -> VirtualTest:
    (results,) = laboratory.run()
    return results.runs[0]


def grows(run: VirtualTest) -> bool:
    """Whether a free vibration diverged, or is larger at the end than before."""
    if run.outcome != "done" or run.record is None:
        return True
    x, n = run.record.deformation, len(run.time)
    late, earlier = x[int(0.85 * n) :], x[int(0.55 * n) : int(0.7 * n)]
    return bool(np.max(np.abs(late)) > np.max(np.abs(earlier)))


def looked_at(one: Partition, folder: Path) -> tuple[ExpectedTest, VirtualTest, bool]:
    """What was expected, the run under the earthquake, and whether the loop is unstable by its runs."""
    laboratory = with_test(one, "quake", 0.0, folder)
    expected = advise(laboratory).tests[0].expected[0]
    run = run_of(laboratory)
    free = run_of(with_test(one, "pulse", max(PERIODS / one.frequency, PERIODS / 2.0), folder))
    return expected, run, grows(free) or run.outcome != "done"


@pytest.mark.slow
def test_verdicts_and_errors_of_random_partitions(tmp_path: Path) -> None:
    write_records(tmp_path)
    rng = np.random.default_rng(2026)
    wrong, far, unstable = [], [], 0
    for number in range(PARTITIONS):
        one = partition(rng)
        expected, run, grew = looked_at(one, tmp_path)
        unstable += grew
        said = (
            f"{number}: expected {expected.response_rms:.4g}, found {run.response_error:.4g}, grew {grew}\n{one.text}"
        )
        if expected.stable == grew:
            wrong.append(said)
        elif not grew and not 1.0 / FACTOR < run.response_error / expected.response_rms < FACTOR:
            far.append(said)
    assert PARTITIONS - len(wrong) >= LEAST_RIGHT, "\n".join(wrong)
    assert not far, "\n".join(far)
    assert 20 <= unstable <= 80  # otherwise one word is right always
