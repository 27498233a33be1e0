"""Cross checks of the dampers of a building: frames, bays and beams that exist, directions, sections of braces."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.checks_selections import Selections
from edesign.project.building.names import BeamPlace
from edesign.project.checks.dampers import check_devices
from edesign.project.dampers.dampers import Attachment, BraceSection, DamperRun
from edesign.project.frame.sections import Catalogue, no_section
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name


def check_dampers(building: Building, problems: Problems, profiles: Catalogue | None) -> None:
    """Check dampers and attachments.

    Args:
        building: its members are right.
        problems: collects what is wrong.
        profiles: names of the catalogue; None leaves section names unchecked.
    """
    check = Selections(building, problems)
    check_devices(building, problems, lambda keys, run: _places(building, problems, check, keys, run))
    if building.dampers is None:
        return
    for i, device in enumerate(building.dampers.devices):
        brace = device.brace
        if isinstance(brace, BraceSection) and profiles is not None and profiles.canonical(brace.section) is None:
            keys: Keys = ("dampers", "devices", i, "brace", "section")
            problems.at_value(keys, no_section(brace.section, (), profiles))
    for i, attachment in enumerate(building.dampers.attachments):
        _attachment(building, problems, ("dampers", "attachments", i), attachment)


def _places(building: Building, problems: Problems, check: Selections, keys: Keys, run: DamperRun) -> tuple[int, ...]:
    """Return the storeys of dampers that stand in frames of one direction; none where they are wrong."""
    if run.along is None or run.frames is None:
        for key, what in (
            ("along", "the direction of the frames, `x` or `y`"),
            ("frames", "such as `[X1, X4]` or `all`"),
        ):
            if getattr(run, key) is None:
                problems.under(keys, key, f"this key is missing: {what} [E-KEY-02]")
        return ()
    right = check.frames((*keys, "frames"), run.frames, run.along)
    right &= check.numbers((*keys, "bays"), run.bays, "bay", building.n_bays(run.along), f" along {run.along}")
    if not (check.storeys(keys, run.storeys) and right):
        return ()
    beams = (BeamPlace(*place) for place in building.layout.brace_places(run))
    absent = [str(beam) for beam in beams if run.kind == "chevron_braces" and beam not in building.layout.beam_at]
    if absent:
        message = f"`chevron_braces` meet a beam in the middle, and {listed(absent)} is missing [E-DAMPER-05]"
        problems.at_value((*keys, "kind"), message)
    return run.storeys.numbers(1, building.n_storeys)


def _attachment(building: Building, problems: Problems, keys: Keys, item: Attachment) -> None:
    """A tuned mass moves in one direction, and stands at the centre of mass or on a column line."""
    if item.direction is None:
        problems.under(keys, "direction", "this key is missing: the direction that it moves in, `x` or `y` [E-KEY-02]")
    grid = building.grid
    if item.at is None or item.floor > building.n_storeys:
        return
    if item.at not in grid.lines:
        problems.at_value((*keys, "at"), unknown_name("column line", item.at, grid.lines))
    elif (node := grid.node_name(item.at, item.floor)) not in grid.nodes:
        problems.at_value((*keys, "at"), f"there is no node `{node}`: no member ends there [E-NAME-01]")
