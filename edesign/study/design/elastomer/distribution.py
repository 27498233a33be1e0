"""Stiffness of the dampers of each storey for a target damping, by several distributions over the height."""

from __future__ import annotations

import math

import numpy as np
import scipy

from edesign.damper.sizing import stiffness_ratio
from edesign.errors import AnalysisError, InputError
from edesign.project.dampers.designs import BraceRatio, StrainEnergyDesign
from edesign.study.design.building import Building
from edesign.study.design.damping import strain_energy_damping
from edesign.study.design.elastomer.least_area import least_area
from edesign.study.design.elastomer.material import Moduli
from edesign.study.design.elastomer.sizing import place_stiffness
from edesign.study.design.estimate import Action
from edesign.study.design.pattern import pattern_of

_SCALES = np.geomspace(1e-4, 1e4, 81)  # of the dampers' stiffness over that of the storeys


def distribute(
    building: Building,
    spec: StrainEnergyDesign,
    moduli: Moduli,
    target: float,
    in_target: np.ndarray | None,
    action: Action | None,
    brace: np.ndarray | None,
    thickness: float,
    before: np.ndarray | None,
) -> np.ndarray:
    """Return the storage stiffness k_D of each storey with dampers in the distribution of a design, (s,) N/m.

    Args:
        building: the frame with its places.
        spec: the design.
        moduli: of the elastomer.
        target: damping ratio to be added.
        in_target: horizontal stiffness of the braces that count in it, (s,) N/m; None: they do not.
        action: spectrum and damping without dampers, for the distribution `least_area`; None: not needed.
        brace: horizontal stiffness of the braces of each storey, (s,) N/m; None: rigid.
        thickness: thickness of a layer, m.
        before: k_D of the previous iteration, (s,) N/m, from which `least_area` starts; None: none.

    Raises:
        InputError: no damper reaches the target.
        AnalysisError: this distribution does not reach it.
    """
    if spec.distribution == "least_area":
        assert action is not None and spec.drift is not None, "check_design wants them"
        args = (building, moduli, action, spec.drift, brace, thickness, before)
        return least_area(*args, nearest=spec.verify is not None and spec.verify.change == "area")
    if spec.distribution == "storey_stiffness" and spec.target_in != "first_mode":
        ratio = math.inf
        if in_target is not None and isinstance(spec.brace, BraceRatio):
            ratio = spec.brace.ratio
        return stiffness_ratio(target, moduli.loss_factor, ratio) * building.designed_stiffness
    pattern = pattern_of(building, spec.distribution)
    return _scale(building, pattern, moduli.loss_factor, target, in_target) * pattern


def _scale(
    building: Building, pattern: np.ndarray, loss_factor: float, target: float, in_target: np.ndarray | None
) -> float:
    """The least factor on a pattern with which the first mode has the target damping (Eq. 5.6).

    Raises:
        InputError: n <= 2 zeta.
        AnalysisError: the damping of the mode stays below the target.
    """
    stiffness_ratio(target, loss_factor)  # refuses what no frame allows

    def excess(scale: float) -> float:
        at_places = place_stiffness(building, scale * pattern, loss_factor, in_target)
        return float(strain_energy_damping(building.frame.modes(at_places.real), at_places)[0]) - target

    largest = -math.inf
    low = float(_SCALES[0])
    if excess(low) >= 0.0:
        raise InputError(f"a damping of {100.0 * target:.4g} % needs next to no dampers in this frame")
    for high in _SCALES[1:].tolist():
        found = excess(high)
        largest = max(largest, found)
        if found >= 0.0:
            return float(scipy.optimize.brentq(excess, low, high, xtol=1e-14 * high, rtol=1e-14))
        low = high
    raise AnalysisError(
        f"these places and this distribution reach a damping of {100.0 * (largest + target):.4g} % in the first mode "
        f"at most (loss factor {loss_factor:.4g}), not {100.0 * target:.4g} %"
    )
