"""Rotational stiffness of the ends of beams beside the stiffness of the beams: slips of units are found so."""

from __future__ import annotations

from edesign.codes.ec3.joints import PINNED, RIGID, classified
from edesign.frame.sections.own_section import section_of
from edesign.project.building.building import Building
from edesign.space.structure.composite import with_slabs


def unusual_ends(building: Building) -> list[str]:
    """Return the entries of beams whose semi-rigid ends are as good as pinned or rigid, a sentence each."""
    building = with_slabs(building)
    layout = building.layout
    numbers = {id(run): i for i, run in enumerate(building.beams)}
    found: dict[tuple[int, str], str] = {}
    for place, run in layout.beam_at.items():
        length = building.widths(place.along)[place.bay - 1]
        beam = building.materials[run.material].E * section_of(building, run.section).I_y / length
        beam *= run.stiffness_factor
        for end in ("start", "end"):
            stiffness = getattr(run.ends, end)
            if not isinstance(stiffness, float):
                continue
            joint = classified(stiffness, beam)
            if joint.name == "semi-rigid":
                continue
            number = numbers[id(run)]
            where = building.where("beams", number, "ends", end)
            found.setdefault(
                (number, end),
                f"{where}: beams[{number}].ends: {joint.ratio:.3g} E I / L of {place} is as good as {joint.name}; a "
                f"semi-rigid end has {PINNED:g} to {RIGID:g} E I / L (EN 1993-1-8, 5.2.2.5)",
            )
    return list(found.values())
