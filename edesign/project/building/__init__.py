"""The building file: YAML with units to a validated three-dimensional building in SI."""

from edesign.project.building.building import Building
from edesign.project.building.loader import BuildingError, load_building, parse_building

__all__ = ["Building", "BuildingError", "load_building", "parse_building"]
