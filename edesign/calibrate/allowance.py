"""Processor time that a search may take: beside other work it takes longer, and finds the same."""

from __future__ import annotations

import math
import os


class OutOfTime(Exception):
    """A search has taken the processor time that it may take."""


class Allowance:
    """Of this process, and of those forked from it, each of which may take its share of what is left.

    Args:
        seconds: of all processes together.
        workers: processes.
    """

    def __init__(self, seconds: float = math.inf, workers: int = 1) -> None:
        self.workers = workers
        self._process = os.getpid()
        self._started, self._given, self._left = taken(), seconds, seconds

    def check(self) -> None:
        """Go on.

        Raises:
            OutOfTime: there is nothing left.
        """
        if os.getpid() != self._process:  # forked: what it has taken is counted anew
            self._process, self._started = os.getpid(), 0.0
            self._given = self._left / self.workers
        self._left = self._given - (taken() - self._started)
        if self._left < 0.0:
            raise OutOfTime

    def renew(self, seconds: float = math.inf) -> None:
        """So much from now on."""
        self._started, self._given, self._left = taken(), seconds, seconds


def taken() -> float:
    """Processor time of this process and of its children that have ended, s."""
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system
