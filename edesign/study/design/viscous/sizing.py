"""Sizing of viscous dampers: coefficients with which the first mode, at its amplitude, has the target damping."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from functools import partial

import numpy as np

from edesign.errors import InputError
from edesign.project.dampers.designs import BraceRatio
from edesign.study.design.pattern import pattern_of
from edesign.study.design.reach import reach
from edesign.study.design.relaxation import AGREEMENT, MOST_ITERATIONS, Relaxation
from edesign.study.design.viscous.least_coefficient import least_coefficient
from edesign.study.design.viscous.model import Vibration, ViscousFrame, difference

_SMALL = 0.01  # damping ratio that is below every limit that a design asks for
_LOCKED = 100.0  # damping ratio by energy at which dampers with a hundredth of it all are locked too
_FREE = 0.25  # omega c f up to which a dashpot hardly feels the flexibility f in series with it
_FIRST = 0.25
"""First trial over what the energy of the mode without dampers asks for. Damping is largest where that formula says at
most twice as much as there is (behind a brace, towards the brace's limit), so a quarter is below every optimum."""


@dataclass(frozen=True)
class ViscousStep:
    """One step of the sizing.

    Attributes:
        vibration: with the dashpots of this step.
        coefficient: of the storeys with dampers along their drift, (s,) N (s/m)^alpha.
        difference: largest one of a linear dashpot from that of the amplitude that comes of it, over the latter.
    """

    vibration: Vibration
    coefficient: np.ndarray
    difference: float


@dataclass(frozen=True)
class ViscousSizing:
    """Viscous dampers of a size.

    Attributes:
        target: damping ratio; nan: none.
        coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        vibration: of the frame with them.
        formula: damping ratio by FEMA 356, Eq. 9-32, with the first mode without dampers.
        brace: horizontal stiffness of the braces of each storey with dampers, (s,) N/m; None: rigid.
        iterations: how it was found.
        reason: why it is not good; empty if it is.
    """

    target: float
    coefficient: np.ndarray
    vibration: Vibration
    formula: float
    brace: np.ndarray | None
    iterations: tuple[ViscousStep, ...]
    reason: str = ""


def size_viscous(frame: ViscousFrame, target: float, factor: float = 1.0) -> ViscousSizing:
    """Find the coefficients of a target damping at the amplitude that the frame has with them.

    The target is the damping ratio of the first complex mode of the frame with linear dashpots of the same energy a
    cycle, and with the braces in series. Coefficients keep their distribution over the height.

    Args:
        frame: with its dampers' law.
        target: damping ratio to be added; nan for the least coefficients.
        factor: on the coefficients, after they are found.

    Returns:
        The coefficients with the vibration of the frame; with a `reason` where the iteration did not converge.

    Raises:
        InputError: no coefficients reach the target.
        AnalysisError: no coefficients do what is wanted, or the frame is unstable.

    Source: equivalent linear dashpots, Constantinou and Symans (1993); distributions, Hwang, Lin and Wu (2013).
    """
    start = frame.undamped(0.0 if math.isnan(target) else target)
    weight, omega, relax = frame.weight(start), start.omega, Relaxation()
    steps: list[ViscousStep] = []
    reason = f"amplitude and dashpots did not agree to {AGREEMENT:g} within {MOST_ITERATIONS} iterations"
    coefficient: np.ndarray | None = None
    while len(steps) < MOST_ITERATIONS:
        coefficient = _coefficients(frame, target, weight, omega, coefficient)
        vibration = frame.vibration(coefficient, weight, frame.roof)
        found, omega = frame.weight(vibration), vibration.omega
        steps.append(ViscousStep(vibration, coefficient, difference(weight, found)))
        if steps[-1].difference <= AGREEMENT:
            reason = ""
            break
        weight = np.exp(relax(np.log(weight), np.log(found)))
    assert coefficient is not None
    if factor != 1.0:
        coefficient = factor * coefficient
        vibration = frame.in_agreement(coefficient, vibration, frame.roof)
    formula = frame.formula(coefficient, vibration.roof)
    return ViscousSizing(target, coefficient, vibration, formula, frame.brace, tuple(steps), reason)


def sized_viscous(frame: ViscousFrame, coefficient: np.ndarray, start: Vibration) -> ViscousSizing:
    """Return dampers of given coefficients with the vibration of the frame.

    Args:
        frame: with its dampers' law.
        coefficient: of all dampers of each storey along its drift, (s,) N (s/m)^alpha.
        start: a vibration with other coefficients.

    Raises:
        AnalysisError: amplitude and dashpots do not agree, or the first mode does not oscillate.
    """
    vibration = frame.in_agreement(coefficient, start, frame.roof)
    return ViscousSizing(math.nan, coefficient, vibration, frame.formula(coefficient, vibration.roof), frame.brace, ())


def largest_viscous_damping(frame: ViscousFrame) -> float:
    """Return the largest damping ratio of the first mode that any coefficients of the design's distribution reach.

    The amplitude is that of the mode without dampers.

    Args:
        frame: the frame of the design.
    """
    pattern, weight = pattern_of(frame.building, frame.spec.distribution), frame.weight(frame.undamped(0.0))
    damping_of = partial(_damping, frame, pattern, weight)
    return reach(damping_of, math.inf, *_ends(frame, pattern, weight, _SMALL))[1]


def _coefficients(
    frame: ViscousFrame, target: float, weight: np.ndarray, omega: float, before: np.ndarray | None
) -> np.ndarray:
    """Coefficients of the storeys (s,) for dashpots of a weight (d,) and a first frequency (rad/s)."""
    if frame.spec.distribution == "least_coefficient":
        return least_coefficient(frame, weight, omega, before)
    pattern = pattern_of(frame.building, frame.spec.distribution)
    ends = _ends(frame, pattern, weight, target)
    scale, found = reach(partial(_damping, frame, pattern, weight), target, *ends)
    if found < target:
        raise InputError(_unreachable(frame, target, found, before is not None))
    return scale * pattern


def _damping(frame: ViscousFrame, pattern: np.ndarray, weight: np.ndarray, scale: float) -> float:
    """Damping of the first mode with scaled coefficients."""
    coefficient = scale * pattern
    return frame.modes(weight * frame.at_places(coefficient), coefficient).first_damping


def _ends(frame: ViscousFrame, pattern: np.ndarray, weight: np.ndarray, target: float) -> tuple[float, float]:
    """Scales of a pattern below all that a damping ratio may need, and at which all dashpots are locked.

    A target far beyond what soft braces let the dampers reach says nothing of the former: a dashpot in series with
    the flexibility f of its brace, and of what the masses do not share, does most at omega c f of about 1, so at
    `_FREE` all are below it.
    """
    first, last = (_scale_of(frame, pattern, weight, damping) for damping in (_FIRST * target, _LOCKED))
    shared = np.sum((frame.bare.dampers / frame.bare.omega[:, None]) ** 2, axis=0)
    flexibility = np.maximum(np.diag(frame.building.frame.C) - shared, 0.0)
    if frame.brace is not None:
        flexibility += 1.0 / frame.building.at_places(frame.brace)
    felt = float(frame.bare.omega[0]) * weight * frame.at_places(pattern) * flexibility
    return min(first, _FREE / max(float(felt.max()), sys.float_info.min)), last


def _scale_of(frame: ViscousFrame, pattern: np.ndarray, weight: np.ndarray, damping: float) -> float:
    """Scale of a pattern with a damping ratio by the energy of the first mode without dampers."""
    bare = frame.bare
    of_pattern = 0.5 * float(bare.dampers[0] ** 2 @ (weight * frame.at_places(pattern))) / float(bare.omega[0])
    return damping / of_pattern


def _unreachable(frame: ViscousFrame, target: float, found: float, followed: bool) -> str:
    """What is wrong with a target; `followed`: the amplitude is that of an iteration, not that of the bare mode."""
    brace, at = frame.spec.brace, " at the amplitude that so strong dampers have" if followed else ""
    cause = "the frame gives way where they stand"
    if isinstance(brace, BraceRatio):
        cause = f"their braces are {brace.ratio:g} times as stiff as the storeys"
    elif math.isfinite(frame.dashpot.spring):
        cause = f"the law {frame.building.law.law.law} has a spring in series that grows with them"
    return (
        f"a damping of {100.0 * target:.4g} % is a target these dampers cannot reach: with `distribution: "
        f"{frame.spec.distribution}` the first mode has {100.0 * found:.4g} % at most{at}, because {cause}"
    )
