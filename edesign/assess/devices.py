"""What histories ask of the viscous dampers of a design: force, stroke and velocity of one damper in each storey."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.sets import HistorySet


@dataclass(frozen=True)
class DeviceDemand:
    """Largest values over time of one damper in each storey with dampers, mean and largest of several histories.

    Attributes:
        variant, level: of the histories.
        histories: completed ones.
        planned: all of them.
        force, stroke, velocity: (2, s) N, m and m/s: the mean, then the largest.
    """

    variant: str
    level: str
    histories: int
    planned: int
    force: np.ndarray
    stroke: np.ndarray
    velocity: np.ndarray


def device_demand(design: Group, found: HistorySet, property_factor: float = 1.0) -> DeviceDemand | None:
    """The demand of histories of one variant at one level; None: none was completed.

    Of each history the damper of the storey that has most counts. The stroke is without the brace; the velocity is
    that of the dashpot at its largest force, (F / c)^(1 / alpha).

    Args:
        design: designs/NAME of an archive, of viscous dampers.
        found: the histories.
        property_factor: of the variant, on all forces.
    """
    completed = list(found.completed.values())
    if not completed:
        return None
    storeys = np.asarray(design.coords["storey"].values)
    force = np.array([_largest(group, "damper_force", storeys) for group in completed])
    force /= float(str(design.attributes["number"]))
    stroke = np.array([_largest(group, "damper_deformation", storeys) for group in completed])
    coefficient = property_factor * np.asarray(design.variables["device_coefficient"].values)
    velocity = (force / coefficient) ** (1.0 / float(str(design.attributes["alpha"])))
    both = [np.array([values.mean(axis=0), values.max(axis=0)]) for values in (force, stroke, velocity)]
    return DeviceDemand(found.variant, found.level, len(completed), len(found.histories), *both)


def _largest(group: Group, name: str, storeys: Sequence[int] | np.ndarray) -> np.ndarray:
    """Largest size of a quantity of the dampers of each storey, (s,)."""
    size = np.maximum(np.abs(group.variables[f"{name}_max"].values), np.abs(group.variables[f"{name}_min"].values))
    of = np.asarray(group.variables["damper_storey"].values)
    return np.array([size[of == storey].max() for storey in storeys])
