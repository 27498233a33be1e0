"""Sections of a project by their name."""

from __future__ import annotations

from edesign.errors import InputError
from edesign.frame.sections.hollow_fibres import hollow_cross_section
from edesign.frame.sections.hollow_section import hollow_section
from edesign.frame.sections.profiles import profile
from edesign.frame.sections.section import CrossSection, plate_section, rectangle_section, rolled_section
from edesign.project.frame.sections import ElasticSection, PlateSection, RectangleSection, SectionAxis
from edesign.project.project import Project


def cross_section(project: Project, name: str, axis: SectionAxis = "strong") -> CrossSection | ElasticSection:
    """Return a section by its name: an own one of the project, one of the catalogue, or a hollow one.

    Args:
        axis: about which it bends.

    Raises:
        InputError: there is no such section, or its plates do not fit together.
    """
    own, weak = project.sections.get(name), axis == "weak"
    try:
        if isinstance(own, PlateSection):
            return plate_section(own, project.fibres, weak)
        if isinstance(own, RectangleSection):
            return rectangle_section(own, project.fibres)
        if own is not None:
            return own
        hollow = hollow_section(name)
        if hollow is not None:
            return hollow_cross_section(hollow, project.fibres, weak)
        return rolled_section(profile(name), project.fibres, weak)
    except InputError as error:
        where = project.where(*(("sections", name) if own is not None else ("frame",)))
        raise InputError(f"{where}: section {name}: {error}") from error
