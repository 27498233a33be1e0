"""The analyses of a project as data of a script."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from edesign.exchange.formats import ProgressLine
from edesign.exchange.opensees.commands import Block, Command, File, Name, Value, command
from edesign.exchange.opensees.dynamics import damping_values
from edesign.exchange.opensees.floors import FloorBlocks
from edesign.exchange.opensees.structure import Structure
from edesign.ground_motion.project_records import find_recordings, references
from edesign.project.analysis.analyses import (
    GravityAnalysis,
    HistoryAnalysis,
    ModalAnalysis,
    PlannedAnalysis,
    PushoverAnalysis,
)
from edesign.project.analysis.damping import CaugheyDamping
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.words import counted
from edesign.project.records.records import record_of
from edesign.study.analysis.capacity import capacity
from edesign.study.analysis.damper_stiffness import damped_modes
from edesign.study.analysis.lateral_patterns import lateral_loads
from edesign.study.analysis.modal import fundamental_period
from edesign.study.analysis.push import load_moments, pushed_along
from edesign.study.analysis.structure import GRAVITY_STEPS, make_frame, make_structure
from edesign.study.motions.applied import check_motion, ground_motion, scale_factor
from edesign.study.motions.motions import AnyMotion, match_options, project_motions
from edesign.study.plan.plan import make_plan

PUSH, QUAKE, VERTICAL, ACROSS = 2, 3, 4, 5
"""Tags of the patterns beside gravity, and of their time series."""
NAMED = 4
"""Analyses that a sentence names."""
REPORTED_EVERY = 5
"""Records between words on how many are ready."""


@dataclass
class Programme:
    """What a script can run.

    Attributes:
        analyses: by name, what each needs, in the order of the plan.
        blocks: lateral loads and motions.
        files: texts of records by their names.
        damping: inherent damping; empty: none.
        left_out: sentences on what is not in it.
    """

    analyses: dict[str, dict[str, Value]] = field(default_factory=dict)
    blocks: list[Block] = field(default_factory=list)
    files: dict[str, str] = field(default_factory=dict)
    damping: dict[str, Value] = field(default_factory=dict)
    left_out: list[str] = field(default_factory=list)

    def block_name(self, kind: str, analysis: str) -> str:
        """Return a name for a block of an analysis that no other one has."""
        name = re.sub(r"\W", "_", f"{kind}_{analysis}")
        while name in {block.name for block in self.blocks}:
            name += "_"
        return name


@dataclass(frozen=True)
class Parts:
    """Which blocks build the model.

    Attributes:
        plain, with_dampers: of analyses without dampers, and what is added with them; the first is `build`.
        floors: of rigid floors and masses of a building.
        soil, at_rest, moving: set in under the gravity loads: soil dashpots in histories; of dampers what resists at
            rest, and in histories what resists speed.
        springs: makes the commands of linear springs in the place of dampers, from their stiffness by name; None: the
            script has no dampers.
        tuned: whether it has tuned masses, with modes of their own.
        base, base_of_dampers: by direction tags of nodes whose reactions are the base shear; of those that dampers add.
        equations: independent degrees of freedom without and with dampers.
        up: degree of the core along the vertical.
    """

    plain: tuple[Name, ...]
    with_dampers: tuple[Name, ...]
    floors: FloorBlocks
    soil: tuple[Name, ...]
    at_rest: tuple[Name, ...]
    moving: tuple[Name, ...]
    springs: Callable[[Mapping[str, float]], list[Command]] | None
    tuned: bool
    base: tuple[tuple[int, ...], ...]
    base_of_dampers: tuple[tuple[int, ...], ...]
    equations: tuple[int, int]
    up: int

    def bases(self, spec: PlannedAnalysis) -> Value:
        """Tags of the nodes whose reactions are the base shear of an analysis, in space by direction."""
        both = zip(self.base, self.base_of_dampers, strict=True)
        found = tuple((*own, *(more if spec.dampers else ())) for own, more in both)
        return found if len(found) > 1 else found[0]

    def model(self, spec: PlannedAnalysis) -> tuple[Name, ...]:
        """Blocks that build the model of an analysis."""
        return (*self.plain, *self.floors.of(spec), *(self.with_dampers if spec.dampers else ()))

    def alone(self, spec: PlannedAnalysis) -> tuple[Name, ...]:
        """Blocks that build it without dampers and tuned masses."""
        return (*self.plain, *self.floors.of(spec.model_copy(update={"dampers": False})))

    def set_in(self, spec: PlannedAnalysis, moves: bool) -> tuple[Name, ...]:
        """Blocks that add what is set in under the gravity loads."""
        found = (*self.at_rest, *(self.moving if moves else ())) if spec.dampers else ()
        return (*(self.soil if moves else ()), *found)


def programme(
    project: AnalysisFile, structure: Structure, parts: Parts, stem: str, without_dampers: bool, progress: ProgressLine
) -> Programme:
    """Return the analyses of a project as data of a script.

    Args:
        structure: of the frame.
        stem: of the script's name, with which those of the records begin.
        without_dampers: whether the script is to have no dampers.
        progress: takes the name of each stage at its beginning.

    Raises:
        InputError: a record cannot be read, or is wrong.
        AnalysisError: no equilibrium under gravity, or no modes for lateral loads.
    """
    found = Programme()
    tasks = [task.spec for task in make_plan(project)]
    if not tasks:
        dampers = "; dampers come with them" if has_placed_dampers(project) and not without_dampers else ""
        found.left_out.append(f"analyses: the file names none; `kind: modal`, for one, gives periods{dampers}")
    motions = _motions(project, tasks, progress)
    progress("translating the analyses")
    histories = [spec for spec in tasks if isinstance(spec, HistoryAnalysis)]
    if histories:
        found.damping = damping_values(project, not without_dampers)
    bare = [spec.name for spec in tasks if spec.dampers] if without_dampers and has_placed_dampers(project) else []
    if bare:
        found.left_out.append(f"the dampers of {_listed(bare)}")
    targets: list[str] = []
    for spec in tasks:
        if spec.name in bare:
            spec = spec.model_copy(update={"dampers": False})
        match spec:
            case ModalAnalysis():
                _modal(found, project, spec, parts)
            case GravityAnalysis():
                found.analyses[spec.name] = {"kind": "gravity", "model": parts.model(spec), "steps": spec.steps}
            case PushoverAnalysis():
                _pushover(found, project, spec, structure, parts)
            case HistoryAnalysis():
                _history(found, project, spec, parts, motions, stem)
            case _:
                targets.append(spec.name)
    if targets:
        found.left_out.append(f"{_listed(targets)}: target displacements follow from clauses of a code")
    return found


def has_placed_dampers(project: AnalysisFile) -> bool:
    """Return whether a project has dampers, tuned masses or isolators, and not their laws alone."""
    dampers = project.dampers
    return dampers is not None and bool(dampers.devices or dampers.attachments or dampers.isolation is not None)


def _listed(analyses: Sequence[str]) -> str:
    """Names of analyses, and of more than `NAMED` how many others there are."""
    named = ", ".join(analyses[:NAMED])
    others = len(analyses) - NAMED
    return f"the analys{'es' if len(analyses) > 1 else 'is'} {named}" + (f" and {others} more" if others > 0 else "")


def _modal(found: Programme, project: AnalysisFile, spec: ModalAnalysis, parts: Parts) -> None:
    gravity = GRAVITY_STEPS if spec.state == "gravity" else 0
    block: tuple[Name, ...] = ()
    if spec.dampers and parts.springs is not None:
        structure = make_structure(project, dampers=True)
        if gravity:
            structure.apply_gravity()
        stiffness = damped_modes(project, structure, spec).stiffness.real
        names = [device.name for device in structure.frame.devices]
        commands = parts.springs(dict(zip(names, map(float, stiffness), strict=True)))
        if commands:
            block = (Name(found.block_name("springs", spec.name)),)
            purpose = f"The stiffness of dampers and braces at the amplitude of {spec.name}, from edesign."
            found.blocks.append(Block(block[0].name, purpose, tuple(commands)))
    found.analyses[spec.name] = {
        "kind": "modal",
        "model": parts.model(spec),
        "set_in": block,
        "modes": spec.modes,
        "equations": parts.equations[spec.dampers],
        "steps": gravity,
    }


def _pushover(
    found: Programme, project: AnalysisFile, spec: PushoverAnalysis, structure: Structure, parts: Parts
) -> None:
    frame = make_frame(project, spec.dampers)
    direction = pushed_along(frame, spec)
    loads = lateral_loads(project, frame, spec.pattern[0], spec.dampers, direction)
    moments = load_moments(project, frame, spec, loads, direction)
    if spec.roof_drift is not None:
        target = spec.sign * spec.roof_drift * project.grid.height
    else:
        target = capacity(project, spec).push.target
    block = found.block_name("push", spec.name)
    lateral = []
    for name, load in loads.items():
        values = [0.0] * len(structure.joined.degrees)
        values[frame.directions[direction].degree], values[-1] = load, moments.get(name, 0.0)
        lateral.append(command("load", structure.nodes[frame.nodes[name]], *values, comment=name))
    commands = (
        command("timeSeries", "Linear", PUSH),
        command("pattern", "Plain", PUSH, PUSH, body=lateral, comment="their sum is 1 N"),
    )
    found.blocks.append(Block(block, f"Lateral loads of the pushover {spec.name}.", commands))
    found.analyses[spec.name] = {
        "kind": "pushover",
        "model": parts.model(spec),
        "base": parts.bases(spec),
        "set_in": parts.set_in(spec, moves=False),
        "loads": Name(block),
        "target": target,
        "steps": spec.steps,
        **({"way": frame.directions[direction].degree + 1} if structure.dimension == 3 else {}),
    }


def _motions(project: AnalysisFile, tasks: Iterable[PlannedAnalysis], progress: ProgressLine) -> dict[str, AnyMotion]:
    """All records of the histories, made ready."""
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


def _history(
    found: Programme,
    project: AnalysisFile,
    spec: HistoryAnalysis,
    parts: Parts,
    motions: dict[str, AnyMotion],
    stem: str,
) -> None:
    if spec.wave_passage is not None:
        found.left_out.append(f"analysis {spec.name}: its ground motion reaches the supports one after the other")
        return
    if found.damping.get("kind") == "modal" and spec.dampers and parts.tuned:
        found.left_out.append(f"analysis {spec.name}: it has modal damping, and tuned masses have modes of their own")
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
