"""Tables of a design of dampers: what stands in each storey, what it adds, and the rounds that led to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet
from edesign.report.device_order import devices_table
from edesign.report.hysteretic_tables import (
    hysteretic_damping_table,
    hysteretic_round_sizes,
    hysteretic_storeys_table,
)
from edesign.report.placement_tables import placement_tables
from edesign.report.table import Table, number
from edesign.report.viscous_tables import viscous_damping_table, viscous_round_sizes, viscous_storeys_table

EMPTY: Mapping[str, float] = MappingProxyType({})

_DAMPINGS = (
    ("Eq. 5.6, modes with dampers [%]", "damping_strain_energy"),
    ("Eq. 5.8, frequencies [%]", "damping_frequencies"),
    ("complex eigenvalues [%]", "damping_complex"),
)
_BOUNDS = (
    ("factor on the forces", "factor", 1.0),
    ("temperature [degC]", "temperature", 1.0),
    ("T1 [s]", "period", 1.0),
    ("added damping [%]", "damping", 0.01),
    ("storey drift [%]", "storey_drift", 0.01),
    ("roof displacement [cm]", "roof_displacement", 0.01),
    ("shear of columns [kN]", "column_shear", 1e3),
    ("base shear [kN]", "base_shear", 1e3),
    ("force of a damper [kN]", "damper_force", 1e3),
    ("damper strain [%]", "damper_strain", 0.01),
    ("stroke of a damper [mm]", "damper_stroke", 1e-3),
)


def design_tables(group: Group, sets: Sequence[HistorySet] = (), factors: Mapping[str, float] = EMPTY) -> list[Table]:
    """Return the tables of a design.

    Args:
        group: designs/NAME of an archive.
        sets: histories by variant and level, for the order of dampers.
        factors: property factors of the variants that have the design, by their names.
    """
    method = group.attributes.get("method")
    if method == "placement":
        return [table for table in placement_tables(group, sets, factors) if table.rows or table.notes]
    if method == "viscous":
        sized = [viscous_storeys_table(group), devices_table(group, sets, factors), viscous_damping_table(group)]
    elif method == "hysteretic":
        sized = [hysteretic_storeys_table(group), devices_table(group, sets, factors), hysteretic_damping_table(group)]
    else:
        sized = [storeys_table(group), damping_table(group)]
    tables = [*sized, rounds_table(group), bounds_table(group)]
    return [table for table in tables if table.rows or table.notes]


def storeys_table(group: Group) -> Table:
    """Return stiffness of storey, dampers and braces, and the area of a layer, as thesis Table 5.7."""
    about = group.attributes
    title = f"Design {about.get('name', '')}: {str(about.get('method', '')).replace('_', ' ')}, {about.get('status')}"
    columns = (
        ("storey [kN/m]", "storey_stiffness", 1e3),
        ("dampers [kN/m]", "damper_stiffness", 1e3),
        ("braces [kN/m]", "brace_stiffness", 1e3),
        ("area of a layer [m2]", "layer_area", 1.0),
        ("A_D/A_P", "area_ratio", 1.0),
    )
    shown = [column for column in columns if column[1] in group.variables]
    table = Table(title, ("storey", *(header for header, _, _ in shown)))
    if "storey" in group.coords and shown:
        for i, storey in enumerate(group.coords["storey"].values):
            cells = [number(float(group.variables[key].values[i]), scale=unit) for _, key, unit in shown]
            table.rows.append([str(storey), *cells])
    if "layer_thickness_m" in about:
        table.notes.append(
            f"{about['number']} x {about['layers']} layers of {1e3 * float(about['layer_thickness_m']):.4g} mm at each "
            f"place; G' {1e-6 * float(about['G_storage_Pa']):.4g} MPa, n {float(about['loss_factor']):.4g} at "
            f"{float(about['frequency_Hz']):.3g} Hz; all layers {float(about['total_layer_area_m2']):.4g} m2"
        )
    if about.get("reason"):
        table.notes.append(f"failed: {about['reason']}")
    warnings = about.get("warnings")
    table.notes += [str(text) for text in (warnings if isinstance(warnings, list) else [])]
    return table


def damping_table(group: Group) -> Table:
    """Return the damping that the dampers add to each mode, by three ways, alone and with their braces."""
    table = Table("", ("mode", "T bare [s]", "dampers", "T [s]", *(header for header, _ in _DAMPINGS)), left=0)
    if any(key not in group.variables for key in ("period", "bare_period", *(key for _, key in _DAMPINGS))):
        return table
    bare, period = group.variables["bare_period"].values, group.variables["period"].values
    for mode in range(period.shape[1]):
        for i, assembly in enumerate(group.coords["assembly"].values):
            cells = [number(float(group.variables[key].values[i, mode]), scale=0.01) for _, key in _DAMPINGS]
            times = [number(float(bare[mode])), str(assembly), number(float(period[i, mode]))]
            table.rows.append([str(mode + 1), *times, *cells])
    return table


def rounds_table(group: Group) -> Table:
    """Return the rounds of sizing and verification; none if there was only one and nothing to verify."""
    table = Table("Rounds", ("round", "changed", "damping [%]", "T1 [s]", "met"), left=1)
    count = group.coords["round"].values.size if "round" in group.coords else 0
    if count == 0 or (count == 1 and "criterion" not in group.coords):
        return table
    values = group.variables
    verdicts = [str(name) for name in group.coords["criterion"].values] if "criterion" in group.coords else []
    damping = round_damping(group)
    if group.attributes.get("method") in ROUND_SIZES:
        used, unit, said = ROUND_SIZES[str(group.attributes["method"])](group)
    else:
        used, unit = np.sum(values["round_layer_area"].values, axis=1), "total area [m2]"
        said = "area: of one layer, all storeys"
    least = ["made least"] if "round_objective" in values else []
    table.columns = [*table.columns[:-1], unit, *verdicts, *least, table.columns[-1]]
    for i in range(count):
        cells = [
            number(float(values["round_changed"].values[i])),
            number(float(damping[i]), scale=0.01),
            number(float(values["round_period"].values[i])),
            number(float(used[i])),
            *(number(float(values["verdict_value"].values[i, j])) for j in range(len(verdicts))),
            *(number(float(values["round_objective"].values[i])) for _ in least),
            "yes" if values["round_met"].values[i] else "no",
        ]
        table.rows.append([str(i + 1), *cells])
    table.notes.append(f"changed: {values['round_changed'].long_name}; {said}")
    if verdicts:
        table.notes.append(f"{', '.join(verdicts)}: value that is judged, in SI")
    if least:
        table.notes.append(
            f"made least: {values['round_objective'].long_name}; round {group.attributes['chosen_round']}"
        )
    return table


ROUND_SIZES = {"viscous": viscous_round_sizes, "hysteretic": hysteretic_round_sizes}
"""What all dampers of each round are in sum, its header, and what it is, by the method of the design."""


def round_damping(group: Group) -> np.ndarray:
    """Return the damping ratio that the dampers of each round add to the first mode."""
    kind = {"viscous": "complex", "hysteretic": "equivalent"}.get(str(group.attributes.get("method")), "strain_energy")
    return np.asarray(group.variables[f"round_damping_{kind}"].values, dtype=float)


def bounds_table(group: Group) -> Table:
    """Return the estimated response with lower, nominal and upper properties, and which of them governs."""
    table = Table("", left=1)
    if "bound" not in group.coords:
        return table
    bounds = [str(name) for name in group.coords["bound"].values]
    table.title, table.columns = (
        "Bounds of the properties (estimates by the response spectrum)",
        ["", *bounds, "governs"],
    )
    found = group.attributes.get("governing")
    governing = found if isinstance(found, Mapping) else {}
    for title, key, unit in _BOUNDS:
        values = group.variables.get(f"bound_{key}")
        if values is None:
            continue
        largest = values.values.reshape(len(bounds), -1).max(axis=1)
        cells = ["-" if np.isnan(value) else number(float(value), scale=unit) for value in largest]
        table.rows.append([title, *cells, str(governing.get(key, ""))])
    table.notes.append("of quantities over the height the largest")
    return table
