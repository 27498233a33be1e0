"""The distribution of viscous dampers over the height that meets a drift with the least sum of coefficients."""

from __future__ import annotations

import numpy as np

from edesign.study.design.least_total import Problem, least_total
from edesign.study.design.viscous.model import Dashpots, ViscousModel

MOST = 2.0
"""Of omega c / k_S, with which a storey by itself is critically damped: no spectrum tells what more would do."""


def least_coefficient(
    model: ViscousModel, weight: np.ndarray, omega: float, start: np.ndarray | None = None
) -> np.ndarray:
    """Return the coefficients of least sum over the dampers with which no storey drifts more than the target, (s,).

    The drifts are estimated by the response spectrum, with linear dashpots of the same energy at a given amplitude.

    Args:
        model: of the dampers, with action and target drift.
        weight: linear dashpot of the energy of a coefficient of 1 at each place, (d,).
        omega: of the first mode, rad/s.
        start: where the search begins; None: in proportion to the storeys.

    Raises:
        OutOfReach: the drift is met without dampers, or no dampers meet it, and no histories are to decide.
    """
    building, action, drift = model.building, model.action, model.spec.drift
    assert action is not None and drift is not None, "check_design wants them"
    one = weight * model.at_places(np.ones(building.storeys.size))

    def used(c: np.ndarray) -> np.ndarray:
        return model.drift(Dashpots(c, one * c[building.place_storey], model.flexibility(c), omega), action) / drift

    unit, share = coefficient_unit(model, weight, omega)
    nearest = model.spec.verify is not None
    return least_total(Problem(used, unit, share, drift, MOST, "dashpots with omega c", "coefficients", nearest), start)


def coefficient_unit(model: ViscousModel, weight: np.ndarray, omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the coefficients with omega c = k_S, (s,), and what the dampers of a storey are in sum with them, (s,).

    Args:
        model: of the dampers.
        weight: linear dashpot of the energy of a coefficient of 1 at each place, (d,).
        omega: of the first mode, rad/s.
    """
    building = model.building
    of_storey = np.bincount(
        building.place_storey, weight * model.at_places(np.ones(building.storeys.size)) * building.cosine**2
    )
    unit = building.designed_stiffness / (omega * of_storey)
    # a storey with steep dampers needs more of them for the same effect
    return unit, unit * np.bincount(building.place_storey) / building.attachment(model.power)
