"""Tables of a design of viscous dampers: coefficients, the damping they add, rounds, and the devices to order."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.devices import DeviceDemand, device_demand
from edesign.assess.sets import HistorySet
from edesign.report.table import Table, number


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
        shown = [column for column in columns if column[1] in group.variables]
        table.columns = ("storey", *(header for header, _, _ in shown))
        for i, storey in enumerate(group.coords["storey"].values):
            cells = [number(float(group.variables[key].values[i]), scale=scale) for _, key, scale in shown]
            table.rows.append([str(storey), *cells])
        roof = about.get("roof_displacement_m")
        amplitude = "" if roof is None else f", roof {1e3 * float(str(roof)):.4g} mm"
        table.notes.append(
            f"alpha {float(str(about['alpha'])):g}, {about['places']} places with {about['number']} each; first mode "
            f"{float(str(about['frequency_Hz'])):.4g} Hz{amplitude}"
        )
    if about.get("reason"):
        table.notes.append(f"failed: {about['reason']}")
    return table


def viscous_damping_table(group: Group) -> Table:
    """Return periods and added damping of each mode, and what other ways say of the first."""
    table = Table("", ("mode", "T bare [s]", "T [s]", "complex eigenvalues [%]"), left=0)
    if "damping_complex" not in group.variables:
        return table
    columns = [group.variables[key].values for key in ("bare_period", "period", "damping_complex")]
    for mode, (bare, period, damping) in enumerate(zip(*columns, strict=True), start=1):
        cells = [number(float(bare)), number(float(period)), number(float(damping), scale=0.01)]
        table.rows.append([str(mode), *cells])
    formula, law = (float(str(group.attributes[key])) for key in ("damping_fema356", "law_damping_strain_energy"))
    table.notes.append(
        f"first mode by FEMA 356, Eq. 9-32 (rigid braces): {100.0 * formula:.4g} %; by the law's own steady vibration: "
        f"{100.0 * law:.4g} %"
    )
    return table


def devices_table(group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float]) -> Table:
    """Return what is needed to order the dampers: estimated, and of the histories of the variants that have them.

    Args:
        group: of the design.
        sets: histories by variant and level.
        factors: property factors of the variants that have the design, by their names.
    """
    table = Table("Devices to order: largest values of one damper", left=1)
    if "device_coefficient" not in group.variables or group.attributes.get("status") != "completed":
        return table
    demands = [device_demand(group, found, factors[found.variant]) for found in sets if found.variant in factors]
    found = [demand for demand in demands if demand is not None]
    unit = kilonewtons(group.variables["device_coefficient"].unit)
    values = ("force [kN]", "stroke [mm]", "velocity [m/s]")
    spread = [f"{which} {value}" for value in values for which in ("mean", "max")]
    table.columns = ["", "storey", "number", f"c [{unit}]", "alpha", *spread]
    storeys = group.coords["storey"].values
    for i, storey in enumerate(storeys):
        sized = [
            str(storey),
            str(int(group.variables["device_count"].values[i])),
            number(float(group.variables["device_coefficient"].values[i]), scale=1e3),
            f"{float(str(group.attributes['alpha'])):g}",
        ]
        if "estimated_device_force" in group.variables:
            table.rows.append(["estimate", *sized, *_estimated(group, i)])
        for demand in found:
            table.rows.append([f"{demand.variant}, {demand.level}".rstrip(", "), *sized, *_of_histories(demand, i)])
    if not table.rows:
        return table
    counts = [f"{d.variant}, {d.level}: {d.histories} of {d.planned}".replace(", :", ":") for d in found]
    table.notes.append("estimate: by the response spectrum of the level of the design, pseudo velocity")
    if counts:
        table.notes.append(f"histories: {'; '.join(counts)}; the stroke is without the brace")
    return table


def viscous_round_sizes(group: Group) -> tuple[np.ndarray, str, str]:
    """Return the sum of the coefficients of all dampers of each round, its header, and what it is."""
    coefficient = group.variables["round_device_coefficient"]
    total = coefficient.values @ group.variables["device_count"].values
    return total / 1e3, f"sum of c [{kilonewtons(coefficient.unit)}]", "sum of c: of all dampers"


def kilonewtons(unit: str) -> str:
    """A unit of a coefficient in kN: N*(s/m)^0.35 becomes kN*(s/m)^0.35."""
    return f"k{unit}"


def _estimated(group: Group, storey: int) -> list[str]:
    cells = []
    for key, scale in (("force", 1e3), ("stroke", 1e-3), ("velocity", 1.0)):
        value = float(group.variables[f"estimated_device_{key}"].values[storey])
        cells += [number(value, scale=scale), "-"]
    return cells


def _of_histories(demand: DeviceDemand, storey: int) -> list[str]:
    cells = []
    for values, scale in ((demand.force, 1e3), (demand.stroke, 1e-3), (demand.velocity, 1.0)):
        both: np.ndarray = values[:, storey]
        cells += [number(float(value), scale=scale) for value in both]
    return cells
