"""Checks of the own sections of a project or building."""

from __future__ import annotations

from collections.abc import Mapping

from edesign.project.frame.sections import BoxSection, Catalogue, PlateSection
from edesign.project.reading.problems import Problems


def check_own_sections(sections: Mapping[str, object], problems: Problems, profiles: Catalogue | None) -> None:
    """Check that own sections have names of their own, and that their plates fit together.

    Args:
        sections: of the file, by name.
        profiles: names of the catalogue; None leaves names unchecked.
    """
    for name, section in sections.items():
        if profiles is not None and name in profiles:
            problems.at_key(
                ("sections", name), "this is the name of a catalogue profile; choose another name [E-NAME-03]"
            )
        if isinstance(section, BoxSection) and 2 * section.web >= section.width:
            message = f"two webs of {section.web:g} m leave no room in a width of {section.width:g} m [E-FRAME-01]"
            problems.at_value(("sections", name, "web"), message)
        if isinstance(section, PlateSection | BoxSection):
            if 2 * section.flange >= section.height:
                message = (
                    f"two flanges of {section.flange:g} m leave no web in a height of {section.height:g} m [E-FRAME-01]"
                )
                problems.at_value(("sections", name, "flange"), message)
            if isinstance(section, PlateSection) and section.web > section.width:
                message = (
                    f"the web ({section.web:g} m) is thicker than the flange is wide ({section.width:g} m) [E-FRAME-01]"
                )
                problems.at_value(("sections", name, "web"), message)
