"""Sizing of hysteretic dampers: yield forces for a share of the storey shears, or for a damping of the first mode."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.project.dampers.designs import BraceRatio
from edesign.study.design.hysteretic.model import HystereticFrame, SecantVibration
from edesign.study.design.pattern import pattern_of
from edesign.study.design.reach import reach

_FIRST = 0.25
"""First trial over what rigid-plastic dampers would need in the first mode without dampers, whose secants add nothing
and whose loops are the fullest: damping less than that starts below every optimum."""
_SMALL = 0.01  # damping ratio that is below every limit that a design asks for
LARGEST_SHARE = 1.0  # of the storey shears: what takes more is no damper but a brace


@dataclass(frozen=True)
class HystereticSizing:
    """Hysteretic dampers of a size.

    Attributes:
        target: share of the storey shears, or damping ratio.
        yield_force: of all dampers of each storey along its drift, (s,) N.
        share: their sum over the sum of the shears of their storeys.
        vibration: of the frame with them.
        brace: horizontal stiffness of the braces of each storey with dampers, (s,) N/m; None: rigid.
        reason: why it is not good: never, a sizing that does not agree is an error.
    """

    target: float
    yield_force: np.ndarray
    share: float
    vibration: SecantVibration
    brace: np.ndarray | None
    reason: str = ""


def size_hysteretic(frame: HystereticFrame, target: float, factor: float = 1.0) -> HystereticSizing:
    """Find the yield forces of a target; they keep their distribution over the height.

    Args:
        frame: with its dampers' law.
        target: damping ratio to be added if the design gives a damping, else share of the storey shears.
        factor: on the yield forces, after they are found.

    Returns:
        The yield forces with the vibration of the frame.

    Raises:
        InputError: no yield forces reach the target.
        AnalysisError: the frame is unstable, or amplitude and secants do not agree.

    Source: equivalent damping: Jacobsen (1930); ASCE/SEI 7-16, 18.7.3; share of the shears: Inoue and Kuwahara (1998),
        Earthquake Engineering and Structural Dynamics 27.
    """
    share = target if frame.spec.damping is None else _share_of_damping(frame, target)
    found = factor * share * unit_forces(frame)
    return HystereticSizing(target, found, factor * share, frame.vibration(found), frame.brace)


def unit_forces(frame: HystereticFrame) -> np.ndarray:
    """Return yield forces in the distribution of the design whose sum is that of the storey shears, (s,) N.

    Args:
        frame: the frame of the design.
    """
    distribution = frame.spec.distribution
    if distribution == "storey_shear":
        return frame.shears
    pattern = pattern_of(frame.building, distribution)
    return np.asarray(pattern * (frame.shears.sum() / pattern.sum()))


def largest_hysteretic_damping(frame: HystereticFrame) -> float:
    """Return the largest damping ratio of the first mode that any yield forces of the design's distribution reach."""
    return _reach(frame, math.inf, _SMALL)[1]


def _share_of_damping(frame: HystereticFrame, target: float) -> float:
    """The least share of the storey shears with a damping ratio.

    Raises:
        InputError: there is none.
    """
    share, found = _reach(frame, target, target)
    if found < target:
        raise InputError(_unreachable(frame, target, share, found))
    return share


def _reach(frame: HystereticFrame, target: float, least: float) -> tuple[float, float]:
    """Share and damping of `reach`, from below what a damping ratio `least` needs."""
    unit = unit_forces(frame)
    first = min(_FIRST * least / frame.bare_damping(unit), LARGEST_SHARE)

    def damping_of(share: float) -> float:
        try:
            return frame.vibration(share * unit).damping
        except AnalysisError:  # of no use for the target, whatever it is
            return 0.0

    return reach(damping_of, target, first, LARGEST_SHARE)


def _unreachable(frame: HystereticFrame, target: float, share: float, found: float) -> str:
    spec, loop = frame.spec, frame.loop
    wanted = f"a damping of {100.0 * target:.4g} % is a target these dampers cannot reach"
    yielding = float(frame.yield_deformation.min())
    if float(loop.energy(np.array(2.0 * loop.yield_force / loop.stiffness))) <= 0.0:
        return f"{wanted}: their law `{spec.law}` dissipates nothing"
    if found <= 0.0:
        return f"{wanted}: they yield at {1e3 * yielding:.4g} mm, more than they deform at the amplitude of the design"
    cause = "they stiffen the frame more and more"
    if isinstance(spec.brace, BraceRatio):
        cause = f"their braces are {spec.brace.ratio:g} times as stiff as the storeys"
    where = "" if share >= LARGEST_SHARE else f", with {100.0 * share:.4g} % of the storey shears"
    return (
        f"{wanted}: with `distribution: {spec.distribution}` the first mode has {100.0 * found:.4g} % at "
        f"most{where}, because {cause}"
    )


def damping_curve(frame: HystereticFrame, unit: np.ndarray, shares: np.ndarray) -> tuple[SecantVibration | None, ...]:
    """Return the first mode with multiples of given yield forces.

    Args:
        frame: the frame of the design.
        unit: yield forces of factor 1, (s,) N.
        shares: factors on these, (n,).

    Returns:
        The vibration of each factor; None where its iteration does not converge.
    """
    found: list[SecantVibration | None] = []
    for share in shares.tolist():
        try:
            found.append(frame.vibration(share * unit))
        except AnalysisError:
            found.append(None)
    return tuple(found)
