"""A call, how it ended, and what a back end that runs many of them has to do."""

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
class Call:
    """A call whose result is wanted.

    Attributes:
        key: its unique name.
        run: a function of a module (so that other processes find it), called as
            `run(*arguments, progress=..., stop=...)`.
        arguments: anything that can be pickled. What several calls share should be the same object, so that it
            travels once.
    """

    key: str
    run: Callable[..., Any]
    arguments: tuple[Any, ...] = ()


@dataclass(frozen=True)
class Result:
    """The result of a call, or the reason of its failure.

    Attributes:
        key: of the call.
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
"""Results as they are ready; closing it before its end stops the calls."""


class Control(Protocol):
    """The progress and stop signals between a back end and its caller, from any thread."""

    def progress(self, key: str, done: int, total: int) -> None:
        """Report the progress of a call.

        Args:
            done: steps done.
            total: steps in all.
        """

    def stopped(self) -> bool:
        """Return whether calls shall end."""


class Backend(Protocol):
    """A back end that runs calls; it is a context manager that holds the processes it needs."""

    name: str

    def results(self, calls: Sequence[Call], control: Control, started: Callable[[str], None]) -> Results:
        """Yield the results of calls as they are ready; their values do not depend on the back end.

        Nothing begins after `control.stopped()`, and calls that did not begin have no result. Closing the generator
        ends what runs and waits for it.

        Args:
            calls: each with its own key.
            control: asked for a stop, receives the progress.
            started: called with the key when a call begins, before its progress.
        """

    def __enter__(self) -> Self: ...

    def __exit__(self, *error: object) -> None: ...


class LocalBackend:
    """A back end without processes of its own."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        return None


def perform(call: Call, control: Control) -> Result:
    """Run a call; any error becomes the reason of a failed result.

    Args:
        call: the function and its arguments.
        control: receives the progress and is asked whether to stop.
    """
    began = time.monotonic()
    if control.stopped():
        return Result(call.key, interrupted=True)
    value, reason = None, ""

    def progress(done: int, total: int) -> None:
        control.progress(call.key, done, total)

    try:
        with stoppable(control.stopped):
            value = call.run(*call.arguments, progress=progress, stop=control.stopped)
    except Stopped:
        return Result(call.key, interrupted=True, seconds=time.monotonic() - began)
    except EdesignError as error:
        reason = str(error)
    except MemoryError:
        reason = NO_MEMORY
    except Exception as error:  # one analysis must not take the others with it
        log.exception("analysis %s", call.key)
        reason = internal_error(error)
    interrupted = getattr(value, "attributes", {}).get("status") == INTERRUPTED
    return Result(call.key, value, reason, interrupted, time.monotonic() - began)


def internal_error(error: Exception) -> str:
    """Return the message of a failure that is an error of edesign."""
    return f"internal error, please report it ({type(error).__name__}: {error})"


def check_keys(calls: Sequence[Call]) -> None:
    """Check that the keys of calls are unique.

    Raises:
        ValueError: two have the same key.
    """
    if len({call.key for call in calls}) < len(calls):
        raise ValueError("two calls have the same key")
