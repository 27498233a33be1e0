"""Floors of a building as rigid bodies in plan."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.report.motion.geometry import SAME, Geometry
from edesign.report.response.histories import names_of


def floors_in_plan(group: Group, geometry: Geometry, floors: np.ndarray) -> np.ndarray:
    """Return base and floors of a building as rigid bodies, by the places that a history kept of each.

    A floor without two such places does not turn, and neither does one with several diaphragms.

    Args:
        floors: displacement of base and floors along x and y, (times, floors + 1, 2) m.

    Returns:
        Displacements of the origin along x and y and turn about the vertical, (times, floors + 1, 3) m, m, rad.
    """
    points = group.variables.get("point_displacement")
    known = names_of(group, "point") if points is not None and points.dims[0] == "time" else []
    found = np.zeros((*floors.shape[:2], 3))
    found[..., :2] = floors
    several = group.variables["diaphragm_floor"].values if "diaphragm_floor" in group.variables else ()
    for floor in set(range(1, floors.shape[1])) - set(several):
        there = {i: name for i, name in enumerate(known) if name.endswith(f".{floor}") and name in geometry.nodes}
        if points is not None and len(there) > 1:
            places = np.array([geometry.nodes[node][:2] for node in there.values()])
            middle, mean, turn = rigid_motion(places, np.asarray(points.values, dtype=float)[:, list(there)])
            found[:, floor] = np.column_stack((mean[:, 0] + turn * middle[1], mean[:, 1] - turn * middle[0], turn))
    return found


def storey_drifts(group: Group, floors: np.ndarray) -> np.ndarray:
    """Return drift ratios of the storeys of a history that did not keep them, by the motion of their floors.

    A floor with several diaphragms has no place of its own that the next floor stands above: the drift is there the
    mean of the column lines whose places were kept at both floors.

    Args:
        floors: displacement of base and floors, (times, floors + 1) m, or of a building along x and y.

    Returns:
        (times, storeys), or of a building (times, storeys, 2).
    """
    apart = np.diff(floors, axis=1)
    several = set(group.variables["diaphragm_floor"].values.tolist()) if "diaphragm_floor" in group.variables else set()
    points = group.variables.get("point_displacement")
    if several and points is not None and points.dims[0] == "time":
        places = {name: i for i, name in enumerate(names_of(group, "point"))}
        for storey in sorted(several | {floor + 1 for floor in several}):
            lines = [name.removesuffix(f".{storey}") for name in places if name.endswith(f".{storey}")]
            both = [
                (places[below], places[f"{line}.{storey}"])
                for line in lines
                if (below := f"{line}.{storey - 1}") in places
            ]
            if both:
                lower, upper = (np.asarray(points.values, dtype=float)[:, list(at)] for at in zip(*both, strict=True))
                apart[:, storey - 1] = (upper - lower).mean(axis=1)
    return np.asarray(apart / group.variables["storey_height"].values.reshape(-1, *(1,) * (floors.ndim - 2)))


def rigid_motion(places: np.ndarray, moved: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the small motion of a rigid body in plan that is nearest to the motion of its points.

    Args:
        places: (n, 2) m.
        moved: (pictures, n, 2) m.

    Returns:
        The middle of the places (2,) m, its displacement (pictures, 2) m, and the turn (pictures,) rad.
    """
    middle, mean = places.mean(axis=0), moved.mean(axis=1)
    x, y = (places - middle).T
    polar = float(np.sum(x**2 + y**2))
    turn = (moved[..., 1] @ x - moved[..., 0] @ y) / polar if polar > SAME**2 else np.zeros(len(moved))
    return middle, mean, turn
