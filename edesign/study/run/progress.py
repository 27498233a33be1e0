"""What a run reports while it goes on, and how much of it is left; who listens decides how to show it."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

RECENT = 8  # analyses whose time predicts that of the next: a plan begins with quick ones, and has its kinds in turn
FORESEEN = 0.05  # part of an analysis that must be done before its time is foreseen


@dataclass(frozen=True)
class Progress:
    """One report of a run.

    Attributes:
        event: "note" (text for the user), "start", "advance" or "end" of an analysis, "reuse" of an earlier result.
        analysis: name of the analysis, "" for a note.
        index: its place in the plan, from 1; 0 for a note, and for what is not in the plan, such as the fit of records.
        count: number of analyses in the plan.
        fraction: done part of this analysis, 0 to 1.
        message: text of a note; at the end the status, with the reason of a failure.
        seconds: time that the analysis took, at its end (s).
    """

    event: Literal["note", "start", "advance", "end", "reuse"]
    analysis: str = ""
    index: int = 0
    count: int = 0
    fraction: float = 0.0
    message: str = ""
    seconds: float = 0.0


Listener = Callable[[Progress], None]


def silent(report: Progress) -> None:
    """Ignore a report."""


class Tally:
    """The progress of a whole run, from the reports of its analyses.

    Attributes:
        count: analyses in the plan.
        done: those that ended or were reused.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self.count = 0
        self.done = 0
        self._clock = clock
        self._seconds: deque[float] = deque(maxlen=RECENT)
        self._running: dict[str, tuple[float, float]] = {}  # when it began, done fraction
        self._workers = 1

    def __call__(self, report: Progress) -> None:
        """Listen to a report."""
        self.count = max(self.count, report.count)
        if not report.index:
            return
        if report.event == "start":
            self._running[report.analysis] = (self._clock(), 0.0)
            self._workers = max(self._workers, len(self._running))
        elif report.event == "advance" and report.analysis in self._running:
            self._running[report.analysis] = (self._running[report.analysis][0], report.fraction)
        elif report.event in ("end", "reuse"):
            self._running.pop(report.analysis, None)
            self.done += 1
            if report.event == "end" and report.seconds > 0.0:  # what was skipped says nothing
                self._seconds.append(report.seconds)

    @property
    def fraction(self) -> float:
        """The share of the plan that is done, 0 to 1, parts of running analyses included."""
        parts = sum(fraction for _, fraction in self._running.values())
        return min((self.done + parts) / self.count, 1.0) if self.count else 0.0

    @property
    def left(self) -> float | None:
        """The estimate of the remaining time, s; None as long as nothing is known.

        Those still to come are taken to last as the latest that ended and as those that run will, on as many workers
        as were seen at the same time; nothing can end before the longest of those that run.
        """
        elapsed = {name: max(self._clock() - began, 0.0) for name, (began, _) in self._running.items()}
        foreseen = {
            name: elapsed[name] / fraction for name, (_, fraction) in self._running.items() if fraction >= FORESEEN
        }
        known = [*self._seconds, *foreseen.values()]
        if not known:
            return None
        mean = sum(known) / len(known)
        rest = [max(foreseen.get(name, mean) - elapsed[name], 0.0) for name in self._running]
        to_come = max(self.count - self.done - len(self._running), 0)
        workers = min(self._workers, max(len(rest) + to_come, 1))
        return max((sum(rest) + to_come * mean) / workers, max(rest, default=0.0))
