"""Bays and braces of a plane frame for its dampers."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.frame.device_places import Bay, DamperSites
from edesign.frame.floors import ACROSS, UP
from edesign.frame.sections.building_sections import BuildingSections
from edesign.frame.sections.named_section import cross_section
from edesign.frame.struts import Strut, strut
from edesign.project.dampers.dampers import BraceSection
from edesign.project.frame.sections import no_section
from edesign.project.notation import names
from edesign.project.notation.grid import BayPlace
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, keys_text


def frame_sites(project: Project) -> DamperSites:
    """Return what dampers need of a plane frame."""
    frame = project.frame

    def bay(at: BayPlace) -> Bay:
        lines = frame.bay_lines(at.bay)
        (low_left, top_left), (low_right, top_right) = (
            (names.node_name(line, at.storey - 1), names.node_name(line, at.storey)) for line in lines
        )
        width, height = frame.bay_widths[at.bay - 1], frame.storey_heights[at.storey - 1]
        middle = frame.beam_name(at.bay, at.storey)
        return Bay((low_left, low_right), (top_left, top_right), middle, width, height, ACROSS.degree)

    def bar(brace: BraceSection, length: float, damper: Keys) -> tuple[float, Strut | None]:
        name = brace.of(0)
        if name not in project.sections and BuildingSections().canonical(name) is None:
            keys = (*damper, "brace", "section")
            message = no_section(name, project.sections, BuildingSections())
            raise InputError(f"{project.where(*keys)}: {keys_text(keys)}: {message}")
        axial = project.materials[brace.material].E * cross_section(project, name).area / length
        return axial, strut(project, name, brace.material, length * brace.buckling_length_factor)

    return DamperSites(UP, bay, bar)
