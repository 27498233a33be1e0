"""The analyses of a project as data of a script."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.exchange.formats import ProgressLine
from edesign.exchange.opensees.commands import Block, Name, command
from edesign.exchange.opensees.dynamics import damping_values
from edesign.exchange.opensees.histories import add_history, ready_motions
from edesign.exchange.opensees.programme import Parts, Programme
from edesign.exchange.opensees.structure import Structure
from edesign.project.analysis.analyses import GravityAnalysis, HistoryAnalysis, ModalAnalysis, PushoverAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.capacity import capacity
from edesign.study.analysis.damper_stiffness import damped_modes
from edesign.study.analysis.lateral_patterns import lateral_loads
from edesign.study.analysis.push import load_moments, pushed_along
from edesign.study.analysis.structure import GRAVITY_STEPS, make_frame, make_structure
from edesign.study.plan.plan import make_plan

PUSH = 2
"""Tag of the pattern of lateral loads, and of its time series."""
NAMED = 4
"""Analyses that a sentence names."""


def programme(
    project: AnalysisFile, structure: Structure, parts: Parts, stem: str, without_dampers: bool, progress: ProgressLine
) -> Programme:
    """Return the analyses of a project as data of a script.

    Args:
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
    motions = ready_motions(project, tasks, progress)
    progress("translating the analyses")
    histories = [spec for spec in tasks if isinstance(spec, HistoryAnalysis)]
    if histories:
        found.damping = damping_values(project, not without_dampers)
    bare = [spec.name for spec in tasks if spec.dampers] if without_dampers and has_placed_dampers(project) else []
    if bare:
        found.left_out.append(f"the dampers of {_listed(bare)}")
    targets: list[str] = []
    for spec in tasks:
        if parts.isolators and not spec.dampers:
            found.left_out.append(f"analysis {spec.name}: it is without isolators; --without-dampers translates it")
            continue
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
                add_history(found, project, spec, parts, motions, stem)
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
    springs: dict[bool, tuple[Name, ...]] = {False: (), True: ()}
    if spec.dampers and parts.springs is not None:
        structure = make_structure(project, dampers=True)
        if gravity:
            structure.apply_gravity()
        stiffness = damped_modes(project, structure, spec).stiffness.real
        for isolators, what in ((True, "isolators"), (False, "dampers and braces")):
            known = zip(structure.frame.devices, map(float, stiffness), strict=True)
            commands = parts.springs({device.name: k for device, k in known if bool(device.column_base) == isolators})
            if commands:
                springs[isolators] = (Name(found.block_name("springs", spec.name)),)
                purpose = f"The stiffness of {what} at the amplitude of {spec.name}, from edesign."
                found.blocks.append(Block(springs[isolators][0].name, purpose, tuple(commands)))
    found.analyses[spec.name] = {
        "kind": "modal",
        "model": parts.model(spec, springs[True]),
        "set_in": springs[False],
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
