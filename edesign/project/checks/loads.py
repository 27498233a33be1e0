"""Cross checks of loads: places that exist, positions on their beams, room for points of integration."""

from __future__ import annotations

from edesign.project.actions.beam_loads import MOST_POINTS, breaks_of_members, points_of_member
from edesign.project.actions.loads import BeamLoad
from edesign.project.checks.selections import Selections
from edesign.project.notation.positions import Position
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems


def check_loads(project: Project, problems: Problems) -> None:
    """Check the loads; `project` has no schema problems.

    Args:
        project: the project, which has no schema problems.
    """
    check = Selections(project.frame, problems)
    loads, before = project.loads, len(problems.found)
    for i, strip in enumerate(loads.floors):
        check.standing_beams(("loads", "floors", i), strip)
    for i, load in enumerate(loads.beams):
        check.standing_beams(("loads", "beams", i), load)
        _positions(project, problems, ("loads", "beams", i), load)
    for i, column in enumerate(loads.columns):
        check.standing_columns(("loads", "columns", i), column)
    for i, node in enumerate(loads.nodes):
        check.nodes(("loads", "nodes", i), node.lines, node.floors)
    if len(problems.found) == before:
        _room(project, problems)


def _positions(project: Project, problems: Problems, keys: Keys, load: BeamLoad) -> None:
    """Every place lies on every beam that has the load, and a part has a length."""
    frame = project.frame
    places = frame.standing_beams(load)
    if not places:
        return
    bay, floor = min(places, key=lambda place: frame.bay_widths[place[0] - 1])
    shortest, name = frame.bay_widths[bay - 1], frame.beam_name(bay, floor)

    def beyond(position: Position) -> str:
        if position.is_share or position.value <= shortest:
            return ""
        return f"{position} is beyond the end of beam {name}, which is {shortest:g} m long [E-LOAD-02]"

    for i, point in enumerate(load.points):
        for k, position in enumerate(point.at):
            message = beyond(position)
            if not message and not 0.0 < position.share(shortest) < 1.0:
                message = f"{position} is an end of beam {name}; give a load on a node under `loads.nodes` [E-LOAD-02]"
            if message:
                problems.at_item((*keys, "points", i, "at"), k, message)
    for i, part in enumerate(load.partial):
        wrong = {"start": beyond(part.start), "end": beyond(part.end)}
        for key, message in wrong.items():
            if message:
                problems.at_value((*keys, "partial", i, key), message)
        if any(wrong.values()):
            continue
        for bay, floor in places:
            width = frame.bay_widths[bay - 1]
            if part.start.share(width) >= part.end.share(width):
                message = f"on beam {frame.beam_name(bay, floor)} the load ends at {part.end}, not after its `start`"
                problems.at_value((*keys, "partial", i, "end"), f"{message} at {part.start} [E-VALUE-04]")
                break


def _room(project: Project, problems: Problems) -> None:
    """A member has as many integration points as the core has room for."""
    for name, breaks in breaks_of_members(project.frame, project.loads).items():
        points = points_of_member(project.elements, breaks)
        if points > MOST_POINTS:
            most = (MOST_POINTS - 1) // (project.elements.integration_points - 1) - 1
            message = (
                f"loads begin, end or stand at {len(breaks)} places inside {name}; with "
                f"{project.elements.integration_points} integration points (`elements`) between two of them a member "
                f"has room for {most} places [E-LOAD-02]"
            )
            problems.at_key(("loads", "beams"), message)
            return
