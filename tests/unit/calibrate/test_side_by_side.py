"""Functions of many things in processes of their own."""

from __future__ import annotations

import os
import signal
import time
from itertools import cycle

import numpy as np
import pytest

from edesign.calibrate.side_by_side import brief_side_by_side, side_by_side


def test_results_come_in_the_order_of_the_items() -> None:
    def slow_first(i: int) -> int:
        time.sleep(0.1 if i == 0 else 0.0)
        return i * i

    assert side_by_side(slow_first, range(7), 2) == [i * i for i in range(7)]
    assert side_by_side(slow_first, [], 2) == []


def test_they_run_here_and_in_other_processes() -> None:
    def slow(_: int) -> int:
        time.sleep(0.3)
        return os.getpid()

    found = side_by_side(slow, range(6), 3)
    assert os.getpid() in found
    assert len(set(found)) == 3
    assert side_by_side(lambda _: os.getpid(), range(4), 1) == [os.getpid()] * 4


def test_what_is_known_comes_back_as_it_is() -> None:
    big, functions = np.arange(5.0), lambda: 1  # the latter cannot be pickled

    def refer(i: int) -> tuple[int, np.ndarray, object, np.ndarray]:
        return i, big, functions, big + i

    for i, same, also, own in side_by_side(refer, range(3), 2, (big, functions)):
        assert same is big and also is functions
        np.testing.assert_array_equal(own, big + i)


def test_errors_are_raised_here() -> None:
    def wrong(i: int) -> int:
        raise ValueError(f"no {i}")

    with pytest.raises(ValueError, match="no 0"):
        side_by_side(wrong, range(3), 2)


def test_items_that_come_here_are_worked_on_by_their_process() -> None:
    def several(_: int) -> bool:
        time.sleep(0.1)
        return set(side_by_side(lambda _: os.getpid(), range(3), 2)) == {os.getpid()}

    assert side_by_side(several, range(3), 2) == [True] * 3


def test_a_killed_process_loses_nothing() -> None:
    here = os.getpid()

    def dies_elsewhere(i: int) -> int:
        if os.getpid() != here:
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.1)
        return i + 10

    assert side_by_side(dies_elsewhere, range(4), 2) == [10, 11, 12, 13]


@pytest.mark.parametrize(("duration", "cost", "processes"), [(0.0, 0.02, 1), (0.15, 0.02, 2), (0.15, 0.15, 1)])
def test_work_is_done_here_if_a_process_costs_as_much(
    duration: float, cost: float, processes: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun = cycle((0.0, duration))
    monkeypatch.setattr(time, "perf_counter", lambda: next(begun))
    monkeypatch.setattr("edesign.calibrate.side_by_side._cost", lambda: cost)

    def work(i: int) -> tuple[int, int]:
        time.sleep(duration)
        return i, os.getpid()

    found = brief_side_by_side(work, range(6), 2)
    assert [i for i, _ in found] == [*range(6)]
    assert len({process for _, process in found}) == processes
    assert brief_side_by_side(work, [], 2) == []
