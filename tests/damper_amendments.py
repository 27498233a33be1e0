"""Amendments of damper laws by their definitions (docs/laws/effects.md), in numpy on the samples, and examples."""

from __future__ import annotations

from collections.abc import Sequence
from math import exp

import numpy as np
from scipy.special import erf

from edesign.damper.amendments import Amendment

EXAMPLES: dict[tuple[str, str], dict[str, float]] = {
    ("payne", "whole"): {"d": 0.3, "a0": 3e-3, "m": 1.2, "tau_a": 3.0},
    ("payne", "elastic"): {"k": 2e6, "a0": 3e-3, "m": 0.8, "tau_a": 1.0},
    ("mullins", "path"): {"m": 0.4, "s0": 0.03},
    ("mullins", "maximum"): {"m": 0.3, "r": 4e-3, "recovery": 0.5},
    ("mullins", "elastic"): {"k": 1.5e6, "s0": 0.04},
    ("degradation", "energy"): {"d": 0.25, "E0": 300.0},
    ("self_heating", "rate"): {"beta": 3e-4, "tau_h": 20.0},
    ("temperature_law", "exponential"): {"b": 0.02, "T0": 20.0},
    ("ageing", "linear"): {"rate": -0.01, "n": 7.0},
    ("hardening", "power"): {"k": 1.2e6, "p": 3.5, "r": 6e-3},
    ("hardening", "threshold"): {"k": 3e6, "u0": 3.3e-3},
    ("one_sided", "factor"): {"b": 0.15, "side": -1.0},
    ("one_sided", "spring"): {"k": 2e6, "u0": 1.7e-3, "side": -1.0},
    ("relaxation_branch", "maxwell"): {"k": 2e6, "tau": 0.2},
    ("velocity_power", "dashpot"): {"c": 8e3, "alpha": 0.4},
}


def example(name: str, form: str) -> Amendment:
    """An amendment that changes forces of some ten kN at some mm visibly."""
    return Amendment(name, form, EXAMPLES[name, form])


def amended(
    amendments: Sequence[Amendment],
    law_force: np.ndarray,
    time: np.ndarray,
    u: np.ndarray,
    v: np.ndarray,
    temperature_C: float | None = None,
) -> np.ndarray:
    """Force (n,) N of a law with amendments, of the law's own force (n,) N, all by the definitions."""
    n = time.size
    h, du = np.diff(time), np.diff(u)
    path = np.concatenate(([0.0], np.cumsum(np.abs(du))))
    largest = np.maximum.accumulate(np.abs(u))
    phi, beside = np.ones(n), np.zeros(n)
    counted = []
    for one in amendments:
        p = one.values
        match one.kind.name:
            case "payne.whole":
                phi *= 1.0 - p["d"] * _broken(p, h, u)
            case "payne.elastic":
                beside -= p["k"] * _broken(p, h, u) * u
            case "mullins.path":
                phi *= 1.0 + p["m"] * np.exp(-path / p["s0"])
            case "mullins.maximum":
                phi *= 1.0 - p["m"] * erf((largest - np.abs(u)) / p["r"])
            case "mullins.elastic":
                beside += p["k"] * np.exp(-path / p["s0"]) * u
            case "temperature_law.exponential":
                phi *= 1.0 if temperature_C is None else exp(-p["b"] * (temperature_C - p["T0"]))
            case "ageing.linear":
                phi *= 1.0 + p["rate"] * p["n"]
            case "hardening.power":
                beside += p["k"] * u * (np.abs(u) / p["r"]) ** (p["p"] - 1.0)
            case "hardening.threshold":
                beside += p["k"] * np.maximum(np.abs(u) - p["u0"], 0.0) * np.sign(u)
            case "one_sided.factor":
                phi *= np.where(p["side"] * u > 0.0, 1.0 + p["b"], 1.0)
            case "one_sided.spring":
                beside += p["k"] * np.maximum(p["side"] * u - p["u0"], 0.0) * p["side"]
            case "relaxation_branch.maxwell":
                beside += _branch(p, h, v)
            case "velocity_power.dashpot":
                beside += p["c"] * np.abs(v) ** p["alpha"] * np.sign(v)
            case _:
                counted.append(one)
    return _with_work(counted, phi * law_force, h, du) + beside


def _broken(p: dict[str, float], h: np.ndarray, u: np.ndarray) -> np.ndarray:
    a = np.empty_like(u)
    a[0] = abs(u[0])
    for i, step in enumerate(h):
        a[i + 1] = max(abs(u[i + 1]), a[i] * exp(-step / p["tau_a"]))
    ratio = (a / p["a0"]) ** p["m"]
    return ratio / (1.0 + ratio)


def _branch(p: dict[str, float], h: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Q' + Q/tau = k v: the particular solution of a linear velocity is k tau (v - tau v')."""
    k, tau = p["k"], p["tau"]
    q = np.zeros_like(v)
    for i, step in enumerate(h):
        slope = (v[i + 1] - v[i]) / step
        q[i + 1] = exp(-step / tau) * (q[i] - k * tau * (v[i] - tau * slope)) + k * tau * (v[i + 1] - tau * slope)
    return q


def _with_work(counted: Sequence[Amendment], force: np.ndarray, h: np.ndarray, du: np.ndarray) -> np.ndarray:
    """Times the factors of work and heat, which act from the next sample on."""
    state = [0.0] * len(counted)
    found = np.empty_like(force)
    for i in range(force.size):
        phi = 1.0
        for one, x in zip(counted, state, strict=True):
            p = one.values
            phi *= exp(-x) if one.name == "self_heating" else 1.0 - p["d"] * (1.0 - exp(-max(x, 0.0) / p["E0"]))
        found[i] = phi * force[i]
        if i == 0:
            continue
        work = 0.5 * (found[i - 1] + found[i]) * du[i - 1]
        for j, one in enumerate(counted):
            p = one.values
            heats = one.name == "self_heating"
            state[j] = state[j] * exp(-h[i - 1] / p["tau_h"]) + p["beta"] * work if heats else state[j] + work
    return found
