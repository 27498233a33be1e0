"""Bays and braces of a building for its dampers."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.frame.device_places import Bay, DamperSites
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.own_section import section_of
from edesign.frame.struts import Strut, section_strut
from edesign.project.building.building import Building
from edesign.project.building.layout import DIRECTIONS
from edesign.project.building.names import BeamPlace, bay_lines, frame_name, node_name
from edesign.project.dampers.dampers import BraceSection
from edesign.project.frame.sections import no_section
from edesign.project.notation.grid import BayPlace
from edesign.project.reading.problems import Keys, keys_text
from edesign.space.nonlinear.floors import UP
from edesign.space.structure.steel_by_thickness import steel_by_thickness


def building_sites(building: Building) -> DamperSites:
    """Return what dampers need of a building.

    Args:
        building: from `load_building`, with its steels as written.
    """
    axes = building.axes
    frames = {frame_name(along, i, axes): (along, i) for along in DIRECTIONS for i in range(building.n_frames(along))}

    def bay(at: BayPlace) -> Bay:
        along, frame = frames[at.frame]
        (low_left, top_left), (low_right, top_right) = (
            (node_name(line, at.storey - 1), node_name(line, at.storey))
            for line in bay_lines(along, frame, at.bay, axes)
        )
        width, height = building.widths(along)[at.bay - 1], building.storey_heights[at.storey - 1]
        middle = str(BeamPlace(along, frame, at.bay, at.storey, axes))
        return Bay((low_left, low_right), (top_left, top_right), middle, width, height, DIRECTIONS.index(along))

    def bar(brace: BraceSection, length: float, damper: Keys) -> tuple[float, Strut | None]:
        name = brace.of(0)
        if name not in building.sections and BuildingSections().canonical(name) is None:
            keys = (*damper, "brace", "section")
            message = no_section(name, building.sections, BuildingSections())
            raise InputError(f"{building.where(*keys)}: {keys_text(keys)}: {message}")
        steel = steel_by_thickness(building, name, brace.material)[1].material
        section = section_of(building, name)
        return steel.E * section.A / length, section_strut(section, steel, length * brace.buckling_length_factor)

    return DamperSites(UP, bay, bar)
