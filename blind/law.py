"""The damper without hidden effects: thesis Eq. 4.29 as printed, in kN, mm and s.

Integration: the right-hand side R of F + tau F' = R is taken at the middle of each step and held, which the relaxation
passes exactly: F1 = e F0 + (1 - e) R, e = exp(-h/tau). Second order in the step.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.signal import lfilter

LAYERS, AREA_MM2, THICKNESS_MM = 2, 41400.0, 12.0
TABLE_4_2 = {
    "k1": 0.515,
    "c1": 0.0151,
    "k0": 0.107,
    "c_NL": 1.585,
    "alpha": 0.374,
    "k_a": 3.741,
    "k_b": 3.613,
    "u_ref": 7.966,
    "c_a": 0.902,
    "c_b": 0.190,
    "v_ref": 13.468,
}
"""kN, mm, s."""
MODULI = ("k1", "c1", "k0", "c_NL", "k_a", "k_b", "c_a", "c_b")
"""Parameters the force is proportional to, all together."""
TABLE_4_4 = ((20.0, 25.0, 30.0, 35.0), (1.0, 0.935, 0.875, 0.820))

Parameters = Mapping[str, float]


def at_temperature(p: Parameters, temperature: float) -> dict[str, float]:
    """Parameters at a temperature in degC: each times gamma_T, linear between values of Table 4.4 and beyond."""
    warmths, gammas = TABLE_4_4
    i = int(np.clip(np.searchsorted(warmths, temperature) - 1, 0, len(warmths) - 2))
    gamma = gammas[i] + (gammas[i + 1] - gammas[i]) / (warmths[i + 1] - warmths[i]) * (temperature - warmths[i])
    return {name: gamma * value for name, value in p.items()}


def stiffened(p: Parameters, factor: float) -> dict[str, float]:
    """Parameters that give `factor` times the force."""
    return {name: value * factor if name in MODULI else value for name, value in p.items()}


def middle(values: np.ndarray) -> np.ndarray:
    """Values at samples (n,) -> at the middle of steps (n-1,)."""
    return 0.5 * (values[1:] + values[:-1])


def velocity(u: np.ndarray, h: float) -> np.ndarray:
    """Velocity at samples (n,), mm/s."""
    return np.gradient(u, h)


@dataclass(frozen=True)
class Parts:
    """Right-hand side of Eq. 4.29 in each step, (n-1,) kN: what moduli, dashpots and the power-law dashpot give."""

    elastic: np.ndarray
    viscous: np.ndarray
    power: np.ndarray


def parts(p: Parameters, u: np.ndarray, h: float) -> Parts:
    """Right-hand side for a deformation (n,) mm at steps of h seconds, from fresh extremes."""
    v = np.diff(u) / h
    u_max = middle(_mean_extreme(u))
    v_max = _mean_extreme(v)
    k = p["k0"] + p["k_a"] * np.exp(-u_max / p["u_ref"]) + p["k_b"]
    c = relaxation(p) * p["k0"] + p["c1"] + p["c_a"] * np.exp(-v_max / p["v_ref"]) + p["c_b"]
    return Parts(k * middle(u), c * v, p["c_NL"] * np.abs(v) ** p["alpha"] * np.sign(v))


def relaxation(p: Parameters) -> float:
    """tau, s."""
    return p["c1"] / p["k1"]


def static_force(p: Parameters, u: float) -> float:
    """Force of a deformation held for long, from fresh extremes, kN."""
    return (p["k0"] + p["k_a"] * math.exp(-0.5 * abs(u) / p["u_ref"]) + p["k_b"]) * u


def relaxed(p: Parameters, right: np.ndarray, h: float, start: float = 0.0) -> np.ndarray:
    """Force (n,) kN of a right-hand side in each step (n-1,)."""
    e = math.exp(-h / relaxation(p))
    force, _ = lfilter([1.0 - e], [1.0, -e], right, zi=[e * start])
    return np.concatenate([[start], force])


def force(p: Parameters, u: np.ndarray, h: float) -> np.ndarray:
    """Force (n,) kN of the damper as declared, from rest."""
    q = parts(p, u, h)
    return relaxed(p, q.elastic + q.viscous + q.power, h, static_force(p, float(u[0])))


def _mean_extreme(x: np.ndarray) -> np.ndarray:
    return 0.5 * (np.maximum.accumulate(np.maximum(x, 0.0)) - np.minimum.accumulate(np.minimum(x, 0.0)))
