"""Cross checks of a placement of dampers in a building: frames, bays and storeys exist, each place once."""

from __future__ import annotations

from edesign.project.building.building import Building
from edesign.project.building.checks.dampers import check_places
from edesign.project.building.checks.selections import Selections
from edesign.project.dampers.placement import PlacementDesign
from edesign.project.notation.grid import BayPlace
from edesign.project.reading.problems import Keys, Problems


def check_candidates(building: Building, problems: Problems, keys: Keys, spec: PlacementDesign) -> bool:
    """Check that a building has the candidate places of a placement, and return whether it has.

    Args:
        building: that is studied.
        problems: of the study file; collects what is wrong.
        keys: of the design in the study file, e.g. ("designs", "placed").
        spec: without schema problems.
    """
    if spec.bays is not None:
        message = "a building has frames in two directions; give `places` with their bays [E-KEY-03]"
        problems.at_key((*keys, "bays"), message)
        return False
    if not spec.places:
        message = "this key is missing: a list of `along`, `frames` and `bays` [E-KEY-02]"
        problems.under(keys, "places", message)
        return False
    if not Selections(building, problems).storeys(keys, spec.storeys):
        return False
    taken: set[BayPlace] = set()
    for i, run in enumerate(spec.candidates):
        where = (*keys, "places", i)
        if not check_places(building, problems, where, run):
            return False
        here = list(building.layout.bay_places(run))
        if twice := sorted(taken.intersection(here)):
            frame, bay, storey = twice[0]
            message = f"bay {bay} of frame {frame} in storey {storey} is a candidate of an entry before [E-NAME-02]"
            problems.at_value(where, message)
            return False
        taken.update(here)
    return True
