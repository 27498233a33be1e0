"""Extremes over time and residual values, as analyses archive them."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group


def peak(group: Group, quantity: str) -> np.ndarray | None:
    """Return the largest absolute value over time of each component, None if the analysis has no such quantity.

    They are stored as `<quantity>_max` and `<quantity>_min`. Of a floor with several diaphragms the largest counts.

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
    found = np.asarray(np.max(np.abs(np.asarray(extremes, dtype=float)), axis=0))
    of_parts = peak(group, diaphragm) if (diaphragm := of_diaphragms(quantity)) else None
    return found if of_parts is None else by_largest_part(group, found, of_parts)


def of_diaphragms(quantity: str) -> str:
    """Return what a quantity of floors is called of their diaphragms; "" of others."""
    return quantity.replace("floor_", "diaphragm_") if quantity.startswith("floor_") else ""


def by_largest_part(group: Group, floors: np.ndarray, parts: np.ndarray) -> np.ndarray:
    """Return values of floors, with the largest one of its diaphragms for each floor that has several.

    Args:
        group: of an analysis of a building.
        floors: by floor, (n_floors, ...).
        parts: by diaphragm, (n_diaphragms, ...).
    """
    numbers = [list(group.coords["floor"].values).index(of) for of in group.variables["diaphragm_floor"].values]
    found = floors.copy()
    found[numbers] = 0.0
    np.maximum.at(found, numbers, parts)
    return found


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
