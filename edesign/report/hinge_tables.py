"""Tables of plastic hinges, joints, panel zones and springs under the columns: what they are and what they did."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.report.table import Table, number

SHOWN = 20
"""Rows of a table at most, those that were used most: a page of them can be read."""


def hinge_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of all analyses with hinges, joints, panel zones or springs at supports.

    Args:
        groups: results by the name of the analysis.
    """
    tables = (_hinges(groups), _joints(groups), _panels(groups), _supports(groups))
    return [table for table in tables if table is not None]


def _worst(groups: Mapping[str, Group], variable: str, coordinate: str) -> dict[str, tuple[float, str]]:
    """The largest magnitude of a variable for each name of its coordinate, and the analysis that has it."""
    found: dict[str, tuple[float, str]] = {}
    for analysis, group in groups.items():
        values = peak(group, variable) if coordinate in group.coords else None
        if values is None:
            continue
        for name, value in zip(group.coords[coordinate].values.tolist(), values.tolist(), strict=True):
            if name not in found or value > found[name][0]:
                found[str(name)] = float(value), analysis
    return found


def _facts(groups: Mapping[str, Group], coordinate: str, variables: tuple[str, ...]) -> dict[str, tuple[object, ...]]:
    """What does not change: the variables of each name of a coordinate."""
    found: dict[str, tuple[object, ...]] = {}
    for group in groups.values():
        if coordinate in group.coords and all(name in group.variables for name in variables):
            columns = (group.variables[name].values.tolist() for name in variables)
            found |= dict(zip(group.coords[coordinate].values.tolist(), zip(*columns, strict=True), strict=True))
    return found


def _most(found: Mapping[str, tuple[float, str]]) -> list[tuple[str, tuple[float, str]]]:
    """The rows of a table: names with the largest values, then in the order of their names."""
    return sorted(found.items(), key=lambda item: (-item[1][0], item[0]))[:SHOWN]


def _note_left_out(table: Table, count: int, what: str) -> None:
    if count > SHOWN:
        table.notes.append(f"The {SHOWN} of {count} {what}.")


def _hinges(groups: Mapping[str, Group]) -> Table | None:
    turned = _worst(groups, "hinge_plastic_rotation", "hinge")
    if not turned:
        return None
    facts = _facts(groups, "hinge", ("hinge_M_y", "hinge_theta_p"))
    left: dict[str, float] = {}
    for group in groups.values():
        if "hinge_strength_left_final" in group.variables:
            values = group.variables["hinge_strength_left_final"].values.tolist()
            for name, value in zip(group.coords["hinge"].values.tolist(), values, strict=True):
                left[name] = min(left.get(name, 1.0), value)
    table = Table(
        "Plastic hinges",
        [
            "hinge",
            "M_y [kN m]",
            "theta_p [mrad]",
            "plastic rotation [mrad]",
            "of theta_p [%]",
            "strength left [%]",
            "analysis",
        ],
    )
    rows = []
    for name, (rotation, analysis) in turned.items():
        M_y, theta_p = (float(np.asarray(value)) for value in facts[name])
        rows.append((rotation / theta_p, name, M_y, theta_p, rotation, analysis))
    rows.sort(key=lambda row: (-row[0], row[1]))
    for ratio, name, M_y, theta_p, rotation, analysis in rows[:SHOWN]:
        cells = (number(M_y, scale=1e3), number(theta_p, scale=1e-3), number(rotation, scale=1e-3, negligible=1e-9))
        table.rows.append(
            [name, *cells, number(100.0 * ratio, 3, negligible=1e-6), number(100.0 * left.get(name, 1.0)), analysis]
        )
    table.notes.append(
        "Plastic rotation: the largest of all analyses; strength left: the least yield moment at their ends over that "
        "at first, 0 % beyond the ultimate rotation or the energy capacity."
    )
    _note_left_out(table, len(rows), "hinges that turned most of theta_p")
    return table


def _joints(groups: Mapping[str, Group]) -> Table | None:
    turned = _worst(groups, "joint_rotation", "joint")
    if not turned:
        return None
    facts = _facts(groups, "joint", ("joint_stiffness", "joint_M_y", "joint_stiffness_ratio", "joint_class"))
    moments = _worst(groups, "joint_moment", "joint")
    columns = [
        "joint",
        "S_j [MN m/rad]",
        "S_j L_b / (E I_b)",
        "class",
        "M_j,Rd [kN m]",
        "moment [kN m]",
        "rotation [mrad]",
    ]
    table = Table("Joints", columns)
    for name, (rotation, _) in _most(turned):
        stiffness, resistance, ratio, word = facts[name]
        capacity = float(np.asarray(resistance))
        table.rows.append(
            [
                name,
                number(float(np.asarray(stiffness)), scale=1e6),
                number(float(np.asarray(ratio)), 3),
                str(word),
                number(capacity if np.isfinite(capacity) else None, scale=1e3),
                number(moments[name][0], scale=1e3),
                number(rotation, scale=1e-3),
            ]
        )
    table.notes.append("Class by the stiffness of the analysis, of an unbraced frame (EN 1993-1-8, 5.2.2.5).")
    _note_left_out(table, len(turned), "joints that turned most")
    return table


def _panels(groups: Mapping[str, Group]) -> Table | None:
    distorted = _worst(groups, "panel_distortion", "panel")
    if not distorted:
        return None
    facts = _facts(groups, "panel", ("panel_stiffness", "panel_yield_moment"))
    moments = _worst(groups, "panel_moment", "panel")
    columns = [
        "panel",
        "yield moment [kN m]",
        "moment [kN m]",
        "distortion at yield [mrad]",
        "distortion [mrad]",
        "distortion / yield",
        "analysis",
    ]
    table = Table("Panel zones", columns)
    for name, (distortion, analysis) in _most(distorted):
        stiffness, moment = (float(np.asarray(value)) for value in facts[name])
        at_yield = moment / stiffness
        cells = (number(moment, scale=1e3), number(moments[name][0], scale=1e3), number(at_yield, scale=1e-3))
        table.rows.append([name, *cells, number(distortion, scale=1e-3), number(distortion / at_yield, 3), analysis])
    table.notes.append("Largest distortions of all analyses; yield: of the web in shear.")
    _note_left_out(table, len(distorted), "panel zones that were distorted most")
    return table


def _supports(groups: Mapping[str, Group]) -> Table | None:
    quantities = (
        ("support_displacement_x", "sway [mm]", 1e-3),
        ("support_displacement_y", "vertical [mm]", 1e-3),
        ("support_rotation", "rotation [mrad]", 1e-3),
        ("support_reaction_x", "horizontal force [kN]", 1e3),
        ("support_reaction_y", "vertical force [kN]", 1e3),
        ("support_reaction_moment", "moment [kN m]", 1e3),
    )
    found = {name: _worst(groups, name, "sprung_support") for name, _, _ in quantities}
    there = [item for item in quantities if found[item[0]]]
    if not there:
        return None
    table = Table("Springs at supports", ["support", *(label for _, label, _ in there)])
    names = list(dict.fromkeys(node for name, _, _ in there for node in found[name]))
    for node in names:
        cells = [number(found[name].get(node, (0.0, ""))[0], scale=scale, negligible=1e-12) for name, _, scale in there]
        table.rows.append([node, *cells])
    table.notes.append("Largest magnitudes of all analyses; 0 where no spring stands.")
    return table
