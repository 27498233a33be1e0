"""The distribution of dampers over the height that meets a drift with the least area of elastomer."""

from __future__ import annotations

import numpy as np
import scipy

from edesign.errors import AnalysisError
from edesign.study.design.building import Building
from edesign.study.design.elastomer import Moduli
from edesign.study.design.estimate import Action, estimate
from edesign.study.design.sizing import place_stiffness

_LEAST = 1e-3  # of k_D / k_S: every chosen storey keeps a damper
_MOST = 30.0  # of k_D / k_S
_STEP = 1e-6  # of the finite differences, over the stiffness of a storey


def least_area(
    building: Building,
    moduli: Moduli,
    action: Action,
    drift: float,
    brace: np.ndarray | None,
    thickness: float,
    start: np.ndarray | None = None,
) -> np.ndarray:
    """k_D of each storey with dampers, (s,) N/m, least in sum, for which no storey drifts more than `drift`.

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
    weight = np.bincount(building.place_storey) / building.attachment * storeys
    weight = weight / weight.sum()

    def spare(x: np.ndarray) -> np.ndarray:
        """1 - drift / limit of each storey for k_D = x k_S."""
        at_places = place_stiffness(building, x * storeys, moduli.loss_factor, brace)
        return 1.0 - estimate(building, action, at_places, braces, thickness).drift / drift

    def gradient(x: np.ndarray) -> np.ndarray:
        columns = [(spare(x + _STEP * e) - spare(x - _STEP * e)) / (2.0 * _STEP) for e in np.eye(x.size)]
        return np.array(columns).T

    first = np.ones(storeys.size)
    if start is not None:
        x0 = start / storeys
    else:
        if spare(_LEAST * first).min() >= 0.0:
            raise AnalysisError(f"the estimated drift stays below {100.0 * drift:.4g} % without dampers")
        if spare(_MOST * first).min() < 0.0:
            most = drift * (1.0 - float(spare(_MOST * first).min()))
            raise AnalysisError(
                f"dampers {_MOST:g} times as stiff as the storeys still leave an estimated drift of "
                f"{100.0 * most:.4g} %; the limit is {100.0 * drift:.4g} %"
            )
        x0 = first * scipy.optimize.brentq(lambda s: float(spare(s * first).min()), _LEAST, _MOST, xtol=1e-6)
    found = scipy.optimize.minimize(
        lambda x: float(weight @ x),
        x0,
        jac=lambda x: weight,
        bounds=[(_LEAST, _MOST)] * storeys.size,
        constraints=[{"type": "ineq", "fun": spare, "jac": gradient}],
        method="SLSQP",
        options={"ftol": 1e-10, "maxiter": 200},
    )
    x = np.asarray(found.x)
    if spare(x).min() < -1e-6:
        raise AnalysisError(f"the search for the least area stopped outside the drift limit: {found.message}")
    return x * storeys
