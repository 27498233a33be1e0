"""Sizing of viscous dampers: coefficients with which the first mode, at its amplitude, has the target damping."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import partial

import numpy as np

from edesign.errors import InputError
from edesign.study.design.device_model import Sizing
from edesign.study.design.least_total import Problem, least_total
from edesign.study.design.pattern import pattern_of
from edesign.study.design.reach import REACHABLE, reach
from edesign.study.design.viscous.model import Dashpots, Vibration, ViscousModel

_SMALL = 0.01  # damping ratio that is below every limit that a design asks for
_LOCKED = 100.0  # damping ratio by energy at which dampers with a hundredth of it all are locked too
_FREE = 0.25  # omega c f up to which a dashpot hardly feels the flexibility f in series with it
_FIRST = 0.25
"""First trial over what the energy of the mode without dampers asks for. Damping is largest where that formula says at
most twice as much as there is (behind a brace, towards the brace's limit), so a quarter is below every optimum."""

MOST = 2.0
"""Of omega c / k_S, with which a storey by itself is critically damped: no spectrum says what more would do."""


@dataclass(frozen=True, eq=False, kw_only=True)
class ViscousSizing(Sizing):
    """Viscous dampers of a size.

    Attributes:
        vibration: of the frame with them.
        formula: damping ratio by FEMA 356, Eq. 9-32, with the first mode without dampers.
    """

    vibration: Vibration
    formula: float


def size_viscous(model: ViscousModel, target: float, factor: float = 1.0) -> ViscousSizing:
    """Find the coefficients of a target damping at the amplitude that the frame has with them.

    The target is the damping ratio of the first complex mode of the frame with linear dashpots of the same energy a
    cycle, and with the braces in series. Coefficients keep their distribution over the height.

    Args:
        target: damping ratio to be added; nan for the least coefficients.
        factor: on the coefficients, after they are found.

    Returns:
        The coefficients with the vibration of the frame; with a `reason` where the iteration did not converge.

    Raises:
        InputError: no coefficients reach the target, and no histories are to decide on that of the design.
        AnalysisError: no coefficients do what is wanted, or the frame is unstable.

    Source: distributions, Hwang, Lin and Wu (2013).
    """
    before: np.ndarray | None = None

    def coefficients(weight: np.ndarray, omega: float) -> np.ndarray:
        nonlocal before
        before = _coefficients(model, target, weight, omega, before)
        return before

    steps, reason = model.iterate(coefficients, model.undamped(0.0 if math.isnan(target) else target))
    vibration = steps[-1].vibration
    coefficient = factor * vibration.coefficient
    if factor != 1.0:
        vibration = model.in_agreement(coefficient, vibration)
    return ViscousSizing(
        target=target,
        size=coefficient,
        iterations=tuple(steps),
        reason=reason,
        reached=math.nan if math.isnan(target) else vibration.modes.first_damping,
        vibration=vibration,
        formula=model.formula(coefficient, vibration.roof),
    )


def sized_viscous(model: ViscousModel, coefficient: np.ndarray, start: Vibration) -> ViscousSizing:
    """Return dampers of given coefficients with the vibration of the frame.

    Args:
        coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.

    Raises:
        AnalysisError: amplitude and dashpots do not agree, or the first mode does not oscillate.
    """
    vibration = model.in_agreement(coefficient, start)
    formula = model.formula(coefficient, vibration.roof)
    return ViscousSizing(target=math.nan, size=coefficient, vibration=vibration, formula=formula)


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


def largest_viscous_damping(model: ViscousModel) -> float:
    """Return the largest damping ratio of the first mode that any coefficients of the design's distribution reach.

    The amplitude is that of the mode without dampers.
    """
    pattern, weight = pattern_of(model.building, model.spec.distribution), model.weight(model.undamped(0.0))
    damping_of = partial(_damping, model, pattern, weight)
    return reach(damping_of, math.inf, *_ends(model, pattern, weight, _SMALL))[1]


def _coefficients(
    model: ViscousModel, target: float, weight: np.ndarray, omega: float, before: np.ndarray | None
) -> np.ndarray:
    """Coefficients of the storeys (s,) for dashpots of a weight (d,) and a first frequency (rad/s)."""
    if model.spec.distribution == "least_coefficient":
        return least_coefficient(model, weight, omega, before)
    pattern = pattern_of(model.building, model.spec.distribution)
    ends = _ends(model, pattern, weight, target)
    scale, found = reach(partial(_damping, model, pattern, weight), target, *ends)
    if found < target:
        if model.spec.verify is None or target != model.spec.damping:
            raise InputError(_unreachable(model, target, found, before is not None))
        scale, _ = reach(partial(_damping, model, pattern, weight), REACHABLE * found, *ends)
    return scale * pattern


def _damping(model: ViscousModel, pattern: np.ndarray, weight: np.ndarray, scale: float) -> float:
    """Damping of the first mode with scaled coefficients."""
    coefficient = scale * pattern
    return model.modes(weight * model.at_places(coefficient), coefficient).first_damping


def _ends(model: ViscousModel, pattern: np.ndarray, weight: np.ndarray, target: float) -> tuple[float, float]:
    """Scales of a pattern below all that a damping ratio may need, and at which all dashpots are locked.

    A target far beyond what soft braces let the dampers reach says nothing of the former: a dashpot in series with
    the flexibility f of its brace, and of what the masses do not share, does most at omega c f of about 1, so at
    `_FREE` all are below it.
    """
    first, last = (_scale_of(model, pattern, weight, damping) for damping in (_FIRST * target, _LOCKED))
    shared = np.sum((model.bare.dampers / model.bare.omega[:, None]) ** 2, axis=0)
    flexibility = np.maximum(np.diag(model.building.frame.C) - shared, 0.0)
    if model.braces is not None:
        flexibility += 1.0 / model.braces
    felt = model.bare.first_omega * weight * model.at_places(pattern) * flexibility
    return min(first, _FREE / max(float(felt.max()), sys.float_info.min)), last


def _scale_of(model: ViscousModel, pattern: np.ndarray, weight: np.ndarray, damping: float) -> float:
    """Scale of a pattern with a damping ratio by the energy of the first mode without dampers."""
    bare = model.bare
    weights = weight * model.at_places(pattern)
    of_pattern = 0.5 * float(bare.lead.dampers**2 @ weights) / bare.first_omega
    return damping / of_pattern


def _unreachable(model: ViscousModel, target: float, found: float, followed: bool) -> str:
    """What is wrong with a target; `followed`: the amplitude is that of an iteration, not that of the bare mode."""
    at = " at the amplitude that so strong dampers have" if followed else ""
    cause = "the frame gives way where they stand"
    if model.brace is not None:
        cause = f"their braces are {float(model.ratios.min()):.4g} times as stiff as the storeys"
    elif math.isfinite(model.dashpot.spring):
        cause = f"the law {model.building.law.law.law} has a spring in series that grows with them"
    return (
        f"a damping of {100.0 * target:.4g} % is a target these dampers cannot reach: with `distribution: "
        f"{model.spec.distribution}` the first mode has {100.0 * found:.4g} % at most{at}, because {cause}"
        " [E-DESIGN-04]"
    )
