"""What a run reports while it goes on, and how much of it is left; who listens decides how to show it."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Literal

from edesign.study.run.pace import Pace, Work

FORESEEN = 0.05  # part of an analysis that must be done before its time is foreseen
NEGLIGIBLE = 0.1  # part of the steps to come whose pace may be unknown when the time that is left is said


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
        plan: how much work each analysis of the plan is; empty where it is not known.
        left: time that is left at most of what a note is of, s; None: it is not known.
    """

    event: Literal["note", "start", "advance", "end", "reuse"]
    analysis: str = ""
    index: int = 0
    count: int = 0
    fraction: float = 0.0
    message: str = ""
    seconds: float = 0.0
    plan: Mapping[str, Work] = field(default_factory=dict, repr=False)
    left: float | None = None


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
        self._plan: Mapping[str, Work] = {}
        self._to_come: dict[str, Work] = {}
        self._pace = Pace()
        self._running: dict[str, tuple[float, float]] = {}  # when it began, done fraction
        self._workers = 1
        self._begun: float | None = None  # when the first began
        self._busy, self._ended = 0.0, 0  # s that those which ended took, and how many there are

    def __call__(self, report: Progress) -> None:
        """Listen to a report."""
        self.count = max(self.count, report.count)
        if report.plan and not self._plan:
            self._plan, self._to_come = report.plan, dict(report.plan)
        if not report.index:
            return
        now, name = self._clock(), report.analysis
        if report.event == "start":
            self._begun = now if self._begun is None else self._begun
            self._running[name] = (now, 0.0)
            self._to_come.pop(name, None)
            self._workers = max(self._workers, len(self._running))
        elif report.event == "advance" and name in self._running:
            self._running[name] = (self._running[name][0], report.fraction)
        elif report.event in ("end", "reuse"):
            self._running.pop(name, None)
            self._to_come.pop(name, None)
            self.done += 1
            if report.event == "end" and report.seconds > 0.0:  # what was skipped says nothing
                self._busy, self._ended = self._busy + report.seconds, self._ended + 1
                self._pace.add(self._work(name), report.seconds)

    @property
    def fraction(self) -> float:
        """The share of the steps of the plan that is done, 0 to 1, parts of running analyses included."""
        if not self.count:
            return 0.0
        if not self._plan:
            return min((self.done + sum(part for _, part in self._running.values())) / self.count, 1.0)
        left = sum(work.steps for work in self._to_come.values())
        left += sum((1.0 - part) * self._work(name).steps for name, (_, part) in self._running.items())
        return min(max(1.0 - left / sum(work.steps for work in self._plan.values()), 0.0), 1.0)

    @property
    def left(self) -> float | None:
        """The estimate of the remaining time, s; None as long as nothing is known of most of what is to come.

        Those still to come are taken to last as their steps and the pace of the variant, level and kind that ended say,
        on as many workers as were seen at the same time. As much time passes between analyses as so far. Nothing can
        end before the longest of those that run.
        """
        now = self._clock()
        elapsed = {name: max(now - began, 0.0) for name, (began, _) in self._running.items()}
        pace, foreseen = self._pace.copy(), {}
        for name, (_, part) in self._running.items():
            if part >= FORESEEN:
                foreseen[name] = elapsed[name] / part
                pace.add(self._work(name), foreseen[name])
        for name in self._running:
            foreseen.setdefault(name, pace.seconds(self._work(name)) or elapsed[name])
        works = list(self._to_come.values())
        if not self._plan:
            works = [Work()] * max(self.count - self.done - len(self._running), 0)
        times = {work: pace.seconds(work) for work in set(works)}
        unknown = sum(work.steps for work in works if times[work] is None)
        if not pace.known or unknown > NEGLIGIBLE * sum(work.steps for work in works):
            return None
        rest = [max(foreseen[name] - elapsed[name], 0.0) for name in self._running]
        to_come = sum(times[work] or 0.0 for work in works)
        workers = min(self._workers, max(len(rest) + len(works), 1))
        busy = self._busy + sum(elapsed.values())
        if self._begun is not None and self._ended:
            between = max((now - self._begun) * self._workers - busy, 0.0) / self._ended
            to_come += between * len(works)
        return max((sum(rest) + to_come) / workers, max(rest, default=0.0))

    def _work(self, name: str) -> Work:
        return self._plan.get(name, Work())
