"""Stiffness of the dampers of each storey for a target damping, by several distributions over the height."""

from __future__ import annotations

import math

import numpy as np
import scipy

from edesign.damper.sizing import largest_damping, stiffness_ratio
from edesign.errors import AnalysisError, InputError
from edesign.project.dampers.designs import StrainEnergyDesign
from edesign.study.design.building import Building
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.model import ElastomerModel, Layers
from edesign.study.design.least_total import Problem, least_total
from edesign.study.design.pattern import pattern_of
from edesign.study.design.reach import REACHABLE, reach

MOST = 30.0
"""Of k_D / k_S, that dampers of the least area may have."""
_SCALES = np.geomspace(1e-4, 1e4, 81)  # of the dampers' stiffness over that of the storeys


def distribute(
    model: ElastomerModel,
    spec: StrainEnergyDesign,
    moduli: Moduli,
    target: float,
    thickness: float,
    before: np.ndarray | None,
) -> np.ndarray:
    """Return the storage stiffness k_D of each storey with dampers in the distribution of a design, (s,) N/m.

    Args:
        target: damping ratio to be added.
        thickness: thickness of a layer, m.
        before: k_D of the previous iteration, (s,) N/m, from which `least_area` starts; None: none.

    Raises:
        InputError: no damper reaches the target.
        AnalysisError: this distribution does not reach it.
    """
    if spec.distribution == "least_area":
        assert spec.drift is not None, "check_design wants it"
        nearest = spec.verify is not None and spec.verify.change == "area"
        return least_area(model, moduli, spec.drift, thickness, before, nearest)
    n = moduli.loss_factor
    nearest = spec.braces_in_target is None and spec.counts_braces and target == spec.damping
    if spec.target_in == "storeys":
        ratios = model.ratios.tolist() if spec.counts_braces else [math.inf] * model.building.storeys.size
        most = [REACHABLE * largest_damping(n, ratio) if nearest else math.inf for ratio in ratios]
        found = [stiffness_ratio(min(target, one), n, ratio) for one, ratio in zip(most, ratios, strict=True)]
        return np.array(found) * model.building.designed_stiffness
    pattern = pattern_of(model.building, spec.distribution)
    if nearest:
        return nearest_scale(model, pattern, n, target)[0] * pattern
    return _scale(model, pattern, n, target, spec.counts_braces) * pattern


def nearest_scale(model: ElastomerModel, pattern: np.ndarray, loss_factor: float, target: float) -> tuple[float, float]:
    """Return the least factor on a pattern with which the first mode has the target, or nearly what braces let it have.

    Args:
        pattern: of k_D over the storeys with dampers, (s,) N/m.
        target: damping ratio to be added by dampers and braces.

    Returns:
        The factor, and the largest damping ratio that was found up to it.
    """
    stiffness_ratio(target, loss_factor)  # refuses what no frame allows

    def damping(scale: float) -> float:
        return model.first_damping(model.stiffness(scale * pattern, loss_factor))

    ends = float(_SCALES[0]), float(_SCALES[-1])
    scale, found = reach(damping, target, *ends)
    return (scale if found >= target else reach(damping, REACHABLE * found, *ends)[0]), found


def least_area(
    model: ElastomerModel,
    moduli: Moduli,
    drift: float,
    thickness: float,
    start: np.ndarray | None = None,
    nearest: bool = False,
) -> np.ndarray:
    """Return the storage stiffnesses k_D of least sum with which no storey drifts more than the target, (s,) N/m.

    All layers have one thickness and modulus, so area is in proportion to stiffness. The drifts are estimated by the
    response spectrum of the frame with dampers and braces. Sequential quadratic programming finds a local optimum.

    Args:
        drift: limit of storey drift over height.
        thickness: of a layer, m.
        start: where the search begins; None: in proportion to the storeys.
        nearest: whether those nearest to the limit are taken where the estimate knows no others.

    Raises:
        OutOfReach: the drift is met without dampers, or no dampers meet it.
    """
    building, action = model.building, model.action
    assert action is not None, "check_design wants a level"

    def used(k_D: np.ndarray) -> np.ndarray:
        """Drift / limit of each storey."""
        return model.drift(Layers(model.stiffness(k_D, moduli.loss_factor), model.braces, thickness), action) / drift

    unit, weight = building.designed_stiffness, area_weight(building)
    return least_total(Problem(used, unit, weight, drift, MOST, "dampers", "area", nearest), start)


def area_weight(building: Building) -> np.ndarray:
    """Return the stiffness of all dampers along their slope for k_D = k_S, (s,) N/m, in proportion to their area."""
    # k_D of a place is shared by equal dampers, whose area grows with 1 / cos^2 of their slope
    return np.asarray(np.bincount(building.place_storey) / building.attachment() * building.designed_stiffness)


def _scale(model: ElastomerModel, pattern: np.ndarray, loss_factor: float, target: float, braces: bool) -> float:
    """The least factor on a pattern with which the first mode has the target damping (Eq. 5.6).

    Raises:
        InputError: n <= 2 zeta.
        AnalysisError: the damping of the mode stays below the target.
    """
    stiffness_ratio(target, loss_factor)  # refuses what no frame allows

    def excess(scale: float) -> float:
        return model.first_damping(model.stiffness(scale * pattern, loss_factor, braces)) - target

    largest = -math.inf
    low = float(_SCALES[0])
    if excess(low) >= 0.0:
        raise InputError(f"a damping of {100.0 * target:.4g} % needs next to no dampers in this frame [E-DESIGN-04]")
    for high in _SCALES[1:].tolist():
        found = excess(high)
        largest = max(largest, found)
        if found >= 0.0:
            return float(scipy.optimize.brentq(excess, low, high, xtol=1e-14 * high, rtol=1e-14))
        low = high
    raise AnalysisError(
        f"these places and this distribution reach a damping of {100.0 * (largest + target):.4g} % in the first mode "
        f"at most (loss factor {loss_factor:.4g}), not {100.0 * target:.4g} % [E-DESIGN-04]"
    )
