"""Evaluations in other processes: the values are those of the function, whatever becomes of a process."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from itertools import count

import pytest
from selection_examples import random_frames

from edesign.one_thread import one_thread
from edesign.space.elastic_design import ElasticAnalysis
from edesign.space.selection import ahead as module
from edesign.space.selection.ahead import Ahead
from edesign.space.selection.evaluate import Evaluator, _evaluated_by
from edesign.space.selection.groups import groups_of
from edesign.space.selection.select import select_sections

HERE = os.getpid()
WAIT = 60.0  # s, until a process is taken not to begin


@contextmanager
def ahead(function: Callable[[int], int], workers: int) -> Iterator[Ahead[int, int]]:
    """The function with other processes that start at once."""
    found = Ahead(function, partial(_same, function), workers, start_after=0.0)
    try:
        yield found
    finally:
        found.close()


def _same(function: Callable[[int], int]) -> Callable[[int], int]:
    return function


def _square(number: int) -> int:
    return number**2


def _inverse(number: int) -> int:
    return 1 // number


def _process(number: int) -> int:
    time.sleep(0.01)
    return os.getpid()


def _dies_elsewhere(here: int, number: int) -> int:
    if os.getpid() != here:
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return number


def _fails_elsewhere(here: int, number: int) -> int:
    if os.getpid() != here:
        raise ValueError("elsewhere")
    time.sleep(0.01)
    return number


def _hangs_elsewhere(here: int, number: int) -> int:
    if os.getpid() != here:
        time.sleep(1e6)
    time.sleep(0.01)
    return number


def helped(found: Ahead[int, int]) -> int:
    """Ask for numbers until another process has begun with one; return the first that was not asked for yet."""
    end = time.monotonic() + WAIT
    for start in count(0, 2):
        found.expect([start + 1])
        found(start)
        if any(other.at_work_on is not None for other in found._others):
            return start + 1
        assert time.monotonic() < end, "no process has begun"
    raise AssertionError


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_values_are_those_of_the_function_in_any_order(workers: int) -> None:
    with ahead(_square, workers) as square:
        begun = helped(square) if workers > 1 else 0
        assert square(begun) == begun**2
        for foretold in (range(20), range(30, 20, -1), ()):
            square.expect(foretold)
            for number in (*foretold, 3, 40, 25):
                assert square(number) == number**2


def test_what_is_announced_is_found_elsewhere() -> None:
    with ahead(_process, 2) as process:
        assert process(0) == HERE  # nobody waits for a process to begin
        assert process(helped(process)) != HERE


@pytest.mark.parametrize("function", [_dies_elsewhere, _fails_elsewhere, _hangs_elsewhere])
def test_a_process_that_dies_fails_or_hangs_costs_nothing_but_time(
    function: Callable[[int, int], int], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "PATIENCE", (0.2, 10.0))
    with ahead(partial(function, HERE), 3) as found:
        begun = helped(found)
        assert found(begun) == begun
        found.expect(range(1000, 1010))
        assert [found(number) for number in range(1000, 1010)] == list(range(1000, 1010))


def test_a_process_that_cannot_begin_is_not_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", "/bin/false")
    with ahead(_process, 2) as process:
        for number in range(20):
            process.expect([number + 1])
            assert process(number) == HERE


def test_short_work_starts_no_process(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(subprocess, "Popen", None)
    alone = Ahead(_square, partial(_same, _square), 2, start_after=WAIT)
    alone.expect(range(10))
    assert [alone(number) for number in range(10)] == [number**2 for number in range(10)]


def test_an_error_is_raised_where_its_argument_is_asked_for() -> None:
    with ahead(_inverse, 2) as inverse:
        inverse.expect([0, 1])
        assert inverse(1) == 1
        with pytest.raises(ZeroDivisionError):
            inverse(0)


def test_an_evaluation_elsewhere_is_that_of_here_bit_by_bit() -> None:
    with one_thread():
        analysis = ElasticAnalysis(random_frames(3, 4, 3))
        here = Evaluator(analysis, groups_of(analysis))
        there = pickle.loads(pickle.dumps(partial(_evaluated_by, analysis.building, here.groups)))()
        for choice in ((1, 1, 2, 0, 0), (3, 2, 1, 0, 0)):
            assert pickle.loads(pickle.dumps(there(choice))) == here(choice)


def test_a_selection_is_the_same_with_any_number_of_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    alone = select_sections(random_frames(3, 4, 3))
    monkeypatch.setattr(Ahead.__init__, "__defaults__", (0.0,))
    together = select_sections(random_frames(3, 4, 3), workers=3)
    assert [row.after for row in alone.groups] == [row.after for row in together.groups]
    assert (alone.evaluations, alone.starts, alone.certified) == (
        together.evaluations,
        together.starts,
        together.certified,
    )
