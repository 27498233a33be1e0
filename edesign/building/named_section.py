"""Sections of a project by their name."""

from __future__ import annotations

from edesign.building.profiles import profile
from edesign.building.section import CrossSection, plate_section, rectangle_section, rolled_section
from edesign.errors import InputError
from edesign.project.project import Project
from edesign.project.sections import ElasticSection, PlateSection, RectangleSection


def cross_section(project: Project, name: str) -> CrossSection | ElasticSection:
    """Return a section by its name: an own one of the project, or one of the catalogue.

    Raises:
        InputError: there is no such section, or its plates do not fit together.
    """
    own = project.sections.get(name)
    try:
        if isinstance(own, PlateSection):
            return plate_section(own, project.fibres)
        if isinstance(own, RectangleSection):
            return rectangle_section(own, project.fibres)
        return own if own is not None else rolled_section(profile(name), project.fibres)
    except InputError as error:
        where = project.where(*(("sections", name) if own is not None else ("frame",)))
        raise InputError(f"{where}: section {name}: {error}") from error
