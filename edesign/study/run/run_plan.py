"""Carrying a plan out: every analysis into the archive as soon as it is finished, whatever happens on the way."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from functools import cache, partial
from pathlib import Path

from edesign.archive.dataset import Group
from edesign.archive.files import source_file
from edesign.archive.owner import check_owner, file_checksum
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter, partial_path, renew_root
from edesign.errors import EdesignError, Interrupted, split_code
from edesign.stopping import stoppable
from edesign.study.analysis.modal import fundamental_period
from edesign.study.plan.plan import Task, waves
from edesign.study.results.hazard import hazard_groups
from edesign.study.results.provenance import IDENTITY, circumstances, now
from edesign.study.results.warnings import ATTRIBUTE
from edesign.study.run.analyses import analyse, analyse_stripe
from edesign.study.run.backends import Backend
from edesign.study.run.backends.call import Call, Result
from edesign.study.run.interrupt import stop_on_signals
from edesign.study.run.outcome import COLLAPSED, COMPLETED, FAILED, SKIPPED, Outcome, RunSummary
from edesign.study.run.progress import Listener, Progress
from edesign.study.run.records import archive_records, prepare_records
from edesign.study.run.state import Job, Prepared, RunState


def run_plan(
    job: Job,
    path: Path,
    listener: Listener,
    backend: Backend,
    workers: int,
    fresh: bool = False,
    overwrite: bool = False,
) -> RunSummary:
    """Run the analyses of a plan and archive them.

    An analysis that fails is archived as failed with its reason, and the run goes on. Results of an interrupted run of
    the same inputs and versions are reused. So are those of a complete archive whose project or study has had another
    title, `document` or comments since. The histories of incremental studies run in waves, from the lowest
    intensity; what is skipped after a collapse depends on its chain alone.

    Args:
        listener: of the progress.
        workers: threads for the records.
        fresh: True discards the results of an interrupted run.
        overwrite: True replaces the archive of another project too.

    Raises:
        ArchiveError: the archive cannot be written, or is that of another project; what was archived before stays in
            the partial file.
        EdesignError: of the back end or of a design; likewise.
        Interrupted: stopped by the user (Ctrl-C) or by SIGTERM; finished analyses stay in the partial file.
    """
    started = time.monotonic()
    job.root.attributes["source_file"] = source_file(job.path, path)
    check_owner(path, job.root, overwrite)
    renewed = None if fresh else _with_new_head(job, path, listener, started)
    if renewed is not None:
        return renewed
    tasks = {task.path: task for task in job.tasks}
    earlier: dict[str, Outcome] = {}

    def accept(place: str, attributes: Mapping[str, object]) -> bool:
        if place not in tasks:
            return place in job.resumable
        task, status = tasks[place], str(attributes.get("status"))
        if status != COMPLETED and (task.stripe is None or status != COLLAPSED):
            return False
        earlier[place] = Outcome(task.name, status, str(attributes.get("reason") or ""), reused=True)
        return True

    extra = {"provenance": circumstances()}
    job.root.attributes[ATTRIBUTE] = list(job.warnings)
    with ArchiveWriter(path, job.root, IDENTITY, None if fresh else accept, extra) as writer:
        run = RunState(job, listener, backend, workers, writer)
        if writer.note:
            run.note(writer.note)
        kept = [place for place in writer.kept if place in tasks]
        if kept or run.resumable:
            found = f", with {_places(run)}" if run.resumable else ""
            run.note(f"continuing an interrupted run: {len(kept)} of {len(tasks)} analyses are reused{found}")
        for warning in job.warnings:
            run.note(f"warning: {warning}")
        for place in kept:
            run.ended(earlier[place])
        with stop_on_signals(run.stop, lambda: run.critical), stoppable(run.stopped):
            try:
                _run_tasks(run)
            except KeyboardInterrupt:
                run.stop.set()
            except EdesignError as error:
                if _keep(run):
                    sentence, code = split_code(str(error))
                    error.args = (f"{sentence}; {_kept(run)}{code}",)
                raise
            if run.stopped() and len(run.outcomes) < len(tasks):
                _keep(run)
                raise Interrupted(_kept_message(run, path))
            with run.uninterrupted():
                failed = any(outcome.failed for outcome in run.outcomes.values())
                writer.finish({"status": FAILED if failed else COMPLETED})
    outcomes = tuple(run.outcomes[task.name] for task in job.tasks)
    return RunSummary(path, outcomes, tuple(run.notes), time.monotonic() - started)


def _with_new_head(job: Job, path: Path, listener: Listener, started: float) -> RunSummary | None:
    """Give a complete archive the texts, title and `document` of today where nothing else has changed.

    Returns:
        None if there is no such archive, an analysis of it failed, or the texts are those of the archive: who runs the
        same again wants it to run.
    """
    root = job.root
    root.attributes[ATTRIBUTE] = list(job.warnings)
    try:
        if not path.is_file() or partial_path(path).exists():
            return None
        with open_archive(path) as opened:
            old = opened.attributes
            made = opened.group_attributes("provenance") if opened.has("provenance") else {}
            ends = {task.path: opened.group_attributes(task.path) for task in job.tasks if opened.has(task.path)}
            complete = opened.complete and not opened.damage
    except (EdesignError, OSError):  # who writes the archive reports why it cannot
        return None
    alike = all(old.get(name) == root.attributes.get(name) for name in (*IDENTITY, "planned"))
    whole = complete and old.get("status") == COMPLETED and len(ends) == len(job.tasks)
    if not (alike and whole) or file_checksum(old) == file_checksum(root.attributes):
        return None
    renew_root(path, root, {"provenance": Group(attributes={**made, "head_renewed": now()})}, {"status": COMPLETED})
    note = (
        f"only the title, `document`, comments or layout have changed: the head of {path.name} was renewed, no "
        "analysis ran again (--fresh runs all)"
    )
    listener(Progress("note", message=note, count=len(job.tasks)))
    outcomes = tuple(
        Outcome(task.name, str(ends[task.path].get("status")), str(ends[task.path].get("reason") or ""), reused=True)
        for task in job.tasks
    )
    return RunSummary(path, outcomes, (note,), time.monotonic() - started)


def _run_tasks(run: RunState) -> None:
    for place, group in hazard_groups(run.job.project.hazard):
        run.archive(place, group)
    periods = cache(partial(fundamental_period, run.job.project))
    run.motions = prepare_records(run, periods)
    if run.stopped():
        return
    prepared = run.job.prepare(run)
    if run.stopped():
        return
    archive_records(run, prepared, periods)
    fallen: dict[str, str] = {}  # why the rest of a chain is skipped
    for wave in waves(run.job.tasks):
        for task, stripe in ((task, task.stripe) for task in wave if task.stripe is not None):
            if stripe.chain in fallen:  # also what an interrupted run has computed, if a failure below it fell now
                skipped = Group(attributes={"status": SKIPPED})
                _archive(run, task, Result(task.name, skipped, fallen[stripe.chain]))
        _run_wave(run, [task for task in wave if task.name not in run.outcomes], prepared)
        if run.stopped():
            return
        for task in wave:
            if task.stripe is not None and run.outcomes[task.name].status == COLLAPSED:
                fallen[task.stripe.chain] = f"collapsed at {task.name.removeprefix(f'{task.stripe.chain}.')}"


def _run_wave(run: RunState, tasks: Sequence[Task], prepared: Prepared) -> None:
    """Run analyses that do not depend on each other, and archive each as soon as it is finished."""
    calls = []
    for task in tasks:
        try:
            project, spec = prepared(task)
        except EdesignError as error:
            _archive(run, task, Result(task.name, reason=str(error)))
            continue
        how = analyse if task.stripe is None else analyse_stripe
        motions = run.motions.get(task.record or ""), run.motions.get(task.vertical_record or "")
        calls.append(Call(task.name, how, (project, spec, *motions)))
    by_name = {task.name: task for task in tasks}
    for result in run.results(calls):
        _archive(run, by_name[result.key], result)


def _archive(run: RunState, task: Task, result: Result) -> None:
    group = result.value if isinstance(result.value, Group) else Group(attributes={"status": FAILED})
    status = str(group.attributes.get("status", COMPLETED))
    if task.stripe is not None and group.attributes.get("collapsed"):
        status = COLLAPSED  # what the study looks for
    reason = result.reason or str(group.attributes.get("reason") or "")
    attributes = {**group.attributes, **task.labels, "status": status, "reason": reason}
    run.archive(task.path, Group(group.coords, group.variables, attributes))
    run.ended(Outcome(task.name, status, reason, seconds=result.seconds))


def _keep(run: RunState) -> bool:
    """Leave the partial file if there is something in it that the next run can use; say whether there is."""
    if run.outcomes or run.resumable:
        return True
    run.writer.discard()
    return False


def _kept_message(run: RunState, path: Path) -> str:
    if not run.outcomes and not run.resumable:
        return f"interrupted before an analysis was finished; {path} is unchanged"
    return f"interrupted: {_kept(run)}; the same command with {run.job.path} goes on from there (--fresh starts anew)"


def _kept(run: RunState) -> str:
    others = f", with {_places(run)}," if run.resumable else ""
    return f"{len(run.outcomes)} of {len(run.job.tasks)} analyses are finished{others} and kept in {run.writer.partial}"


def _places(run: RunState) -> str:
    return " and ".join(run.resumable)
