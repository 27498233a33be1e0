"""Analyses as pieces of work for a back end."""

from __future__ import annotations

from collections.abc import Callable

from edesign.archive.dataset import Group
from edesign.project.analysis.analyses import PlannedAnalysis
from edesign.project.project import Project
from edesign.study.motions.motions import Motion
from edesign.study.run import analyses


def analyse(
    project: Project,
    spec: PlannedAnalysis,
    motion: Motion | None,
    vertical: Motion | None,
    progress: Callable[[int, int], None],
    stop: Callable[[], bool],
) -> Group:
    """Run one analysis, as a back end calls it."""
    return analyses.run_analysis(project, spec, progress=progress, stop=stop, motion=motion, vertical=vertical)


def analyse_stripe(
    project: Project,
    spec: PlannedAnalysis,
    motion: Motion | None,
    vertical: Motion | None,
    progress: Callable[[int, int], None],
    stop: Callable[[], bool],
) -> Group:
    """Run one history of an incremental study, as a back end calls it; nothing over time is kept."""
    return analyse(project, spec, motion, vertical, progress, stop).without("time")
