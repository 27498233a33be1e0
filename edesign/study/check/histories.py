"""What `edesign check` says of the histories of a run: how many of each record, how they act, how long they are."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.ground_motion.pairs import first_components
from edesign.ground_motion.sources import Found
from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.words import counted
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import record_of
from edesign.study.plan.plan import Task


def histories_text(project: AnalysisFile, plan: Sequence[Task], found: Mapping[str, Found]) -> dict[str, str]:
    """Return a line for each record: its histories, the motions, angles and places that they are made of, their length.

    Args:
        plan: all analyses; those of other kinds are left out.
        found: recordings by reference.

    Returns:
        Lines under the label `histories`; nothing without histories.
    """
    acting = {**found, **first_components(project, found)}
    of_records: dict[str, list[Task]] = {}
    for task in plan:
        if task.record is not None and task.record in acting:
            of_records.setdefault(record_of(task.record), []).append(task)
    lines = [f"{name}: {_text(project, tasks, acting)}" for name, tasks in of_records.items()]
    return {"histories": "\n".join(lines)} if lines else {}


def _text(project: AnalysisFile, tasks: Sequence[Task], acting: Mapping[str, Found]) -> str:
    specs = [task.spec for task in tasks if isinstance(task.spec, HistoryAnalysis)]
    record = project.records[record_of(specs[0].record)]
    parts = [counted(len({spec.record for spec in specs}), "pair" if isinstance(record, InSpace) else "record")]
    if isinstance(record, InSpace):
        parts[0] += f" along {' and '.join(record.components)}{', with the vertical component' * bool(record.vertical)}"
    for count, what in (
        (len({spec.angle for spec in specs}), "angles"),
        (len({spec.position for spec in specs}), "places of the masses"),
        (len({spec.level for spec in specs}), "levels"),
        (len({(task.variant, task.temperature_C) for task in tasks}), "variants"),
    ):
        parts += [f"{count} {what}"] if count > 1 else []
    lengths = [acting[spec.record].record.duration + spec.free_vibration for spec in specs]
    ends = dict.fromkeys(f"{length:.4g}" for length in (min(lengths), max(lengths)))
    number = f"{len(specs)} {'history' if len(specs) == 1 else 'histories'}"
    return f"{number} of {', '.join(parts)}; {' to '.join(ends)} s long, {sum(lengths):.4g} s in all"
