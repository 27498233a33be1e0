"""What tables of designs show storey by storey and mode by mode, whatever the method."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.report.tables.column import Column, count
from edesign.report.tables.items import Place

STOREY: Column[Place] = count("storey", lambda storey: int(storey.name))
MODE: Column[Place] = count("mode", lambda mode: int(mode.name))


def first_mode(group: Group) -> str:
    """Return what the mode of a design is called: of a building it is the one that leads along its direction."""
    along = group.attributes.get("along")
    return f"mode along {along}" if along else "first mode"


def heading(group: Group) -> str:
    """Return what titles say of a design: its name, method and status."""
    about = group.attributes
    return f"{about.get('name', '')}: {str(about.get('method', '')).replace('_', ' ')}, {about.get('status')}"
