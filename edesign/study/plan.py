"""The plan of a run: which analyses, in which order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from edesign.errors import InputError
from edesign.project.analyses import Analysis
from edesign.project.problems import did_you_mean
from edesign.project.project import Project

ANALYSES = "analyses"  # their group in the archive


@dataclass(frozen=True)
class Task:
    """One analysis of a plan.

    Attributes:
        order: its place in the project file, from 0.
        spec: what the project file says about it.
    """

    order: int
    spec: Analysis

    @property
    def name(self) -> str:
        """The unique name of the analysis."""
        return self.spec.name

    @property
    def path(self) -> str:
        """Where its results lie in the archive."""
        return f"{ANALYSES}/{self.name}"

    @property
    def record(self) -> str | None:
        """Name of the record that it needs."""
        return getattr(self.spec, "record", None)

    @property
    def labels(self) -> dict[str, str | int | None]:
        """What identifies the analysis: order, name, kind, variant, record, level (None where not applicable)."""
        return {"order": self.order, **labels(self.spec)}


def labels(spec: Analysis) -> dict[str, str | None]:
    """Return name, kind, variant, record and level of an analysis; None where there is none."""
    return {
        "name": spec.name,
        "kind": spec.kind,
        "variant": spec.variant or None,
        "record": getattr(spec, "record", None),
        "level": getattr(spec, "level", None) or None,
    }


def make_plan(project: Project, only: Sequence[str] = ()) -> tuple[Task, ...]:
    """List the analyses of a project in its order.

    Args:
        project: the validated project.
        only: names to which the plan is restricted; all if empty.

    Raises:
        InputError: a name in `only` is not an analysis of the project.
    """
    tasks = tuple(Task(order, spec) for order, spec in enumerate(project.analyses))
    names = [task.name for task in tasks]
    for name in only:
        if name not in names:
            hint = did_you_mean(name, names)
            raise InputError(f"{project.path}: no analysis is named {name!r}{hint} (there are: {', '.join(names)})")
    return tuple(task for task in tasks if not only or task.name in only)
