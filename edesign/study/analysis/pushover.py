"""Pushover analysis: the capacity curve of one pattern and direction, with its events."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.project.analysis.analyses import PushoverAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.capacity import capacity
from edesign.study.analysis.capacity_events import store_capacity_events
from edesign.study.analysis.push import Progress, Stop


def run_pushover(
    project: AnalysisFile, spec: PushoverAnalysis, progress: Progress | None = None, stop: Stop | None = None
) -> Group:
    """Push a frame to its roof drift, or without one as far as its target displacements ask.

    Args:
        spec: the pushover, with its first pattern and direction.
        progress: called now and then with (steps done, steps).
        stop: asked now and then; True ends the push.

    Returns:
        The results, with the events of the push.

    Raises:
        AnalysisError: no equilibrium under gravity, no usable mode, or no target displacement.
        CoreError: the frame is a mechanism.
    """
    pushed = capacity(project, spec, progress, stop).push
    events = pushed.events.events(pushed.response, pushed.resistance)
    store_capacity_events(pushed.group, events, pushed.displacement, pushed.base_shear)
    return pushed.group
