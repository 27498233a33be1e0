"""The records of a run: fitted before its first analysis, and archived with the warnings about their use."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Callable
from typing import Literal

from edesign.errors import EdesignError
from edesign.optional_stages import optional
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.records import Suite, record_of
from edesign.study.analysis.intensity import first_periods
from edesign.study.check.suitability import scale_warnings
from edesign.study.motions.archived import project_record_groups
from edesign.study.motions.motions import AnyMotion, match_options, project_motions
from edesign.study.motions.record_groups import failed_criteria
from edesign.study.run.progress import Progress
from edesign.study.run.state import Prepared, RunState

MATCHING = "matching"  # what the progress of the fit of the records is called


def prepare_records(run: RunState, periods: Callable[[], tuple[float, ...] | None]) -> dict[str, AnyMotion]:
    """Fit the records to the spectrum where the project says so, and return them by reference.

    Args:
        run: reports the progress; a stop leaves out what is not fitted yet.
        periods: gives T1 of the bare structure by direction, s.
    """
    started = time.monotonic()
    project, recordings = run.job.project, run.job.recordings
    fits = [name for name in recordings if match_options(project, name) is not None]
    done: list[str] = []

    def report(event: Literal["start", "advance", "end"], message: str = "") -> None:
        if fits:
            seconds, fraction = time.monotonic() - started, len(done) / len(recordings)
            run.report(Progress(event, MATCHING, 0, len(run.job.tasks), fraction, message, seconds))

    def each(motion: AnyMotion) -> None:
        done.extend(motion.parts)
        report("advance")

    report("start")
    motions = project_motions(project, recordings, periods, run.workers, each, run.stopped)
    report("end", f"{len([name for name in fits if name in done])} of {len(fits)} records")
    return motions


def archive_records(run: RunState, prepared: Prepared, periods: Callable[[], tuple[float, ...] | None]) -> None:
    """Archive the records with the warnings about their use, which the periods of designed frames decide too.

    Args:
        run: with its motions and its archive.
        prepared: gives the frame of each task.
        periods: gives T1 of the bare structure by direction, s.

    Raises:
        EdesignError: a period that a criterion of the code needs cannot be found.
    """
    project, motions = run.job.project, run.motions
    warnings: dict[str, list[str]] = {}
    with optional("the warnings about the records"):
        warnings = scale_warnings(project, run.job.tasks, motions)
    for name, texts in warnings.items():
        for text in texts:
            run.note(f"warning: records {name}: {text}")
    for place, group in project_record_groups(project, motions, periods, _variant_periods(run, prepared), warnings):
        run.archive(place, group)
        for text in failed_criteria(group.attributes["name"], group):
            run.note(f"warning: {text}")


def _variant_periods(run: RunState, prepared: Prepared) -> dict[str, dict[str, float]]:
    """T1 under gravity of the frames with dampers that each fitted suite acts on, s, by suite and label.

    The label is the variant, with the temperature of its dampers where the plan gives one, or `with dampers` of a
    project without variants. Dampers count with their stiffness at the design strain, or else in small vibrations. T1
    of the bare frame, for which the suite is raised, is not among them.

    Raises:
        EdesignError: a period cannot be found.
    """
    found: dict[str, dict[str, float]] = defaultdict(dict)
    known: dict[str, float] = {}
    for task in run.job.tasks:
        spec = task.spec
        if (
            not isinstance(spec, HistoryAnalysis)
            or not spec.dampers
            or not _is_fitted_suite(run.job.project, spec.record)
        ):
            continue
        label = task.variant or "with dampers"
        if task.temperature_C is not None:
            label += f" at {task.temperature_C:g} degC"
        if label not in known:
            try:
                frame, _ = prepared(task)
            except EdesignError:  # its design failed, and so will its histories, with that reason
                continue
            if frame.dampers is None or frame.masses is None:
                continue
            known[label] = max(first_periods(frame, True, run.job.damper_strains.get(task.variant)))
        found[record_of(spec.record)][label] = known[label]
    return found


def _is_fitted_suite(project: AnalysisFile, reference: str) -> bool:
    spec = project.records.get(record_of(reference))
    return isinstance(spec, Suite) and spec.fitted and project.hazard is not None
