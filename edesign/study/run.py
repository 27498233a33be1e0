"""Run a project: every analysis of the plan, each into the archive as soon as it is finished."""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Literal

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter, partial_path
from edesign.errors import ArchiveError, EdesignError, Interrupted
from edesign.ground_motion.sources import Found
from edesign.project.project import Project
from edesign.study import analyses
from edesign.study.check import check_inputs
from edesign.study.dampers import law_warnings
from edesign.study.interrupt import stop_on_signals
from edesign.study.modal import fundamental_period
from edesign.study.motions import Motion, match_options, project_motions
from edesign.study.plan import Task, make_plan
from edesign.study.progress import Listener, Progress, silent
from edesign.study.provenance import IDENTITY, circumstances, root_group
from edesign.study.record_results import project_record_groups

MATCHING = "matching"  # what the progress of the fit of the records is called
COMPLETED, FAILED, INTERRUPTED = "completed", "failed", "interrupted"
log = logging.getLogger("edesign")


@dataclass(frozen=True)
class Outcome:
    """How one analysis ended.

    Attributes:
        name: of the analysis.
        status: "completed" or "failed".
        reason: of the failure, "" if there was none.
        reused: whether the result is that of an earlier, interrupted run.
        seconds: time it took (s), 0 if reused.
    """

    name: str
    status: str
    reason: str = ""
    reused: bool = False
    seconds: float = 0.0


@dataclass(frozen=True)
class RunSummary:
    """What a run did.

    Attributes:
        archive: the finished archive.
        outcomes: one for each analysis, in the order of the plan.
        notes: what the user was told, such as what became of an interrupted run.
        seconds: time of the whole run (s).
    """

    archive: Path
    outcomes: tuple[Outcome, ...]
    notes: tuple[str, ...] = ()
    seconds: float = 0.0

    @property
    def failed(self) -> tuple[Outcome, ...]:
        """The analyses that failed."""
        return tuple(outcome for outcome in self.outcomes if outcome.status != COMPLETED)


def run_project(
    project: Project,
    archive_path: str | os.PathLike[str] | None = None,
    progress: Listener | None = None,
    workers: int = 1,
    only: Sequence[str] = (),
    fresh: bool = False,
) -> RunSummary:
    """Run the analyses of a project and archive them.

    An analysis that fails is archived as failed with its reason, and the run goes on. Results of an interrupted run
    of the same project, inputs and versions are reused. Results do not depend on `workers`.

    Args:
        project: from `load_project`.
        archive_path: the archive; by default what the project says, with the names appended if `only` selects some.
        progress: called with a `Progress` at every step worth telling, from one thread at a time.
        workers: number of analyses that run at the same time, in threads.
        only: names of the analyses to run; all if empty.
        fresh: True discards the results of an interrupted run.

    Returns:
        Where the archive is and how each analysis ended.

    Raises:
        InputError: an unknown name in `only`, a record that cannot be read, a frame that cannot be built.
        ArchiveError: the archive cannot be written; what was archived before stays in the partial file.
        Interrupted: stopped by the user (Ctrl-C) or by SIGTERM; finished analyses stay in the partial file.
    """
    started = time.monotonic()
    plan = make_plan(project, only)
    path = Path(archive_path) if archive_path is not None else default_archive_path(project, only)
    recordings = check_inputs(project, [task.spec for task in plan])
    checksums = {name: found.record.checksum for name, found in recordings.items()}
    run = _Run(project, plan, progress or silent)
    tasks = {task.path: task for task in plan}

    def accept(place: str, attributes: Mapping[str, object]) -> bool:
        return place in tasks and attributes.get("status") == COMPLETED

    root = root_group(project, [task.name for task in plan], checksums)
    extra = {"provenance": circumstances()}
    with ArchiveWriter(path, root, IDENTITY, None if fresh else accept, extra) as writer:
        if writer.note:
            run.note(writer.note)
        if writer.kept:
            run.note(f"continuing an interrupted run: {len(writer.kept)} of {len(plan)} analyses are reused")
        if any(task.spec.dampers for task in plan):
            for warning in law_warnings(project):
                run.note(warning)
        for place in writer.kept:
            run.reuse(tasks[place])
        todo = [task for task in plan if task.path not in writer.kept]
        with stop_on_signals(run.stop, lambda: run.critical):
            try:
                run.motions = _prepare_records(writer, run, recordings, workers)
                for task, group, seconds in _results(run, todo, workers):
                    with run.uninterrupted():
                        _archive(writer, run, task, group, seconds)
            except KeyboardInterrupt:
                run.stop.set()
            except EdesignError as error:
                if not run.outcomes:
                    writer.discard()
                elif isinstance(error, ArchiveError):
                    raise ArchiveError(f"{error}; {_kept(path, len(run.outcomes), len(plan))}") from error
                raise
            if run.stop.is_set() and len(run.outcomes) < len(plan):
                if not run.outcomes:
                    writer.discard()
                raise Interrupted(_kept_message(path, project, len(run.outcomes), len(plan)))
            with run.uninterrupted():
                failed = any(outcome.status != COMPLETED for outcome in run.outcomes.values())
                writer.finish({"status": FAILED if failed else COMPLETED})
    outcomes = tuple(run.outcomes[task.name] for task in plan)
    return RunSummary(path, outcomes, tuple(run.notes), time.monotonic() - started)


