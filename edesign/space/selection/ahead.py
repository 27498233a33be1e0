"""Evaluations made ahead in other processes: what a search asks for is the same with them and without."""

from __future__ import annotations

import os
import signal
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Generic, TypeVar

T = TypeVar("T")
S = TypeVar("S")


class Ahead(Generic[T, S]):
    """A function whose next arguments can be foretold; forked processes find their values meanwhile.

    A value that was found and is not asked for is lost work and nothing else: the function must be pure.

    Args:
        function: of one argument, both sides of which can be pickled; a process has what this one had at the call.
        workers: processes, this one among them.
    """

    def __init__(self, function: Callable[[T], S], workers: int) -> None:
        self._function = function
        self._next: Iterator[T] = iter(())
        self._found: dict[T, S] = {}
        # elsewhere there is no fork, or, on macOS, system libraries may crash in a forked process
        others = workers - 1 if sys.platform == "linux" else 0
        self._others = [_Other(function) for _ in range(others)]

    def expect(self, arguments: Iterable[T]) -> None:
        """Foretell the arguments of the next calls, the nearest first; this replaces what was foretold before.

        Args:
            arguments: of the next calls.
        """
        self._next = iter(arguments)

    def __call__(self, argument: T) -> S:
        """Return the function of an argument.

        Raises:
            Exception: whatever the function raises.
        """
        self._feed(argument)
        if argument not in self._found:
            other = next((one for one in self._others if one.at_work_on == argument), None)
            if other is None:
                self._found[argument] = self._function(argument)
            else:
                self._wait_for(other)
                self._feed(argument)
        if argument not in self._found:  # the process has died, or met an error
            self._found[argument] = self._function(argument)
        return self._found[argument]

    def _wait_for(self, other: _Other[T, S]) -> None:
        """Find what comes after it here until a process has its value."""
        while not other.is_ready() and (following := self._following()) is not None:
            try:
                self._found[following] = self._function(following)
            except Exception:  # is met again where it is asked for
                break
        self._take(other)

    def close(self) -> None:
        """End the processes."""
        for other in self._others:
            other.close()
        self._others = []

    def _feed(self, current: T) -> None:
        """Give the processes that are free what comes next."""
        for other in self._others:
            if other.at_work_on is not None and other.is_ready():
                self._take(other)
        for other in self._others:
            if other.at_work_on is None:
                wanted = self._following(current)
                if wanted is None:
                    return
                other.begin(wanted)

    def _following(self, current: T | None = None) -> T | None:
        """The next argument that was foretold and that nobody has begun with; None without one."""
        begun = {current, *(other.at_work_on for other in self._others)}
        return next((of for of in self._next if of not in self._found and of not in begun), None)

    def _take(self, other: _Other[T, S]) -> None:
        """Keep what a process found; one that has died or met an error leaves its argument to this process."""
        argument = other.at_work_on
        with suppress(EOFError, OSError):
            for value in other.end():
                if argument is not None:
                    self._found[argument] = value
            return
        self._others = [one for one in self._others if one is not other]
        other.close()


class _Other(Generic[T, S]):
    """A forked process that finds one value at a time."""

    def __init__(self, function: Callable[[T], S]) -> None:
        self.at_work_on: T | None = None
        fork = get_context("fork")
        self._pipe, there = fork.Pipe()
        parent = os.getpid()
        self._process: BaseProcess = fork.Process(target=_serve, args=(function, there, parent), daemon=True)
        with warnings.catch_warnings():
            # Python 3.12 warns of threads beside a fork: those of the BLAS, which knows of forks
            warnings.simplefilter("ignore", DeprecationWarning)
            self._process.start()
        there.close()

    def begin(self, argument: T) -> None:
        self.at_work_on = argument
        with suppress(OSError):  # of a process that has died; `end` finds that out
            self._pipe.send(argument)

    def is_ready(self) -> bool:
        return self._pipe.poll()

    def end(self) -> list[S]:
        """The value, in a list; an empty one after an error."""
        self.at_work_on = None
        found: list[S] = self._pipe.recv()
        return found

    def close(self) -> None:
        self._process.kill()
        self._process.join()
        self._pipe.close()


def _serve(function: Callable[[T], S], pipe: Connection, parent: int) -> None:
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # the parent says what is to be said
    with suppress(EOFError, OSError):
        while True:
            while not pipe.poll(1.0):
                if os.getppid() != parent:  # other forks keep the pipe open
                    return
            argument: T = pipe.recv()
            found: list[S]
            try:
                found = [function(argument)]
            except Exception:  # the parent meets it itself, if it ever asks
                found = []
            pipe.send(found)
