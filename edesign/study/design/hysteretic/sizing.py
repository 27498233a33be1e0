"""Sizing of hysteretic dampers: yield forces for a share of the storey shears, or for a damping of the first mode."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from edesign.errors import AnalysisError, InputError
from edesign.study.design.device_model import Sizing
from edesign.study.design.hysteretic.model import HystereticModel, SecantVibration
from edesign.study.design.hysteretic.vibration import bare_damping, secant_vibration
from edesign.study.design.pattern import pattern_of
from edesign.study.design.reach import REACHABLE, reach

_FIRST = 0.25
"""First trial over what rigid-plastic dampers would need in the first mode without dampers, whose secants add nothing
and whose loops are the fullest: damping less than that starts below every optimum."""
_SMALL = 0.01  # damping ratio that is below every limit that a design asks for
LARGEST_SHARE = 1.0  # of the storey shears: what takes more is no damper but a brace


@dataclass(frozen=True, eq=False, kw_only=True)
class HystereticSizing(Sizing):
    """Hysteretic dampers of a size; what does not agree is an error, so that there is never a `reason`.

    Attributes:
        share: the sum of the yield forces over the sum of the shears of their storeys.
        vibration: of the frame with them.
    """

    share: float
    vibration: SecantVibration


def size_hysteretic(model: HystereticModel, target: float, factor: float = 1.0) -> HystereticSizing:
    """Find the yield forces of a target; they keep their distribution over the height.

    Args:
        target: damping ratio to be added if the design gives a damping, else share of the storey shears.
        factor: on the yield forces, after they are found.

    Returns:
        The yield forces with the vibration of the frame.

    Raises:
        InputError: no yield forces reach the target, and no histories are to decide on that of the design.
        AnalysisError: the frame is unstable, or amplitude and secants do not agree.

    Source: equivalent damping: Jacobsen (1930); ASCE/SEI 7-16, 18.7.3; share of the shears: Inoue and Kuwahara (1998),
        Earthquake Engineering and Structural Dynamics 27.
    """
    share = target if model.spec.damping is None else _share_of_damping(model, target)
    found = factor * share * unit_forces(model)
    vibration = secant_vibration(model, found)
    reached = math.nan if model.spec.damping is None else vibration.damping
    return HystereticSizing(target=target, size=found, share=factor * share, vibration=vibration, reached=reached)


def unit_forces(model: HystereticModel) -> np.ndarray:
    """Return yield forces in the distribution of the design whose sum is that of the storey shears, (s,) N."""
    distribution = model.spec.distribution
    if distribution == "storey_shear":
        return model.shears
    pattern = pattern_of(model.building, distribution)
    return np.asarray(pattern * (model.shears.sum() / pattern.sum()))


def largest_hysteretic_damping(model: HystereticModel) -> float:
    """Return the largest damping ratio of the first mode that any yield forces of the design's distribution reach."""
    return _reach(model, math.inf, _SMALL)[1]


def _share_of_damping(model: HystereticModel, target: float) -> float:
    """The least share of the storey shears with a damping ratio, or nearly the largest where histories are to decide.

    Raises:
        InputError: there is none.
    """
    share, found = _reach(model, target, target)
    if found >= target:
        return share
    if model.spec.verify is None or target != model.spec.damping or found <= 0.0:
        raise InputError(_unreachable(model, target, share, found))
    return _reach(model, REACHABLE * found, REACHABLE * found)[0]


def _reach(model: HystereticModel, target: float, least: float) -> tuple[float, float]:
    """Share and damping of `reach`, from below what a damping ratio `least` needs."""
    unit = unit_forces(model)
    first = min(_FIRST * least / bare_damping(model, unit), LARGEST_SHARE)

    def damping_of(share: float) -> float:
        found = vibration_of(model, share * unit)
        return 0.0 if found is None else found.damping  # of no use for the target, whatever it is

    return reach(damping_of, target, first, LARGEST_SHARE)


def _unreachable(model: HystereticModel, target: float, share: float, found: float) -> str:
    spec, loop = model.spec, model.loop
    wanted = f"a damping of {100.0 * target:.4g} % is a target these dampers cannot reach"
    yielding = float(model.yield_deformation.min())
    if float(loop.energy(np.array(2.0 * loop.yield_force / loop.stiffness))) <= 0.0:
        return f"{wanted}: their law `{spec.law}` dissipates nothing [E-DESIGN-03]"
    if found <= 0.0:
        return (
            f"{wanted}: they yield at {1e3 * yielding:.4g} mm, more than they deform at the amplitude of the design"
            " [E-DESIGN-04]"
        )
    cause = "they stiffen the frame more and more"
    if model.brace is not None:
        cause = f"their braces are {float(model.ratios.min()):.4g} times as stiff as the storeys"
    where = "" if share >= LARGEST_SHARE else f", with {100.0 * share:.4g} % of the storey shears"
    return (
        f"{wanted}: with `distribution: {spec.distribution}` the first mode has {100.0 * found:.4g} % at "
        f"most{where}, because {cause} [E-DESIGN-04]"
    )


def vibration_of(model: HystereticModel, yield_force: np.ndarray) -> SecantVibration | None:
    """Return the first mode with dampers of given yield forces; None where its iteration does not converge.

    Args:
        yield_force: of all dampers of each storey along its drift, (s,) N.
    """
    try:
        return secant_vibration(model, yield_force)
    except AnalysisError:
        return None
