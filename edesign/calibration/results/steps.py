"""The steps of a calibration, that an interrupt (Ctrl-C) may end: the search, and what follows it."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from edesign.calibration.search.models import EffortSpentError
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.search import Ending, Found, Progress, Search
from edesign.calibration.search.settings import SETTINGS, SearchSettings
from edesign.errors import InputError
from edesign.optional_stages import optional

T = TypeVar("T")


@dataclass
class Steps:
    """Steps after a search: after an interrupt among them the rest is left out, after one before all that can be.

    A step that fails has what stands instead of it.

    Attributes:
        progress: called with what is done.
        ending: how the search ended; interrupted if a step was.
        failed: steps that failed, with the reason, for people.
    """

    progress: Progress
    ending: Ending
    failed: dict[str, str] = field(default_factory=dict)
    _left: bool = False
    _raising: Any = field(
        default=None, init=False
    )  # handler of interrupts outside of `deferring_interrupts`; None: not in it

    @contextmanager
    def deferring_interrupts(self) -> Iterator[None]:
        """Keep interrupts from what no result can do without; steps that are taken meanwhile end by them."""
        handler = signal.getsignal(signal.SIGINT)
        if handler is None or threading.current_thread() is not threading.main_thread():  # which alone is interrupted
            yield
            return

        def note(*_: object) -> None:
            self.ending, self._left = "interrupted", True
            self.progress("interrupted: what was found is written as it stands")

        self._raising = signal.signal(signal.SIGINT, note)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, self._raising)
            self._raising = None

    def take(self, what: str, step: Callable[[], T], instead: T, needed: bool = False) -> T:
        """Return what a step makes; what stands instead where it is interrupted, left out, or fails.

        Args:
            what: is done, for people.
            needed: whether it is taken after an interrupt of the search too.
        """
        if self._left or (self.ending == "interrupted" and not needed):
            return instead
        self.progress(what)
        holding = None if self._raising is None else signal.signal(signal.SIGINT, self._raising)
        try:
            return self.guard(what, step, instead)
        except KeyboardInterrupt:
            self.ending, self._left = "interrupted", True
            return instead
        finally:
            if holding is not None:
                signal.signal(signal.SIGINT, holding)

    def guard(self, what: str, step: Callable[[], T], instead: T) -> T:
        """Return what a short step makes, which is taken after interrupts too; what stands instead where it fails.

        Args:
            what: is done, for people.
        """
        with optional(what) as attempt:
            return step()
        assert attempt.failure is not None
        self.failed[what] = attempt.failure.reason
        return instead


def searched(problem: Problem, settings: SearchSettings, progress: Progress, campaign: Path, model: str) -> Found:
    """Return what a search finds.

    Args:
        problem: of the tests.
        progress: called with what is done.
        model: what is declared in it, for people.

    Raises:
        InputError: the declared model cannot predict the tests, or the effort is too little to fit it.
        KeyboardInterrupt: before it was fitted.
    """
    try:
        found = Search(problem, settings, progress).run()
    except ValueError as error:
        raise InputError(f"{campaign}: {model}: {error}") from error
    except EffortSpentError:
        raise InputError(
            f"--effort {settings.effort:g}: too little to fit the {model} alone; {SETTINGS.effort:g} are usual"
            " [E-CALIB-06]"
        ) from None
    if found.ending == "interrupted":
        progress("interrupted: going on with what was found so far; interrupting again writes it as it stands")
    return found
