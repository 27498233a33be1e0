"""Beams with which a slab acts: the factor on E I about their strong axis that the slab of the file makes."""

from __future__ import annotations

from edesign.codes.en1994.composite_beams import (
    Slab,
    cracked_inertia,
    effective_width,
    equivalent_inertia,
    equivalent_span,
    uncracked_inertia,
)
from edesign.errors import InputError
from edesign.frame.sections.own_section import section_of
from edesign.project.building.building import Building
from edesign.project.building.members import BeamRun
from edesign.project.building.names import BeamPlace
from edesign.project.building.places import panels_in

SAME = 0.02
"""Beams of one entry have one factor, that of the first; those that differ by more are refused."""


def with_slabs(building: Building) -> Building:
    """Return the building with the stiffness factors of its slabs; itself where no beam has one.

    Raises:
        InputError: beams of one entry differ by more than `SAME`.
    """
    if all(run.slab is None for run in building.beams):
        return building
    beams = tuple(
        run if run.slab is None else run.model_copy(update={"stiffness_factor": stiffness_factor(building, i, run)})
        for i, run in enumerate(building.beams)
    )
    return building.model_copy(update={"beams": beams})


def stiffness_factor(building: Building, number: int, run: BeamRun, section: str = "") -> float:
    """Return I_eq / I_y of the beams of an entry.

    Args:
        number: of the entry, from 0.
        section: another section in the place of its own.

    Raises:
        InputError: its beams differ by more than `SAME`.
    """
    factors: dict[BeamPlace, float] = {}
    for place, of in building.layout.beam_at.items():
        if of.group == run.group and of.slab is not None:
            factors[place] = _factor(building, run, place, section or run.section)
    if not factors:
        return 1.0
    (least, low), (most, high) = min(factors.items(), key=lambda of: of[1]), max(factors.items(), key=lambda of: of[1])
    if high > (1.0 + SAME) * low:
        raise InputError(
            f"{building.where('beams', number, 'slab')}: beams.{number}.slab: E I of {most} is multiplied by "
            f"{high:.2f} and of {least} by {low:.2f}, as their widths of slab or spans differ; give them entries and "
            "groups of their own [E-BLDG-03]"
        )
    return next(iter(factors.values()))


def _factor(building: Building, run: BeamRun, place: BeamPlace, section: str) -> float:
    assert run.slab is not None, "only beams with a slab are asked for"
    steel, of = section_of(building, section), run.slab
    length = building.widths(place.along)[place.bay - 1]
    held = sum(end != "pinned" for end in (run.ends.start, run.ends.end))
    width = effective_width(equivalent_span(length, held), _sides(building, place))
    slab = Slab(of.thickness, of.ribs, building.materials[run.material].E / of.E, of.reinforcement)
    sagging = uncracked_inertia(steel.A, steel.I_y, steel.h, slab, width)
    if held == 0:
        return sagging / steel.I_y
    return equivalent_inertia(sagging, cracked_inertia(steel.A, steel.I_y, steel.h, slab, width)) / steel.I_y


def _sides(building: Building, place: BeamPlace) -> tuple[float, float]:
    """Half of the distance to the next beams on both sides, secondary ones that run alike among them; 0 at an edge."""
    along_x = place.along == "x"
    across = building.widths("y" if along_x else "x")
    found = []
    for beside in (place.frame, place.frame + 1):
        panel = (place.bay, beside) if along_x else (beside, place.bay)
        if panel not in building.layout.floors[place.floor]:
            found.append(0.0)
            continue
        between = 0
        for load in building.loads.areas:
            parallel = load.spans == ("y" if along_x else "x")
            on = panel in panels_in(load.bays, building.n_bays("x"), building.n_bays("y"))
            if parallel and on and place.floor in load.floors.numbers(1, building.n_storeys):
                between = max(between, load.secondary_beams)
        found.append(0.5 * across[beside - 1] / (between + 1))
    return found[0], found[1]
