"""The distribution of dampers over the height that meets a drift with the least area of elastomer."""

from __future__ import annotations

import numpy as np

from edesign.study.design.building import Building
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.sizing import place_stiffness
from edesign.study.design.estimate import Action, estimate
from edesign.study.design.least_total import Problem, least_total

_MOST = 30.0  # of k_D / k_S


def least_area(
    building: Building,
    moduli: Moduli,
    action: Action,
    drift: float,
    brace: np.ndarray | None,
    thickness: float,
    start: np.ndarray | None = None,
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

    Raises:
        AnalysisError: the drift is met without dampers, or no dampers meet it.
    """
    storeys = building.designed_stiffness
    braces = None if brace is None else building.at_places(brace)
    # k_D of a place is shared by equal dampers, whose area grows with 1 / cos^2 of their slope
    weight = np.bincount(building.place_storey) / building.attachment() * storeys

    def used(x: np.ndarray) -> np.ndarray:
        """Drift / limit of each storey for k_D = x k_S."""
        at_places = place_stiffness(building, x * storeys, moduli.loss_factor, brace)
        return estimate(building, action, at_places, braces, thickness).drift / drift

    problem = Problem(used, weight / weight.sum(), drift, _MOST, "dampers", "area")
    return least_total(problem, None if start is None else start / storeys) * storeys
