"""The plan of a run: which analyses, in which order."""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.project_records import references
from edesign.project.analysis.analyses import (
    AnyAnalysis,
    BuildingHistory,
    HistoryAnalysis,
    PlannedAnalysis,
    PushoverAnalysis,
    TargetAnalysis,
)
from edesign.project.analysis.pushover import pattern_name
from edesign.project.analysis.shaking import Eccentric, Position
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import did_you_mean, unknown_name
from edesign.project.records.pairs import SuitePairs
from edesign.project.records.records import RecordSet
from edesign.study.results.kinds import ANALYSES


@dataclass(frozen=True)
class Stripe:
    """The place of a history in an incremental study.

    A chain is one record at all intensities on one variant; from a collapse on the rest of it is not run.

    Attributes:
        incremental: name of the study.
        intensity: value of its intensity measure.
        step: index of the intensity, from 0 for the lowest.
        chain: unique name of the chain, which the names of its histories begin with.
    """

    incremental: str
    intensity: float
    step: int
    chain: str


@dataclass(frozen=True)
class Task:
    """One analysis of a plan.

    Attributes:
        order: its place in the plan of the whole project, from 0.
        spec: what the project file says about it; of a history of a suite the part of one recording.
        entry: name of the analysis in the project file.
        variant: of the study that it is of, "" in a run of a project.
        temperature_C: of the dampers, where the plan says it.
        details: whether its histories are kept whole.
        stripe: of a history of an incremental study.
    """

    order: int
    spec: PlannedAnalysis
    entry: str
    variant: str = ""
    temperature_C: float | None = None
    details: bool = False
    stripe: Stripe | None = None

    @property
    def name(self) -> str:
        """The unique name of the analysis."""
        return self.spec.name

    @property
    def path(self) -> str:
        """The place of the results in the archive."""
        return f"{ANALYSES}/{self.name}"

    @property
    def record(self) -> str | None:
        """The reference of the record of the history; None for other analyses."""
        return getattr(self.spec, "record", None)

    @property
    def vertical_record(self) -> str | None:
        """The reference of the record of the vertical motion, if it is another one."""
        vertical = getattr(self.spec, "vertical", None)
        return None if vertical is None else vertical.record

    @property
    def labels(self) -> dict[str, str | int | float | None]:
        """The labels of the analysis: order, name, kind, variant, record, level (None where not applicable).

        In a study also temperature_C, and incremental and intensity.
        """
        found: dict[str, str | int | float | None] = {"order": self.order, **labels(self.spec)}
        if self.variant:
            found["temperature_C"] = self.temperature_C
        if self.stripe is not None:
            found |= {"incremental": self.stripe.incremental, "intensity": self.stripe.intensity}
        return found


def labels(spec: PlannedAnalysis) -> dict[str, str | float | None]:
    """Return name, kind, variant, record and level of an analysis; None where there is none.

    A history of a building also has the angle of its record and the place of the masses.
    """
    shaken = {}
    if isinstance(spec, BuildingHistory):
        shaken = {"angle_deg": round(math.degrees(spec.angle), 9), "eccentricity": spec.position}
    return shaken | {
        "name": spec.name,
        "kind": spec.kind,
        "variant": spec.variant or None,
        "record": getattr(spec, "record", None),
        "level": getattr(spec, "level", None) or None,
    }


def make_plan(project: AnalysisFile, only: Sequence[str] = ()) -> tuple[Task, ...]:
    """List the analyses of a project in its order; a history of a suite becomes one of each recording.

    Args:
        only: names to which the plan is restricted, of the project file or of the plan; all if empty.

    Raises:
        InputError: a name in `only` is not an analysis of the project, two analyses get the same name, or a suite
            cannot be read.
    """
    labelled = [_labelled(project, spec) for spec in project.analyses]
    named = [(part, spec.name) for spec in labelled for part in _parts(project, spec)]
    tasks = tuple(Task(order, spec, entry) for order, (spec, entry) in enumerate(named))
    first: dict[str, Task] = {}
    for task in tasks:
        other = first.setdefault(task.name, task)
        if other is not task:
            at = next(i for i, spec in enumerate(project.analyses) if spec.name == task.entry)
            raise InputError(
                f"{project.where('analyses', at, 'name')}: analyses[{at}].name: the analyses `{other.entry}` and "
                f"`{task.entry}` both lead to one named `{task.name}`; rename one of them [E-NAME-02]"
            )
    return selected(tasks, only, project.path)


def waves(tasks: Iterable[Task]) -> list[list[Task]]:
    """Return a plan in parts that may run side by side: all but incremental studies, then intensity by intensity."""
    found: dict[int, list[Task]] = defaultdict(list)
    for task in tasks:
        found[-1 if task.stripe is None else task.stripe.step].append(task)
    return [found[step] for step in sorted(found)]


def selected(tasks: Sequence[Task], only: Sequence[str], path: Path) -> tuple[Task, ...]:
    """Return the analyses of a plan that have given names or entries; all if none are given.

    Args:
        path: of the file, for messages.

    Raises:
        InputError: a name is of none.
    """
    names = list(dict.fromkeys(name for task in tasks for name in (task.entry, task.name)))
    for name in only:
        if name not in names:
            hint = did_you_mean(name, names)
            known = ", ".join(dict.fromkeys(task.entry for task in tasks))
            raise InputError(f"{path}: no analysis is named {name!r}{hint} (there are: {known}) [E-NAME-01]")
    return tuple(task for task in tasks if not only or task.name in only or task.entry in only)


