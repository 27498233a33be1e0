"""Tables of a design of hysteretic dampers: yield forces, periods and damping, and their sum in each round."""

from __future__ import annotations

import math

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.design.storeys import put_storeys
from edesign.report.tables.table import Table, number, whole


def hysteretic_storeys_table(group: Group) -> Table:
    """Return shears of the storeys, yield forces, drifts at yield, and the amplitude of the dampers."""
    about = group.attributes
    table = Table(f"Design {about.get('name', '')}: hysteretic, {about.get('status')}")
    if "device_yield_force" in group.variables:
        columns = (
            ("storey [kN/mm]", "storey_stiffness", 1e6),
            ("braces [kN/mm]", "brace_stiffness", 1e6),
            ("shear [kN]", "storey_shear", 1e3),
            ("F_y of the storey [kN]", "yield_force", 1e3),
            ("share [%]", "shear_share", 0.01),
            ("F_y of a damper [kN]", "device_yield_force", 1e3),
            ("yield drift [%]", "yield_drift", 0.01),
            ("amplitude [mm]", "design_stroke", 1e-3),
            ("ductility", "design_ductility", 1.0),
            ("core strain [%]", "design_core_strain", 0.01),
        )
        put_storeys(table, group, columns)
        table.notes.append(
            f"{about['places']} places with {about['number']} each; F_y in sum {_percent(about['share'])} of the "
            f"storey shears, roof {1e3 * float(str(about['roof_displacement_m'])):.4g} mm"
        )
    return table


def hysteretic_damping_table(group: Group) -> Table:
    """Return periods of each mode without dampers, with elastic ones and with their secants, and the added damping."""
    table = Table("", ("mode", "T bare [s]", "T elastic [s]", "T secant [s]"), left=0)
    if "elastic_period" not in group.variables:
        return table
    columns = [group.variables[key].values for key in ("bare_period", "elastic_period", "period")]
    for mode, periods in enumerate(zip(*columns, strict=True), start=1):
        table.rows.append([whole(mode), *(number(float(period)) for period in periods)])
    about = group.attributes
    table.notes.append(
        f"added equivalent damping of the first mode: {_percent(about['damping_at_amplitude'])} at the amplitude, "
        f"{_percent(about['damping_average'])} on average up to it; the former counts"
        if about["equivalent_damping"] == "amplitude"
        else f"added equivalent damping of the first mode: {_percent(about['damping_average'])} on average up to the "
        f"amplitude, {_percent(about['damping_at_amplitude'])} at it; the former counts"
    )
    return table


def hysteretic_round_sizes(group: Group) -> tuple[np.ndarray, str]:
    """Return the sum of the yield forces of all dampers of each round, and its header with the unit."""
    total = group.variables["round_device_yield_force"].values @ group.variables["device_count"].values
    return total / 1e3, "sum of F_y [kN]"


def _percent(value: object) -> str:
    found = 100.0 * float(str(value))
    return "-" if math.isnan(found) else f"{found:.4g} %"
