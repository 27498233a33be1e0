"""What histories ask of the dampers of a design, of one damper in each storey."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak
from edesign.assess.sets import HistorySet
from edesign.codes.motion_sets import SetRules


@dataclass(frozen=True)
class DeviceDemand:
    """Largest values over time of one damper in each storey with dampers, mean and largest of several motions.

    Attributes:
        variant, level: of the histories.
        histories: completed ones.
        planned: all of them.
        motions: of the completed ones; of each the worst of its angles and places of the masses counts.
        values: (2, s) each, the mean over the motions, then the largest: force (N) and stroke (m); of viscous dampers
            velocity (m/s), of buckling-restrained braces core_strain and cumulative_ductility, of other hysteretic
            dampers cumulated_plastic (m), of elastomers the strain of the layers and the velocity that was recorded.
    """

    variant: str
    level: str
    histories: int
    planned: int
    motions: int
    values: Mapping[str, np.ndarray]

    def counted(self, rules: SetRules) -> dict[str, np.ndarray]:
        """Return the values that count, (s,) each: the mean of as many motions as a code asks for, else the largest.

        Args:
            rules: of the code in force.
        """
        return {name: both[0 if self.motions >= rules.number_for_mean else 1] for name, both in self.values.items()}


def device_demand(design: Group, found: HistorySet, property_factor: float = 1.0) -> DeviceDemand | None:
    """Return the demand of histories of one variant at one level; None: none was completed.

    Of each history the damper of the storey that has most counts. The stroke is without the brace; the velocity is
    that of the dashpot at its largest force, (F / c)^(1 / alpha). The cumulated plastic deformation is the work of the
    damper at the end over its yield force.

    Args:
        design: designs/NAME of an archive, not of a placement.
        property_factor: of the variant, on all forces.

    Source: cumulated plastic deformation: Akiyama (1985), Earthquake-Resistant Limit-State Design for Buildings;
        cumulative ductility: AISC 341-16, K3.4c.
    """
    completed = list(found.completed.values())
    if not completed:
        return None
    storeys = np.asarray(design.coords["storey"].values)
    own = _own(design, completed[0])
    number = float(str(design.attributes["number"]))
    force = np.array([_largest(group, "damper_force", storeys, own) for group in completed]) / number
    values = {"force": force}
    values["stroke"] = np.array([_largest(group, "damper_deformation", storeys, own) for group in completed])
    if "device_core_area" in design.variables:
        values["core_strain"] = np.array([_largest(group, "core_strain", storeys, own) for group in completed])
        cumulated = (group.variables["cumulative_ductility_final"].values for group in completed)
        values["cumulative_ductility"] = np.array(
            [_of_storeys(group, of, storeys, own) for group, of in zip(completed, cumulated, strict=True)]
        )
    elif design.attributes["method"] == "hysteretic":
        yield_force = number * property_factor * np.asarray(design.variables["device_yield_force"].values)
        work = np.array(
            [_of_storeys(group, group.variables["damper_work_final"].values, storeys, own) for group in completed]
        )
        values["cumulated_plastic"] = work / yield_force
    elif "layer_thickness_m" in design.attributes:
        values["strain"] = values["stroke"] / float(str(design.attributes["layer_thickness_m"]))
        if all("damper_velocity_max" in group.variables for group in completed):
            values["velocity"] = np.array([_largest(group, "damper_velocity", storeys, own) for group in completed])
    else:
        coefficient = property_factor * np.asarray(design.variables["device_coefficient"].values)
        values["velocity"] = (force / coefficient) ** (1.0 / float(str(design.attributes["alpha"])))
    worst = {name: worst_of_each(found, of) for name, of in values.items()}
    both = {name: np.array([of.mean(axis=0), of.max(axis=0)]) for name, of in worst.items()}
    counts = len(completed), len(found.histories), len(worst["force"])
    return DeviceDemand(found.variant, found.level, *counts, both)


def place_forces(
    found: HistorySet, storeys: np.ndarray, names: Collection[str] | None, rules: SetRules
) -> np.ndarray | None:
    """Return the force of all dampers of a place in each storey, (s,) N; None: no history was completed.

    Of the motions the mean counts where there are enough of them, else the largest.

    Args:
        storeys: with dampers, from 1.
        names: of the dampers that count; None: all.
        rules: of the code in force, from how many motions on the mean counts.
    """
    completed = list(found.completed.values())
    if not completed:
        return None
    values = np.array([_largest(group, "damper_force", storeys, _mine(names, group)) for group in completed])
    return _of_motions(found, values, rules)


def force_of_each(found: HistorySet, rules: SetRules) -> np.ndarray:
    """Return the force of all dampers of each place, (d,) N, as `place_forces`, of a set with completed histories."""
    values = np.array([peak(group, "damper_force") for group in found.completed.values()])
    return _of_motions(found, values, rules)


def names_of_history(history: Group) -> list[str]:
    """Return the names of the dampers of a history, in its order."""
    return [str(name) for name in history.coords["damper"].values]


def _of_motions(found: HistorySet, values: np.ndarray, rules: SetRules) -> np.ndarray:
    worst = worst_of_each(found, values)
    return np.asarray(worst.mean(axis=0) if len(worst) >= rules.number_for_mean else worst.max(axis=0))


def worst_of_each(found: HistorySet, values: np.ndarray) -> np.ndarray:
    """Return the largest values of each motion over its completed histories, (motions, ...).

    Args:
        values: of its completed histories, (n, ...).
    """
    of = np.array([found.motion_of[name] for name in found.completed])
    return np.array([values[of == motion].max(axis=0) for motion in dict.fromkeys(of.tolist())])


def _own(design: Group, history: Group) -> np.ndarray:
    """Which of the dampers of a variant, that may have several designs, are of one of them, (d,)."""
    return _mine(names_of_dampers(design), history)


def names_of_dampers(design: Group) -> list[str] | None:
    """Return the names of the dampers of a design; None where the archive does not say them."""
    names = design.attributes.get("device_names")
    return names if isinstance(names, list) else None


def _mine(names: Collection[str] | None, history: Group) -> np.ndarray:
    dampers = np.asarray(history.coords["damper"].values).astype(str)
    return np.ones(dampers.size, dtype=bool) if names is None else np.isin(dampers, list(names))


def _largest(group: Group, name: str, storeys: np.ndarray, own: np.ndarray) -> np.ndarray:
    """Largest size of a quantity of the dampers of each storey, (s,)."""
    size = peak(group, name)
    assert size is not None, "histories of dampers have their extremes"
    return _of_storeys(group, size, storeys, own)


def _of_storeys(group: Group, values: np.ndarray, storeys: np.ndarray, own: np.ndarray) -> np.ndarray:
    """Largest of values of some of the dampers (d,) in each storey, (s,)."""
    of = np.asarray(group.variables["damper_storey"].values)
    return np.array([values[own & (of == storey)].max() for storey in storeys])
