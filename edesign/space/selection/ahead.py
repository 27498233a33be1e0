"""Evaluations made ahead in other processes: what a search asks for is the same with them and without."""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from multiprocessing.connection import wait
from typing import Generic, TypeVar

from edesign.one_thread import one_thread

T = TypeVar("T")
S = TypeVar("S")

START_AFTER = 2.0
"""Seconds of work here before other processes start: one takes about as long to start, which short searches spare."""
PATIENCE = 5.0, 10.0
"""A process is given up after so many seconds, or so many times the longest work on one argument here if more."""


class Ahead(Generic[T, S]):
    """A function whose next arguments can be foretold; other processes find their values meanwhile.

    A value that was found and is not asked for is lost work and nothing else: the function must be pure. No process is
    waited for without limit: what one owes that dies, fails or hangs is found here.

    Args:
        function: of one argument, both sides of which can be pickled.
        make: returns the same function in another process; it is pickled.
        workers: processes, this one among them.
        start_after: seconds of work here before the others start.
    """

    def __init__(
        self,
        function: Callable[[T], S],
        make: Callable[[], Callable[[T], S]],
        workers: int,
        start_after: float = START_AFTER,
    ) -> None:
        self._function = function
        self._make = make
        self._to_start = workers - 1
        self._start_after = start_after
        self._spent = self._longest = 0.0  # s
        self._next: Iterator[T] = iter(())
        self._found: dict[T, S] = {}
        self._others: list[_Other[T, S]] = []

    def expect(self, arguments: Iterable[T]) -> None:
        """Foretell the arguments of the next calls, the nearest first; this replaces what was foretold before."""
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
                self._find(argument)
            else:
                self._wait_for(other)
                self._feed(argument)
        if argument not in self._found:  # the process has died, hangs, or met an error
            self._find(argument)
        return self._found[argument]

    def _find(self, argument: T) -> None:
        began = time.monotonic()
        self._found[argument] = self._function(argument)
        took = time.monotonic() - began
        self._spent, self._longest = self._spent + took, max(self._longest, took)

    def _wait_for(self, other: _Other[T, S]) -> None:
        """Find what comes after it here until a process has its value."""
        while not other.is_ready() and (following := self._following()) is not None:
            try:
                self._find(following)
            except Exception:  # is met again where it is asked for
                break
        least, times = PATIENCE
        if other.is_ready(max(least, times * self._longest)):
            self._take(other)
        else:
            self._give_up(other)

    def close(self) -> None:
        """End the processes."""
        self._to_start = 0
        for other in self._others:
            other.close()
        self._others = []

    def _feed(self, current: T) -> None:
        """Give the processes that are free what comes next."""
        if self._to_start > 0 and self._spent >= self._start_after:
            with suppress(OSError):  # the system allows no more processes
                self._others += [_Other(self._make) for _ in range(self._to_start)]
            self._to_start = 0
        for other in [other for other in self._others if other.busy and other.is_ready()]:
            self._take(other)
        for other in self._others:
            if not other.busy:
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
        try:
            for value in other.end():
                if argument is not None:
                    self._found[argument] = value
        except (EOFError, OSError, pickle.UnpicklingError):
            self._give_up(other)

    def _give_up(self, other: _Other[T, S]) -> None:
        self._others = [one for one in self._others if one is not other]
        other.close()


class _Other(Generic[T, S]):
    """A Python process of its own that finds one value at a time; its first answer, an empty one, says that it can.

    It is started anew and not forked, as a fork beside threads may wait forever for what these hold. Unlike processes
    of `multiprocessing` it does not run the script of the user once more, and Ctrl-C does not reach it.
    """

    def __init__(self, make: Callable[[], Callable[[T], S]]) -> None:
        self.busy = True
        self.at_work_on: T | None = None
        with tempfile.TemporaryFile() as made:  # a pipe would hold this process up until the other one has read it
            pickle.dump(make, made)
            made.seek(0)
            self._process = subprocess.Popen(
                [sys.executable, "-P", "-c", f"from {__name__} import serve; serve({made.fileno()})"],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,  # what is to be said is said where the argument is asked for
                env=os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)},
                pass_fds=[made.fileno()],
                start_new_session=True,
            )
        assert self._process.stdin is not None and self._process.stdout is not None
        self._asked, self._answers = self._process.stdin, self._process.stdout

    def begin(self, argument: T) -> None:
        self.busy, self.at_work_on = True, argument
        with suppress(OSError):  # of a process that has died; `end` finds that out
            pickle.dump(argument, self._asked)
            self._asked.flush()

    def is_ready(self, timeout: float = 0.0) -> bool:
        return bool(wait([self._answers.fileno()], timeout))

    def end(self) -> list[S]:
        """The value, in a list; an empty one after an error."""
        self.busy, self.at_work_on = False, None
        found: list[S] = pickle.load(self._answers)
        return found

    def close(self) -> None:
        self._process.kill()
        self._process.wait()
        for stream in (self._asked, self._answers):
            with suppress(OSError):  # what was not sent
                stream.close()


def serve(made: int) -> None:
    """Find values for the process that started this one, until it ends.

    Args:
        made: descriptor of the file with what makes the function.
    """
    asked, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # nothing else comes between the answers
    with suppress(EOFError, OSError), one_thread():
        with open(made, "rb") as file:
            function = pickle.load(file)()
        found: list[object] = []
        while True:
            pickle.dump(found, answers)
            answers.flush()
            argument = pickle.load(asked)
            try:
                found = [function(argument)]
            except Exception:  # the process that asked meets it itself, if it ever asks for this value
                found = []
