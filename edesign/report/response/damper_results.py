"""Tables of the dampers of an analysis: forces, deformations, work, stiffness in modes."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.energy import final_energies, share_of_input
from edesign.assess.envelopes import peak
from edesign.report.tables.column import col, count, text
from edesign.report.tables.items import Analysis, Place, at, largest, overall, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KJ, KN, KN_MM, MM, ONE, PERCENT


def _most_deformed(analysis: Analysis) -> str | None:
    deformation = peak(analysis.group, "damper_deformation")
    return None if deformation is None else str(analysis.group.coords["damper"].values[int(np.argmax(deformation))])


def _work(analysis: Analysis) -> float | None:
    work = analysis.group.variables.get("damper_work_final")
    return None if work is None else float(np.sum(work.values))


DAMPERS = TableSpec[Analysis](
    "dampers",
    "Dampers (largest absolute values, and the one with the largest deformation)",
    (
        text("analysis", "name"),
        col("strain", PERCENT, overall("damper_strain"), optional=True),
        col("u", MM, overall("damper_deformation"), optional=True),
        col("F", KN, overall("damper_force"), optional=True),
        text("damper", _most_deformed),
        col("work", KJ, _work),
        col("of the input", PERCENT, lambda one: share_of_input(final_energies(one.group), _work(one))),
    ),
)
EACH_DAMPER = TableSpec[Place](
    "each_damper",
    "{whose}: dampers (largest absolute values)",
    (
        text("damper", "name"),
        count("storey", lambda damper: damper.value("damper_storey") or None),
        col("strain", PERCENT, largest("damper_strain"), optional=True),
        col("u", MM, largest("damper_deformation"), optional=True),
        col("F", KN, largest("damper_force"), optional=True),
        col("work", KJ, at("damper_work_final")),
    ),
    each="Each damper (largest absolute values)",
)


def _of_vibration(name: str) -> Callable[[Place], float | None]:
    """A value of a damper; None where it is no number: that of a dashpot alone, or of a damper that is left out."""
    return lambda damper: None if not np.isfinite(value := damper.known(name)) else value


DAMPER_STIFFNESS = TableSpec[Place](
    "damper_stiffness",
    "{whose}: dampers",
    (
        text("damper", "name"),
        col("k'", KN_MM, _of_vibration("damper_storage_stiffness")),
        col("loss factor", ONE, _of_vibration("damper_loss_factor")),
        col("amplitude", MM, _of_vibration("damper_amplitude")),
    ),
    each="Stiffness and loss factor of dampers",
)


def dampers_table(groups: Mapping[str, Group]) -> Table:
    """Return the largest response of any damper in each analysis, and the share of the input that went into all.

    The energy term `dampers` has dashpots of footings and tuned masses too, which are none of these.
    """
    return DAMPERS.of(
        Analysis(name, group) for name, group in groups.items() if peak(group, "damper_force") is not None
    )


def each_damper_table(name: str, group: Group) -> Table:
    """Return the largest response of every damper of an analysis."""
    return EACH_DAMPER.of(places({name: group}, "damper", "damper_force_max", "damper_work_final"), whose=name)


def damper_stiffness_table(name: str, group: Group) -> Table:
    """Return stiffness and loss factor of the dampers that a modal analysis took into account."""
    needed = ("damper_storage_stiffness", "damper_loss_factor", "damper_amplitude")
    found = list(places({name: group}, "damper", *needed))
    frequency = float(group.attributes["damper_frequency_Hz"]) if found else 0.0
    notes = [f"in steady vibration at {frequency:.4g} Hz, braces included"] if found else []
    return DAMPER_STIFFNESS.of(found, whose=name, notes=notes)


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
