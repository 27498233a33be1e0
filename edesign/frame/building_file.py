"""Reading a building file with the sections at hand that a building may use."""

from __future__ import annotations

from pathlib import Path

from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building import loader
from edesign.project.building.building import Building


def load_building(path: Path | str) -> Building:
    """Read and check a building file; its sections must be in the catalogue, or hollow sections.

    Args:
        path: the YAML file, UTF-8.

    Returns:
        The building, all values in SI.

    Raises:
        InputError: the file cannot be read, or is wrong; the message lists all problems with file, line and column.
    """
    return loader.load_building(path, BuildingSections())
