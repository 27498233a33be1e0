"""Amendments of damper laws by their definitions (docs/reference/laws/effects.md), in numpy on samples; examples."""

from __future__ import annotations

from collections.abc import Sequence
from math import exp, log

import numpy as np
from scipy.special import erf

from edesign.damper.amendments import AMENDMENTS, Amendment

EXAMPLES: dict[tuple[str, str], dict[str, float]] = {
    ("payne", "whole"): {"d": 0.3, "a0": 3e-3, "m": 1.2, "tau_a": 3.0},
    ("payne", "elastic"): {"k": 2e6, "a0": 3e-3, "m": 0.8, "tau_a": 1.0},
    ("mullins", "path"): {"m": 0.4, "s0": 0.03},
    ("mullins", "maximum"): {"m": 0.3, "r": 4e-3, "recovery": 0.5},
    ("mullins", "elastic"): {"k": 1.5e6, "s0": 0.04},
    ("degradation", "energy"): {"d": 0.25, "E0": 300.0},
    ("self_heating", "rate"): {"beta": 3e-4, "tau_h": 20.0},
    ("temperature_law", "exponential"): {"b": 0.02, "T0": 20.0},
    ("temperature_law", "wlf"): {"b": 0.03, "c": 0.01, "T0": 20.0},
    ("temperature_law", "transition"): {"d": 0.3, "Tc": 28.0, "w": 4.0, "T0": 20.0},
    ("ageing", "linear"): {"rate": -0.01, "n": 7.0},
    ("hardening", "power"): {"k": 1.2e6, "p": 3.5, "r": 6e-3},
    ("hardening", "threshold"): {"k": 3e6, "u0": 3.3e-3},
    ("one_sided", "factor"): {"b": 0.15, "side": -1.0},
    ("one_sided", "spring"): {"k": 2e6, "u0": 1.7e-3, "side": -1.0},
    ("one_sided", "contact"): {"k": 4e6, "u0": 1.2e-3, "n": 1.6, "side": 1.0, "r": 3e-3},
    ("one_sided", "even"): {"k": 8e5, "n": 2.1, "r": 5e-3},
    ("relaxation_branch", "maxwell"): {"k": 2e6, "tau": 0.2},
    ("velocity_exponent", "dashpot"): {"c": 8e3, "alpha": 0.4},
    ("payne", "network"): {"d": 0.3, "s0": 0.01, "tau": 2.0},
    ("mullins", "damage"): {"m": 0.25, "r": 4e-3, "p": 1.4, "recovery": 0.2},
    ("velocity_exponent", "flow"): {"f": 1.5e3, "v0": 4e-3},
    ("degradation", "path"): {"d": 0.2, "p": 1.3, "S": 0.1},
    ("ageing", "logarithmic"): {"rate": -0.03, "n": 7.0},
}
EXAMPLES |= {kind: EXAMPLES[kind[0], kind[1].removesuffix("_inside")] for kind in AMENDMENTS if AMENDMENTS[kind].inside}


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
    tau: float = 0.0,
) -> np.ndarray:
    """Force (n,) N of a law with amendments, of the law's own force (n,) N, all by the definitions.

    tau: of the law, s, for those inside it; it has been held before the first sample.
    """
    beside = tuple(one for one in amendments if not one.kind.inside)
    inside = np.zeros_like(u)
    for one in amendments:
        if one.kind.inside:
            same = Amendment(one.name, one.form.removesuffix("_inside"), one.values)
            inside += _inside(same, law_force, time, u, v, tau)
    return _beside(beside, law_force, time, u, v, temperature_C, inside)


def _inside(
    one: Amendment, law_force: np.ndarray, time: np.ndarray, u: np.ndarray, v: np.ndarray, tau: float
) -> np.ndarray:
    """Q + tau Q' = g: for g a polynomial of time over the step, g - tau g' + tau^2 g'' and what fades from it."""
    force = _beside((one,), np.zeros_like(u), time, u, v, None)
    phi = _beside((one,), np.ones_like(u), time, u, v, None) - force
    q = np.empty_like(u)
    q[0] = (phi[0] - 1.0) * law_force[0] + (0.0 if one.name == "velocity_exponent" else force[0])
    for i, h in enumerate(np.diff(time)):
        rate = (law_force[i + 1] - law_force[i]) / h
        share = np.polynomial.Polynomial([phi[i] - 1.0, (phi[i + 1] - phi[i]) / h])
        before_relaxing = np.polynomial.Polynomial([law_force[i] + tau * rate, rate])
        g = share * before_relaxing + np.polynomial.Polynomial([force[i], (force[i + 1] - force[i]) / h])
        steady = g - tau * g.deriv() + tau**2 * g.deriv(2)
        q[i + 1] = steady(h) + (q[i] - steady(0.0)) * exp(-h / tau)
    return q


