"""Work in stages that a user can watch and end, whatever it calls."""

from __future__ import annotations

import contextvars
import os
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeVar

from edesign.cli.shared.streams import progress_line
from edesign.report.tables.visible import visible_line
from edesign.stopping import Stopped, end_uninterrupted

R = TypeVar("R")
ProgressLine = Callable[[str], None]
LOOK = 0.1  # s between looks at the work
LINE_AFTER = 1.0  # s: on a terminal quicker stages have no line


def in_stages(work: Callable[[ProgressLine], R], quiet: bool = False) -> R:
    """Run a function in a thread, with lines on standard error for its stages, and return its result.

    On a terminal stages that last have a line. In a file or a pipe each stage has one at its beginning, so that the
    lines do not depend on the speed of the machine.

    Python answers Ctrl-C between two of its own steps only, and the factorisation of a large building is one step of
    many seconds. So this thread waits, and Ctrl-C ends it as soon as no file is being written; the work ends at its
    next stage, or with the process.

    Args:
        work: is handed a function that takes the name of each stage at its beginning.
        quiet: without lines.
    """
    stages: list[tuple[str, float]] = []
    by_time = sys.stderr.isatty()
    ended, done = threading.Event(), threading.Event()
    results: list[R] = []
    errors: list[BaseException] = []

    def progress(stage: str) -> None:
        if ended.is_set():
            raise Stopped
        stages.append((stage, time.monotonic()))
        if not by_time and not quiet:
            _print_stage(stage)

    def run() -> None:
        try:
            results.append(work(progress))
        except BaseException as error:
            errors.append(error)
        done.set()

    context: Any = contextvars.copy_context()
    thread = threading.Thread(target=context.run, args=(run,), daemon=True)
    reported = ""
    try:
        thread.start()
        while thread.is_alive():
            thread.join(LOOK)
            stage, since = stages[-1] if stages else ("", 0.0)
            lasts = time.monotonic() - since >= LINE_AFTER
            if by_time and not quiet and stage != reported and thread.is_alive() and lasts:
                reported = stage
                _print_stage(stage)
    except KeyboardInterrupt:
        ended.set()
        end_uninterrupted()
        _left.append(done)
        raise
    finally:
        ended.set()
    if errors:
        raise errors[0]
    return results[0]


def end_with(code: int) -> None:
    """End the process with an exit code if work that Ctrl-C has left still goes on in it.

    Python would take libraries down under that work, and crash.

    Args:
        code: of the command.
    """
    if not all(done.is_set() for done in _left):
        for stream in (sys.stdout, sys.stderr):
            with suppress(OSError, ValueError):
                stream.flush()
        os._exit(code)


_left: list[threading.Event] = []
"""Set when work that Ctrl-C did not wait for has ended; a `join` that it interrupts may take a thread for ended."""


def _print_stage(stage: str) -> None:
    progress_line(f"{visible_line(stage)} ...")
