"""Errors that a user sees; each carries the exit code of the command line."""

from __future__ import annotations

import re

CODE = re.compile(r" \[E-[A-Z0-9]+-\d\d\]")
"""The code at the end of a message, with the space before it."""


class EdesignError(Exception):
    """Base of all errors that edesign raises on purpose; `str(error)` is the whole message for people."""

    exit_code = 1


class InputError(EdesignError):
    """Something the user wrote or pointed at is wrong: project file, record, argument."""

    exit_code = 2


class AnalysisError(EdesignError):
    """An analysis could not be finished; what was computed before it is kept."""

    exit_code = 3


class ArchiveError(EdesignError):
    """An archive cannot be read or written (missing, damaged, no permission, disk full)."""

    exit_code = 4


class StageFailed(EdesignError):
    """A stage that follows the results failed, such as a figure; the results are written."""

    exit_code = 5


class Interrupted(EdesignError):
    """The user stopped the run; the message says what was kept."""

    exit_code = 130


def split_code(message: str) -> tuple[str, str]:
    """Return a message without its code, and the code with the space before it, "" if it has none.

    A sentence that goes on, or that another message takes in, has the code at its end.
    """
    found = CODE.search(message)
    return (message[: found.start()] + message[found.end() :], found[0]) if found else (message, "")
