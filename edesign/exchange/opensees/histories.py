"""The histories of a script, and their ground motions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from edesign.exchange.formats import ProgressLine
from edesign.exchange.opensees.commands import Block, Command, File, Name, command
from edesign.exchange.opensees.programme import Parts, Programme
from edesign.ground_motion.project_records import find_recordings, references
from edesign.project.analysis.analyses import HistoryAnalysis, PlannedAnalysis
from edesign.project.analysis.damping import CaugheyDamping
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.words import counted
from edesign.project.records.records import record_of
from edesign.study.analysis.modal import fundamental_period
from edesign.study.motions.applied import check_motion, ground_motion, scale_factor
from edesign.study.motions.motions import AnyMotion, match_options, project_motions

QUAKE, VERTICAL, ACROSS = 3, 4, 5
"""Tags of the patterns of motions, and of their time series."""
REPORTED_EVERY = 5
"""Records between words on how many are ready."""


def ready_motions(
    project: AnalysisFile, tasks: Iterable[PlannedAnalysis], progress: ProgressLine
) -> dict[str, AnyMotion]:
    """Return all records of the histories, made ready.

    Args:
        tasks: of the plan.
        progress: takes how many are ready.

    Raises:
        InputError: a record cannot be read, or is wrong.
    """
    wanted: list[str] = []
    for spec in tasks:
        if isinstance(spec, HistoryAnalysis):
            other = spec.vertical.record if spec.vertical is not None else None
            for reference in filter(None, (spec.record, other)):
                wanted += references(project, record_of(reference))
    if not wanted:
        return {}
    wanted = list(dict.fromkeys(wanted))
    progress(f"reading {counted(len(wanted), 'record')}")
    recordings = find_recordings(project, wanted)
    ready: list[str] = []

    def each(motion: AnyMotion) -> None:
        ready.append(motion.name)
        if fits and len(ready) % REPORTED_EVERY == 0:
            progress(f"fitting records to the spectrum: {len(ready)} of {len(wanted)} done")

    fits = any(match_options(project, name) is not None for name in wanted)
    if fits:
        progress(f"fitting records to the spectrum: 0 of {len(wanted)} done")
    return project_motions(project, recordings, lambda: fundamental_period(project), each=each)


def add_history(
    found: Programme,
    project: AnalysisFile,
    spec: HistoryAnalysis,
    parts: Parts,
    motions: dict[str, AnyMotion],
    stem: str,
) -> None:
    """Add a history with its motion, or why it is left out.

    Args:
        motions: made ready, by reference.
        stem: with which the files of records begin.

    Raises:
        InputError: a record does not fit the history.
    """
    if spec.wave_passage is not None:
        found.left_out.append(f"analysis {spec.name}: its ground motion reaches the supports one after the other")
        return
    if found.damping.get("kind") == "modal" and spec.dampers and parts.tuned:
        found.left_out.append(f"analysis {spec.name}: it has modal damping, and tuned masses have modes of their own")
        return
    if found.damping.get("kind") == "modal" and parts.isolators:
        found.left_out.append(f"analysis {spec.name}: it has modal damping, and isolators count with another stiffness")
        return
    if any(spec.eccentricity_with(project.accidental_torsion)):
        if isinstance(project.damping, CaugheyDamping):
            found.left_out.append(f"analysis {spec.name}: its Caughey damping is that of masses beside their places")
            return
        if spec.dampers and parts.tuned:
            found.left_out.append(f"analysis {spec.name}: its masses stand beside the tuned masses")
            return
    if spec.collapse_drift is not None:
        found.left_out.append(f"analysis {spec.name}: its `collapse_drift` does not end it")
    motion = motions[spec.record]
    check_motion(project, spec, motion.record)
    vertical = spec.vertical.record if spec.vertical is not None else None
    other = None if vertical is None else motions[vertical]
    ground = ground_motion(project, spec, motion, scale_factor(project, spec, motion.record), other)
    horizontal, dt = ground.horizontal.acceleration, ground.horizontal.time_step
    across = None if ground.across is None else ground.across.acceleration
    if any(abs(one[0]) > 0.01 * np.max(np.abs(one)) for one in (horizontal, across) if one is not None):
        begins = "begins with more than 1 % of its peak, with which OpenSees does not begin from rest in equilibrium"
        found.left_out.append(f"analysis {spec.name}: its record {begins}; put a zero before it to compare")
    block = found.block_name("motion", spec.name)
    commands: list[Command] = []
    directions = [(1, QUAKE, horizontal, "")]
    if across is not None:
        directions.append((2, ACROSS, across, "_y"))
    if ground.samples is not None:
        directions.append((parts.up + 1, VERTICAL, ground.samples, "_vertical"))
    for direction, tag, samples, which in directions:
        name = _file_of(found, f"{stem}_{spec.name}{which}.txt", samples)
        words = ("Path", tag, "-dt", dt, "-filePath", File(name), "-useLast")  # sums of steps pass the end by rounding
        series = command("timeSeries", *words, comment="m/s2")
        commands += [series, command("pattern", "UniformExcitation", tag, direction, "-accel", tag)]
    found.blocks.append(Block(block, f"Ground motion of the history {spec.name}.", tuple(commands)))
    found.analyses[spec.name] = {
        "kind": "history",
        "model": parts.model(spec),
        "base": parts.bases(spec),
        "set_in": parts.set_in(spec, moves=True),
        "motion": Name(block),
        **({"alone": parts.alone(spec)} if parts.up == 2 and found.damping else {}),
        "step": dt,
        "steps": int(horizontal.size) - 1,
    }


def _file_of(found: Programme, name: str, samples: np.ndarray) -> str:
    """Keep a motion, once, and return the name of its file."""
    text = "".join(f"{float(value)!r}\n" for value in samples)
    for other, known in found.files.items():
        if known == text:
            return other
    found.files[name] = text
    return name
