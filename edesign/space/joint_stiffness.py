"""Rotational stiffness of the ends of beams beside the stiffness of the beams: slips of units are found so."""

from __future__ import annotations

from edesign.building.steel_section import steel_section
from edesign.project.building.building import Building

PINNED_BELOW, RIGID_FROM = 0.5, 25.0
"""Of E I / L of the beam. Source: EN 1993-1-8:2005, 5.2.2.5(1), Figure 5.4, frames without bracing."""


def unusual_ends(building: Building) -> list[str]:
    """Return the entries of beams whose semi-rigid ends are as good as pinned or rigid, a sentence each."""
    layout = building.layout
    numbers = {id(run): i for i, run in enumerate(building.beams)}
    found: dict[tuple[int, str], str] = {}
    for place, run in layout.beam_at.items():
        length = building.widths(place.along)[place.bay - 1]
        beam = building.materials[run.material].E * steel_section(run.section).I_y / length
        for end in ("start", "end"):
            stiffness = getattr(run.ends, end)
            if not isinstance(stiffness, float) or PINNED_BELOW <= stiffness / beam < RIGID_FROM:
                continue
            kind = "pinned" if stiffness < PINNED_BELOW * beam else "rigid"
            number = numbers[id(run)]
            where = building.where("beams", number, "ends", end)
            found.setdefault(
                (number, end),
                f"{where}: beams[{number}].ends: {stiffness / beam:.3g} E I / L of {place} is as good as {kind}; a "
                f"semi-rigid end has {PINNED_BELOW:g} to {RIGID_FROM:g} E I / L (EN 1993-1-8, 5.2.2.5)",
            )
    return list(found.values())
