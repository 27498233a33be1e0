"""Tables of plastic hinges, joints, panel zones and springs under the columns: what they are and what they did.

All values of a row are of the analysis that the row names.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.report.tables.table import Table, number
from edesign.report.tables.text import wrapped

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


def _value(group: Group, variable: str, coordinate: str, name: str) -> float | None:
    """The value of one name of a coordinate; None: it is not in the archive."""
    stored = group.variables.get(variable)
    return None if stored is None else float(stored.values[group.coords[coordinate].values.tolist().index(name)])


def _peak(group: Group, variable: str, coordinate: str, name: str) -> float | None:
    """The largest magnitude of a variable of one name of its coordinate; None: it is not in the archive."""
    values = peak(group, variable)
    return None if values is None else float(values[group.coords[coordinate].values.tolist().index(name)])


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
        formulas=(),
        name="plastic_hinges",
    )
    theta_p = {name: float(np.asarray(facts[name][1])) for name in turned}
    order = sorted(turned, key=lambda name: (-turned[name][0] / theta_p[name], name))
    weakest = _weakest_hinges(groups)
    for name in order[:SHOWN]:
        M_y = float(np.asarray(facts[name][0]))
        for analysis in dict.fromkeys((turned[name][1], weakest.get(name, turned[name][1]))):
            rotation = _peak(groups[analysis], "hinge_plastic_rotation", "hinge", name) or 0.0
            left = _value(groups[analysis], "hinge_strength_left_final", "hinge", name)
            cells = [number(M_y, scale=1e3), number(theta_p[name], scale=1e-3)]
            cells += [number(rotation, scale=1e-3, negligible=1e-9), number(rotation / theta_p[name], 3, 0.01, 1e-8)]
            table.rows.append([name, *cells, number(left, 4, 0.01), analysis])
    table.notes += wrapped(
        "Of each hinge the analysis in which it turned most, and the one that left it least strength. Strength left: "
        "yield moment at its end over that at first, 0 % beyond the ultimate rotation or the energy capacity."
    )
    _note_left_out(table, len(order), "hinges that turned most of theta_p")
    return table


def _weakest_hinges(groups: Mapping[str, Group]) -> dict[str, str]:
    """The analysis that left each hinge least strength, of those that have lost some."""
    least: dict[str, tuple[float, str]] = {}
    for analysis, group in groups.items():
        if "hinge_strength_left_final" in group.variables:
            values = group.variables["hinge_strength_left_final"].values.tolist()
            for name, value in zip(group.coords["hinge"].values.tolist(), values, strict=True):
                if value < least.get(name, (1.0, ""))[0]:
                    least[name] = value, analysis
    return {name: analysis for name, (_, analysis) in least.items()}


def _joints(groups: Mapping[str, Group]) -> Table | None:
    turned = _worst(groups, "joint_rotation", "joint")
    if not turned:
        return None
    facts = _facts(groups, "joint", ("joint_stiffness", "joint_M_y", "joint_stiffness_ratio", "joint_class"))
    columns = [
        "joint",
        "S_j [MN m/rad]",
        "S_j L_b / (E I_b)",
        "class",
        "M_j,Rd [kN m]",
        "moment [kN m]",
        "rotation [mrad]",
        "analysis",
    ]
    table = Table("Joints", columns, formulas=(), name="joints")
    for name, (rotation, analysis) in _most(turned):
        stiffness, resistance, ratio, word = facts[name]
        capacity = float(np.asarray(resistance))
        table.rows.append(
            [
                name,
                number(float(np.asarray(stiffness)), scale=1e6),
                number(float(np.asarray(ratio)), 3),
                str(word),
                number(capacity if np.isfinite(capacity) else None, scale=1e3),
                number(_peak(groups[analysis], "joint_moment", "joint", name), scale=1e3),
                number(rotation, scale=1e-3),
                analysis,
            ]
        )
    table.notes.append("Of each joint the analysis in which it turned most.")
    table.notes.append("Class by the stiffness of the analysis, of an unbraced frame (EN 1993-1-8, 5.2.2.5).")
    _note_left_out(table, len(turned), "joints that turned most")
    return table


def _panels(groups: Mapping[str, Group]) -> Table | None:
    distorted = _worst(groups, "panel_distortion", "panel")
    if not distorted:
        return None
    facts = _facts(groups, "panel", ("panel_stiffness", "panel_yield_moment"))
    columns = [
        "panel",
        "yield moment [kN m]",
        "moment [kN m]",
        "distortion at yield [mrad]",
        "distortion [mrad]",
        "distortion / yield",
        "analysis",
    ]
    table = Table("Panel zones", columns, name="panel_zones")
    for name, (distortion, analysis) in _most(distorted):
        stiffness, moment = (float(np.asarray(value)) for value in facts[name])
        at_yield = moment / stiffness
        largest = _peak(groups[analysis], "panel_moment", "panel", name)
        cells = (number(moment, scale=1e3), number(largest, scale=1e3), number(at_yield, scale=1e-3))
        table.rows.append([name, *cells, number(distortion, scale=1e-3), number(distortion / at_yield, 3), analysis])
    table.notes.append("Of each panel zone the analysis with its largest distortion; yield: of the web in shear.")
    _note_left_out(table, len(distorted), "panel zones that were distorted most")
    return table


_OF_SUPPORTS = (
    ("support_displacement_x", "sway [mm]", 1e-3),
    ("support_displacement_y", "vertical displacement [mm]", 1e-3),
    ("support_rotation", "rotation [mrad]", 1e-3),
    ("support_reaction_x", "horizontal reaction [kN]", 1e3),
    ("support_reaction_y", "vertical reaction [kN]", 1e3),
    ("support_reaction_moment", "moment [kN m]", 1e3),
)


def _supports(groups: Mapping[str, Group]) -> Table | None:
    table = Table(
        "Springs at supports", ("support", "quantity", "largest", "analysis"), left=2, name="springs_at_supports"
    )
    found = {name: _worst(groups, name, "sprung_support") for name, _, _ in _OF_SUPPORTS}
    for node in dict.fromkeys(node for of in found.values() for node in of):
        for name, label, scale in _OF_SUPPORTS:
            value, analysis = found[name].get(node, (0.0, ""))
            if (shown := number(value, scale=scale, negligible=1e-12)) != "0":
                table.rows.append([node, label, shown, analysis])
    table.notes.append("Largest magnitudes; what no spring holds, and what does not move, is left out.")
    return table if table.rows else None
