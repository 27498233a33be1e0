"""The devices to order of a design: sizes and largest values of one damper, estimated and of the histories."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from edesign.archive.dataset import Group
from edesign.assess.devices import DeviceDemand, device_demand
from edesign.assess.sets import HistorySet
from edesign.report.design.viscous_tables import kilonewtons
from edesign.report.tables.table import Table, number, whole

_VALUES = {  # header, name, unit shown in SI
    "viscous": (("force [kN]", "force", 1e3), ("stroke [mm]", "stroke", 1e-3), ("velocity [m/s]", "velocity", 1.0)),
    "hysteretic": (
        ("force [kN]", "force", 1e3),
        ("stroke [mm]", "stroke", 1e-3),
        ("plastic [mm]", "cumulated_plastic", 1e-3),
    ),
    "buckling_restrained": (
        ("force [kN]", "force", 1e3),
        ("strain [%]", "core_strain", 0.01),
        ("cum. [-]", "cumulative_ductility", 1.0),
    ),
}


def devices_table(group: Group, sets: Sequence[HistorySet], factors: Mapping[str, float]) -> Table:
    """Return the data to order the dampers: the estimate, and the demand in histories of the variants that have them.

    Args:
        group: of a design of viscous or hysteretic dampers.
        sets: histories by variant and level.
        factors: property factors of the variants that have the design, by their names.
    """
    table = Table("Devices to order: largest values of one damper", left=1, name="devices_to_order")
    if "device_count" not in group.variables or group.attributes.get("status") != "completed":
        return table
    demands = [device_demand(group, found, factors[found.variant]) for found in sets if found.variant in factors]
    found = [demand for demand in demands if demand is not None]
    values = _VALUES[_kind(group)]
    spread = [f"{which} {header}" for header, _, _ in values for which in ("mean", "max")]
    headers, nominal = _sizes(group)
    bounded = [_sizes(group, factors[demand.variant])[1] for demand in found]
    table.columns = ["", "storey", "number", *headers, *spread]
    for i, storey in enumerate(group.coords["storey"].values):
        counted = [whole(storey), whole(group.variables["device_count"].values[i])]
        if "estimated_device_force" in group.variables:
            table.rows.append(["estimate", *counted, *nominal[i], *_estimated(group, i, values)])
        for demand, sizes in zip(found, bounded, strict=True):
            cells = [number(float(of), scale=unit) for _, name, unit in values for of in demand.values[name][:, i]]
            table.rows.append([f"{demand.variant}, {demand.level}".rstrip(", "), *counted, *sizes[i], *cells])
    if table.rows:
        table.notes += _notes(group, found)
        if any(factors[demand.variant] != 1.0 for demand in found):
            own = "T_adj and C_adj have" if _kind(group) == "buckling_restrained" else "forces alone have"
            table.notes.append(f"{own} the bound of a variant; what is ordered is without")
    return table


_STRENGTHS = ("adjusted_tension", "adjusted_compression")  # go with the bound of a variant; sizes to order do not
_SIZES = {  # header, name, unit shown in SI
    "hysteretic": (("F_y [kN]", "yield_force", 1e3), ("k [kN/mm]", "stiffness", 1e6)),
    "buckling_restrained": (
        ("A_sc [mm2]", "core_area", 1e-6),
        ("T_adj [kN]", "adjusted_tension", 1e3),
        ("C_adj [kN]", "adjusted_compression", 1e3),
    ),
}


def _kind(group: Group) -> str:
    return "buckling_restrained" if "device_core_area" in group.variables else str(group.attributes["method"])


def _sizes(group: Group, property_factor: float = 1.0) -> tuple[list[str], list[list[str]]]:
    """Headers and cells of each storey of what one damper is, its strengths with the property factor of a variant."""
    if (sizes := _SIZES.get(_kind(group))) is not None:
        columns = [
            [
                number(float(of) * (property_factor if key in _STRENGTHS else 1.0), scale=unit)
                for of in group.variables[f"device_{key}"].values
            ]
            for _, key, unit in sizes
        ]
        return [header for header, _, _ in sizes], [list(row) for row in zip(*columns, strict=True)]
    coefficient = group.variables["device_coefficient"]
    alpha = f"{float(str(group.attributes['alpha'])):g}"
    cells = [[number(float(c), scale=1e3), alpha] for c in coefficient.values]
    return [f"c [{kilonewtons(coefficient.unit)}]", "alpha"], cells


def _notes(group: Group, found: Sequence[DeviceDemand]) -> list[str]:
    kind = _kind(group)
    notes = []
    if "estimated_device_force" in group.variables:
        pseudo = ", pseudo velocity" if kind == "viscous" else ""
        notes.append(f"estimate: by the response spectrum of the level of the design{pseudo}")
    if kind == "hysteretic":
        hardening = float(str(group.attributes["hardening"]))
        after = f"; stiffness after yielding {hardening:g} k" if hardening > 0.0 else ""  # nan: it keeps changing
        notes.append(f"a damper yields at {_yields(group)}{after}; plastic: cumulated, work over F_y")
    elif kind == "buckling_restrained":
        notes.append("T_adj: omega R_y F_ysc A_sc, C_adj: beta omega R_y F_ysc A_sc (AISC 341-16, F4.2a)")
        notes.append(f"a brace yields at {_yields(group)}; strain: of its core")
        notes.append("cum.: cumulative ductility, the sum of the plastic deformations over that at yield")
    counts = [f"{d.variant}, {d.level}: {d.histories} of {d.planned}".replace(", :", ":") for d in found]
    if counts:
        without = "" if kind == "buckling_restrained" else "; the stroke is without the brace"
        notes.append(f"histories: {'; '.join(counts)}{without}")
    return notes


def _yields(group: Group) -> str:
    """Deformation at which a damper yields: one, or from the least to the largest of the storeys."""
    deformation = group.variables["device_yield_deformation"].values
    ends = dict.fromkeys(f"{1e3 * end:.4g}" for end in (deformation.min(), deformation.max()))
    return f"{' to '.join(ends)} mm"


def _estimated(group: Group, storey: int, values: Sequence[tuple[str, str, float]]) -> list[str]:
    cells = []
    for _, name, unit in values:
        variable = group.variables.get(f"estimated_device_{name}")
        value = None if variable is None else float(variable.values[storey])
        cells += [number(value, scale=unit), "-"]
    return cells
