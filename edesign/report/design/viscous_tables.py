"""Tables of a design of viscous dampers: coefficients, and the damping they add."""

from __future__ import annotations

from edesign.archive.dataset import Group
from edesign.report.design.storeys import MODE, STOREY, first_mode, heading
from edesign.report.tables.column import col
from edesign.report.tables.items import Place, at, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN_PER_M, MM, PERCENT, S, Unit

VISCOUS_STOREYS = TableSpec[Place](
    "viscous_design",
    "Design {design}",
    (
        STOREY,
        col("storey", KN_PER_M, at("storey_stiffness")),
        col("braces", KN_PER_M, at("brace_stiffness")),
        col("c of the storey", "coefficient", at("damping_coefficient")),
        col("c of a damper", "coefficient", at("device_coefficient")),
        col("linear dashpot", Unit("kN*s/m", 1e3), at("device_linear_dashpot")),
        col("amplitude", MM, at("design_stroke")),
    ),
    optional=True,
    named_by_title=True,
)
VISCOUS_DAMPING = TableSpec[Place](
    "viscous_damping",
    "",
    (
        MODE,
        col("T bare", S, at("bare_period")),
        col("T", S, at("period")),
        col("complex eigenvalues", PERCENT, at("damping_complex")),
    ),
    keys=0,
    named_by_title=True,
)


def viscous_storeys_table(group: Group) -> Table:
    """Return stiffness of storeys and braces, the coefficients of the storeys, and the amplitude of their dampers."""
    if "device_coefficient" not in group.variables:
        return Table("")
    about = group.attributes
    roof = about.get("roof_displacement_m")
    amplitude = "" if roof is None else f", roof {1e3 * float(str(roof)):.4g} mm"
    note = (
        f"alpha {float(str(about['alpha'])):g}, {about['places']} places with {about['number']} each; "
        f"{first_mode(group)} {float(str(about['frequency_Hz'])):.4g} Hz{amplitude}"
    )
    notes = [note]
    if "along" in about:  # of a building, whose floors turn
        notes.append("linear dashpot, amplitude: the largest of the storey's places, each by itself")
    units = {"coefficient": kilonewtons(group.variables["device_coefficient"].unit)}
    return VISCOUS_STOREYS.of(places({"": group}, "storey"), units=units, notes=notes, design=heading(group))


def viscous_damping_table(group: Group) -> Table:
    """Return periods and added damping of each mode, and the damping of the first by other formulas."""
    modes, notes = list(places({"": group}, "mode", "damping_complex")), []
    if modes:
        formula, law = (float(str(group.attributes[key])) for key in ("damping_fema356", "law_damping_strain_energy"))
        notes.append(
            f"{first_mode(group)} by FEMA 356, Eq. 9-32 (rigid braces): {100.0 * formula:.4g} %; by the law's own "
            f"steady vibration: {100.0 * law:.4g} %"
        )
    return VISCOUS_DAMPING.of(modes, notes=notes)


def kilonewtons(unit: str) -> Unit:
    """Return the unit of a coefficient in kN: N*(s/m)^0.35 becomes kN*(s/m)^0.35."""
    return Unit(f"k{unit}", 1e3)
