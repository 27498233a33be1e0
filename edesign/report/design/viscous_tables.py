"""Tables of a design of viscous dampers: coefficients, the damping they add, and their sum in each round."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.design.storeys import put_storeys
from edesign.report.tables.table import Table, number, whole


def viscous_storeys_table(group: Group) -> Table:
    """Return stiffness of storeys and braces, the coefficients of the storeys, and the amplitude of their dampers."""
    about = group.attributes
    table = Table(f"Design {about.get('name', '')}: viscous, {about.get('status')}")
    if "device_coefficient" in group.variables:
        unit = kilonewtons(group.variables["device_coefficient"].unit)
        columns = (
            ("storey [kN/m]", "storey_stiffness", 1e3),
            ("braces [kN/m]", "brace_stiffness", 1e3),
            (f"c of the storey [{unit}]", "damping_coefficient", 1e3),
            (f"c of a damper [{unit}]", "device_coefficient", 1e3),
            ("linear dashpot [kN*s/m]", "device_linear_dashpot", 1e3),
            ("amplitude [mm]", "design_stroke", 1e-3),
        )
        put_storeys(table, group, columns)
        roof = about.get("roof_displacement_m")
        amplitude = "" if roof is None else f", roof {1e3 * float(str(roof)):.4g} mm"
        table.notes.append(
            f"alpha {float(str(about['alpha'])):g}, {about['places']} places with {about['number']} each; first mode "
            f"{float(str(about['frequency_Hz'])):.4g} Hz{amplitude}"
        )
    return table


def viscous_damping_table(group: Group) -> Table:
    """Return periods and added damping of each mode, and the damping of the first by other formulas."""
    table = Table("", ("mode", "T bare [s]", "T [s]", "complex eigenvalues [%]"), left=0)
    if "damping_complex" not in group.variables:
        return table
    columns = [group.variables[key].values for key in ("bare_period", "period", "damping_complex")]
    for mode, (bare, period, damping) in enumerate(zip(*columns, strict=True), start=1):
        cells = [number(float(bare)), number(float(period)), number(float(damping), scale=0.01)]
        table.rows.append([whole(mode), *cells])
    formula, law = (float(str(group.attributes[key])) for key in ("damping_fema356", "law_damping_strain_energy"))
    table.notes.append(
        f"first mode by FEMA 356, Eq. 9-32 (rigid braces): {100.0 * formula:.4g} %; by the law's own steady vibration: "
        f"{100.0 * law:.4g} %"
    )
    return table


def viscous_round_sizes(group: Group) -> tuple[np.ndarray, str]:
    """Return the sum of the coefficients of all dampers of each round, and its header with the unit."""
    coefficient = group.variables["round_device_coefficient"]
    total = coefficient.values @ group.variables["device_count"].values
    return total / 1e3, f"sum of c [{kilonewtons(coefficient.unit)}]"


def kilonewtons(unit: str) -> str:
    """Return the unit of a coefficient in kN: N*(s/m)^0.35 becomes kN*(s/m)^0.35."""
    return f"k{unit}"
