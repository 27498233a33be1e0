"""Cross checks of how records act on a building: angles and places of its masses, each once."""

from __future__ import annotations

import math
from typing import Protocol

from edesign.project.analysis.shaking import IN_PLACE, Position
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.problems import Keys, Problems

_SAME_ANGLE = 1e-9  # rad
_OF_BUILDINGS = {
    "angles": "records are turned in plan",
    "eccentricity": "masses stand beside their places in plan",
    "eccentricity_ratio": "masses stand beside their places in plan",
}


class _Shaking(Protocol):
    """What files say of how records act: histories of a building file, and those of a study."""

    @property
    def model_fields_set(self) -> set[str]:
        """Keys that stand in the file."""

    @property
    def angles(self) -> tuple[float, ...]:
        """Of the records, rad."""

    @property
    def eccentricity(self) -> tuple[Position, ...]:
        """Places of the masses."""

    @property
    def eccentricity_ratio(self) -> float | None:
        """How far beside their places these are over the length of the floor."""


def check_shaking(file: AnalysisFile, problems: Problems, keys: Keys, asked: _Shaking) -> None:
    """Check angles and eccentricities of histories, which a plane frame has not.

    Args:
        file: that is shaken.
        keys: their place there.
    """
    if file.structure == "frame":
        for key, what in _OF_BUILDINGS.items():
            if key in asked.model_fields_set:
                message = f"{what}, and a plane frame has none; this key is of histories of a building [E-PAIR-04]"
                problems.at_key((*keys, key), message)
        return
    for i, angle in enumerate(asked.angles):
        if any(abs(math.remainder(angle - other, 2.0 * math.pi)) < _SAME_ANGLE for other in asked.angles[:i]):
            message = f"the angle of {math.degrees(angle):g} deg stands here twice [E-NAME-02]"
            problems.at_item((*keys, "angles"), i, message)
    for i, position in enumerate(asked.eccentricity):
        if position in asked.eccentricity[:i]:
            problems.at_item((*keys, "eccentricity"), i, f"`{position}` stands here twice [E-NAME-02]")
    aside = [i for i, position in enumerate(asked.eccentricity) if position != IN_PLACE]
    if not aside:
        if asked.eccentricity_ratio is not None:
            message = "all masses stand in place; name by `eccentricity` where they stand beside it [E-KEY-03]"
            problems.at_key((*keys, "eccentricity_ratio"), message)
        return
    if not file.accidental_torsion and asked.eccentricity_ratio is None:
        message = "`design.accidental_torsion` is `none`; give `eccentricity_ratio` here [E-KEY-02]"
        problems.at_item((*keys, "eccentricity"), aside[0], message)
    if not file.rigid_floors:
        message = "no floor is rigid (`diaphragms`), and masses of others stand at nodes [E-MASS-02]"
        problems.at_item((*keys, "eccentricity"), aside[0], message)
