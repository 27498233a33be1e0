"""Tables of a design of hysteretic dampers: yield forces, periods and damping."""

from __future__ import annotations

import math

from edesign.archive.dataset import Group
from edesign.report.design.storeys import MODE, STOREY, first_mode, heading
from edesign.report.tables.column import col
from edesign.report.tables.items import Place, at, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, KN_MM, MM, ONE, PERCENT, S

HYSTERETIC_STOREYS = TableSpec[Place](
    "hysteretic_design",
    "Design {design}",
    (
        STOREY,
        col("storey", KN_MM, at("storey_stiffness")),
        col("braces", KN_MM, at("brace_stiffness")),
        col("shear", KN, at("storey_shear")),
        col("F_y of the storey", KN, at("yield_force")),
        col("share", PERCENT, at("shear_share")),
        col("F_y of a damper", KN, at("device_yield_force")),
        col("yield drift", PERCENT, at("yield_drift")),
        col("amplitude", MM, at("design_stroke")),
        col("ductility", ONE, at("design_ductility")),
        col("core strain", PERCENT, at("design_core_strain")),
    ),
    optional=True,
    named_by_title=True,
)
HYSTERETIC_DAMPING = TableSpec[Place](
    "hysteretic_damping",
    "",
    (
        MODE,
        col("T bare", S, at("bare_period")),
        col("T elastic", S, at("elastic_period")),
        col("T secant", S, at("period")),
    ),
    keys=0,
    named_by_title=True,
)


def hysteretic_storeys_table(group: Group) -> Table:
    """Return shears of the storeys, yield forces, drifts at yield, and the amplitude of the dampers."""
    about, storeys, notes = group.attributes, list(places({"": group}, "storey", "device_yield_force")), []
    if storeys:
        notes.append(
            f"{about['places']} places with {about['number']} each; F_y in sum {_percent(about['share'])} of the "
            f"storey shears, roof {1e3 * float(str(about['roof_displacement_m'])):.4g} mm"
        )
    return HYSTERETIC_STOREYS.of(storeys, notes=notes, design=heading(group))


def hysteretic_damping_table(group: Group) -> Table:
    """Return periods of each mode without dampers, with elastic ones and with their secants, and the added damping."""
    modes = list(places({"": group}, "mode", "elastic_period"))
    return HYSTERETIC_DAMPING.of(modes, notes=[_damping(group)] if modes else [])


def _damping(group: Group) -> str:
    about = group.attributes
    at_amplitude, average = _percent(about["damping_at_amplitude"]), _percent(about["damping_average"])
    counts, other = f"{at_amplitude} at the amplitude", f"{average} on average up to it"
    if about["equivalent_damping"] != "amplitude":
        counts, other = f"{average} on average up to the amplitude", f"{at_amplitude} at it"
    return f"added equivalent damping of the {first_mode(group)}: {counts}, {other}; the former counts"


def _percent(value: object) -> str:
    found = 100.0 * float(str(value))
    return "-" if math.isnan(found) else f"{found:.4g} %"
