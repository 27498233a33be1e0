"""Peaks floor by floor and storey by storey."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.envelopes import peak, residual


def storey_profile(group: Group) -> dict[str, np.ndarray]:
    """Return the peaks over the height, from the lowest storey up; each floor belongs to the storey below it.

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