def _beside(
    amendments: Sequence[Amendment],
    law_force: np.ndarray,
    time: np.ndarray,
    u: np.ndarray,
    v: np.ndarray,
    temperature_C: float | None,
    inside: np.ndarray | float = 0.0,
) -> np.ndarray:
    n = time.size
    h, du = np.diff(time), np.diff(u)
    path = np.concatenate(([0.0], np.cumsum(np.abs(du))))
    largest = np.maximum.accumulate(np.abs(u))
    phi, beside = np.ones(n), np.zeros(n) + inside
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
            case "temperature_law.wlf":
                w = 0.0 if temperature_C is None else temperature_C - p["T0"]
                phi *= exp(-p["b"] * w / (1.0 + p["c"] * w))
            case "temperature_law.transition":
                at = [
                    1.0 / (1.0 + exp(-(degrees - p["Tc"]) / p["w"])) for degrees in (temperature_C or p["T0"], p["T0"])
                ]
                phi *= 1.0 - p["d"] * (at[0] - at[1])
            case "ageing.linear":
                phi *= 1.0 + p["rate"] * p["n"]
            case "ageing.logarithmic":
                phi *= 1.0 + p["rate"] * log(1.0 + p["n"])
            case "payne.network":
                phi *= 1.0 - p["d"] * _network(p, h, du)
            case "mullins.damage":
                phi *= 1.0 - p["m"] * (1.0 - np.exp(-((largest / p["r"]) ** p["p"])))
            case "degradation.path":
                phi *= 1.0 - p["d"] * (path / p["S"]) ** p["p"]
            case "hardening.power":
                beside += p["k"] * u * (np.abs(u) / p["r"]) ** (p["p"] - 1.0)
            case "hardening.threshold":
                beside += p["k"] * np.maximum(np.abs(u) - p["u0"], 0.0) * np.sign(u)
            case "one_sided.factor":
                phi *= np.where(p["side"] * u > 0.0, 1.0 + p["b"], 1.0)
            case "one_sided.spring":
                beside += p["k"] * np.maximum(p["side"] * u - p["u0"], 0.0) * p["side"]
            case "one_sided.contact":
                x = np.maximum(p["side"] * u - p["u0"], 0.0)
                beside += p["side"] * p["k"] * x * (x / p["r"]) ** (p["n"] - 1.0)
            case "one_sided.even":
                beside += p["k"] * p["r"] * (np.abs(u) / p["r"]) ** p["n"]
            case "relaxation_branch.maxwell":
                beside += _branch(p, h, v)
            case "velocity_exponent.dashpot":
                beside += p["c"] * np.abs(v) ** p["alpha"] * np.sign(v)
            case "velocity_exponent.flow":
                beside += p["f"] * np.arcsinh(v / p["v0"])
            case _:
                counted.append(one)
    return _with_work(counted, phi * law_force, beside, h, du)


def _broken(p: dict[str, float], h: np.ndarray, u: np.ndarray) -> np.ndarray:
    a = np.empty_like(u)
    a[0] = abs(u[0])
    for i, step in enumerate(h):
        a[i + 1] = max(abs(u[i + 1]), a[i] * exp(-step / p["tau_a"]))
    ratio = (a / p["a0"]) ** p["m"]
    return ratio / (1.0 + ratio)


def _network(p: dict[str, float], h: np.ndarray, du: np.ndarray) -> np.ndarray:
    """x' = (1 - x) |v|/s0 - x/tau, |v| constant over a step."""
    x = np.zeros(h.size + 1)
    for i, step in enumerate(h):
        breaks, heals = abs(du[i]) / step / p["s0"], 1.0 / p["tau"]
        steady = breaks / (breaks + heals)
        x[i + 1] = steady + (x[i] - steady) * exp(-(breaks + heals) * step)
    return x


def _branch(p: dict[str, float], h: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Q' + Q/tau = k v: the particular solution of a linear velocity is k tau (v - tau v')."""
    k, tau = p["k"], p["tau"]
    q = np.zeros_like(v)
    for i, step in enumerate(h):
        slope = (v[i + 1] - v[i]) / step
        q[i + 1] = exp(-step / tau) * (q[i] - k * tau * (v[i] - tau * slope)) + k * tau * (v[i + 1] - tau * slope)
    return q


def _with_work(
    counted: Sequence[Amendment], force: np.ndarray, beside: np.ndarray, h: np.ndarray, du: np.ndarray
) -> np.ndarray:
    """Times the factors of work and heat, which act from the next sample on, and what stands beside."""
    state = [0.0] * len(counted)
    found = np.empty_like(force)
    for i in range(force.size):
        phi = 1.0
        for one, x in zip(counted, state, strict=True):
            p = one.values
            phi *= exp(-x) if one.name == "self_heating" else 1.0 - p["d"] * (1.0 - exp(-max(x, 0.0) / p["E0"]))
        found[i] = phi * force[i] + beside[i]
        if i == 0:
            continue
        work = 0.5 * (found[i - 1] + found[i]) * du[i - 1]
        for j, one in enumerate(counted):
            p = one.values
            heats = one.name == "self_heating"
            state[j] = state[j] * exp(-h[i - 1] / p["tau_h"]) + p["beta"] * work if heats else state[j] + work
    return found
