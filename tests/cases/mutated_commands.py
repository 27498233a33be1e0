"""What commands say of files with mistakes: exit code and message, within a limit of time."""

from __future__ import annotations

import io
import re
import signal
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from pathlib import Path
from types import FrameType

from edesign.cli.main import main

LIMIT = 120.0  # s of CPU time; the slowest of mutated building files takes 15 s


class TooLong(BaseException):
    """A command takes longer than its limit; nothing in edesign catches it."""


@contextmanager
def limit(seconds: float) -> Iterator[None]:
    def ring(number: int, frame: FrameType | None) -> None:
        raise TooLong

    before = signal.signal(signal.SIGPROF, ring)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


def outcome(words: list[str]) -> tuple[int | str, str]:
    """Exit code and standard error of a command; of one that is stopped or breaks off the name of the reason."""
    errors = io.StringIO()
    try:
        with redirect_stdout(io.StringIO()), redirect_stderr(errors), limit(LIMIT):
            code: int | str = main(words)
    except BaseException as error:
        code = type(error).__name__
    return code, errors.getvalue()


def fault(code: int | str, said: str, *paths: Path, allowed: tuple[int, ...] = (0, 2)) -> str:
    """What is wrong with the end of a command, "" if nothing is: it is done, or refuses a file with a place in it.

    Args:
        code, said: from `outcome`.
        paths: files one of which a refusal names.
        allowed: exit codes.
    """
    if code not in allowed:
        return f"ends with {code}"
    message, names = said[said.find("edesign: ") :], "|".join(re.escape(str(path)) for path in paths)
    if code == 2 and not re.match(rf"edesign: ({names}):[0-9]+:[0-9]+: \S", message):
        return "has no place"
    return ""
