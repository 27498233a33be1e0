"""Tables of a design of dampers: what stands in each storey, what it adds, and the rounds that led to it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.requirement import UNITS
from edesign.assess.sets import HistorySet
from edesign.report.design.device_order import devices_table
from edesign.report.design.hysteretic_tables import (
    hysteretic_damping_table,
    hysteretic_round_sizes,
    hysteretic_storeys_table,
)
from edesign.report.design.placement_tables import placement_tables
from edesign.report.design.storeys import put_storeys
from edesign.report.design.viscous_tables import viscous_damping_table, viscous_round_sizes, viscous_storeys_table
from edesign.report.tables.table import Table, number, whole

EMPTY: Mapping[str, float] = MappingProxyType({})

_DAMPINGS = (
    ("energies [%]", "damping_strain_energy"),
    ("frequencies [%]", "damping_frequencies"),
    ("complex [%]", "damping_complex"),
)
_CHANGED = {
    "target": ("target [%]", 0.01),
    "area": ("factor on areas", 1.0),
    "thickness": ("factor on thicknesses", 1.0),
    "coefficient": ("factor on coefficients", 1.0),
}
"""What rounds change, as a header with its unit, and that unit."""
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
        tables = [*placement_tables(group, sets, factors), Table("", notes=_doubts(group))]
        return [table for table in tables if table.rows or table.notes]
    if method == "viscous":
        sized = [viscous_storeys_table(group), devices_table(group, sets, factors), viscous_damping_table(group)]
    elif method == "hysteretic":
        sized = [hysteretic_storeys_table(group), devices_table(group, sets, factors), hysteretic_damping_table(group)]
    else:
        sized = [storeys_table(group), damping_table(group)]
    tables = [*sized, _warnings(group), rounds_table(group), bounds_table(group)]
    return [table for table in tables if table.rows or table.notes]


def storeys_table(group: Group) -> Table:
    """Return stiffness of storey, dampers and braces, area of a layer, as thesis Table 5.7, and estimated forces."""
    about = group.attributes
    title = f"Design {about.get('name', '')}: {str(about.get('method', '')).replace('_', ' ')}, {about.get('status')}"
    columns = (
        ("k_S [kN/m]", "storey_stiffness", 1e3),
        ("k_D [kN/m]", "damper_stiffness", 1e3),
        ("braces [kN/m]", "brace_stiffness", 1e3),
        ("layer [m2]", "layer_area", 1.0),
        ("A_D/A_P", "area_ratio", 1.0),
        ("force [kN]", "estimated_damper_force", 1e3),
    )
    table = Table(title, formulas=())
    if "storey" in group.coords:
        put_storeys(table, group, columns)
    values = group.variables
    if "damper_stiffness" in values and "storey_stiffness" in values:
        ratio = values["damper_stiffness"].values / values["storey_stiffness"].values
        _put(table, "k_D/k_S", ratio, after="k_D [kN/m]")
    if "estimated_column_shear" in values:
        shear = values["estimated_column_shear"].values[np.asarray(group.coords["storey"].values) - 1]
        _put(table, "columns [kN]", shear / 1e3, after="force [kN]")
    if "layer_thickness_m" in about:
        table.notes.append(
            f"{about['number']} x {about['layers']} layers of {1e3 * float(about['layer_thickness_m']):.4g} mm at each "
            f"place; G' {1e-6 * float(about['G_storage_Pa']):.4g} MPa, n {float(about['loss_factor']):.4g} at "
            f"{float(about['frequency_Hz']):.3g} Hz{_strains(group)}; all layers "
            f"{float(about['total_layer_area_m2']):.4g} m2{_prototypes(about)}"
        )
        table.notes.append(
            "k_S, k_D: of the storey and of its dampers; layer: area of one; A_D/A_P: over the prototype"
        )
    if "estimated_damper_force" in values:
        at = f" at {about['level']}" if about.get("level") else ""
        table.notes.append(f"estimated{at}: force of the dampers and the brace of a place, shear of all columns")
    return table


def _put(table: Table, header: str, values: np.ndarray, after: str) -> None:
    """Put a column of numbers into a table behind another one."""
    i = list(table.columns).index(after) + 1
    table.columns = [*table.columns[:i], header, *table.columns[i:]]
    for row, value in zip(table.rows, values, strict=True):
        row.insert(i, number(float(value)))


def _strains(group: Group) -> str:
    """The strain of the properties, and what is reached."""
    about = group.attributes
    if "strain" not in about:
        return ""
    text = f", {100.0 * float(str(about['strain'])):.3g} % strain"
    reached = []
    if "estimated_strain" in about:
        reached.append(f"estimated {100.0 * float(str(about['estimated_strain'])):.3g} %")
    chosen = int(str(about.get("chosen_round", 1))) - 1
    if "round_history_strain" in group.variables:
        strain = float(group.variables["round_history_strain"].values[chosen])
        reached += [f"in histories {100.0 * strain:.3g} %"] if np.isfinite(strain) else []
    return f"{text} ({', '.join(reached)})" if reached else text


def _prototypes(about: Mapping[str, Any]) -> str:
    return f", those of {float(about['prototypes']):.4g} prototypes" if "prototypes" in about else ""


def _warnings(group: Group) -> Table:
    """Return why a design failed, and what is doubtful about it; no columns."""
    about = group.attributes
    return Table("", notes=[*([f"failed: {about['reason']}"] if about.get("reason") else []), *_doubts(group)])


def _doubts(group: Group) -> list[str]:
    warnings = group.attributes.get("warnings")
    return [f"warning: {text}" for text in (warnings if isinstance(warnings, list) else [])]


def damping_table(group: Group) -> Table:
    """Return the damping that the dampers add to each mode, by three ways, alone and with their braces."""
    table = Table("", ("mode", "T bare [s]", "dampers", "T [s]", *(header for header, _ in _DAMPINGS)), left=0)
    if any(key not in group.variables for key in ("period", "bare_period", *(key for _, key in _DAMPINGS))):
        return table
    bare, period = group.variables["bare_period"].values, group.variables["period"].values
    for mode in range(period.shape[1]):
        for i, assembly in enumerate(group.coords["assembly"].values):
            cells = [number(float(group.variables[key].values[i, mode]), scale=0.01) for _, key in _DAMPINGS]
            times = [number(float(bare[mode])), str(assembly).replace("_", " "), number(float(period[i, mode]))]
            table.rows.append([whole(mode + 1), *times, *cells])
    table.notes.append("added damping: by energies of the modes with dampers, frequencies, complex eigenvalues")
    return table


def rounds_table(group: Group) -> Table:
    """Return the rounds of sizing and verification; none if there was only one and nothing to verify."""
    table = Table("Rounds", left=1, name="rounds")
    count = group.coords["round"].values.size if "round" in group.coords else 0
    if count == 0 or (count == 1 and "criterion" not in group.coords):
        return table
    values, about = group.variables, group.attributes
    verdicts = [str(name) for name in group.coords["criterion"].values] if "criterion" in group.coords else []
    units = [UNITS[str(unit)] for unit in values["criterion_unit"].values] if "criterion_unit" in values else []
    units = units or [("SI", 1.0)] * len(verdicts)  # of archives that do not say them
    sizes = ROUND_SIZES.get(str(about.get("method")))
    used, size = (round_areas(group), "all layers [m2]") if sizes is None else sizes(group)
    damping = round_damping(group)
    least = "round_objective" in values
    changed, unit = _changed_header(group)
    strains = [
        (header, values[key].values)
        for header, key in (("strain [%]", "round_strain"), ("in histories [%]", "round_history_strain"))
        if key in values
    ]
    judged = [f"{name} [{label}]" if label else name for name, (label, _) in zip(verdicts, units, strict=True)]
    table.columns = [
        "round",
        changed,
        "damping [%]",
        "T1 [s]",
        size,
        *(header for header, _ in strains),
        *judged,
        *(["made least"] if least else []),
        "met",
    ]
    for i in range(count):
        cells = [
            number(float(values["round_changed"].values[i]), scale=unit),
            number(float(damping[i]), scale=0.01),
            number(float(values["round_period"].values[i])),
            number(float(used[i])),
            *("-" if np.isnan(strain[i]) else number(float(strain[i]), scale=0.01) for _, strain in strains),
            *(number(float(values["verdict_value"].values[i, j]), scale=units[j][1]) for j in range(len(verdicts))),
            *([number(float(values["round_objective"].values[i]))] if least else []),
            "yes" if values["round_met"].values[i] else "no",
        ]
        chosen = " (chosen)" if i + 1 == about.get("chosen_round") else ""
        table.rows.append([f"{i + 1}{chosen}", *cells])
    if "verdict_limit" in values:
        limits = values["verdict_limit"].values[-1]
        said = [
            f"{name} {number(float(limit), scale=scale)} {label}".rstrip()
            for name, limit, (label, scale) in zip(verdicts, limits, units, strict=True)
        ]
        table.notes.append(f"limits: {', '.join(said)}")
    if least:
        table.notes.append(f"made least: {values['round_objective'].long_name}")
    return table


ROUND_SIZES = {"viscous": viscous_round_sizes, "hysteretic": hysteretic_round_sizes}
"""What all dampers of each round are in sum, and its header, by the method of the design."""


def round_damping(group: Group) -> np.ndarray:
    """Return the damping ratio that the dampers of each round add to the first mode."""
    kind = {"viscous": "complex", "hysteretic": "equivalent"}.get(str(group.attributes.get("method")), "strain_energy")
    return np.asarray(group.variables[f"round_damping_{kind}"].values, dtype=float)


def _changed_header(group: Group) -> tuple[str, float]:
    """Return the quantity that the rounds of a design change as a header with its unit, and that unit."""
    about = group.attributes
    if about.get("method") == "simplified" and about.get("changed") == "target":
        return "beta", 1.0
    return _CHANGED.get(str(about.get("changed")), ("changed", 1.0))


def round_areas(group: Group) -> np.ndarray:
    """Return the area of all layers of all dampers of each round, m2."""
    about = group.attributes
    storeys = group.coords["storey"].values.size
    layers = int(str(about.get("layers", 1))) * int(str(about.get("number", 1)))
    places = int(str(about.get("places", storeys))) / storeys
    return np.asarray(places * layers * np.sum(group.variables["round_layer_area"].values, axis=1))


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
