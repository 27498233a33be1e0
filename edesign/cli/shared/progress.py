"""Progress of a run: bars on a terminal, plain lines elsewhere."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, TaskID, TaskProgressColumn, TextColumn, TimeElapsedColumn
from rich.progress import Progress as Bars
from rich.text import Text  # in which brackets and colons are no markup

from edesign.cli.shared.streams import LOG_EVERY
from edesign.report.tables.visible import visible, visible_line
from edesign.study.run.progress import Listener, Progress, Tally, silent

REPORTED_FROM = 1.0  # s: less that is left is not worth a line


@contextmanager
def listener(quiet: bool = False) -> Iterator[Listener]:
    """Return a listener for `run_project` that shows the progress of the run on standard error."""
    if quiet:
        yield silent
    elif sys.stderr.isatty():
        with _bars() as listen:
            yield listen
    else:
        yield PlainLines()


class PlainLines:
    """A listener that prints a line at the end of each analysis, and of those that last at most one a minute."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._last = clock()
        self._tally = Tally(clock)

    def __call__(self, report: Progress) -> None:
        """Print the report if it is worth a line."""
        self._tally(report)
        text = describe(report)
        if report.event in ("start", "advance"):
            if self._clock() - self._last < LOG_EVERY:
                return
            text = f"{visible_line(place(report) + report.analysis)}: {report.fraction:.0%}"
        if report.event in ("end", "advance") and report.index:
            left = remaining(self._tally.left, ", about ")
            text += f"; {self._tally.fraction:.0%} done{left}" if left and self._tally.count > 1 else left
        self._last = self._clock()
        try:
            print(text, file=sys.stderr, flush=True)
        except OSError:  # nobody reads on, or the disk of a log is full: no reason to stop a run
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stderr.fileno())


def place(report: Progress) -> str:
    """Return the place of an analysis in the plan, such as "[3/20] "; "" outside the plan."""
    return f"[{report.index}/{report.count}] " if report.index else ""


def describe(report: Progress) -> str:
    """Return the report as a line; the reason of a failure may have more. Control characters are written out."""
    message = visible(report.message)
    if report.event == "note":
        return message + remaining(report.left, ", at most about ")
    name = place(report) + visible_line(report.analysis)
    if report.event == "start":
        return name
    return f"{name}: reused" if report.event == "reuse" else f"{name}: {message} ({duration(report.seconds)})"


def duration(seconds: float) -> str:
    """Return a time with the digits that matter: 0.042 s, 1.2 s, 25 s, 2 min 5 s, 1 h 20 min."""
    if seconds < 9.95:
        return f"{seconds:.2g} s"
    whole = round(seconds)
    if whole < 100:
        return f"{whole} s"
    if whole < 3600:
        return f"{whole // 60} min {whole % 60} s"
    return f"{whole // 3600} h {whole % 3600 // 60} min"


def remaining(seconds: float | None, before: str = "") -> str:
    """Return the estimate of the remaining time, such as "25 s left"; "" if there is none or it is negligible."""
    if seconds is None or seconds < REPORTED_FROM:
        return ""
    step = 1 if seconds < 10 else 5 if seconds < 120 else 60  # s: no more digits than an estimate has
    return f"{before}{duration(step * round(seconds / step))} left".replace(" min 0 s", " min")


@contextmanager
def _bars() -> Iterator[Listener]:
    """A bar for the run if it has several analyses, and one for each that is running."""
    console = Console(file=sys.stderr)
    columns = (
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TaskProgressColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[left]}", markup=False),
    )
    with Bars(*columns, console=console, transient=True) as bars:
        tasks: dict[str, TaskID] = {}
        tally = Tally()
        overall: list[TaskID] = []

        def listen(report: Progress) -> None:
            tally(report)
            if tally.count > 1 and not overall:
                overall.append(bars.add_task("", total=1.0, left=""))
            if report.event == "start":
                tasks[report.analysis] = bars.add_task(describe(report), total=1.0, left="")
            elif report.event == "advance" and report.analysis in tasks:
                bars.update(tasks[report.analysis], completed=report.fraction)
            else:
                if report.analysis in tasks:
                    bars.remove_task(tasks.pop(report.analysis))
                console.print(Text(describe(report)))
            for task in overall:
                done = f"{tally.done}/{tally.count} analyses"
                left = remaining(tally.left, "about ")
                bars.update(task, description=done, completed=tally.fraction, left=left)

        yield listen
