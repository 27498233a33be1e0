"""How far single storeys and members change from one variant to another, and which columns go into tension.

The largest value of all members says nothing of this: another member may have it in each variant.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak, residual
from edesign.assess.sets import HistorySet
from edesign.project.notation.names import storey_of

PLACES: Mapping[str, str] = {
    "storey_drift": "storey",
    "residual_storey_drift": "storey",
    "storey_shear": "storey",
    "floor_acceleration": "floor",
    "column_axial_force": "column",
    "brace_axial_force": "brace",
    "beam_plastic_rotation": "beam",
    "column_plastic_rotation": "column",
    "brace_ductility": "buckling_brace",
}
"""Quantities that are compared place by place, with the dimension of their places in archives."""
MAY_BE_ZERO = ("residual_storey_drift", "beam_plastic_rotation", "column_plastic_rotation")
"""Of these the difference is compared: members that stay elastic have no ratio."""
EQUILIBRIUM = 1e-6
"""Of the largest axial force: tension below it is what the solution of equilibrium, to 1e-7 by default, leaves."""


@dataclass(frozen=True)
class Change:
    """The place where a quantity changes most from one variant to another.

    Attributes:
        place: name of the member, or number of the storey or floor in words.
        before, after: means over the motions in common, in SI.
    """

    place: str
    before: float
    after: float


@dataclass(frozen=True)
class Tension:
    """Columns that go into tension in some history.

    Attributes:
        column: that has the largest tension.
        force: the largest of all histories, N.
        columns: all of them, in the order of the frame.
    """

    column: str
    force: float
    columns: tuple[str, ...]

    @property
    def lifting(self) -> tuple[str, ...]:
        """Those that stand on the supports, which they lift."""
        return tuple(name for name in self.columns if storey_of(name) == 1)


def in_common(first: HistorySet, other: HistorySet) -> tuple[dict[str, Group], dict[str, Group]]:
    """Return the completed histories of two sets whose records both have, by name.

    Args:
        other: of another one.
    """
    records = [_records(found) for found in (first, other)]
    common = set(records[0].values()) & set(records[1].values())
    both = [
        {name: found.completed[name] for name, record in of.items() if record in common}
        for found, of in zip((first, other), records, strict=True)
    ]
    return both[0], both[1]


Motions = Collection[Collection[Group]]
"""Histories by motion: those of a record at several angles and places of the masses are one."""


def largest_change(before: Motions, after: Motions, quantity: str) -> Change | None:
    """Return where a quantity grows most, or falls least, from one variant to another.

    It is the largest ratio of the means over the motions, or of quantities that may be zero the largest difference. Of
    one motion the worst history counts for each place.

    Args:
        before: histories of the first variant.
        after: those of the other one under the same records.
        quantity: a key of `PLACES`.

    Returns:
        The change; None if either has no such quantity, or no place that the other has.
    """
    old, new = (_means(motions, quantity) for motions in (before, after))
    both = [place for place in old if place in new and (old[place] > 0.0 or quantity in MAY_BE_ZERO)]
    if not both:
        return None
    grown = {place: new[place] - old[place] if quantity in MAY_BE_ZERO else new[place] / old[place] for place in both}
    place = max(grown, key=grown.__getitem__)
    words = f"{PLACES[quantity]} {place}" if PLACES[quantity] in ("storey", "floor") else place
    return Change(words, old[place], new[place])


def tension(groups: Iterable[Group]) -> Tension | None:
    """Return which columns go into tension in some of the histories; None if no column does.

    Args:
        groups: histories of one variant.
    """
    largest: dict[str, float] = {}
    scale = 0.0
    for group in groups:
        values, all_of = group.variables.get("column_axial_force_max"), peak(group, "column_axial_force")
        if values is None or all_of is None:
            continue
        scale = max(scale, float(all_of.max(initial=0.0)))
        for name, value in zip(map(str, group.coords["column"].values), map(float, values.values), strict=True):
            largest[name] = max(largest.get(name, 0.0), value)
    pulled = {name: value for name, value in largest.items() if value > EQUILIBRIUM * scale}
    if not pulled:
        return None
    most = max(pulled, key=pulled.__getitem__)
    return Tension(most, pulled[most], tuple(pulled))


def _records(found: HistorySet) -> dict[str, str]:
    """The record of each completed history."""
    return {name: str(group.attributes.get("record") or name) for name, group in found.completed.items()}


def _means(motions: Motions, quantity: str) -> dict[str, float]:
    """The mean of each place over motions, of members of their worse ends; {} if a history has no such quantity."""
    dimension = PLACES[quantity]
    values = []
    for groups in motions:
        of_motion = []
        for group in groups:
            left = quantity.startswith("residual_")
            found = residual(group, quantity.removeprefix("residual_")) if left else peak(group, quantity)
            if found is None or found.size == 0 or dimension not in group.coords:
                return {}
            of_motion.append(found.reshape(len(found), -1).max(axis=1))
            names = [str(name) for name in group.coords[dimension].values]
        values.append(np.max(of_motion, axis=0))
    return dict(zip(names, np.mean(values, axis=0).tolist(), strict=True)) if values else {}
