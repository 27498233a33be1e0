"""Floors that are rigid in their plane."""

from __future__ import annotations

from edesign.exchange.sap2000.grid import Grid
from edesign.exchange.sap2000.model import Sap2000Model


def diaphragm_floors(model: Sap2000Model, grid: Grid) -> set[int]:
    """Return the floors that are rigid in their plane; all joints of such a floor must be in the diaphragm.

    Raises:
        InputError: a diaphragm has joints of several floors, or not all of one.
    """
    levels = {joint: point[2] for joint, point in grid.points.items()}
    levels |= {joint: levels[ends[0]] for joint, ends in grid.middles.items()}
    found = set()
    for name, joints in model.diaphragms.items():
        used = {joint for joint in joints if joint in levels}
        floors = {levels[joint] for joint in used}
        if len(used) < 2:
            continue
        if len(floors) > 1:
            raise model.error("diaphragm", name, f"its joints are on {len(floors)} floors [E-SAP-14]")
        floor = floors.pop()
        of_floor = {joint for joint, level in levels.items() if level == floor}
        if used != of_floor:
            lacking = len(of_floor - used)
            raise model.error(
                "diaphragm",
                name,
                f"{lacking} joints of its floor are not in it; a floor is rigid as a whole or not [E-SAP-14]",
            )
        found.add(floor)
    return found
