"""Tables of the dampers of an analysis: forces, deformations, work, stiffness in modes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.energy import final_energies, share_of_input
from edesign.assess.envelopes import peak
from edesign.report.tables.table import Table, number, whole

COLUMNS = (
    ("strain [%]", "damper_strain", 0.01),
    ("u [mm]", "damper_deformation", 1e-3),
    ("F [kN]", "damper_force", 1e3),
)


def dampers_table(groups: Mapping[str, Group]) -> Table:
    """Return the largest response of any damper in each analysis, and the share of the input that went into all.

    The energy term `dampers` has dashpots of footings and tuned masses too, which are none of these.
    """
    rows = {name: group for name, group in groups.items() if peak(group, "damper_force") is not None}
    shown = [column for column in COLUMNS if any(peak(group, column[1]) is not None for group in rows.values())]
    header = ("analysis", *(title for title, _, _ in shown), "damper", "work [kJ]", "of the input [%]")
    table = Table("Dampers (largest absolute values, and the one with the largest deformation)", header, name="dampers")
    for name, group in rows.items():
        cells = [_largest(peak(group, key), unit) for _, key, unit in shown]
        deformation = peak(group, "damper_deformation")
        worst = str(group.coords["damper"].values[int(np.argmax(deformation))]) if deformation is not None else "-"
        work = group.variables.get("damper_work_final")
        total = float(np.sum(work.values)) if work is not None else None
        share = share_of_input(final_energies(group), total)
        table.rows.append([name, *cells, worst, number(total, scale=1e3), number(share, scale=0.01)])
    return table


def each_damper_table(name: str, group: Group) -> Table:
    """Return the largest response of every damper of an analysis.

    Args:
        name: name of the analysis.
        group: results of the analysis.
    """
    columns = [(title, unit, values) for title, key, unit in COLUMNS if (values := peak(group, key)) is not None]
    work = group.variables.get("damper_work_final")
    table = Table(
        f"{name}: dampers (largest absolute values)",
        ("damper", "storey", *(title for title, _, _ in columns), "work [kJ]"),
        each=("Each damper (largest absolute values)", name),
        name="each_damper",
    )
    if not columns or work is None:
        return table
    storeys = group.variables["damper_storey"].values
    for i, damper in enumerate(group.coords["damper"].values):
        cells = [number(float(values[i]), scale=unit) for _, unit, values in columns]
        table.rows.append([str(damper), whole(storeys[i] or None), *cells, number(float(work.values[i]), scale=1e3)])
    return table


def damper_stiffness_table(name: str, group: Group) -> Table:
    """Return stiffness and loss factor of the dampers that a modal analysis took into account.

    Args:
        name: name of the analysis.
        group: results of the modal analysis.
    """
    table = Table(f"{name}: dampers", ("damper", "k' [kN/mm]", "loss factor", "amplitude [mm]"))
    table.each = ("Stiffness and loss factor of dampers", name)
    table.name = "damper_stiffness"
    keys = ("damper_storage_stiffness", "damper_loss_factor", "damper_amplitude")
    if any(key not in group.variables for key in keys):
        return table
    columns = (group.variables[key].values for key in keys)
    for damper, k, n, u in zip(group.coords["damper"].values, *columns, strict=True):
        cells = [number(float(k), scale=1e6), number(float(n)), number(float(u), scale=1e-3)]
        table.rows.append([str(damper), *cells])
    table.notes.append(
        f"in steady vibration at {float(group.attributes['damper_frequency_Hz']):.4g} Hz, braces included"
    )
    return table


def amplitude_notes(group: Group) -> list[str]:
    """Return the notes of a table of periods on dampers whose amplitude is not given."""
    amplitude = group.variables.get("damper_amplitude")
    if amplitude is None:
        return []
    small = group.attributes.get("dampers_in_small_vibrations")
    missing = "no `design_deformation` is given"
    said = {
        f"count in small vibrations: {missing}": len(small) if isinstance(small, list) else 0,
        f"are left out: their stiffness depends on the amplitude (alpha < 1), and {missing}": int(
            np.isnan(amplitude.values).sum()
        ),
    }
    return [f"{count} of {amplitude.values.size} dampers {how}" for how, count in said.items() if count]


def _largest(values: np.ndarray | None, unit: float) -> str:
    return number(float(np.max(values)) if values is not None else None, scale=unit)
