"""How long analyses last: by their steps, and by the pace of those of their kind, variant and level that ended."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from edesign.ground_motion.sources import Found
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.plan.plan import Task

RECENT = 8  # analyses of one kind, variant and level whose pace is that of the next: records of a set differ by a third
_SHRINK = 0.01  # of the influence of a label that one group alone has; those of two are taken as they are


@dataclass(frozen=True)
class Work:
    """How much work an analysis is, as far as it is known before.

    Attributes:
        steps: of its time history or pushover.
        kind: of the analysis.
        labels: what else its pace depends on: variant, level, temperature.
    """

    steps: float = 1.0
    kind: str = ""
    labels: tuple[str, ...] = ()


def works_of(project: AnalysisFile, tasks: Sequence[Task], recordings: Mapping[str, Found]) -> dict[str, Work]:
    """Return how much work each analysis of a plan is, by its name.

    Args:
        project: whose time step is used.
        recordings: what was found, by reference.
    """
    given = project.integration.time_step if project.integration is not None else None
    lasting: dict[str, tuple[float, float]] = {}  # s, and the time step
    for reference, found in recordings.items():
        for name in (reference, reference.rpartition("/")[0]):  # of a pair the longer component
            one = (found.record.duration, given or found.record.time_step)
            lasting[name] = max(lasting.get(name, one), one)
    longest = max(lasting.values(), default=(1.0, 0.01))
    works = {}
    for task in tasks:
        spec = task.spec
        labels = [task.variant, getattr(spec, "level", ""), str(task.temperature_C), str(getattr(spec, "dampers", ""))]
        if isinstance(spec, HistoryAnalysis):
            duration, step = lasting.get(spec.record, longest)
            steps = (duration + spec.free_vibration) / step
            if task.stripe is not None:
                labels[1] = f"{task.stripe.incremental} {task.stripe.step}"
        else:
            steps = float(getattr(spec, "steps", 1))
        works[task.name] = Work(max(steps, 1.0), spec.kind, tuple(map(str, labels)))
    return works


class Pace:
    """Seconds a step of analyses that ended, by kind and labels."""

    def __init__(self) -> None:
        self._of: dict[tuple[str, tuple[str, ...]], deque[tuple[float, float]]] = {}

    @property
    def known(self) -> bool:
        """Whether any analysis ended."""
        return bool(self._of)

    def copy(self) -> Pace:
        """Return the same, to which what runs can be added."""
        found = Pace()
        found._of = {key: deque(of, RECENT) for key, of in self._of.items()}
        return found

    def add(self, work: Work, seconds: float) -> None:
        """Note an analysis that ended.

        Args:
            seconds: that it took.
        """
        self._of.setdefault((work.kind, work.labels), deque(maxlen=RECENT)).append((seconds, work.steps))

    def seconds(self, work: Work) -> float | None:
        """Return how long an analysis will last, s; None where none of its kind ended.

        Those of its kind, variant and level say it; until one ended, the factors of its variant and of its level among
        the others of its kind, and 1 of what is new.
        """
        of = self._of.get((work.kind, work.labels))
        if of is not None:
            return work.steps * _mean(of)
        others = {labels: _mean(of) for (kind, labels), of in self._of.items() if kind == work.kind}
        if not others:
            return None
        return work.steps * math.exp(
            _additive({labels: math.log(pace) for labels, pace in others.items()}, work.labels)
        )


def _mean(of: Sequence[tuple[float, float]] | deque[tuple[float, float]]) -> float:
    return sum(seconds for seconds, _ in of) / sum(steps for _, steps in of)


def _additive(known: Mapping[tuple[str, ...], float], wanted: tuple[str, ...]) -> float:
    """The value of labels that is the sum of one for each of them, by least squares; new labels add nothing."""
    names = sorted({(i, label) for labels in known for i, label in enumerate(labels)})
    mean = sum(known.values()) / len(known)
    rows = np.array([[float(labels[i] == label) for i, label in names] for labels in known])
    values = np.array(list(known.values())) - mean
    parts = np.linalg.solve(rows.T @ rows + _SHRINK * np.eye(len(names)), rows.T @ values)
    return mean + sum(float(parts[k]) for k, (i, label) in enumerate(names) if wanted[i] == label)
