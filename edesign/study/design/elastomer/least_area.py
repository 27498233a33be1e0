"""The distribution of dampers over the height that meets a drift with the least area of elastomer."""

from __future__ import annotations

import numpy as np

from edesign.study.design.building import Building
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.sizing import place_stiffness
from edesign.study.design.estimate import Action, estimate
from edesign.study.design.fully_stressed import StoreySizes
from edesign.study.design.least_total import LEAST, OutOfReach, Problem, least_total
from edesign.study.design.loop import LARGEST_FACTOR

_MOST = 30.0  # of k_D / k_S


def least_area(
    building: Building,
    moduli: Moduli,
    action: Action,
    drift: float,
    brace: np.ndarray | None,
    thickness: float,
    start: np.ndarray | None = None,
    nearest: bool = False,
) -> np.ndarray:
    """Return the storage stiffnesses k_D of least sum with which no storey drifts more than the target, (s,) N/m.

    All layers have one thickness and modulus, so area is in proportion to stiffness. The drifts are estimated by the
    response spectrum of the frame with dampers and braces. Sequential quadratic programming finds a local optimum.

    Args:
        building: the frame with its places.
        moduli: of the elastomer.
        action: the spectrum.
        drift: limit of storey drift over height.
        brace: horizontal stiffness of the braces of each storey, (s,) N/m; None: rigid.
        thickness: of a layer, m.
        start: where the search begins; None: in proportion to the storeys.
        nearest: whether those nearest to the limit are taken where the estimate knows no others.

    Raises:
        OutOfReach: the drift is met without dampers, or no dampers meet it.
    """
    storeys = building.designed_stiffness
    braces = None if brace is None else building.at_places(brace)
    weight = _weight(building)

    def used(x: np.ndarray) -> np.ndarray:
        """Drift / limit of each storey for k_D = x k_S."""
        at_places = place_stiffness(building, x * storeys, moduli.loss_factor, brace)
        return estimate(building, action, at_places, braces, thickness).drift / drift

    problem = Problem(used, weight / weight.sum(), drift, _MOST, "dampers", "area")
    try:
        return least_total(problem, None if start is None else start / storeys) * storeys
    except OutOfReach as error:
        if not nearest:
            raise
        return error.nearest * storeys


def storey_sizes(building: Building, k_D: np.ndarray, loss_factor: float, action: Action) -> StoreySizes:
    """Return the sizes k_D / k_S from which a search by histories starts.

    Args:
        building: the frame with its places.
        k_D: storage stiffness of the first dampers, (s,) N/m.
        loss_factor: of the elastomer.
        action: with the damping of the frame without dampers.
    """
    first = np.maximum(k_D / building.designed_stiffness, LEAST)
    inherent = 2.0 * action.inherent_damping / loss_factor
    return StoreySizes(first, _weight(building), inherent, LEAST, LARGEST_FACTOR * _MOST, building.storeys)


def _weight(building: Building) -> np.ndarray:
    """Stiffness of the dampers along their slope in sum for k_D = k_S, (s,) N/m, in proportion to their area."""
    # k_D of a place is shared by equal dampers, whose area grows with 1 / cos^2 of their slope
    return np.asarray(np.bincount(building.place_storey) / building.attachment() * building.designed_stiffness)