def default_archive_path(project: Project, only: Sequence[str] = ()) -> Path:
    """Return where a run writes: the archive of the project; with `only`, one beside it that spares the full one."""
    path = project.archive_path
    if not only:
        return path
    return path.with_name(f"{path.stem}.{'+'.join(only)[:80]}{path.suffix}")


@dataclass
class _Run:
    """The state of a run that its threads share."""

    project: Project
    plan: tuple[Task, ...]
    listener: Listener
    stop: threading.Event = field(default_factory=threading.Event)
    motions: Mapping[str, Motion] = field(default_factory=dict)
    outcomes: dict[str, Outcome] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    critical: bool = False
    _lock: threading.RLock = field(default_factory=threading.RLock)

    def tell(self, report: Progress) -> None:
        with self._lock:
            self.listener(report)

    def note(self, message: str) -> None:
        self.notes.append(message)
        self.tell(Progress("note", message=message, count=len(self.plan)))

    def start(self, task: Task) -> None:
        self.tell(Progress("start", task.name, self.plan.index(task) + 1, len(self.plan)))

    def advance(self, task: Task) -> Callable[[int, int], None]:
        place = self.plan.index(task) + 1

        def report(done: int, total: int) -> None:
            self.tell(Progress("advance", task.name, place, len(self.plan), done / total if total else 1.0))

        return report

    def end(self, task: Task, outcome: Outcome) -> None:
        self.outcomes[task.name] = outcome
        message = outcome.status + (f": {outcome.reason}" if outcome.reason else "")
        event: Literal["reuse", "end"] = "reuse" if outcome.reused else "end"
        place = self.plan.index(task) + 1
        self.tell(Progress(event, task.name, place, len(self.plan), 1.0, message, outcome.seconds))

    def reuse(self, task: Task) -> None:
        self.end(task, Outcome(task.name, COMPLETED, reused=True))

    @contextmanager
    def uninterrupted(self) -> Iterator[None]:
        """Hold back a second Ctrl-C while the archive is written."""
        self.critical = True
        try:
            yield
        finally:
            self.critical = False


