"""Stages that a result can do without, such as figures, pages and advice: where one fails, the result stands.

A command writes its result first, and puts what comes after it into `optional`. A failure there is noted with its
reason; the command goes on, reports it at its end, and ends with the exit code of `StageFailed`. Outside of a command,
in Python, a failure is a warning `StageFailedWarning`, which tests take for an error.
"""

from __future__ import annotations

import errno
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path

from edesign.errors import EdesignError, Interrupted

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EIO)


class StageFailedWarning(UserWarning):
    """A stage that a result can do without has failed, and the result stands."""


@dataclass(frozen=True)
class Failure:
    """A stage that failed.

    Attributes:
        stage: what was made or done.
        error: that ended it.
        kept: where the result is, for people; "": it is not said.
    """

    stage: str
    error: Exception
    kept: str = ""

    @property
    def unexpected(self) -> bool:
        """Whether it is a mistake of edesign."""
        return not isinstance(self.error, EdesignError)

    @property
    def reason(self) -> str:
        """Why it failed, for people."""
        return str(self.error) if not self.unexpected else words_of_mistake(self.error)

    def __str__(self) -> str:
        return f"{self.stage} failed: {self.reason}"


@dataclass
class Attempt:
    """A stage while it is made; afterwards `failure` is None, or says why there is none."""

    failure: Failure | None = None


_noted: ContextVar[list[Failure] | None] = ContextVar("_noted", default=None)


@contextmanager
def noting_failures() -> Iterator[Sequence[Failure]]:
    """Note the stages that fail inside, each once, in the list that is yielded."""
    found: list[Failure] = []
    token = _noted.set(found)
    try:
        yield found
    finally:
        _noted.reset(token)


@contextmanager
def optional(stage: str, kept: str = "", passing: tuple[type[Exception], ...] = ()) -> Iterator[Attempt]:
    """Let a stage fail without its result: the failure is noted, and what follows the context goes on.

    An output whose reader has left, or that has no room, is no fault of a stage, and ends the command as elsewhere.

    Args:
        stage: what is made or done, for people: "the report".
        kept: where the result is by now, for people: "the results are in study.h5"; "" within another stage.
        passing: errors that are no failure of the stage, and end the command.

    Raises:
        Interrupted: by Ctrl-C where `kept` is said; it says so too.
        StageFailedWarning: in Python, where warnings are errors.
    """
    attempt = Attempt()
    try:
        yield attempt
    except KeyboardInterrupt as error:
        if not kept:
            raise
        raise Interrupted(f"interrupted at {stage}; {kept}") from error
    except Interrupted:
        raise
    except Exception as error:
        if isinstance(error, passing) or _of_the_output(error):
            raise
        attempt.failure = Failure(stage, error, kept)
        _note(attempt.failure)


def earlier(*paths: Path) -> str:
    """Return what to say, behind what is kept, of files of an earlier run that a stage which fails leaves there.

    Args:
        *paths: that the stage replaces.
    """
    there = [str(path) for path in paths if path.is_file()]
    return f" ({', '.join(there)} {'is' if len(there) == 1 else 'are'} of an earlier run)" if there else ""


def failure_text(failures: Sequence[Failure]) -> str:
    """Return the message of a command at whose end stages had failed.

    Args:
        failures: of `noting_failures`.
    """
    kept = dict.fromkeys(one.kept for one in failures if one.kept)
    lines = [f"{'; '.join(kept) or 'the results stand'}, but not all that follows", *map(str, failures)]
    if any(one.unexpected for one in failures):
        lines.append("please report an error in edesign itself with the output of --debug, which has its traceback")
    return "\n  ".join(lines)


def words_of_mistake(error: Exception) -> str:
    """Return what to say of an error that is a mistake of edesign; the first line of what it says itself.

    Args:
        error: of Python.
    """
    said = str(error).strip().partition("\n")[0]
    return f"an error in edesign itself ({type(error).__name__}{': ' if said else ''}{said})"


def _of_the_output(error: Exception) -> bool:
    if isinstance(error, BrokenPipeError):
        return True
    return isinstance(error, OSError) and error.errno in _NO_ROOM and error.filename is None


def _note(failure: Failure) -> None:
    found = _noted.get()
    if found is None:
        message = f"{failure}; the result stands" + (f": {failure.kept}" if failure.kept else "")
        warnings.warn(StageFailedWarning(message), stacklevel=4)
    elif str(failure) not in map(str, found):
        found.append(failure)
