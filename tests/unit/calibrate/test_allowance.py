"""Processor time of a search, by a clock that the tests set."""

from __future__ import annotations

import os

import pytest

from edesign.calibrate.allowance import Allowance, OutOfTime


class _Clock:
    """Processor times of one process, s."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.own = self.children = 0.0
        monkeypatch.setattr(os, "times", lambda: os.times_result((self.own, 0.0, self.children, 0.0, 1e9)))


def test_time_of_the_process_and_of_its_children_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = _Clock(monkeypatch)
    clock.own = 100.0  # before
    allowance = Allowance(10.0)
    clock.own, clock.children = 104.0, 5.0
    allowance.check()
    clock.children = 6.1
    with pytest.raises(OutOfTime):
        allowance.check()
    allowance.renew(3.0)
    clock.own += 2.9
    allowance.check()
    allowance.renew()
    clock.own = 1e9
    allowance.check()


def test_a_process_has_its_share_of_what_is_left(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = _Clock(monkeypatch)
    allowance = Allowance(10.0, workers=2)
    clock.own = 4.0
    allowance.check()
    monkeypatch.setattr(os, "getpid", lambda: -1)  # forked: a process begins with none taken
    clock.own = 2.9
    allowance.check()
    clock.own = 3.1
    with pytest.raises(OutOfTime):
        allowance.check()
