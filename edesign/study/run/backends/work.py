"""A piece of work, how it ended, and what a back end that runs many of them has to do."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, Self

from edesign.errors import EdesignError
from edesign.stopping import Stopped, stoppable

INTERRUPTED = "interrupted"  # status of a value that was not finished because of a stop
NO_MEMORY = "not enough memory: use a longer time step, fewer histories in `outputs`, or fewer workers"
log = logging.getLogger("edesign")


@dataclass(frozen=True)
class Work:
    """A call whose result is wanted.

    Attributes:
        key: its unique name.
        run: a function of a module (so that other processes find it), called as
            `run(*arguments, progress=..., stop=...)`.
        arguments: anything that can be pickled. What several works share should be the same object, so that it
            travels once.
    """

    key: str
    run: Callable[..., Any]
    arguments: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Result:
    """How a piece of work ended.

    Attributes:
        key: of the work.
        value: what it returned, None if it failed or did not begin.
        reason: of the failure, "" if there was none.
        interrupted: whether it was stopped before its end.
        seconds: time it took (s).
    """

    key: str
    value: Any | None = None
    reason: str = ""
    interrupted: bool = False
    seconds: float = 0.0


Results = Generator[Result, None, None]
"""Results as they are ready; closing it before its end stops the works."""


class Control(Protocol):
    """What the one who wants the results tells and is told while the work goes on, from any thread."""

    def progress(self, key: str, done: int, total: int) -> None:
        """Hear how far a work is."""

    def stopped(self) -> bool:
        """Whether the work shall end."""


class Backend(Protocol):
    """Runs works; a context manager that holds the processes it needs."""

    name: str

    def results(self, works: Sequence[Work], control: Control, started: Callable[[str], None]) -> Results:
        """Yield results as they are ready; what they are does not depend on the back end.

        Nothing begins after `control.stopped()`, and works that did not begin have no result. Closing the generator
        ends what runs and waits for it.

        Args:
            works: each with its own key.
            control: asked for a stop, told the progress.
            started: called with the key when a work begins, before its progress.
        """

    def __enter__(self) -> Self: ...

    def __exit__(self, *error: object) -> None: ...


class LocalBackend:
    """What back ends without processes of their own have in common."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        return None


def perform(work: Work, control: Control) -> Result:
    """Run a work; whatever goes wrong in it becomes the reason of a failed result."""
    began = time.monotonic()
    if control.stopped():
        return Result(work.key, interrupted=True)
    value, reason = None, ""

    def progress(done: int, total: int) -> None:
        control.progress(work.key, done, total)

    try:
        with stoppable(control.stopped):
            value = work.run(*work.arguments, progress=progress, stop=control.stopped)
    except Stopped:
        return Result(work.key, interrupted=True, seconds=time.monotonic() - began)
    except EdesignError as error:
        reason = str(error)
    except MemoryError:
        reason = NO_MEMORY
    except Exception as error:  # one analysis must not take the others with it
        log.exception("analysis %s", work.key)
        reason = internal_error(error)
    interrupted = getattr(value, "attributes", {}).get("status") == INTERRUPTED
    return Result(work.key, value, reason, interrupted, time.monotonic() - began)


def internal_error(error: Exception) -> str:
    """Return the reason of a failure that is edesign's own."""
    return f"internal error, please report it ({type(error).__name__}: {error})"


def check_keys(works: Sequence[Work]) -> None:
    """Refuse works that could not be told apart.

    Raises:
        ValueError: two have the same key.
    """
    if len({work.key for work in works}) < len(works):
        raise ValueError("two works have the same key")
