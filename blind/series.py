"""What is in series with the damper: its deformation is found step by step so that both carry the same force."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from blind.law import Parameters, relaxation, static_force

NOTHING = 1e-30  # kN
Joint = Callable[[float], tuple[float, float]]
"""Force kN and slope kN/mm of the joint for its own deformation in mm; never falling."""


@dataclass(frozen=True)
class Changes:
    """What effects add: factors in each step (n-1,), right-hand side (n-1,) kN, force beside the damper (n,) kN."""

    elastic: np.ndarray
    viscous: np.ndarray
    power: np.ndarray
    right: np.ndarray
    parallel: np.ndarray

    def mean(self, other: Changes) -> Changes:
        """Half-way to others."""
        return Changes(*(0.5 * (a + b) for a, b in zip(vars(self).values(), vars(other).values(), strict=True)))


def deformation(p: Parameters, x: np.ndarray, h: float, joint: Joint, changes: Changes) -> np.ndarray:
    """Deformation of the damper (n,) mm under a displacement (n,) mm of damper and joint.

    The law is that of blind.law, with the same rule for a step; its running extremes are looked ahead by half a step.
    """
    e = math.exp(-h / relaxation(p))
    g = 1.0 - e
    alpha, u_ref, v_ref = p["alpha"], p["u_ref"], p["v_ref"]
    k_stays, c_stays = p["k0"] + p["k_b"], relaxation(p) * p["k0"] + p["c1"] + p["c_b"]
    columns = (
        x[1:],
        changes.elastic,
        changes.viscous,
        changes.power * p["c_NL"] * g,
        changes.right,
        changes.parallel[1:],
    )
    u, v = float(x[0]), 0.0
    relaxing = static_force(p, u)
    highest, lowest, fastest, slowest = max(u, 0.0), min(u, 0.0), 0.0, 0.0
    soft_k, soft_c = p["k_a"] * math.exp(-0.5 * (highest - lowest) / u_ref), p["c_a"]
    out = [u]
    exp = math.exp
    for x1, fk, fc, d, right, parallel in zip(*(column.tolist() for column in columns), strict=True):
        ahead = u + 0.5 * h * v
        if ahead > highest or ahead < lowest:
            highest, lowest = max(highest, ahead), min(lowest, ahead)
            soft_k = p["k_a"] * exp(-0.5 * (highest - lowest) / u_ref)
        if v > fastest or v < slowest:
            fastest, slowest = max(fastest, v), min(slowest, v)
            soft_c = p["c_a"] * exp(-0.5 * (fastest - slowest) / v_ref)
        k = fk * (k_stays + soft_k)
        known = e * relaxing + g * (k * u + right) + parallel
        slope = g * (0.5 * h * k + fc * (c_stays + soft_c))
        for _ in range(30):
            w = x1 - u - h * v
            carried, stiffness = joint(w)
            # known + slope v + d |v|^alpha = carried + stiffness (w_new - w), w_new = x1 - u - h v
            new = power_root(slope + h * stiffness, d, alpha, carried + stiffness * (x1 - u - w) - known, v)
            if abs(new - v) * h <= 1e-9 + 1e-7 * abs(w):
                v = new
                break
            v = new
        relaxing = e * relaxing + g * (k * (u + 0.5 * h * v) + right) + (slope - g * 0.5 * h * k) * v
        relaxing += d * abs(v) ** alpha * (1.0 if v > 0.0 else -1.0)
        u += h * v
        out.append(u)
    return np.array(out)


def power_root(m: float, d: float, alpha: float, right: float, guess: float) -> float:
    """The v with m v + d |v|^alpha sgn v = right; m, d > 0. Newton from below, where it cannot overshoot."""
    if abs(right) < NOTHING:
        return 0.0
    sign, right = (1.0, right) if right > 0.0 else (-1.0, -right)
    y = guess * sign
    least = 0.0
    for _ in range(60):
        if y <= 0.0:
            if not least:
                least = min(0.5 * right / m, (0.5 * right / d) ** (1.0 / alpha))
            y = least
        p = d * y ** (alpha - 1.0)
        step = (right - (m + p) * y) / (m + alpha * p)
        y += step
        if abs(step) <= 1e-9 * y:
            break
    return sign * y
