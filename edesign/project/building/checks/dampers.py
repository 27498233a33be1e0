"""Cross checks of the dampers of a building: frames, bays and beams that exist, directions, sections of braces."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.building.names import BeamPlace, node_name
from edesign.project.building.supports import Springs
from edesign.project.checks.dampers import check_apart, check_devices
from edesign.project.dampers.dampers import Attachment, BraceSection, DamperBetween, DamperRun
from edesign.project.dampers.designs import DesignRun
from edesign.project.frame.sections import Catalogue, no_section
from edesign.project.notation.grid import InBays
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name


def check_dampers(building: Building, problems: Problems, profiles: Catalogue | None) -> None:
    """Check dampers and attachments.

    Args:
        building: its members are right.
        profiles: names of the catalogue; None leaves section names unchecked.
    """
    check_devices(building, problems, lambda keys, run: check_bays(building, problems, keys, run))
    if building.dampers is None:
        return
    for i, device in enumerate(building.dampers.devices):
        if isinstance(device, DamperBetween):
            check_apart(problems, ("dampers", "devices", i), device, building.layout.tied, _fixed(building))
        brace = device.brace
        if not isinstance(brace, BraceSection) or profiles is None:
            continue
        for section in brace.sections:
            if section not in building.sections and profiles.canonical(section) is None:
                keys: Keys = ("dampers", "devices", i, "brace", "section")
                problems.at_value(keys, no_section(section, building.sections, profiles))
    for i, attachment in enumerate(building.dampers.attachments):
        _attachment(building, problems, ("dampers", "attachments", i), attachment)


def check_bays(building: Building, problems: Problems, keys: Keys, run: DamperRun | DesignRun) -> tuple[int, ...]:
    """Check that dampers stand in bays of frames of one direction, and return their storeys; none where they are wrong.

    Args:
        building: its members are right.
        problems: of the file of the dampers; collects what is wrong.
        keys: of the dampers there.
        run: the dampers, or those of one kind of a design.
    """
    if run.along is None or run.frames is None:
        for key, what in (
            ("along", "the direction of the frames, `x` or `y`"),
            ("frames", "such as `[X1, X4]` or `all`"),
        ):
            if getattr(run, key) is None:
                problems.under(keys, key, f"this key is missing: {what} [E-KEY-02]")
        return ()
    if not check_places(building, problems, keys, run):
        return ()
    beams = (BeamPlace(*place) for place in building.layout.brace_places(run))
    absent = [beam for beam in beams if beam not in building.layout.beam_at]
    if absent and run.kind == "chevron_braces":
        message = f"`chevron_braces` meet a beam in the middle, and {listed(map(str, absent))} is missing [E-DAMPER-05]"
        problems.at_value((*keys, "kind"), message)
    if run.kind == "chevron" and (apart := [str(beam) for beam in absent if not _tied(building, beam)]):
        message = f"a `chevron` pushes the beam above, and there is no {listed(apart)} [E-DAMPER-05]"
        problems.at_value((*keys, "kind"), message)
    return run.storeys.numbers(1, building.n_storeys)


def _tied(building: Building, beam: BeamPlace) -> bool:
    """Whether a rigid floor ties both ends of a beam."""
    start, end = (building.layout.tied.get(node_name(line, beam.floor)) for line in beam.lines)
    return start is not None and start == end


def check_places(building: Building, problems: Problems, keys: Keys, run: InBays) -> bool:
    """Check that frames of one direction have bays and storeys with members at their corners.

    Args:
        building: its members are right.
        problems: of the file that names them; collects what is wrong.
        keys: of what names them there.

    Returns:
        Whether they have.
    """
    check = Selections(building, problems)
    assert run.along is not None and run.frames is not None, "the caller wants them"
    right = check.frames((*keys, "frames"), run.frames, run.along)
    right &= check.numbers((*keys, "bays"), run.bays, "bay", building.n_bays(run.along), f" along {run.along}")
    if not (check.storeys(keys, run.storeys) and right):
        return False
    corners = {
        node_name(line, floor)
        for place in building.layout.brace_places(run)
        for line in place.lines
        for floor in (place.storey - 1, place.storey)
    }
    if absent := sorted(corners - building.layout.nodes.keys()):
        nodes = f"is no node {listed(absent)}" if len(absent) == 1 else f"are no nodes {listed(absent, 4)}"
        problems.at_value(keys, f"at a corner of their bays no member ends: there {nodes} [E-NAME-01]")
    return not absent


def _fixed(building: Building) -> set[str]:
    """The nodes that the ground holds in all directions."""
    bases = {node_name(line, 0): building.support(line) for line in building.layout.node_lines[0]}
    return {name for name, on in bases.items() if isinstance(on, Springs) and set(on.all()[:3]) == {"fixed"}}


def _attachment(building: Building, problems: Problems, keys: Keys, item: Attachment) -> None:
    """A tuned mass moves in one direction, and stands at the centre of mass or on a column line."""
    if item.direction is None:
        problems.under(keys, "direction", "this key is missing: the direction that it moves in, `x` or `y` [E-KEY-02]")
    grid = building.grid
    if item.floor > building.n_storeys:
        return
    if item.at is None:
        if len(building.rigid_parts(item.floor)) != 1:
            rigid = "is in several rigid parts" if item.floor in building.rigid_floors else "is not rigid"
            loose = f"floor {item.floor} {rigid} and has no one centre of mass"
            problems.under(keys, "at", f"this key is missing: {loose}; give a column line, such as `A1` [E-KEY-02]")
        return
    if item.at not in grid.lines:
        problems.at_value((*keys, "at"), unknown_name("column line", item.at, grid.lines))
    elif (node := grid.node_name(item.at, item.floor)) not in grid.nodes:
        problems.at_value((*keys, "at"), f"there is no node `{node}`: no member ends there [E-NAME-01]")
