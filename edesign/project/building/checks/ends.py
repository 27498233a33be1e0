"""Cross checks of hinges, joints and panel zones of a building."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.checks.hinges import check_ends, no_rigid_ends
from edesign.project.reading.problems import Problems


def check_building_ends(building: Building, problems: Problems) -> None:
    """Check where hinges, joints and panel zones stand, and that their values fit together.

    Args:
        building: its members stand.
    """
    layout = building.layout
    check = Selections(building, problems)
    check_ends(building, problems, check, layout)
    for i, zones in enumerate(building.panel_zones):
        check.nodes(("panel_zones", i), zones.at, zones.floors)
        no_rigid_ends(building, problems, ("panel_zones", i))
    soft = {name for name, ends in layout.beam_ends.items() if any(isinstance(end, float) for end in ends)}
    for i, joints in enumerate(building.joints):
        beams = {name for pair in layout.members_in(joints.beams, None) for name in pair}
        if twice := sorted(beams & soft):
            message = (
                f"{twice[0]} has ends with a stiffness already (`beams: ends`); leave out one of both [E-FRAME-05]"
            )
            problems.at_key(("joints", i, "beams"), message)