def _labelled(project: AnalysisFile, spec: AnyAnalysis) -> AnyAnalysis:
    """The analysis with a label of its variant, where others of its kind have what it has not, or the reverse.

    Analyses without a label count as one variant: a mean over histories with and without dampers means nothing.
    """
    if spec.variant or project.dampers is None:
        return spec
    if len({other.dampers for other in project.analyses if other.kind == spec.kind}) == 1:
        return spec
    what = "dampers" if project.dampers.devices or project.dampers.attachments else "isolators"
    return spec.model_copy(update={"variant": f"{'with' if spec.dampers else 'without'} {what}"})


def recordings_of(project: AnalysisFile, name: str, place: str) -> tuple[str, ...]:
    """Return the references of recordings that a name stands for: a record, all of a suite, or one as SUITE/ID.

    Args:
        place: where the name stands, for messages.

    Raises:
        InputError: a suite has no such recording.
    """
    record, _, recording = name.partition("/")
    known = references(project, record)
    if not recording:
        return known
    if name in known:
        return (name,)
    if known == (record,):
        raise InputError(f"{place}: `{record}` is a single record, not a suite; write `{record}` [E-VALUE-01]")
    message = unknown_name("recording", recording, [key.partition("/")[2] for key in known])
    raise InputError(f"{place}: {message}")


def _parts(project: AnalysisFile, spec: AnyAnalysis) -> Sequence[PlannedAnalysis]:
    """The analysis itself, for a suite one named ANALYSIS.ID for each of its recordings, or the parts of a pushover.

    Of a building each is one of every angle and place of its masses.
    """
    if isinstance(spec, PushoverAnalysis):
        return pushover_parts(spec, tuple(project.hazard_levels))
    if not isinstance(spec, HistoryAnalysis):
        return [spec]
    if "/" in spec.record:
        at = next(i for i, of in enumerate(project.analyses) if of.name == spec.name)
        recordings_of(project, spec.record, f"{project.where('analyses', at, 'record')}: analyses[{at}].record")
        return shakings(spec)
    if not isinstance(project.records.get(spec.record), RecordSet | SuitePairs):
        return shakings(spec)
    parts = (
        spec.model_copy(update={"name": f"{spec.name}.{reference.partition('/')[2]}", "record": reference})
        for reference in references(project, spec.record)
    )
    return [one for part in parts for one in shakings(part)]


def shakings(spec: HistoryAnalysis, beside: bool = False) -> list[HistoryAnalysis]:
    """Return one history of each angle and place of the masses; what there are several of stands in the names.

    Args:
        beside: whether others may have its name: an angle or a place that is not zero then stands in the names too.
    """
    if not isinstance(spec, BuildingHistory):
        return [spec]
    found: list[HistoryAnalysis] = []
    for angle in spec.angles:
        for position in spec.eccentricity:
            turned, moved = (beside and one for one in (angle != 0.0, position != "0"))
            name = [spec.name, *[f"{math.degrees(angle):g}deg"] * (len(spec.angles) > 1 or turned)]
            name += [position] * (len(spec.eccentricity) > 1 or moved)
            update = {"name": ".".join(name), "angles": (angle,), "eccentricity": (position,)}
            found.append(spec.model_copy(update=update))
    return found


def pushover_parts(spec: PushoverAnalysis, hazard_levels: tuple[str, ...]) -> list[PushoverAnalysis | TargetAnalysis]:
    """Return the pushovers of each pattern, direction and position of masses, each followed by those to its targets.

    Several patterns stand in the names as `push.uniform`, directions as `push.right` or `push.x+`, positions as
    `push.x+.+x+y`, targets as `push.n2.DBE`.

    Args:
        spec: of one or several patterns, directions and positions.
        hazard_levels: names of all levels, for which targets are found where `spec` names none.
    """
    found: list[PushoverAnalysis | TargetAnalysis] = []
    positions: tuple[Position | None, ...] = spec.eccentricity if isinstance(spec, Eccentric) else (None,)
    several = len(spec.pattern) > 1, len(spec.directions) > 1, len(positions) > 1
    for pattern, direction, position in product(spec.pattern, spec.directions, positions):
        parts = zip((pattern_name(pattern), direction, position), several, strict=True)
        name = ".".join([spec.name, *(str(part) for part, named in parts if named)])
        of = {"name": name, "pattern": (pattern,), "direction": direction}
        one = spec.model_copy(update=of if position is None else {**of, "eccentricity": (position,)})
        found.append(one)
        values = {key: getattr(one, key) for key in type(one).model_fields if key not in ("kind", "name")}
        for method in spec.targets:
            for level in spec.levels if spec.levels is not None else hazard_levels:
                place = ".".join((one.name, method, level))
                found.append(
                    TargetAnalysis.model_construct(kind="target", name=place, method=method, level=level, **values)
                )
    return found
