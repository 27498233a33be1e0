"""Peaks floor by floor and storey by storey, of one analysis and over many histories."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak, residual
from edesign.assess.statistics import statistics


@dataclass(frozen=True)
class ProfileStatistics:
    """Statistics of a storey profile over the histories that have it, storey by storey from the lowest up.

    Attributes:
        mean, median, percentile_84, maximum: shape (storeys,), in the unit of the profile. Each storey has its own
            statistics: the median profile is in general the profile of no history.
        count: how many histories have the profile.
        missing: the others.
    """

    mean: np.ndarray
    median: np.ndarray
    percentile_84: np.ndarray
    maximum: np.ndarray
    count: int
    missing: tuple[str, ...]


def storey_profile(group: Group) -> dict[str, np.ndarray]:
    """Return the peaks over the height, from the lowest storey up; each floor goes with the storey below it.

    Args:
        group: results of one analysis, as archived.

    Returns:
        Those of these that the analysis has, each of shape (storeys,): "floor_displacement" (m), "storey_drift"
        (ratio), "residual_storey_drift" (ratio), "storey_shear" (N), "floor_acceleration" (total, m/s2).
    """
    found = {
        "floor_displacement": peak(group, "floor_displacement"),
        "storey_drift": peak(group, "storey_drift"),
        "residual_storey_drift": residual(group, "storey_drift"),
        "storey_shear": peak(group, "storey_shear"),
        "floor_acceleration": peak(group, "floor_acceleration"),
    }
    return {name: values for name, values in found.items() if values is not None}


def profile_statistics(histories: Mapping[str, Group]) -> dict[str, ProfileStatistics]:
    """Return the statistics of the storey profiles over histories of one frame.

    Args:
        histories: results by name; one that is not completed counts as missing, as its peaks are not the last word.

    Returns:
        Statistics by the names of `storey_profile`; a profile that no history has is left out.
    """
    profiles = {
        name: storey_profile(group) if group.attributes.get("status") == "completed" else {}
        for name, group in histories.items()
    }
    found = {}
    for quantity in dict.fromkeys(key for profile in profiles.values() for key in profile):
        there = {name: profile[quantity] for name, profile in profiles.items() if quantity in profile}
        storeys = len(next(iter(there.values())))
        each = [statistics({name: float(v[storey]) for name, v in there.items()}) for storey in range(storeys)]
        found[quantity] = ProfileStatistics(
            mean=np.array([s.mean for s in each], dtype=float),
            median=np.array([s.median for s in each], dtype=float),
            percentile_84=np.array([s.percentile_84 for s in each], dtype=float),
            maximum=np.array([s.maximum for s in each], dtype=float),
            count=len(there),
            missing=tuple(name for name in profiles if name not in there),
        )
    return found
