"""Cross checks of dampers: places inside the grid, laws and nodes that exist, one value for each storey."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence

from edesign.project.analysis.analyses import ModalAnalysis
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.selections import Selections
from edesign.project.dampers.dampers import (
    PROTOTYPE_SCALE,
    AnyChosenBrace,
    BraceSection,
    DamperBetween,
    DamperLaw,
    DamperRun,
    Device,
)
from edesign.project.dampers.designs import DesignRun
from edesign.project.dampers.placement import CatalogueItem
from edesign.project.frame.supports import FootingSupport, springs_of
from edesign.project.notation import names
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, did_you_mean, listed, unknown_name
from edesign.project.reading.words import counted


def check_dampers(project: Project, problems: Problems) -> None:
    """Check dampers and attachments; `project` has no schema problems.

    Args:
        project: the project, which has no schema problems.
    """
    check_devices(project, problems, lambda keys, run: _places(project, problems, keys, run))
    for part in ("devices", "attachments"):
        keys: Keys = ("dampers", part)
        for i, item in enumerate(getattr(project.dampers, part, ())):
            if isinstance(item, DamperBetween):
                check_apart(problems, (*keys, i), item, *_still(project))
            for key in ("along", "frames", "direction", "at"):
                if getattr(item, key, None) is not None:
                    message = "a plane frame has one direction; this is of a building [E-KEY-03]"
                    problems.at_key((*keys, i, key), message)


def check_devices(project: AnalysisFile, problems: Problems, stand: Callable[[Keys, DamperRun], Sequence[int]]) -> None:
    """Check dampers and attachments of a plane frame or a building, but for where dampers stand in bays.

    Args:
        project: the file, which has no schema problems.
        stand: checks the places of dampers at keys, and returns their storeys; none where they are wrong.
    """
    for i, analysis in enumerate(project.analyses):
        if isinstance(analysis, ModalAnalysis):
            _amplitude(project, problems, ("analyses", i), analysis)
    if project.dampers is None:
        return
    for name, law in project.dampers.laws.items():
        if law.temperature_law is not None and law.temperature is None:
            message = "a temperature law needs the `temperature` of the dampers [E-KEY-02]"
            problems.at_key(("dampers", "laws", name, "temperature_law"), message)
    for name, law in project.dampers.laws.items():
        check_law(problems, ("dampers", "laws", name), law)
    for i, device in enumerate(project.dampers.devices):
        keys: Keys = ("dampers", "devices", i)
        _device(project, problems, keys, device)
        storeys = stand(keys, device) if isinstance(device, DamperRun) else (0,)
        if storeys:
            _lists(problems, keys, device, len(storeys))
    for i, item in enumerate(project.dampers.attachments):
        last = project.grid.n_storeys
        if item.floor > last:
            message = f"there is no floor {item.floor}; floors are numbered 1 to {last} [E-NAME-01]"
            problems.at_value(("dampers", "attachments", i, "floor"), message)


def _amplitude(project: AnalysisFile, problems: Problems, keys: Keys, analysis: ModalAnalysis) -> None:
    """An amplitude of the dampers is one that they can have."""
    given = [key for key in ("damper_strain", "damper_deformation") if getattr(analysis, key) is not None]
    if len(given) == 2:
        problems.at_key((*keys, given[1]), f"give either `{given[0]}` or `{given[1]}`, one of them [E-KEY-03]")
        return
    devices = project.dampers.devices if project.dampers is not None and analysis.dampers else ()
    if given == ["damper_strain"] and project.isolation is not None and analysis.dampers:
        problems.at_key((*keys, given[0]), "isolators count at a deformation; give `damper_deformation` [E-DAMPER-01]")
    elif given and not devices and (project.isolation is None or not analysis.dampers):
        problems.at_key((*keys, given[0]), "this analysis has no dampers [E-DAMPER-04]")
    elif given == ["damper_strain"] and project.dampers is not None:
        laws = project.dampers.laws
        bare = sorted({d.law for d in devices if d.law in laws and laws[d.law].prototype is None})
        if bare:
            subject = f"the law {listed(bare)} has" if len(bare) == 1 else f"the laws {listed(bare)} have"
            message = f"{subject} no `prototype`, so no layers; give `damper_deformation` [E-DAMPER-01]"
            problems.at_key((*keys, "damper_strain"), message)


def check_brace(project: AnalysisFile, problems: Problems, keys: Keys, brace: object, kind: str) -> None:
    """Check braces that have a section, or get one: they have a length, and a material that is there.

    Args:
        brace: in series with dampers.
        kind: how these stand.
    """
    if not isinstance(brace, (BraceSection, AnyChosenBrace)):
        return
    if kind == "storey":
        message = "a damper between floors has no brace geometry; give the `stiffness` of its brace [E-DAMPER-02]"
        problems.at_value(keys, message)
    if brace.material not in project.steels:
        problems.at_value((*keys, "material"), unknown_name("material", brace.material, project.steels))


def check_law(problems: Problems, keys: Keys, law: DamperLaw) -> None:
    """Check that a law is either in the file itself or in a law file.

    Args:
        law: the law, as the file describes it.
    """
    if law.file is None:
        for key in ("type", "parameters"):
            if getattr(law, key) is None:
                problems.under(keys, key, "this key is missing (or `file`, a law file) [E-KEY-02]")
        return
    for key in ("type", "parameters", "temperature_law", "effects", "standard_errors", "tested"):
        if getattr(law, key) not in (None, ()):
            problems.at_key((*keys, key), f"the law file `{law.file}` says this; leave one of them out [E-KEY-03]")


def _device(project: AnalysisFile, problems: Problems, keys: Keys, device: Device) -> None:
    assert project.dampers is not None
    laws = project.dampers.laws
    if device.law not in laws:
        problems.at_value((*keys, "law"), unknown_name("damper law", device.law, laws))
    else:
        check_size(problems, keys, device, laws)
    check_brace(project, problems, (*keys, "brace"), device.brace, device.kind)
    if isinstance(device, DamperBetween):
        _nodes(project, problems, keys, device)


def check_size(problems: Problems, keys: Keys, device: Device | CatalogueItem, laws: Mapping[str, DamperLaw]) -> None:
    """Check that a damper has the size that its law needs: layers or a factor on its forces.

    Args:
        device: the damper, or an item of a catalogue.
        laws: of the project, by name.
    """
    law = laws[device.law]
    restrained = law.type == "buckling_restrained"  # a prototype of it is refused itself
    if restrained or (law.prototype is None and law.file is None):
        message = f"the law `{device.law}` has no `prototype` whose size could be changed [E-DAMPER-03]"
        if restrained:
            message = (
                f"the law `{device.law}` is of a buckling-restrained brace without layers; `scale` is its size"
                " [E-DAMPER-01]"
            )
        for key in ("layers", "layer_area", "layer_thickness"):
            if getattr(device, key) is not None:
                problems.at_key((*keys, key), message)
        if getattr(device, "strain_limit", None) is not None:  # an item of a catalogue has none
            message = f"the law `{device.law}` has no `prototype`, and so no layers that could strain [E-DAMPER-01]"
            problems.at_key((*keys, "strain_limit"), message)
    elif law.prototype is not None and device.scale is not None:
        problems.at_key((*keys, "scale"), PROTOTYPE_SCALE.format(device.law))


def _nodes(project: AnalysisFile, problems: Problems, keys: Keys, device: DamperBetween) -> None:
    known = project.grid.nodes
    for i, name in enumerate(device.nodes):
        if name not in known:
            every = list(known)
            hint = f"{did_you_mean(name, known)} (nodes are named by line and floor: `{every[0]}` to `{every[-1]}`)"
            message = f"there is no node `{name}` in this {project.structure}{hint} [E-NAME-01]"
            problems.at_value((*keys, "nodes", i), message)
    if device.nodes[0] == device.nodes[1]:
        problems.at_value((*keys, "nodes"), f"a damper from `{device.nodes[0]}` to itself [E-DAMPER-05]")


def check_apart(
    problems: Problems, keys: Keys, device: DamperBetween, tied: Mapping[str, object], fixed: Collection[str]
) -> None:
    """Check that the ends of a damper can move apart: that they are not both on one rigid floor, nor on the ground.

    Args:
        tied: diaphragm of each node that one ties, by name; its text is what messages call it.
        fixed: nodes that the ground holds in all directions.
    """
    rigid = {tied.get(name) for name in device.nodes}
    what = ""
    if device.nodes[0] == device.nodes[1]:
        return
    if None not in rigid and len(rigid) == 1:
        what = f"both are on the rigid floor {rigid.pop()}"
    elif all(name in fixed for name in device.nodes):
        what = "both are fixed to the ground"
    if what:
        message = f"{listed(device.nodes)} never move apart: {what} [E-DAMPER-05]"
        problems.at_value((*keys, "nodes"), message)


def _still(project: Project) -> tuple[dict[str, int], set[str]]:
    """The nodes that rigid floors tie, with their floors, and those that the ground holds."""
    grid = project.frame
    floor_at = {
        grid.levels[floor]: floor for floor in (*grid.diaphragm_floors, *(() if project.isolation is None else (0,)))
    }
    tied = {name: floor_at[place[1]] for name, place in grid.nodes.items() if place[1] in floor_at}
    fixed = set()
    for line in grid.lines if project.isolation is None else ():
        support = grid.support(line)
        if not isinstance(support, FootingSupport):
            springs = springs_of(support)
            if springs.horizontal == springs.vertical == "fixed":
                fixed.add(names.node_name(line, 0))
    return tied, fixed


def _places(project: Project, problems: Problems, keys: Keys, device: DamperRun) -> tuple[int, ...]:
    check = Selections(project.frame, problems)
    inside = check.bays(keys, device.bays)
    if not (check.storeys(keys, device.storeys) and inside):
        return ()
    check_beams_met((*keys, "kind"), device, project, problems)
    return device.storeys.numbers(1, project.frame.n_storeys)


def check_beams_met(keys: Keys, run: DamperRun | DesignRun, project: Project, problems: Problems) -> None:
    """Check that dampers in place of a chevron's braces have the beams that they meet.

    Args:
        keys: of the `kind` of the dampers.
        run: of dampers, or those of one kind of a design.
    """
    grid = project.frame
    absent = [
        grid.beam_name(bay, storey)
        for storey in run.storeys.numbers(1, grid.n_storeys)
        for bay in run.bays.numbers(1, grid.n_bays)
        if run.kind == "chevron_braces" and (bay, storey) not in grid.beam_at
    ]
    if absent:
        problems.at_value(
            keys, f"`chevron_braces` meet a beam in the middle, and {listed(absent)} is missing [E-DAMPER-05]"
        )


def _lists(problems: Problems, keys: Keys, device: Device, storeys: int) -> None:
    """Lists have one value for each storey."""
    given: dict[Keys, object] = {(key,): getattr(device, key) for key in ("layer_area", "scale", "design_deformation")}
    given |= {("brace", key): getattr(device.brace, key, None) for key in ("stiffness", "section", "force")}
    for at, values in given.items():
        if isinstance(values, tuple) and len(values) != storeys:
            message = (
                f"{counted(len(values), 'value')} for {counted(storeys, 'storey')}; one for each is needed [E-VALUE-04]"
            )
            problems.at_value((*keys, *at), message)
