"""Cross checks of dampers: places inside the grid, laws and nodes that exist, one value for each storey."""

from __future__ import annotations

from edesign.project.analyses import ModalAnalysis
from edesign.project.checks_frame import Selections
from edesign.project.dampers import BraceSection, BraceStiffness, DamperBetween, DamperRun, Device
from edesign.project.problems import Keys, Problems, did_you_mean, unknown_name
from edesign.project.project import Project


def check_dampers(project: Project, problems: Problems) -> None:
    """Check dampers and attachments; `project` has no schema problems."""
    for i, analysis in enumerate(project.analyses):
        if isinstance(analysis, ModalAnalysis) and analysis.damper_strain and analysis.damper_deformation:
            message = "give either `damper_strain` or `damper_deformation`, one of them"
            problems.at_value(("analyses", i, "damper_deformation"), message)
    if project.dampers is None:
        return
    for i, device in enumerate(project.dampers.devices):
        _device(project, problems, ("dampers", "devices", i), device)
    for i, item in enumerate(project.dampers.attachments):
        last = project.frame.n_storeys
        if item.floor > last:
            message = f"there is no floor {item.floor}; floors are numbered 1 to {last}"
            problems.at_value(("dampers", "attachments", i, "floor"), message)


def _device(project: Project, problems: Problems, keys: Keys, device: Device) -> None:
    assert project.dampers is not None
    laws = project.dampers.laws
    if device.law not in laws:
        problems.at_value((*keys, "law"), unknown_name("damper law", device.law, laws))
    elif laws[device.law].prototype is None:
        for key in ("layers", "layer_area", "layer_thickness"):
            if getattr(device, key) is not None:
                message = f"the law `{device.law}` has no `prototype` whose size could be changed"
                problems.at_key((*keys, key), message)
    if isinstance(device.brace, BraceSection):
        if device.kind == "storey":
            message = "a damper between floors has no brace geometry; give the `stiffness` of its brace"
            problems.at_value((*keys, "brace"), message)
        if device.brace.material not in project.materials:
            message = unknown_name("material", device.brace.material, project.materials)
            problems.at_value((*keys, "brace", "material"), message)
    if isinstance(device, DamperBetween):
        _nodes(project, problems, keys, device)
    else:
        _places(project, problems, keys, device)


def _nodes(project: Project, problems: Problems, keys: Keys, device: DamperBetween) -> None:
    known = project.frame.nodes
    for i, name in enumerate(device.nodes):
        if name not in known:
            message = f"there is no node `{name}` in this frame{did_you_mean(name, known)}"
            problems.at_value((*keys, "nodes", i), message)
    if device.nodes[0] == device.nodes[1]:
        problems.at_value((*keys, "nodes"), f"a damper from `{device.nodes[0]}` to itself")
    _lists(problems, keys, device, 1)


def _places(project: Project, problems: Problems, keys: Keys, device: DamperRun) -> None:
    check = Selections(project.frame, problems)
    inside = check.numbers((*keys, "bays"), device.bays, "bay", project.frame.n_bays)
    if check.numbers((*keys, "storeys"), device.storeys, "storey", project.frame.n_storeys) and inside:
        _lists(problems, keys, device, len(device.storeys.numbers(1, project.frame.n_storeys)))


def _lists(problems: Problems, keys: Keys, device: Device, storeys: int) -> None:
    """Lists have one value for each storey."""
    stiffness = device.brace.stiffness if isinstance(device.brace, BraceStiffness) else None
    for at, values in (((*keys, "layer_area"), device.layer_area), ((*keys, "brace", "stiffness"), stiffness)):
        if isinstance(values, tuple) and len(values) != storeys:
            expected = "1 storey" if storeys == 1 else f"{storeys} storeys"
            problems.at_value(at, f"{len(values)} values for {expected}; one for each is needed")
