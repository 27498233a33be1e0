"""A choice of sections as a group of an archive."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group, Variable
from edesign.space.selection.select import Selection


def selection_group(selection: Selection) -> Group:
    """Return what was chosen for each group of members, and what its next lighter section would break."""
    rows = selection.groups
    group = Group(
        attributes={
            "mass_kg": selection.mass,
            "mass_before_kg": selection.mass_before,
            "evaluations": selection.evaluations,
            "certified": int(selection.certified),
            "starts": selection.starts,
            "splices": selection.splices,
            "doublers": selection.doublers,
        }
    )
    if selection.free is not None:
        group.attributes |= {"mass_free_kg": selection.free.best.mass, "free_met": int(selection.free.best.met)}
    names = np.array([row.group.name for row in rows])
    group.coords["group"] = Variable(("group",), names, "", "group of members")
    for name, values, unit, text in (
        ("before", [row.before for row in rows], "", "section of the file that was designed"),
        ("after", [row.after for row in rows], "", "section chosen"),
        ("mass", [row.mass for row in rows], "kg", "mass of the members of the group"),
        ("held_by", [row.held_by for row in rows], "", "what the next lighter section would break"),
    ):
        group.add(name, ("group",), np.array(values), unit, text)
    return group