def _prepare_records(
    writer: ArchiveWriter, run: _Run, recordings: Mapping[str, Found], workers: int
) -> dict[str, Motion]:
    """Fit the records to the spectrum where the project says so, and archive them."""
    started = time.monotonic()
    fits = [name for name in recordings if match_options(run.project, name) is not None]
    done: list[str] = []

    def tell(event: Literal["start", "advance", "end"], message: str = "") -> None:
        if fits:
            seconds, fraction = time.monotonic() - started, len(done) / len(recordings)
            run.tell(Progress(event, MATCHING, 0, len(run.plan), fraction, message, seconds))

    def each(motion: Motion) -> None:
        done.append(motion.name)
        tell("advance")

    tell("start")
    period = cache(partial(fundamental_period, run.project))
    motions = project_motions(run.project, recordings, period, workers, each, run.stop.is_set)
    tell("end", f"{len([name for name in fits if name in motions])} of {len(fits)} records")
    if not run.stop.is_set():
        with run.uninterrupted():
            for place, group in project_record_groups(run.project, motions, period):
                writer.write(place, group)
    return motions


def _analyse(run: _Run, task: Task) -> tuple[Group, float]:
    """Run one analysis; whatever goes wrong in it becomes a group with the status "failed"."""
    started = time.monotonic()
    if run.stop.is_set():
        return Group(attributes={"status": INTERRUPTED}), 0.0
    run.start(task)
    try:
        motion = run.motions.get(task.record or "")
        group = analyses.run_analysis(
            run.project, task.spec, progress=run.advance(task), stop=run.stop.is_set, motion=motion
        )
    except EdesignError as error:
        group = Group(attributes={"status": FAILED, "reason": str(error)})
    except MemoryError:
        reason = "not enough memory: use a longer time step, fewer histories in `outputs`, or fewer workers"
        group = Group(attributes={"status": FAILED, "reason": reason})
    except Exception as error:  # one analysis must not take the others with it
        log.exception("analysis %s", task.name)
        reason = f"internal error, please report it ({type(error).__name__}: {error})"
        group = Group(attributes={"status": FAILED, "reason": reason})
    return group, time.monotonic() - started


def _results(run: _Run, tasks: Sequence[Task], workers: int) -> Iterator[tuple[Task, Group, float]]:
    """Yield results as they come; interrupted analyses are left out, and none starts after a stop."""
    if run.stop.is_set():
        return
    if workers <= 1:
        for task in tasks:
            if run.stop.is_set():
                return
            group, seconds = _analyse(run, task)
            if group.attributes.get("status") != INTERRUPTED:
                yield task, group, seconds
        return
    pool = ThreadPoolExecutor(workers, thread_name_prefix="edesign")
    try:
        waiting: dict[Future[tuple[Group, float]], Task] = {pool.submit(_analyse, run, task): task for task in tasks}
        while waiting:
            done, _ = wait(waiting, timeout=0.2, return_when=FIRST_COMPLETED)
            for future in sorted(done, key=lambda item: waiting[item].order):
                task = waiting.pop(future)
                group, seconds = future.result()
                if group.attributes.get("status") != INTERRUPTED:
                    yield task, group, seconds
            if run.stop.is_set():
                for future in [future for future in waiting if future.cancel()]:
                    del waiting[future]
    finally:
        if waiting:  # left by an error or Ctrl-C: the others need not go on
            run.stop.set()
        pool.shutdown(wait=True, cancel_futures=True)


def _archive(writer: ArchiveWriter, run: _Run, task: Task, group: Group, seconds: float) -> None:
    status = str(group.attributes.get("status", COMPLETED))
    reason = str(group.attributes.get("reason") or "")
    attributes = {**group.attributes, **task.labels, "status": status, "reason": reason}
    writer.write(task.path, Group(group.coords, group.variables, attributes))
    run.end(task, Outcome(task.name, status, reason, seconds=seconds))


def _kept_message(path: Path, project: Project, kept: int, planned: int) -> str:
    if kept == 0:
        return f"interrupted before an analysis was finished; {path} is unchanged"
    return (
        f"interrupted: {_kept(path, kept, planned)}; "
        f"the same command with {project.path} goes on from there (--fresh starts anew)"
    )


def _kept(path: Path, kept: int, planned: int) -> str:
    return f"{kept} of {planned} analyses are finished and kept in {partial_path(path)}"
