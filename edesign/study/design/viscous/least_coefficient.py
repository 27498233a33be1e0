"""The distribution of viscous dampers over the height that meets a drift with the least sum of coefficients."""

from __future__ import annotations

import numpy as np

from edesign.study.design.fully_stressed import StoreySizes
from edesign.study.design.least_total import LEAST, OutOfReach, Problem, least_total
from edesign.study.design.loop import LARGEST_FACTOR
from edesign.study.design.viscous.estimate import viscous_drift
from edesign.study.design.viscous.model import Vibration, ViscousFrame

_MOST = 2.0
"""Of omega c / k_S, with which a storey by itself is critically damped: no spectrum tells what more would do."""


def least_coefficient(
    frame: ViscousFrame, weight: np.ndarray, omega: float, start: np.ndarray | None = None
) -> np.ndarray:
    """Return the coefficients of least sum over the dampers with which no storey drifts more than the target, (s,).

    The drifts are estimated by the response spectrum, with linear dashpots of the same energy at a given amplitude.

    Args:
        frame: with its dampers' law, action and target drift.
        weight: linear dashpot of the energy of a coefficient of 1 at each place, (d,).
        omega: of the first mode, rad/s.
        start: where the search begins; None: in proportion to the storeys.

    Raises:
        OutOfReach: the drift is met without dampers, or no dampers meet it, and no histories are to decide.
    """
    building, action, drift = frame.building, frame.action, frame.spec.drift
    assert action is not None and drift is not None, "check_design wants them"
    one = weight * frame.at_places(np.ones(building.storeys.size))
    unit, share = _unit(frame, weight, omega)

    def used(x: np.ndarray) -> np.ndarray:
        linear = one * (x * unit)[building.place_storey]
        return viscous_drift(building, action, linear, frame.flexibility(x * unit), omega) / drift

    problem = Problem(used, share / share.sum(), drift, _MOST, "dashpots with omega c", "coefficients")
    try:
        return least_total(problem, None if start is None else start / unit) * unit
    except OutOfReach as error:
        if frame.spec.verify is None:
            raise
        return error.nearest * unit


def storey_sizes(frame: ViscousFrame, coefficient: np.ndarray, vibration: Vibration) -> tuple[StoreySizes, np.ndarray]:
    """Return the sizes from which a search by histories starts, and the coefficients of size 1, (s,).

    Args:
        frame: with its dampers' law and action.
        coefficient: of the first dampers, (s,).
        vibration: with them.
    """
    assert frame.action is not None, "check_design wants a level"
    unit, share = _unit(frame, frame.weight(vibration), vibration.omega)
    inherent = 2.0 * frame.action.inherent_damping  # omega c / k_S of the damping ratio of a storey by itself
    first = np.maximum(coefficient / unit, LEAST)
    # histories know what more would do
    return StoreySizes(first, share, inherent, LEAST, LARGEST_FACTOR * _MOST, frame.building.storeys), unit


def _unit(frame: ViscousFrame, weight: np.ndarray, omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients with omega c = k_S, (s,), and what the dampers of a storey are in sum with them."""
    building = frame.building
    of_storey = np.bincount(
        building.place_storey, weight * frame.at_places(np.ones(building.storeys.size)) * building.cosine**2
    )
    unit = building.designed_stiffness / (omega * of_storey)
    # a storey with steep dampers needs more of them for the same effect
    return unit, unit * np.bincount(building.place_storey) / building.attachment(frame.power)
