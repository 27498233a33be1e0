"""Elastic members that leave out the flexibility of springs at their ends."""

from __future__ import annotations

import numpy as np

from edesign.frame.loads import MemberLoads


def _flexibility(EI: float, length: float) -> np.ndarray:
    """Of a plain simply supported member, turns over moments at its ends, (2, 2) rad/(N m)."""
    return length / (6.0 * EI) * np.array([[2.0, -1.0], [-1.0, 2.0]])


def stiffness_factors(EI: float, length: float, without: tuple[float, float]) -> tuple[float, float, float]:
    """Return K11, K33 and K44 of `ModElasticBeam2d`: the stiffness of both ends and between them, over E I / L.

    Args:
        EI: N m2.
        length: m.
        without: flexibilities that its ends leave out, rad/(N m).
    """
    stiffness = np.linalg.inv(_flexibility(EI, length) - np.diag(without)) * length / EI
    return float(stiffness[0, 0]), float(stiffness[1, 1]), float(stiffness[0, 1])


def released_flexibility_loads(
    EI: float, length: float, without: tuple[float, float], loads: MemberLoads
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return (force across, moment) on both ends that a member lacks whose fixed-end moments are of a plain one.

    The loads turn the ends of the simply supported member as they turn a plain one, and the stiffer ends hold that back
    with larger moments.

    Args:
        EI: N m2.
        length: m.
        without: flexibilities that its ends leave out, rad/(N m).
        loads: uniform and point loads, positive along its local y axis.
    """
    at_ends = np.zeros(2)  # that hold a plain member, anticlockwise
    at_ends += loads.uniform * length**2 / 12.0 * np.array([-1.0, 1.0])
    for position, force in loads.points:
        other = 1.0 - position
        at_ends += force * length * position * other * np.array([-other, position])
    plain = _flexibility(EI, length)
    missing = np.linalg.inv(plain - np.diag(without)) @ plain @ at_ends - at_ends
    across = float(missing.sum()) / length
    return (-across, -float(missing[0])), (across, -float(missing[1]))
