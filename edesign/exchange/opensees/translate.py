"""A project or building as a script for OpenSees."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from math import dist
from pathlib import Path

from edesign._version import __version__
from edesign.errors import InputError
from edesign.exchange.formats import MARK, ProgressLine, Translation
from edesign.exchange.opensees.analyses import has_placed_dampers, programme
from edesign.exchange.opensees.commands import Block, Command, Name, Value, command
from edesign.exchange.opensees.dampers import DamperBuilder
from edesign.exchange.opensees.dynamics import integrator_words
from edesign.exchange.opensees.floors import FloorBlocks, first_of_dampers
from edesign.exchange.opensees.joined import JoinedDegrees
from edesign.exchange.opensees.limits import differences, places, refuse
from edesign.exchange.opensees.outputs import bases, outputs
from edesign.exchange.opensees.programme import Parts
from edesign.exchange.opensees.script import SETTINGS, Script, python_text, tcl_text
from edesign.exchange.opensees.space_builder import SpaceBuilder
from edesign.exchange.opensees.space_dampers import SpaceDampers
from edesign.exchange.opensees.structure import (
    GRAVITY,
    NotTranslated,
    NotTranslatedParts,
    Structure,
    Tags,
)
from edesign.exchange.opensees.structure_builder import StructureBuilder
from edesign.exchange.recorded_model import RecordedModel
from edesign.project.analysis_file import AnalysisFile
from edesign.project.records.records import ChosenRecords
from edesign.study.analysis.structure import GRAVITY_STEPS, make_frame
from edesign.study.plan.choosing import with_choices


def translate_python(project: AnalysisFile, path: Path, without_dampers: bool, progress: ProgressLine) -> Translation:
    """Return a script for OpenSeesPy and its records; errors as `Format.translate`."""
    return _translate(project, path, without_dampers, progress, python_text)


def translate_tcl(project: AnalysisFile, path: Path, without_dampers: bool, progress: ProgressLine) -> Translation:
    """Return a script for OpenSees and its records; errors as `Format.translate`."""
    return _translate(project, path, without_dampers, progress, tcl_text)


def _translate(
    project: AnalysisFile,
    path: Path,
    without_dampers: bool,
    progress: ProgressLine,
    text: Callable[[Script, Path], str],
) -> Translation:
    if not re.fullmatch(r"[\w.+-]+", path.name, re.ASCII):
        raise InputError(
            f"{path}: the script names files beside it; give it a name of letters, digits and `_ + - .` [E-FILE-10]"
        )
    refuse(project, without_dampers)
    if any(isinstance(spec, ChosenRecords) for spec in project.records.values()):
        progress("choosing the records")
    project = with_choices(project)
    script, beside = opensees_script(project, path, without_dampers, progress)
    return replace(beside, files={path: text(script, path), **beside.files})


def opensees_script(
    project: AnalysisFile, path: Path, without_dampers: bool = False, progress: ProgressLine = lambda stage: None
) -> tuple[Script, Translation]:
    """Return a file as blocks of commands and data, and beside it its records, with what is left out or differs.

    Args:
        without_dampers: whether dampers and tuned masses are left out.
        progress: takes the name of each stage at its beginning.

    Raises:
        InputError: OpenSees lacks something that the project has, or a record is wrong.
        AnalysisError: an analysis that the script takes numbers from failed.
    """
    progress(f"building the {project.structure}")
    left_out = []
    has_dampers = project.dampers is not None and not without_dampers and any(s.dampers for s in project.analyses)
    isolated = has_dampers and project.isolation is not None
    plain = _recorded(project)
    frame = make_frame(project, isolated, model=plain)
    model, devices = plain, frame
    if has_dampers and not isolated:
        model = _recorded(project)
        devices = make_frame(project, True, model=model)
    if without_dampers and has_placed_dampers(project):
        left_out.append("dampers, isolators and tuned masses, as --without-dampers asks")
    first = first_of_dampers(model.calls)
    base, extra = plain.calls[:first] if isolated else plain.calls, model.calls[first:] if has_dampers else []
    materials = 1 + sum(call.name == "material" for call in model.calls)
    sections = 1 + sum(call.name.endswith("_section") for call in model.calls)
    tags = Tags(len(model.node_names) + 1, len(model.element_names) + 1, materials, sections)
    structure = Structure(frame, JoinedDegrees(model.calls, model.degrees), tags)
    builder = (SpaceBuilder if structure.dimension == 3 else StructureBuilder)(frame, plain, structure)
    try:
        builder.build(base)
        largest = _largest_stiffness(builder, structure)
        make_dampers = SpaceDampers if structure.dimension == 3 else DamperBuilder
        soil = make_dampers(structure, largest).build(base)
        build_commands = (*structure.commands(), *soil.place)
        loads = tuple(structure.loads)
        masses, plain_equations = len(structure.moving), structure.joined.independent(structure.kept)
        shown = outputs(frame, structure)
        base_shear = bases(frame, structure)
        mark = _Mark(structure)
        builder.build(extra)
        damper_builder = make_dampers(structure, largest)
        dampers = damper_builder.build(extra)
        more_modes = len(structure.moving) > masses
        added_commands = (*mark.commands(), *dampers.place)
        shown = outputs(frame, structure) if isolated else shown
    except NotTranslated as problem:
        raise InputError("\n".join(places(project, devices, [problem]))) from problem
    except NotTranslatedParts as several:
        raise InputError("\n".join(places(project, devices, several.problems))) from several
    blocks = [Block("build", f"The {project.structure}, without loads.", build_commands)]
    gravity = (
        command("timeSeries", "Linear", GRAVITY),
        command("pattern", "Plain", GRAVITY, GRAVITY, body=loads, comment="N, N m; on members N/m, in their axes"),
    )
    blocks.append(Block("gravity_loads", "The gravity combination.", gravity))
    with_dampers = _block(blocks, "add_dampers", "Tuned masses, and what dampers stand on.", added_commands)
    isolators = _block(blocks, "add_isolators", "Isolators and what acts beside them.", dampers.carrying)
    soil_part = _block(blocks, "set_in_soil_dashpots", "Dashpots of the soil.", (*soil.at_rest, *soil.moving))
    at_rest = _block(blocks, "set_in_dampers", "What resists at rest in dampers.", dampers.at_rest)
    moving = _block(blocks, "set_in_dashpots", "What resists speed in dampers.", dampers.moving)
    springs = damper_builder.springs if devices.devices else None
    equations = plain_equations, structure.joined.independent(structure.kept)
    added_bases = tuple(
        tuple(tag for tag in more if tag not in known)
        for more, known in zip(bases(devices, structure), base_shear, strict=True)
    )
    plain_model, floors = (Name("build"),), FloorBlocks(project, isolated)
    floors.of()  # also of a building that is not analysed
    parts = Parts(
        plain_model,
        with_dampers,
        isolators,
        floors,
        soil_part,
        at_rest,
        moving,
        springs,
        has_dampers and more_modes,
        base_shear,
        added_bases,
        equations,
        frame.up,
    )
    found = programme(project, structure, parts, path.stem, without_dampers, progress)
    left_out += found.left_out
    constants: dict[str, Value | dict[str, Value]] = {
        **SETTINGS,
        "INTEGRATOR": integrator_words(project),
        "GRAVITY_STEPS": GRAVITY_STEPS,
        "MASSES": masses,
        "EQUATIONS": plain_equations,
        "DAMPING": found.damping,
        "DAMPING_FACTORS": _factors(structure),
        **({} if structure.dimension == 3 else {"PLAIN_MODEL": plain_model}),
        **shown,
    }
    texts = {path.with_name(name): content for name, content in found.files.items()}
    other = differences(project, structure, dampers)
    head = _head(project, structure, left_out, other)
    script = Script(head, [*blocks, *floors.blocks, *found.blocks], constants, found.analyses, structure.dimension)
    return script, Translation(texts, tuple(left_out), tuple(other))


def _recorded(project: AnalysisFile) -> RecordedModel:
    return RecordedModel(len(next(iter(project.grid.nodes.values()))))


class _Mark:
    """What a structure had at a moment, to find what was added afterwards."""

    LISTS = ("node_commands", "masses", "materials", "sections", "elements", "springs")

    def __init__(self, structure: Structure) -> None:
        self._of, self._kept = structure, len(structure.kept)
        self._sizes = {name: len(getattr(structure, name)) for name in self.LISTS}

    def commands(self) -> list[Command]:
        """What has been added since, with the supports and ties of its nodes."""
        new = {name: getattr(self._of, name)[size:] for name, size in self._sizes.items()}
        ties = self._of.joined.commands(self._of.kept[self._kept :], self._of.nodes, self._of.names)
        return [*new.pop("node_commands"), *ties, *(one for group in new.values() for one in group)]


def _block(blocks: list[Block], name: str, purpose: str, commands: Iterable[Command]) -> tuple[Name, ...]:
    """Add a block if there is anything in it, and return its name."""
    found = tuple(commands)
    if not found:
        return ()
    blocks.append(Block(name, purpose, found))
    return (Name(name),)


def _largest_stiffness(builder: StructureBuilder, structure: Structure) -> float:
    """Largest E A / L of the members, N/m."""
    largest = 0.0
    for call in builder.members():
        length = dist(*(structure.places[call[end]] for end in "ij"))
        largest = max(largest, builder.stiffness(call["section"])[0] / length)
    return largest


def _factors(structure: Structure) -> tuple[Value, ...]:
    """Factors of stiffness-proportional damping, each with the elements that it is of."""
    of: dict[float, list[int]] = defaultdict(list)
    for tag, factor in structure.damping_factors.items():
        of[factor].append(tag)
    return tuple((factor, tuple(tags)) for factor, tags in of.items())


def _head(project: AnalysisFile, structure: Structure, left_out: Sequence[str], other: Sequence[str]) -> list[str]:
    """Paragraphs of the comment at the top."""
    degrees = "ux, uy upwards, rz anticlockwise"
    if structure.dimension == 3:
        degrees = "ux, uy, uz upwards, rx, ry, rz. Members have local x from start to end, local z along the web"
    head = [
        f"{MARK} {__version__} from {project.path.name}",
        project.title,
        f"Model and analyses of {project.path.name} (SHA-256 {project.checksum}), for OpenSees.",
        f"Units: m, N, kg, s, Pa, rad. Degrees of freedom: {degrees}.",
        "Tags of nodes and elements are those of edesign plus one; further ones follow.",
        f"What is not, or not quite, as in the {project.kind}:",
    ]
    head += [f"- {sentence}" for sentence in (*left_out, *other)] or ["- nothing is left out"]
    return head
