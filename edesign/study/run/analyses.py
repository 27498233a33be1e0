"""Run one analysis of a project, as who wants it calls it and as a back end does."""

from __future__ import annotations

from collections.abc import Callable

from edesign.archive.dataset import Group
from edesign.errors import AnalysisError
from edesign.project.analysis.analyses import (
    GravityAnalysis,
    HistoryAnalysis,
    ModalAnalysis,
    PlannedAnalysis,
    TargetAnalysis,
)
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.gravity import run_gravity
from edesign.study.analysis.history import run_history
from edesign.study.analysis.modal import run_modal
from edesign.study.analysis.pushover import run_pushover
from edesign.study.analysis.target import run_target
from edesign.study.motions.motions import Motion
from edesign.study.plan.plan import labels


def run_analysis(
    project: AnalysisFile,
    spec: PlannedAnalysis,
    progress: Callable[[int, int], None] | None = None,
    stop: Callable[[], bool] | None = None,
    motion: Motion | None = None,
    vertical: Motion | None = None,
) -> Group:
    """Run one analysis of a project.

    Args:
        progress: called now and then with (steps done, steps) of a history or pushover.
        stop: asked now and then; True ends a history or pushover with the status "interrupted".
        motion: the record of a history, made ready; None reads it.
        vertical: likewise that of its vertical motion.

    Returns:
        The results, ready for the archive. Attributes: name, kind, variant, record, level (None where there is none),
        height (of the frame, m), status ("completed", "failed", "interrupted"), reason, and, where steps were made,
        statistics and events. An analysis that failed has what was computed before.

    Raises:
        InputError: the frame cannot be built, the record cannot be read, or a requested output does not exist.
    """
    try:
        group = _run(project, spec, progress, stop, motion, vertical)
    except AnalysisError as error:
        group = Group(attributes={"status": "failed", "reason": str(error)})
    group.attributes |= {**labels(spec), "height": project.grid.height}
    return group


def _run(
    project: AnalysisFile,
    spec: PlannedAnalysis,
    progress: Callable[[int, int], None] | None,
    stop: Callable[[], bool] | None,
    motion: Motion | None,
    vertical: Motion | None,
) -> Group:
    if isinstance(spec, ModalAnalysis):
        return run_modal(project, spec)
    if isinstance(spec, GravityAnalysis):
        return run_gravity(project, spec)
    if isinstance(spec, HistoryAnalysis):
        return run_history(project, spec, progress, stop, motion, vertical)
    if isinstance(spec, TargetAnalysis):
        return run_target(project, spec, progress, stop)
    return run_pushover(project, spec, progress, stop)


def analyse(
    project: AnalysisFile,
    spec: PlannedAnalysis,
    motion: Motion | None,
    vertical: Motion | None,
    progress: Callable[[int, int], None],
    stop: Callable[[], bool],
) -> Group:
    """Run one analysis, as a back end calls it.

    Args:
        project: the validated project of the variant.
        motion: the record made ready; None: the analysis needs none.
        vertical: the record of the vertical motion; None: there is none of its own.
        progress: called with (steps done, steps).
        stop: asked now and then; True ends the analysis.

    Returns:
        The results, which also say how the analysis ended.
    """
    return run_analysis(project, spec, progress=progress, stop=stop, motion=motion, vertical=vertical)


def analyse_stripe(
    project: AnalysisFile,
    spec: PlannedAnalysis,
    motion: Motion | None,
    vertical: Motion | None,
    progress: Callable[[int, int], None],
    stop: Callable[[], bool],
) -> Group:
    """Run one history of an incremental study, as a back end calls it; nothing is kept over time.

    Args:
        project: the validated project of the variant.
        motion: the record made ready.
        vertical: the record of the vertical motion; None: there is none of its own.
        progress: called with (steps done, steps).
        stop: asked now and then; True ends the history.

    Returns:
        The results without histories.
    """
    return analyse(project, spec, motion, vertical, progress, stop).without("time")
