"""Errors that a user sees; each carries the exit code of the command line."""

from __future__ import annotations


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
