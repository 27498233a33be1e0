"""Tables of an isolated base: the equivalent linear estimate, and what histories made of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak, residual
from edesign.assess.sets import HistorySet
from edesign.codes.ec8.isolation import GAMMA_X
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.report.assessment.measure_columns import ROUNDING
from edesign.report.assessment.measure_tables import label, missing_notes
from edesign.report.tables.table import Table, number


def isolation_estimate_table(name: str, group: Group) -> Table:
    """Return the equivalent linear analysis of an isolated base at each level, and the conditions that it misses.

    Args:
        name: of the modal analysis.
        group: its results.
    """
    header = ("level", "d [mm]", f"{GAMMA_X:g} d [mm]", "T_eff [s]", "xi_eff [%]", "S_e [m/s2]", "F [kN]", "F/W [%]")
    table = Table(f"{name}: isolated base, equivalent linear (EN 1998-1, 10.9)", header, formulas=())
    table.each = ("Isolated base, equivalent linear (EN 1998-1, 10.9)", name)
    table.name = "isolated_base_design"
    if "isolation_displacement" not in group.variables:
        return table
    of = {key: group.variables[f"isolation_{key}"].values for key in ("displacement", "period", "damping", "shear")}
    acceleration = group.variables["isolation_acceleration"].values
    for i, level in enumerate(group.coords["hazard_level"].values):
        d, period, damping, shear = (float(of[key][i]) for key in ("displacement", "period", "damping", "shear"))
        cells = [number(d, scale=1e-3), number(GAMMA_X * d, scale=1e-3), number(period), number(damping, scale=1e-2)]
        cells += [number(float(acceleration[i])), number(shear, scale=1e3)]
        table.rows.append([str(level), *cells, number(float(acceleration[i]) / STANDARD_GRAVITY, scale=1e-2)])
    period = float(str(group.attributes["fixed_base_period_s"]))
    table.notes.append(f"T_f = {period:.4g} s on a fixed base; a rigid body of {_mass(group)} t above the isolators")
    missed = group.attributes.get("isolation_not_met")
    table.notes += [f"not met: {text}" for text in missed] if isinstance(missed, list) else []
    return table


def isolation_table(groups: Mapping[str, Group]) -> Table:
    """Return the largest displacement and acceleration of an isolated base, and the forces on its isolators.

    Args:
        groups: results of analyses by name; those without isolated base, and modes, are left out.
    """
    header = ("analysis", "u [mm]", "residual u [mm]", "base a [m/s2]", "base shear [kN]")
    table = Table("Isolated base", (*header, "N max [kN]", "isolator", "N min [kN]", "isolator"), name="isolated_base")
    for name, group in groups.items():
        if "isolator_axial_force_final" not in group.variables:
            continue
        left = residual(group, "base_displacement")
        cells = [
            number(_value(peak(group, "base_displacement")), scale=1e-3, negligible=ROUNDING),
            number(_value(left), scale=1e-3, negligible=ROUNDING),
            number(_value(peak(group, "base_acceleration"))),
            number(_value(peak(group, "base_shear")), scale=1e3, negligible=ROUNDING),
        ]
        names = [str(one) for one in group.coords["isolator"].values]
        last = group.variables["isolator_axial_force_final"]  # of a gravity analysis alone
        tension, compression = (
            np.asarray(group.variables.get(f"isolator_axial_force_{which}", last).values) for which in ("max", "min")
        )
        most, least = int(np.argmax(tension)), int(np.argmin(compression))
        cells += [number(float(tension[most]), scale=1e3, negligible=ROUNDING), names[most]]
        table.rows.append([name, *cells, number(float(compression[least]), scale=1e3), names[least]])
    if table.rows:
        table.notes.append("N: axial force of the isolators, gravity included, positive in tension")
    return table


def isolation_statistics_table(sets: Sequence[HistorySet]) -> Table:
    """Return mean and largest response of an isolated base in histories, for each variant and level.

    Args:
        sets: histories by variant and level; those without isolated base are left out.
    """
    header = ("variant, level", "statistic", "of", "u [mm]", "residual u [mm]", "base a [m/s2]", "base shear [kN]")
    table = Table("Isolated base", (*header, "N max [kN]", "N min [kN]"), left=2, name="isolated_base")
    told = []
    for found in sets:
        groups = {n: group for n, group in found.completed.items() if "isolator_axial_force_max" in group.variables}
        if not groups:
            continue
        told.append(found)
        columns = [
            (found.statistics(lambda group: _value(peak(group, "base_displacement"))), 1e-3),
            (found.statistics(lambda group: _value(residual(group, "base_displacement"))), 1e-3),
            (found.statistics(lambda group: _value(peak(group, "base_acceleration"))), 1.0),
            (found.statistics(lambda group: _value(peak(group, "base_shear"))), 1e3),
            (found.statistics(lambda group: float(np.max(group.variables["isolator_axial_force_max"].values))), 1e3),
        ]
        least = found.statistics(lambda group: float(np.min(group.variables["isolator_axial_force_min"].values)))
        of = f"{len(found.completed)}/{len(found.histories)}"
        statistics = [
            ("mean", [(one.mean, scale) for one, scale in columns], least.mean),
            ("largest", [(one.maximum, scale) for one, scale in columns], least.minimum),
        ]
        for name, values, last in statistics[-min(len(groups), 2) :]:
            cells = [number(one, scale=scale, negligible=ROUNDING) for one, scale in (*values, (last, 1e3))]
            table.rows.append([label(found), name, of, *cells])
    if table.rows:
        table.notes.append("N: axial force of the isolators, gravity included, positive in tension")
        table.notes += missing_notes(told)
    return table


def _value(found: np.ndarray | None) -> float | None:
    return None if found is None else float(found)


def _mass(group: Group) -> str:
    return number(float(str(group.attributes["mass_kg"])), scale=1e3)
