"""Progress of a run: a bar on a terminal, plain lines elsewhere."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from edesign.study.progress import Listener, Progress, silent

LINE_EVERY = 0.1  # of an analysis, where no bar can be shown
LINE_AFTER = 2.0  # s: quicker analyses have lines at their start and end only


@contextmanager
def listener(quiet: bool = False) -> Iterator[Listener]:
    """Give a listener for `run_project` that shows on standard error how far the run is."""
    if quiet:
        yield silent
    elif sys.stderr.isatty():
        with _bar() as listen:
            yield listen
    else:
        yield PlainLines()


class PlainLines:
    """A line at the start and the end of each analysis, and at every tenth of those that take long."""

    def __init__(self) -> None:
        self._told: dict[str, int] = {}
        self._began: dict[str, float] = {}

    def __call__(self, report: Progress) -> None:
        """Print the report if it is worth a line."""
        text = describe(report)
        now = time.monotonic()
        if report.event == "start":
            self._began[report.analysis] = now
        if report.event == "advance":
            if now - self._began.get(report.analysis, now) < LINE_AFTER:
                return
            tenths = int(report.fraction / LINE_EVERY + 1e-9)
            if tenths <= self._told.get(report.analysis, 0) or report.fraction >= 1:
                return
            self._told[report.analysis] = tenths
            text = f"{place(report)}{report.analysis}: {tenths * LINE_EVERY:.0%}"
        try:
            print(text, file=sys.stderr, flush=True)
        except OSError:  # nobody reads on, or the disk of a log is full: no reason to stop a run
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def place(report: Progress) -> str:
    """Return the place in the plan, such as "[3/20] "; "" for what is not in the plan."""
    return f"[{report.index}/{report.count}] " if report.index else ""


def describe(report: Progress) -> str:
    """Return the report as one line."""
    if report.event == "note":
        return report.message
    if report.event == "start":
        return f"{place(report)}{report.analysis}"
    if report.event == "reuse":
        return f"{place(report)}{report.analysis}: reused"
    return f"{place(report)}{report.analysis}: {report.message} ({report.seconds:.2f} s)"


@contextmanager
def _bar() -> Iterator[Listener]:
    from rich.console import Console
    from rich.markup import escape
    from rich.progress import BarColumn, TaskID, TaskProgressColumn, TextColumn, TimeElapsedColumn, TimeRemainingColumn
    from rich.progress import Progress as Bars

    console = Console(stderr=True)
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Bars(*columns, console=console, transient=True) as bars:
        tasks: dict[str, TaskID] = {}

        def listen(report: Progress) -> None:
            if report.event == "start":
                tasks[report.analysis] = bars.add_task(escape(describe(report)), total=1.0)
            elif report.event == "advance" and report.analysis in tasks:
                bars.update(tasks[report.analysis], completed=report.fraction)
            else:
                if report.analysis in tasks:
                    bars.remove_task(tasks.pop(report.analysis))
                console.print(escape(describe(report)), highlight=False)

        yield listen
