"""Evaluations in other processes: the values are those of the function, whatever becomes of a process."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager

import pytest
from selection_examples import random_frames

from edesign.space.selection.ahead import Ahead
from edesign.space.selection.select import select_sections

HERE = os.getpid()


@contextmanager
def ahead(function: object, workers: int) -> Iterator[Ahead[int, int]]:
    found: Ahead[int, int] = Ahead(function, workers)  # type: ignore[arg-type]
    try:
        yield found
    finally:
        found.close()


@pytest.mark.parametrize("workers", [1, 2, 3])
def test_values_are_those_of_the_function_in_any_order(workers: int) -> None:
    with ahead(lambda number: number**2, workers) as square:
        for foretold in (range(20), range(30, 20, -1), ()):
            square.expect(foretold)
            for number in (*foretold, 3, 40, 25):
                assert square(number) == number**2


def test_the_first_of_what_is_foretold_is_found_elsewhere() -> None:
    with ahead(lambda number: os.getpid(), 2) as process:
        process.expect([1, 2])
        assert process(0) == HERE  # while another process finds the first
        assert process(1) != HERE


def _dies_elsewhere(number: int) -> int:
    if os.getpid() != HERE:
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def _fails_elsewhere(number: int) -> int:
    if os.getpid() != HERE:
        raise ValueError("elsewhere")
    return number


@pytest.mark.parametrize("function", [_dies_elsewhere, _fails_elsewhere])
def test_a_process_that_dies_or_fails_costs_nothing_but_time(function: object) -> None:
    with ahead(function, 3) as found:
        found.expect(range(10))
        assert [found(number) for number in range(10)] == list(range(10))


def test_an_error_is_raised_where_its_argument_is_asked_for() -> None:
    with ahead(lambda number: 1 // number, 2) as inverse:
        inverse.expect([0, 1])
        assert inverse(1) == 1
        with pytest.raises(ZeroDivisionError):
            inverse(0)


def test_a_selection_is_the_same_with_any_number_of_processes() -> None:
    alone, together = (select_sections(random_frames(3, 4, 3), workers=workers) for workers in (1, 3))
    assert [row.after for row in alone.groups] == [row.after for row in together.groups]
    assert (alone.evaluations, alone.starts, alone.certified) == (
        together.evaluations,
        together.starts,
        together.certified,
    )
