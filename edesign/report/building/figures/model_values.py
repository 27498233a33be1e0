"""A building before its analysis, as drawings ask for it."""

from __future__ import annotations

import numpy as np

from edesign.codes.ec3.section import SteelSection
from edesign.space.structure.frame import SpaceFrame
from edesign.space.structure.masses import floor_masses


class ModelValues:
    """Values of members, nodes and floors of a building that was not analysed, named as in an archive."""

    def __init__(self, frame: SpaceFrame) -> None:
        self._frame = frame
        members, names = frame.members, np.array(frame.node_names)
        start, end = frame.ends
        masses = floor_masses(frame)
        self._groups: dict[str, dict[str, np.ndarray]] = {
            "members": {
                "member": np.array([member.name for member in members]),
                "kind": np.array([member.kind for member in members]),
                "section": np.array([member.section for member in members]),
                "storey": np.array([member.storey for member in members]),
                "frame": np.array([", ".join(member.frame) for member in members]),
                "start": frame.coordinates[start],
                "end": frame.coordinates[end],
                "start_node": names[start],
                "end_node": names[end],
                "web": frame.webs,
                "ends": np.array([member.ends for member in members]),
            },
            "nodes": {"node": names, "position": frame.coordinates, "fixed": frame.fixed.astype(int)},
            "floors": {"floor": np.arange(frame.n_floors + 1), "x": masses.x, "y": masses.y},
        }

    def values(self, name: str, variable: str) -> np.ndarray:
        """Return the values of a variable of a group, named as in an archive."""
        return self._groups[name][variable]

    def section(self, name: str) -> SteelSection:
        """Return a section of a member by its name: own section of the building, or one of the catalogue."""
        return self._frame.section(name)
