"""Extremes over time and residual values, as analyses archive them."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group


def peak(group: Group, quantity: str) -> np.ndarray | None:
    """Return the largest absolute value over time of each component, None if the analysis has no such quantity.

    They are stored as `<quantity>_max` and `<quantity>_min`.

    Args:
        quantity: such as "floor_displacement"; its components are floors, storeys or members.

    Returns:
        An array shaped and in the unit of the stored extremes.
    """
    extremes = [
        group.variables[name].values for name in (f"{quantity}_max", f"{quantity}_min") if name in group.variables
    ]
    if not extremes:
        return None
    return np.asarray(np.max(np.abs(np.asarray(extremes, dtype=float)), axis=0))


def residual(group: Group, quantity: str) -> np.ndarray | None:
    """Return the absolute residual value of each component, None unless the analysis is a completed history.

    They are stored as `residual_<quantity>`.

    Args:
        quantity: "roof_displacement" or "storey_drift".

    Returns:
        One value a component, in the unit of the quantity, or None.
    """
    variable = group.variables.get(f"residual_{quantity}")
    return None if variable is None else np.abs(np.asarray(variable.values, dtype=float))


def final(group: Group, quantity: str) -> np.ndarray | None:
    """Return the absolute value at the end of each component, None unless the analysis is a completed history.

    They are stored as `<quantity>_final`.

    Args:
        quantity: "floor_displacement" or "storey_drift".

    Returns:
        One value a component, in the unit of the quantity, or None.
    """
    variable = group.variables.get(f"{quantity}_final")
    if variable is None or residual(group, "storey_drift") is None:
        return None
    return np.abs(np.asarray(variable.values, dtype=float))
