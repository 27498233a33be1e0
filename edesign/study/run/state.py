"""A run under way: what is to be run, and the state that its threads share."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.ground_motion.sources import Found
from edesign.project.analysis.analyses import PlannedAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.motions.motions import AnyMotion
from edesign.study.plan.plan import Task
from edesign.study.run.backends import Backend
from edesign.study.run.backends.call import Call, Result
from edesign.study.run.outcome import Outcome
from edesign.study.run.pace import works_of
from edesign.study.run.progress import Listener, Progress

Prepared = Callable[[Task], tuple[AnalysisFile, PlannedAnalysis]]
"""Gives the frame and the analysis of a task; raises an EdesignError if it cannot be run."""


@dataclass(frozen=True)
class Job:
    """The plan of a run with its records and archive.

    Attributes:
        path: of the project or study file.
        project: whose records are used.
        tasks: the plan.
        recordings: what the plan needs, by reference.
        root: of the archive.
        warnings: about the input, for the user and the archive.
        prepare: called once the records are ready, before the first task.
        resumable: places of other groups in the archive that an interrupted run may have left.
        damper_strains: shear strain at which the dampers of a variant count for its period, where its design says it.
    """

    path: Path
    project: AnalysisFile
    tasks: tuple[Task, ...]
    recordings: Mapping[str, Found]
    root: Group
    warnings: tuple[str, ...]
    prepare: Callable[[RunState], Prepared]
    resumable: tuple[str, ...] = ()
    damper_strains: Mapping[str, float | None] = field(default_factory=dict)


@dataclass
class RunState:
    """The state of a run that its threads share."""

    job: Job
    listener: Listener
    backend: Backend
    workers: int
    writer: ArchiveWriter
    stop: threading.Event = field(default_factory=threading.Event)
    motions: Mapping[str, AnyMotion] = field(default_factory=dict)
    outcomes: dict[str, Outcome] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    critical: bool = False
    resumable: tuple[str, ...] = ()
    _lock: threading.RLock = field(default_factory=threading.RLock)

    def __post_init__(self) -> None:
        self._places = {task.name: place for place, task in enumerate(self.job.tasks, start=1)}
        self._works = works_of(self.job.project, self.job.tasks, self.job.recordings)
        self.writer.on_rewrite = self.note
        self.resumable = tuple(place for place in self.job.resumable if place in self.writer.kept)

    def report(self, report: Progress) -> None:
        """Send a report to the listener, one at a time."""
        with self._lock:
            self.listener(report)

    def note(self, message: str, left: float | None = None) -> None:
        """Report a message to the user that also stands in the summary; see `say`."""
        self.notes.append(message)
        self.say(message, left)

    def say(self, message: str, left: float | None = None) -> None:
        """Report the progress of a part of the run to the user; it does not stand in the summary.

        Args:
            left: time that is left of this part at most, s; None: it is not known.
        """
        self.report(Progress("note", message=message, count=len(self._places), left=left))

    def stopped(self) -> bool:
        """Return whether the user wants the run to stop."""
        return self.stop.is_set()

    def progress(self, name: str, done: int, total: int) -> None:
        """Report the progress of an analysis.

        Args:
            done: steps done.
            total: steps in all.
        """
        self._report("advance", name, done / total if total else 1.0)

    def started(self, name: str) -> None:
        """Report the start of an analysis."""
        self._report("start", name)

    def ended(self, outcome: Outcome) -> None:
        """Report the end of an analysis of the plan."""
        self.outcomes[outcome.name] = outcome
        message = outcome.status + (f": {outcome.reason}" if outcome.reason else "")
        self._report("reuse" if outcome.reused else "end", outcome.name, 1.0, message, outcome.seconds)

    def _report(
        self,
        event: Literal["start", "advance", "end", "reuse"],
        name: str,
        fraction: float = 0.0,
        message: str = "",
        seconds: float = 0.0,
    ) -> None:
        place = self._places.get(name, 0)
        self.report(Progress(event, name, place, len(self._places), fraction, message, seconds, self._works))

    def results(self, calls: Sequence[Call]) -> Iterator[Result]:
        """Yield the results of calls from the back end without interrupted ones; nothing starts after a stop."""
        if self.stopped():
            return
        for result in self.backend.results(calls, self, self.started):
            if not result.interrupted:
                yield result

    def archive(self, path: str, group: Group) -> None:
        """Write a group to the archive, which a second Ctrl-C does not interrupt.

        Args:
            path: place in the archive.
        """
        with self.uninterrupted():
            self.writer.write(path, group)
        if path in self.job.resumable:
            self.resumable = tuple(dict.fromkeys((*self.resumable, path)))

    @contextmanager
    def uninterrupted(self) -> Iterator[None]:
        """Hold back a second Ctrl-C while the archive is written."""
        self.critical = True
        try:
            yield
        finally:
            self.critical = False
